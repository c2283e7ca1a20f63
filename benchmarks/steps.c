/* What each communication step takes through the FMI 2 functions: set an input, step, read nine outputs.
 *
 *     steps INPUT STEP DURATION RUNS      INPUT: constant, slow, brisk, braking; STEP and DURATION in s
 *
 * Linked with the sources of CarTrailer or Trailer. The input of CarTrailer is the brake torque, that of Trailer the
 * speed that the car would have. Runs repeat the same numbers, so that of each step the shortest time counts. Prints a
 * line "KIND count mean 99.9% worst rhs_mean rhs_worst" for each kind of steps, times in ns. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fmi2_component.h"

enum { MAX_STEPS = 100000, OUTPUTS = 9 };

typedef enum { ALL_STEPS, EVENT_STEP, SLOW_STEP, OTHER_STEP, KINDS } Kind;

static const char *const kind_name[KINDS] = {"all", "with an event", "below 1 m/s", "other"};

static const char *const outputs[2][OUTPUTS] = {{"v_car", "v_trailer", "a_car", "a_trailer", "compression", "F_hitch",
                                                 "slip_car", "slip_trailer", "trailer_brake_torque"},
                                                {"F_hitch", "F_hitch_mean", "F_hitch_hold", "coupling_energy",
                                                 "v_trailer", "a_trailer", "compression", "slip_trailer",
                                                 "trailer_brake_torque"}};

typedef struct {
    double time;
    long evaluations;
    Kind kind;
} Step;

static Step steps[MAX_STEPS];
static double input[MAX_STEPS];
static double sorted[MAX_STEPS];

static double now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static unsigned reference(const char *name)
{
    unsigned i = 0;
    while (i < N_VARIABLES && strcmp(variable_info[i].name, name) != 0) {
        i++;
    }
    return i;
}

/* N.m on the car's wheels. Braking: ten times for 0.6 s in 50 s, then down to standstill; a pedal takes 0.1 s. */
static double torque(const char *kind, double t)
{
    if (strcmp(kind, "braking") == 0) {
        const double since = t < 50.0 ? fmod(t, 5.0) : t - 50.0;
        const double until = t < 50.0 ? 0.6 - since : 1.0;
        return 1500.0 * fmax(0.0, fmin(1.0, 10.0 * fmin(since, until)));
    }
    return 1000.0 + (strcmp(kind, "slow") == 0 ? 10.0 : strcmp(kind, "brisk") == 0 ? 200.0 : 0.0) * sin(3.0 * t);
}

/* The trailer's is the speed of a car that the torque slows by 2.6 m/s2 at 1000 N.m. */
static void make_input(const char *kind, double size, int n, bool is_trailer)
{
    double speed = 40.0;
    for (int i = 0; i < n; i++) {
        input[i] = is_trailer ? speed : torque(kind, i * size);
        speed = fmax(0.0, speed - 2.6e-3 * size * torque(kind, (i + 0.5) * size));
    }
}

static bool run(fmi2Component c, double size, int n, bool is_trailer, bool first)
{
    const Integrator *m = &((const Instance *)c)->state.integrator;
    const unsigned set = reference(is_trailer ? "v_car" : "brake_torque");
    unsigned get[OUTPUTS];
    double values[OUTPUTS];
    for (int i = 0; i < OUTPUTS; i++) {
        get[i] = reference(outputs[is_trailer][i]);
    }
    bool fine = fmi2Reset(c) == fmi2OK && fmi2SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2False, 0.0) == fmi2OK &&
                fmi2EnterInitializationMode(c) == fmi2OK && fmi2SetReal(c, &set, 1, input) == fmi2OK &&
                fmi2ExitInitializationMode(c) == fmi2OK;
    for (int i = 0; i < n && fine; i++) {
        const Counters before = m->counters;
        const double start = now();
        fine = fmi2SetReal(c, &set, 1, &input[i]) == fmi2OK && fmi2DoStep(c, i * size, size, fmi2True) == fmi2OK &&
               fmi2GetReal(c, get, OUTPUTS, values) == fmi2OK;
        const double time = now() - start;
        const double speed = values[is_trailer ? 4 : 0];
        steps[i].time = first ? time : fmin(time, steps[i].time);
        steps[i].evaluations = (long)(m->counters.evaluations - before.evaluations);
        steps[i].kind = m->counters.events > before.events ? EVENT_STEP : fabs(speed) < 1.0 ? SLOW_STEP : OTHER_STEP;
    }
    return fine;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print(Kind kind, int n)
{
    int count = 0;
    double sum = 0.0;
    long evaluations = 0;
    long most = 0;
    for (int i = 0; i < n; i++) {
        if (kind == ALL_STEPS || steps[i].kind == kind) {
            sorted[count++] = steps[i].time;
            sum += steps[i].time;
            evaluations += steps[i].evaluations;
            most = steps[i].evaluations > most ? steps[i].evaluations : most;
        }
    }
    qsort(sorted, (size_t)count, sizeof sorted[0], ascending);
    if (count > 0) {
        (void)printf("%s: %d %.1f %.1f %.1f %.2f %ld\n", kind_name[kind], count, sum / count,
                     sorted[(int)(0.999 * (count - 1))], sorted[count - 1], (double)evaluations / count, most);
    }
}

int main(int argc, char **argv)
{
    const bool is_trailer = reference("brake_torque") == N_VARIABLES;
    const fmi2CallbackFunctions silent = {0};
    fmi2Component c = fmi2Instantiate("steps", fmi2CoSimulation, MODEL_TOKEN, NULL, &silent, fmi2False, fmi2False);
    if (argc != 5 || c == NULL) {
        return 2;
    }
    const double size = strtod(argv[2], NULL);
    const int n = (int)(strtod(argv[3], NULL) / size + 0.5);
    const int runs = (int)strtol(argv[4], NULL, 10);
    if (n < 1 || n > MAX_STEPS) {
        return 2;
    }
    make_input(argv[1], size, n, is_trailer);
    for (int i = 0; i < runs; i++) {
        if (!run(c, size, n, is_trailer, i == 0)) {
            return 1;
        }
    }
    for (int kind = 0; kind < KINDS; kind++) {
        print((Kind)kind, n);
    }
    fmi2FreeInstance(c);
    return 0;
}
