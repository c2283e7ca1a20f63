/* What follows from what has been set: truths and start values, and all variables. */
#ifndef SETTLE_H
#define SETTLE_H

#include "state.h"

/* A parameter, an input or a start value has been changed: what depends on it is to follow. */
void settle_later(State *s, unsigned reference);

/* Parameters, truths and the start values that depend on them. False: why they do not settle. */
bool settle_truths(Instance *instance, Message *why);

/* These and all variables. */
bool settle_variables(Instance *instance, Message *why);

/* All variables, the truths being what they are. */
void settle_outputs(State *s);

/* The derivatives alone, as far as that takes less than to compute them anew: false if it does not. */
bool settle_derivatives(State *s);

#endif
