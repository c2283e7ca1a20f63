/* Derivatives of what is calculated with respect to what is known, at the present point and with the truths held.
 *
 * Known are the time, inputs, parameters that may change, and states; during initialization also parameters of start
 * values, but not the states that follow from them. Unknown may be all that is calculated, and states and inputs, as
 * outputs may be equal to them. */
#ifndef DERIVATIVES_H
#define DERIVATIVES_H

#include "calls.h"

typedef struct {
    const unsigned *references;
    size_t n;
} References;

/* The call `function`, with what it has to refuse. GET_DIRECTIONAL_DERIVATIVE: one seed for each known, one sensitivity
 * for each unknown; any other is the adjoint one, with a seed for each unknown and a sensitivity for each known. */
Status derivatives_chain(Instance *instance, int function, References unknown, References known, const double seed[],
                         size_t n_seed, double sensitivity[], size_t n_sensitivity);

/* The call GET_OUTPUT_DERIVATIVES, with what it has to refuse: first derivatives with respect to time, along the
 * solution; inputs move as in the step that has ended, or as has been set for the next one. orders: of each, must be
 * 1. */
Status derivatives_by_time(Instance *instance, References variables, const int orders[], double values[],
                           size_t n_values);

/* What a variable depends on, by the structure of the equations: the first `room` references, and how many there are.
 * At the start these are settable start values, parameters, inputs and time; later states, inputs and time. */
Status derivatives_dependencies(Instance *instance, unsigned reference, unsigned independents[], size_t room,
                                size_t *count);

#endif
