/* Co-Simulation: the integrator steps that lead from one communication point towards the next. */
#ifndef ADVANCE_H
#define ADVANCE_H

#include "state.h"

/* What the caller learns, and may ask for, after each accepted integrator step: the values at `time` can be read then.
 * Returns where the step shall end at the latest: INFINITY if it shall go on. */
typedef double Intermediate(void *receiver, double time);

typedef struct {
    bool may_return_early;
    Intermediate *intermediate; /* NULL: not wanted */
    void *receiver;
} StepOptions;

/* From where the instance is to target, unless an event that waits for the caller, the caller or the model ends the way
 * before. False: why it has not arrived. */
bool advance_to(Instance *instance, double target, const StepOptions *options, Message *why);

/* To a time on the path of the course. */
void advance_follow(State *s, double time);

/* The course has overlooked that a surface is crossed: the same from `start`, or where the course begins, by steps that
 * end at target. */
bool advance_again(Instance *instance, double start, double target, const StepOptions *options, Message *why);

#endif
