/* Whether the time of an event has come. Callers sum up their communication points, and two ways to compute one time
 * differ by rounding: an event that is ahead by no more than that, relatively, is there. */
#ifndef EVENT_TIME_H
#define EVENT_TIME_H

#include <float.h>
#include <math.h>
#include <stdbool.h>

static const double SAME_TIME = 8.0 * DBL_EPSILON;

static inline bool is_there(double event, double time) { return event - time <= SAME_TIME * fabs(time); }

/* Zero if it is there. */
static inline double time_left(double event, double time) { return is_there(event, time) ? 0.0 : event - time; }

#endif
