/* The Jacobian, and the derivatives by time, at the start of a step. */
#ifndef GRADIENT_H
#define GRADIENT_H

#include "finite.h"
#include "model.h"
#include "ramp.h"

/* Exact, but where an exact one is not finite, as that of sqrt(x) at zero, the slope between two points beside it, or
 * between one and the point itself where the other has no value. Time and inputs move along the ramp. v and derivative
 * must be as model_derivatives has left them; v is left so. Returns FINITE, or the index of the first state whose
 * derivative has no finite slope. */
int gradient(const Ramp *ramp, Variables *v, const bool holds[], const double derivative[], double jacobian[],
             double time_derivative[]);

/* The derivatives by time alone, where inputs move along the ramp: the derivatives change through them too. */
void gradient_by_time(const Ramp *ramp, const Variables *v, const bool holds[], double time_derivative[]);

#endif
