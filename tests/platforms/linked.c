/* The sources of three units, in both versions of FMI, linked into one program: car and trailer coupled against the
 * whole. units.h, which the test writes, has the tokens and value references. Prints the largest distances between the
 * two. */
#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include "fmi2FunctionTypes.h"
#include "fmi3FunctionTypes.h"
#include "units.h"

#define DECLARE2(unit)                                                                                                 \
    fmi2InstantiateTYPE unit##_fmi2Instantiate;                                                                        \
    fmi2SetupExperimentTYPE unit##_fmi2SetupExperiment;                                                                \
    fmi2EnterInitializationModeTYPE unit##_fmi2EnterInitializationMode;                                                \
    fmi2ExitInitializationModeTYPE unit##_fmi2ExitInitializationMode;                                                  \
    fmi2SetRealTYPE unit##_fmi2SetReal;                                                                                \
    fmi2GetRealTYPE unit##_fmi2GetReal;                                                                                \
    fmi2DoStepTYPE unit##_fmi2DoStep;                                                                                  \
    fmi2FreeInstanceTYPE unit##_fmi2FreeInstance;

#define DECLARE3(unit)                                                                                                 \
    fmi3InstantiateCoSimulationTYPE unit##_fmi3InstantiateCoSimulation;                                                \
    fmi3EnterInitializationModeTYPE unit##_fmi3EnterInitializationMode;                                                \
    fmi3ExitInitializationModeTYPE unit##_fmi3ExitInitializationMode;                                                  \
    fmi3SetFloat64TYPE unit##_fmi3SetFloat64;                                                                          \
    fmi3GetFloat64TYPE unit##_fmi3GetFloat64;                                                                          \
    fmi3DoStepTYPE unit##_fmi3DoStep;                                                                                  \
    fmi3FreeInstanceTYPE unit##_fmi3FreeInstance;

typedef struct {
    void *instance;
    void (*start)(void *);
    void (*set)(void *, unsigned, double);
    double (*get)(void *, unsigned);
    void (*step)(void *, double, double);
    void (*end)(void *);
} Unit;

static void demand(int is_true, const char *what)
{
    if (!is_true) {
        fprintf(stderr, "%s failed\n", what);
        exit(1);
    }
}

static void ignore2(fmi2ComponentEnvironment e, fmi2String i, fmi2Status s, fmi2String c, fmi2String m, ...)
{
    (void)e, (void)i, (void)s, (void)c, (void)m;
}

static const fmi2CallbackFunctions callbacks = {ignore2, calloc, free, NULL, NULL};

#define DEFINE2(unit, token)                                                                                           \
    static void unit##_start2(void *c)                                                                                 \
    {                                                                                                                  \
        demand(unit##_fmi2SetupExperiment(c, fmi2True, 1e-8, 0.0, fmi2False, 0.0) == fmi2OK, #unit " set-up");         \
        demand(unit##_fmi2EnterInitializationMode(c) == fmi2OK, #unit " initialization");                              \
        demand(unit##_fmi2ExitInitializationMode(c) == fmi2OK, #unit " initialization");                               \
    }                                                                                                                  \
    static void unit##_set2(void *c, unsigned r, double x)                                                             \
    {                                                                                                                  \
        demand(unit##_fmi2SetReal(c, &r, 1, &x) == fmi2OK, "set");                                                     \
    }                                                                                                                  \
    static double unit##_get2(void *c, unsigned r)                                                                     \
    {                                                                                                                  \
        double x = NAN;                                                                                                \
        demand(unit##_fmi2GetReal(c, &r, 1, &x) == fmi2OK, "get");                                                     \
        return x;                                                                                                      \
    }                                                                                                                  \
    static void unit##_step2(void *c, double t, double h)                                                              \
    {                                                                                                                  \
        demand(unit##_fmi2DoStep(c, t, h, fmi2True) == fmi2OK, #unit " step");                                         \
    }                                                                                                                  \
    static Unit unit##_open2(void)                                                                                     \
    {                                                                                                                  \
        void *c = unit##_fmi2Instantiate(#unit, fmi2CoSimulation, token, "", &callbacks, fmi2False, fmi2False);        \
        demand(c != NULL, #unit " instantiation");                                                                     \
        return (Unit){c, unit##_start2, unit##_set2, unit##_get2, unit##_step2, unit##_fmi2FreeInstance};              \
    }

#define DEFINE3(unit, token)                                                                                           \
    static void unit##_start3(void *c)                                                                                 \
    {                                                                                                                  \
        demand(unit##_fmi3EnterInitializationMode(c, true, 1e-8, 0.0, false, 0.0) == fmi3OK, #unit " initialization"); \
        demand(unit##_fmi3ExitInitializationMode(c) == fmi3OK, #unit " initialization");                               \
    }                                                                                                                  \
    static void unit##_set3(void *c, unsigned r, double x)                                                             \
    {                                                                                                                  \
        demand(unit##_fmi3SetFloat64(c, &r, 1, &x, 1) == fmi3OK, "set");                                               \
    }                                                                                                                  \
    static double unit##_get3(void *c, unsigned r)                                                                     \
    {                                                                                                                  \
        double x = NAN;                                                                                                \
        demand(unit##_fmi3GetFloat64(c, &r, 1, &x, 1) == fmi3OK, "get");                                               \
        return x;                                                                                                      \
    }                                                                                                                  \
    static void unit##_step3(void *c, double t, double h)                                                              \
    {                                                                                                                  \
        fmi3Boolean event, end, early;                                                                                 \
        fmi3Float64 reached;                                                                                           \
        demand(unit##_fmi3DoStep(c, t, h, true, &event, &end, &early, &reached) == fmi3OK, #unit " step");             \
    }                                                                                                                  \
    static Unit unit##_open3(void)                                                                                     \
    {                                                                                                                  \
        void *c = unit##_fmi3InstantiateCoSimulation(#unit, token, NULL, false, false, false, false, NULL, 0, NULL,    \
                                                     NULL, NULL);                                                      \
        demand(c != NULL, #unit " instantiation");                                                                     \
        return (Unit){c, unit##_start3, unit##_set3, unit##_get3, unit##_step3, unit##_fmi3FreeInstance};              \
    }

DECLARE2(Car)
DECLARE2(Trailer)
DECLARE2(CarTrailer)
DECLARE3(Car)
DECLARE3(Trailer)
DECLARE3(CarTrailer)
DEFINE2(Car, CAR_2)
DEFINE2(Trailer, TRAILER_2)
DEFINE2(CarTrailer, WHOLE_2)
DEFINE3(Car, CAR_3)
DEFINE3(Trailer, TRAILER_3)
DEFINE3(CarTrailer, WHOLE_3)

/* Largest distance between the compressions of the pair and of the whole, in m. */
static double run(Unit car, Unit trailer, Unit whole)
{
    const double h = 1e-3;
    double worst = 0.0;
    car.set(car.instance, CAR_BRAKE_TORQUE, 1000.0);
    whole.set(whole.instance, WHOLE_BRAKE_TORQUE, 1000.0);
    car.start(car.instance);
    trailer.start(trailer.instance);
    whole.start(whole.instance);
    for (int n = 0; n < 3000; n++) {
        const double force = trailer.get(trailer.instance, TRAILER_F_HITCH_HOLD), t = n * h;
        const double speed = car.get(car.instance, CAR_V_CAR), acceleration = car.get(car.instance, CAR_A_CAR);
        car.set(car.instance, CAR_F_HITCH, force);
        trailer.set(trailer.instance, TRAILER_V_CAR, speed);
        trailer.set(trailer.instance, TRAILER_A_CAR, acceleration);
        car.step(car.instance, t, h);
        trailer.step(trailer.instance, t, h);
        whole.step(whole.instance, t, h);
        worst = fmax(worst, fabs(trailer.get(trailer.instance, TRAILER_COMPRESSION) -
                                 whole.get(whole.instance, WHOLE_COMPRESSION)));
    }
    car.end(car.instance);
    trailer.end(trailer.instance);
    whole.end(whole.instance);
    return worst;
}

int main(void)
{
    printf("%.3e\n", run(Car_open2(), Trailer_open2(), CarTrailer_open2()));
    printf("%.3e\n", run(Car_open3(), Trailer_open3(), CarTrailer_open3()));
    return 0;
}
