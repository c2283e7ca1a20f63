/* A run in one call: what a unit takes by itself for steps through communication points and outputs at each. */
#include <stddef.h>

typedef int DoStep(void *, double, double, int);
typedef int GetReal(void *, const unsigned *, size_t, double *);

/* Values (points, count) at the times (points,). Returns 0 or the status that ended it. */
int run(DoStep *do_step, GetReal *get_real, void *unit, const unsigned *references, size_t count, const double *times,
        size_t points, double *values)
{
    int status = get_real(unit, references, count, values);
    for (size_t i = 1; i < points && status == 0; i++) {
        status = do_step(unit, times[i - 1], times[i] - times[i - 1], 1);
        if (status == 0) {
            status = get_real(unit, references, count, values + i * count);
        }
    }
    return status;
}
