/* What a coupling expects of the exchange that comes.
 *
 * The instance runs ahead over it and comes back. What a master holds meanwhile moves each u, and so changes the means:
 * that is followed where it is known what the force has to accelerate there. */
#ifndef COUPLING_PREDICTION_H
#define COUPLING_PREDICTION_H

#include "state.h"

#if N_COUPLINGS > 0

/* By how much the slope of this u rises with the force, 0 if its inertia is not known. */
double coupling_response(const State *s, int across);

/* The mean of each through over the next exchange, of this size, with the inputs moving on. Where an inertia is known
 * the master is taken to hold the mean of the first, and `owed` more; it is found on the line through two trials. */
void coupling_predict(Instance *instance, double size, double owed, double means[]);

#endif
#endif
