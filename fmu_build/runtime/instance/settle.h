/* What follows from what has been set: truths and start values, and all variables. */
#ifndef SETTLE_H
#define SETTLE_H

#include "state.h"

/* Parameters, truths and the start values that depend on them. False: why they do not settle. */
bool settle_truths(Instance *instance, Message *why);

/* These and all variables. */
bool settle_variables(Instance *instance, Message *why);

/* All variables, the truths being what they are. */
void settle_outputs(State *s);

#endif
