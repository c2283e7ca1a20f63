/* The variables of a coupling: its input when it is set, and its outputs, which are not those of the model's equations.
 */
#ifndef COUPLING_VALUES_H
#define COUPLING_VALUES_H

#include "state.h"

#if N_COUPLINGS > 0

/* A variable has been set. */
void coupling_values_note(State *s, unsigned reference);

/* To be called whenever the outputs have been calculated: puts those of the coupling in their place. */
void coupling_values_show(State *s);

/* The derivatives by time of those outputs are 0: they are given once for a step, whatever the flow does meanwhile. */
void coupling_values_still(const State *s, Variables *derivatives);

/* By how much the slope of an input rises with the force, 0 if its inertia is not known. */
double coupling_values_response(const State *s, int across);

#else

static inline void coupling_values_note(State *s, unsigned reference)
{
    (void)s;
    (void)reference;
}

static inline void coupling_values_show(State *s) { (void)s; }

static inline void coupling_values_still(const State *s, Variables *derivatives)
{
    (void)s;
    (void)derivatives;
}

#endif
#endif
