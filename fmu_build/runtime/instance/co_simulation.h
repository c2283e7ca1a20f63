/* Co-Simulation: from one communication point to the next. */
#ifndef CO_SIMULATION_H
#define CO_SIMULATION_H

#include "instance.h"

/* What the caller learns, and may ask for, after each accepted integrator step: the values at `time` can be read then.
 * Returns where the step shall end at the latest: INFINITY if it shall go on. */
typedef double Intermediate(void *receiver, double time);

typedef struct {
    bool may_return_early;
    Intermediate *intermediate; /* NULL: not wanted */
    void *receiver;
} StepOptions;

typedef struct {
    bool event;  /* the caller has to handle it before the next step */
    bool early;  /* the step has ended before its end */
    bool ended;  /* because the model asks to end the simulation */
    double time; /* where it has ended */
} StepResult;

/* The slope of an input over the next step, which ends with it. */
Status instance_set_slopes(Instance *instance, const unsigned references[], size_t n, const double slopes[]);

/* Integrate from the communication point `time`, where the instance must be, to time + size. Events are left to the
 * caller if the instance is used so and the step may return early; otherwise they are handled on the way. */
Status instance_step(Instance *instance, double time, double size, const StepOptions *options, StepResult *result);

/* For coupling.c: integrate from where the instance is. False: why it has not arrived. */
bool stepping_integrate(Instance *instance, double target, const StepOptions *options, Message *why);

#endif
