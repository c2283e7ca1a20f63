/* The loop of sampler.py compiled, since calls out of Python are dear: steps of a unit of FMI 2 for co-simulation and
 * readings of the same variables after each. It knows the standard's two functions and nothing of the unit. */
#include <stddef.h>

#ifdef _WIN32
#define EXPORTED __declspec(dllexport)
#else
#define EXPORTED __attribute__((visibility("default")))
#endif

typedef void *Component;
typedef int Status; /* fmi2OK, fmi2Warning, and worse */
typedef Status DoStep(Component, double time, double size, int no_set_state_prior_to_time);
typedef Status GetReal(Component, const unsigned references[], size_t count, double values[]);

enum { WARNING = 1, TRUE = 1 };

typedef struct {
    DoStep *do_step;
    GetReal *get_real;
    Component unit;
    const unsigned *references; /* (count,) */
    size_t count;
    const double *times; /* s (points,) */
    double *values;      /* (points, count) */
} Sampling;

EXPORTED Status sample(const Sampling *s, size_t begin, size_t end, const char **refusing);

/* From the point `begin` on to the point `end`; the values at `begin` have been read. The status that ends it, and in
 * `refusing` the function that gave it. */
Status sample(const Sampling *s, size_t begin, size_t end, const char **refusing)
{
    for (size_t i = begin; i < end; i++) {
        Status status = s->do_step(s->unit, s->times[i], s->times[i + 1] - s->times[i], TRUE);
        if (status > WARNING) {
            *refusing = "fmi2DoStep";
            return status;
        }
        status = s->get_real(s->unit, s->references, s->count, s->values + (i + 1) * s->count);
        if (status > WARNING) {
            *refusing = "fmi2GetReal";
            return status;
        }
    }
    return 0;
}
