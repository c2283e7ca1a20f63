/* Derivatives of what is calculated with respect to what is known, at the present point and with the truths held.
 *
 * Known are the time, inputs, parameters that may change, and states; during initialization also parameters of start
 * values, but not the states that follow from them. Unknown may be all that is calculated, and states and inputs, as
 * outputs may be equal to them. */
#ifndef DERIVATIVES_H
#define DERIVATIVES_H

#include "instance.h"

typedef struct {
    const unsigned *references;
    size_t n;
} References;

/* seed: one number for each known; sensitivity: one for each unknown. */
Status instance_directional(Instance *instance, References unknown, References known, const double seed[],
                            double sensitivity[]);

/* seed: one number for each unknown; sensitivity: one for each known. */
Status instance_adjoint(Instance *instance, References unknown, References known, const double seed[],
                        double sensitivity[]);

/* First derivatives with respect to time, along the solution; inputs move as in the step that has ended, or as has been
 * set for the next one. orders: of each, must be 1. */
Status instance_time_derivatives(Instance *instance, References variables, const int orders[], double values[]);

/* What a variable depends on, by the structure of the equations: the first `room` references, and how many there are.
 * At the start these are settable start values, parameters, inputs and time; later states, inputs and time. */
Status instance_dependencies(Instance *instance, unsigned reference, unsigned independents[], size_t room,
                             size_t *count);

#endif
