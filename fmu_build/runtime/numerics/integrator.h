/* Step-size control around Rodas5P, and events between its steps. */
#ifndef INTEGRATOR_H
#define INTEGRATOR_H

#include <stdint.h>

#include "brief.h"
#include "message.h"
#include "model.h"
#include "rodas.h"

typedef struct {
    int64_t steps;       /* accepted, those shortened to an event among them */
    int64_t rejected;    /* because of the error estimate, or of a value that is not finite */
    int64_t repeated;    /* good, but repeated with the length that ends at an event */
    int64_t evaluations; /* of the derivatives; at the start of a step, too, where the caller has had them computed */
    int64_t jacobians;
    int64_t events;
} Counters;

/* What has to be remembered from step to step. */
typedef struct {
    double length;         /* that the error control would choose next; 0: not known yet */
    double error_constant; /* error / length^5 of the last step; 0: not known */
    double left_surface;   /* last time at which a truth was decided by leaving a surface; only once at a time */
    bool has_left_surface;
    bool restart;  /* the next step is the first one behind a discontinuity */
    double behind; /* the length chosen behind the last discontinuity, if that was no event; 0: not known */
    int cuts;      /* so many steps have been cut to end at their target, with none between that was far from one */
    double brief;  /* up to this length the brief method may do; 0: nothing has been seen against it */
    BriefMatrix matrix;
    Counters counters;
} Integrator;

/* Where a step has arrived. */
typedef struct {
    double time;
    double state[AT_LEAST_ONE(N_STATES)];
    bool holds[AT_LEAST_ONE(N_RELATIONS)];
    bool event; /* some truths have changed; time may be that of the start */
} Point;

/* An input has been changed at once: what was learned about the error may not hold. */
void integrator_discontinuity(Integrator *m);

/* So has something on which the Jacobian may depend in any way (a parameter; an event). */
void integrator_forget(Integrator *m);

/* One accepted step from the point in v, at most to target, at most to the next event; the ramp moves the inputs;
 * the derivatives at the start may be known.
 * False: no step can be made. v serves as working space, and is left somewhere in the step: rodas_back(r, v) leads back
 * to its start. */
bool integrator_step(Integrator *m, Rodas *r, Variables *v, const bool holds[], const Ramp *ramp, bool derived,
                     double target, double tolerance, Point *arrival, Message *why);

/* The next step may be longer than what is asked for, so that states on its way will be: none is to be brief. */
void integrator_go_free(Integrator *m);

#endif
