/* The error of a step's trial, beside what the tolerance allows. */
#ifndef ERROR_H
#define ERROR_H

#include "rodas.h"

/* The error of a state's value that the tolerance allows. */
double error_allowed(int state, double value, double tolerance);

/* The largest error in the last trial relative to what is allowed. */
double error_norm(const Rodas *r, double tolerance);

/* Is it at most 1/weight? In about half of the time. */
bool error_is_below(const Rodas *r, double tolerance, double weight);

/* The state whose error is that; 0 if there are none. */
int error_worst_state(const Rodas *r, double tolerance);

/* The state that would leave what is allowed first, by its derivative at the start. */
int error_fastest_state(const Rodas *r, double tolerance);

#endif
