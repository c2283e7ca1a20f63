/* Co-Simulation: from one communication point to the next. */
#ifndef CO_SIMULATION_H
#define CO_SIMULATION_H

#include "advance.h"

typedef struct {
    bool event;  /* the caller has to handle it before the next step */
    bool early;  /* the step has ended before its end */
    bool ended;  /* because the model asks to end the simulation */
    double time; /* where it has ended */
} StepResult;

/* The slope of an input over the next step, which ends with it. */
Status co_simulation_set_slopes(Instance *instance, const unsigned references[], size_t n, const double slopes[]);

/* Integrate from the communication point `time`, where the instance must be, to time + size. Events are left to the
 * caller if the instance is used so and the step may return early; otherwise they are handled on the way.
 * STATUS_DISCARD: the step cannot be made, and the instance is as it was before the call. */
Status co_simulation_step(Instance *instance, double time, double size, const StepOptions *options, StepResult *result);

#endif
