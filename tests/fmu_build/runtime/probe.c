/* A window into the runtime for the tests: linked to the model under test, exported beside the FMI functions. */
#include <math.h>
#include <string.h>

#include "brief.h"
#include "gradient.h"
#include "grk4t.h"
#include "instance.h"

#if defined _WIN32
#define PROBE __declspec(dllexport)
#else
#define PROBE __attribute__((visibility("default")))
#endif

PROBE void probe_counters(const void *component, int64_t counters[6]);
PROBE size_t probe_state_size(void);
PROBE void probe_state(const void *component, void *state);
PROBE void probe_coefficients(double *gamma, double a[56], double c[56], double node[8], double d[8], double h[24]);
PROBE void probe_brief_coefficients(double *gamma, double a[6], double c[12], double weight[4], double error[4],
                                    double node[3], double d[4]);
PROBE void probe_brief_steps(double start, double end, int steps, int with_one_matrix, double x[], double fraction,
                             double dense[]);
PROBE int probe_first_not_finite(const double a[], int n);
PROBE void probe_fixed_steps(double start, double end, int steps, double x[], double fraction, double dense[],
                             double embedded[]);

/* A component begins with its instance. */
void probe_counters(const void *component, int64_t counters[6])
{
    const Counters *from = &((const Instance *)component)->state.integrator.counters;
    counters[0] = from->steps;
    counters[1] = from->rejected;
    counters[2] = from->repeated;
    counters[3] = from->evaluations;
    counters[4] = from->jacobians;
    counters[5] = from->events;
}

size_t probe_state_size(void) { return sizeof(State); }

void probe_state(const void *component, void *state)
{
    memcpy(state, &((const Instance *)component)->state, sizeof(State));
}

void probe_coefficients(double *gamma, double a[56], double c[56], double node[8], double d[8], double h[24])
{
    *gamma = RODAS_GAMMA;
    memcpy(a, RODAS_A, sizeof RODAS_A);
    memcpy(c, RODAS_C, sizeof RODAS_C);
    memcpy(node, RODAS_NODE, sizeof RODAS_NODE);
    memcpy(d, RODAS_D, sizeof RODAS_D);
    memcpy(h, RODAS_BEND, sizeof RODAS_BEND);
}

int probe_first_not_finite(const double a[], int n) { return first_not_finite(a, n); }

void probe_brief_coefficients(double *gamma, double a[6], double c[12], double weight[4], double error[4],
                              double node[3], double d[4])
{
    *gamma = GRK4T_GAMMA;
    memcpy(a, GRK4T_A, sizeof GRK4T_A);
    memcpy(c, GRK4T_C, sizeof GRK4T_C);
    memcpy(weight, GRK4T_WEIGHT, sizeof GRK4T_WEIGHT);
    memcpy(error, GRK4T_ERROR, sizeof GRK4T_ERROR);
    memcpy(node, GRK4T_NODE, sizeof GRK4T_NODE);
    memcpy(d, GRK4T_D, sizeof GRK4T_D);
}

/* By Rodas5P or, with a matrix, by the brief method, which makes a new one every few steps. */
static void fixed_steps(BriefMatrix *matrix, int with_one, Rodas *r, double start, double end, int steps)
{
    Variables v;
    const bool holds[AT_LEAST_ONE(N_RELATIONS)] = {false};
    const Ramp ramp = {.moves = false};
    for (int i = 0; i < N_VARIABLES; i++) {
        v.at[i] = variable_info[i].start;
    }
    const double length = (end - start) / steps;
    for (int step = 0; step < steps; step++) {
        v.time = start + (end - start) * step / steps;
        (void)rodas_start(r, &v, holds, &ramp, false);
        (void)gradient(&ramp, &v, holds, r->derivative, r->jacobian, r->time_derivative);
        if (matrix == NULL) {
            (void)rodas_try(r, length, &v, holds);
        } else {
            const bool is_new = step % with_one == 0;
            (void)(is_new && brief_factorize(matrix, r, length));
            (void)brief_try(r, matrix, length, is_new, &v, holds);
        }
        memcpy(&v.at[FIRST_STATE], r->path.end, N_STATES * sizeof(double));
    }
}

/* Equal steps from the model's start values; dense and embedded belong to the last step. */
void probe_fixed_steps(double start, double end, int steps, double x[], double fraction, double dense[],
                       double embedded[])
{
    Rodas r;
    fixed_steps(NULL, 0, &r, start, end, steps);
    rodas_bend(&r);
    rodas_dense(&r.path, fraction, dense);
    memcpy(x, r.path.end, N_STATES * sizeof(double));
    for (int i = 0; i < N_STATES; i++) {
        embedded[i] = r.path.end[i] - r.u[RODAS_STAGES - 1][i];
    }
}

/* The same, with a new matrix every few steps. */
void probe_brief_steps(double start, double end, int steps, int with_one_matrix, double x[], double fraction,
                       double dense[])
{
    Rodas r;
    BriefMatrix matrix;
    fixed_steps(&matrix, with_one_matrix, &r, start, end, steps);
    brief_bend(&r);
    rodas_dense(&r.path, fraction, dense);
    memcpy(x, r.path.end, N_STATES * sizeof(double));
}
