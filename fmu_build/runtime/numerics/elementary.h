/* Functions of the standard library that equal their argument where that is small, said before they are called.
 *
 * The curve of a tyre far from its limit takes six of them for each evaluation, a sixth of a run. Below the bound they
 * differ from the argument by less than half a unit in the last place: |x|^3 / 3 at most. */
#ifndef ELEMENTARY_H
#define ELEMENTARY_H

#include <math.h>

static const double EQUALS_ARGUMENT = 1e-8;

static inline double sine(double x) { return fabs(x) < EQUALS_ARGUMENT ? x : sin(x); }

static inline double arctangent(double x) { return fabs(x) < EQUALS_ARGUMENT ? x : atan(x); }

#endif
