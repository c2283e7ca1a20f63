/* What may be set, when, and to which values. */
#ifndef VALIDATION_H
#define VALIDATION_H

#include "state.h"

/* Each returns false with a message that names what is wrong. */
bool valid_reference(unsigned reference, Message *why);
bool valid_type(unsigned reference, ValueType type, Message *why);
bool valid_setting(unsigned reference, double value, Phase phase, Message *why); /* the value finite */
bool valid_range(unsigned reference, double value, Message *why);                /* see input_range.h for Real inputs */
bool valid_slope(unsigned reference, double slope, Message *why);
bool valid_result(unsigned reference, double value, double time, Message *why);
bool valid_experiment(const double *tolerance, double start, const double *stop, Message *why);
bool valid_step(const State *s, double time, double size, Message *why);

/* Why a variable is none of `type`, such as "a String": there is no such variable, or it is of another type. */
void explain_type(unsigned reference, const char *type, Message *why);

/* A communication point that is allowed is, but for rounding, where the instance is. */
bool same_point(const State *s, double time, double size);

/* Every state inside its range, but for the error that the tolerance allows. */
bool valid_states(const Point *p, double tolerance, Message *why);

/* Every variable finite. */
bool valid_variables(const Variables *v, Message *why);

#endif
