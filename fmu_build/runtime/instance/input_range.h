/* Real inputs beyond their ranges: a solver that varies an input, or a filter that undershoots, must not end a run. The
 * limit acts, and the caller is told. */
#ifndef INPUT_RANGE_H
#define INPUT_RANGE_H

#include "state.h"

/* The value that acts. A warning, once for each input, if `value` is beyond the range by more than rounding. */
double input_range_limited(Instance *instance, int input, double value);

/* The same warning for inputs that their slopes lead there in a step that ends at `end`. */
void input_range_look_ahead(Instance *instance, double end);

#endif
