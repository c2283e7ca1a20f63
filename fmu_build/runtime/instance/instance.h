/* The life of an instance, from creation to its end, and its variables. The facades translate to and from it.
 *
 * Every function that can fail says why through the log, and changes nothing if it refuses its arguments. */
#ifndef INSTANCE_H
#define INSTANCE_H

#include "state.h"

/* Fills in *instance; errors and warnings are logged, events are not. */
void instance_create(Instance *instance, Use use, const Caller *caller);

/* Give back the caller's memory, of which the instance is the beginning. One that is in the middle of a step, in its
 * caller's hands, is not freed. */
void instance_free(Instance *instance);

/* Back to where instance_create left it, but for the log. */
void instance_reset(Instance *instance);

/* Tolerance and stop time: NULL if not given. */
Status instance_setup(Instance *instance, const double *tolerance, double start, const double *stop);
Status instance_enter_initialization(Instance *instance);
Status instance_exit_initialization(Instance *instance);
Status instance_terminate(Instance *instance);

/* Values by value reference: the index in Variables. All must be of that type. */
Status instance_get(Instance *instance, ValueType type, const unsigned references[], size_t n, double values[]);

/* Whether a value can be set: STATUS_ERROR if the variable cannot, or not to what is not finite, STATUS_DISCARD if it
 * is out of its range. A Real input never is: the limit acts, see input_range.h. */
Status instance_check(const Instance *instance, ValueType type, unsigned reference, double value);

/* Set what has been checked. */
void instance_set(Instance *instance, unsigned reference, double value);

#endif
