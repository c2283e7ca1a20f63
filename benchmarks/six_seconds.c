/* CPU time of figure 8's six seconds through the FMI 2 functions, and of the arithmetic alone that they take.
 *
 *     six_seconds GUID BRAKE_TORQUE COMPRESSION TOLERANCE RUNS      the second and third are value references
 *
 * Linked with the sources of the FMU, whose headers tell the counters and the linear algebra. Runs and arithmetic
 * alternate, so that both see the same machine. Prints "name value" lines, then the compression at every 10 ms. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fmi2_component.h"
#include "lu.h"
#include "rodas5p.h"

static const double DURATION = 6.0; /* s */

enum { STEPS = 600, MAX_RUNS = 10000, KINDS = 5 };

static const char *const kind_name[KINDS] = {"right-hand side", "Jacobian", "factorization", "solution", "outputs"};

typedef struct {
    Variables v; /* half-way through the run */
    bool holds[AT_LEAST_ONE(N_RELATIONS)];
    long count[KINDS]; /* how many a run takes; outputs are not among what the requirement counts */
    double jacobian[AT_LEAST_ONE(N_JACOBIAN)];
} Arithmetic;

static double now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The CPU time of a run in seconds; NaN if it failed. */
static double run(fmi2Component c, const fmi2ValueReference references[], double tolerance, double compression[],
                  Arithmetic *taken)
{
    const double torque = 1000.0;
    const double size = 0.01;
    const Instance *instance = c;
    const double start = now();
    bool fine = fmi2Reset(c) == fmi2OK &&
                fmi2SetupExperiment(c, fmi2True, tolerance, 0.0, fmi2True, DURATION) == fmi2OK &&
                fmi2EnterInitializationMode(c) == fmi2OK && fmi2ExitInitializationMode(c) == fmi2OK &&
                fmi2SetReal(c, &references[0], 1, &torque) == fmi2OK &&
                fmi2GetReal(c, &references[1], 1, &compression[0]) == fmi2OK;
    for (int i = 0; i < STEPS && fine; i++) {
        fine = fmi2DoStep(c, i * size, size, fmi2True) == fmi2OK &&
               fmi2GetReal(c, &references[1], 1, &compression[i + 1]) == fmi2OK;
        if (taken != NULL && i == STEPS / 2) {
            taken->v = instance->state.v;
            memcpy(taken->holds, instance->state.holds, sizeof taken->holds);
        }
    }
    return fine ? now() - start : (double)NAN;
}

/* What the counters say that a run takes, and a right-hand side at each communication point: steps go on across them,
 * and the accelerations there are asked for. Each trial of a step has one factorization and a solution for each stage;
 * its first stage uses the right-hand side of the step's start. */
static void count(Arithmetic *taken, const Counters *n)
{
    const long trials = (long)(n->evaluations - n->jacobians) / (RODAS_STAGES - 1);
    const long counts[KINDS] = {(long)n->evaluations + STEPS, (long)n->jacobians, trials, trials * RODAS_STAGES, STEPS};
    double time_derivative[AT_LEAST_ONE(N_STATES)];
    memcpy(taken->count, counts, sizeof counts);
    model_jacobian(&taken->v, taken->holds, taken->jacobian, time_derivative);
}

/* CPU times in seconds of each kind of arithmetic, as often as a run takes it. */
static void calculate(const Arithmetic *taken, double times[])
{
    static volatile double sink;
    static _Alignas(64) Variables v; /* static: where the system puts the stack must not matter */
    static _Alignas(64) double jacobian[AT_LEAST_ONE(N_JACOBIAN)];
    static _Alignas(64) double factors[AT_LEAST_ONE(N_FACTORS)];
    static _Alignas(64) double vector[AT_LEAST_ONE(N_STATES)];
    v = taken->v;
    for (int kind = 0; kind < KINDS; kind++) {
        const double start = now();
        for (long i = 0; i < taken->count[kind]; i++) {
            if (kind == 0) {
                model_derivatives(&v, taken->holds);
            } else if (kind == 1) {
                model_jacobian(&v, taken->holds, jacobian, vector);
            } else if (kind == 2) {
                sink = lu_factorize(taken->jacobian, 1.0 / (RODAS_GAMMA * 0.01), factors) ? factors[0] : 0.0;
            } else if (kind == 3) { /* with the factors of the last kind */
                lu_solve(factors, &v.at[FIRST_STATE], vector);
                sink = vector[0];
            } else {
                model_outputs(&v, taken->holds);
            }
        }
        times[kind] = now() - start;
    }
    (void)sink;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double values[], int n)
{
    qsort(values, (size_t)n, sizeof values[0], ascending);
    return values[n / 2];
}

int main(int argc, char **argv)
{
    static double compression[STEPS + 1];
    static double total[MAX_RUNS], ratio[MAX_RUNS], each[KINDS][MAX_RUNS];
    static Arithmetic taken;
    if (argc != 6) {
        return 2;
    }
    const fmi2ValueReference references[] = {(fmi2ValueReference)strtoul(argv[2], NULL, 10),
                                             (fmi2ValueReference)strtoul(argv[3], NULL, 10)};
    const double tolerance = strtod(argv[4], NULL);
    const int runs = (int)strtol(argv[5], NULL, 10);
    const fmi2CallbackFunctions silent = {0};
    fmi2Component c = fmi2Instantiate("six seconds", fmi2CoSimulation, argv[1], NULL, &silent, fmi2False, fmi2False);
    if (c == NULL || runs < 1 || runs > MAX_RUNS || isnan(run(c, references, tolerance, compression, &taken))) {
        return 1;
    }
    const Counters n = ((const Instance *)c)->state.integrator.counters;
    count(&taken, &n);
    for (int i = 0; i < runs; i++) {
        double times[KINDS];
        total[i] = run(c, references, tolerance, compression, NULL);
        calculate(&taken, times);
        ratio[i] = total[i] / (times[0] + times[1] + times[2] + times[3]);
        for (int kind = 0; kind < KINDS; kind++) {
            each[kind][i] = times[kind];
        }
    }
    (void)printf("total %.6g\nratio %.6g\nbytes %zu\n", median(total, runs), median(ratio, runs), sizeof(Component));
    (void)printf("steps %ld\nrejected %ld\nrepeated %ld\nevents %ld\n", (long)n.steps, (long)n.rejected,
                 (long)n.repeated, (long)n.events);
    for (int kind = 0; kind < KINDS; kind++) {
        (void)printf("%s:%ld %.6g\n", kind_name[kind], taken.count[kind], median(each[kind], runs));
    }
    for (int i = 0; i <= STEPS; i++) {
        (void)printf("compression %.17g\n", compression[i]);
    }
    fmi2FreeInstance(c);
    return 0;
}
