/* Inputs that move linearly in time: u(t) = u(start) + slope * (t - start). */
#ifndef RAMP_H
#define RAMP_H

#include "model.h"

typedef struct {
    bool moves; /* some slope is not zero, and the step for which they were set is not over */
    double start;
    double from[AT_LEAST_ONE(N_INPUTS)];
    double slope[AT_LEAST_ONE(N_INPUTS)];
    bool given[AT_LEAST_ONE(N_INPUTS)]; /* the slope has been set, be it to zero */
    bool is_set;                        /* some slope is given */
    bool over; /* the slopes are those of the last step, and are forgotten when the next one begins */
} Ramp;

/* A slope for the next step. */
void ramp_set(Ramp *ramp, int input, double slope);

/* The inputs in v are those at the beginning of a step. */
void ramp_begin(Ramp *ramp, const Variables *v);

/* The value of an input that acts where it is given this one: beyond its range the limit does. */
double ramp_limited(int input, double value);

/* Inputs at v->time, during a step. Where one is led out of its range, it stays at the limit. */
void ramp_apply(const Ramp *ramp, Variables *v);

/* Their derivatives by time there, into d: 0 at a limit that is left outwards. */
void ramp_rates(const Ramp *ramp, const Variables *v, Variables *d);

/* The step is over: from now on the inputs are constant. */
void ramp_end(Ramp *ramp);

#endif
