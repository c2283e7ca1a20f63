/* The exchanges of a coupling: which steps are made between two of them, and what each does to the accounts.
 *
 * No call says that values are exchanged. A value of u is new if it is not the last one, or if the caller gives u a
 * slope: so it makes no difference whether a value is set once for several steps or again for each of them. One that
 * stands is still held, or it has been exchanged for an equal one; which of the two is judged by the exchanges before.
 */
#ifndef COUPLING_EXCHANGE_H
#define COUPLING_EXCHANGE_H

#include "state.h"

#if N_COUPLINGS > 0

/* The slope of this u in the next step is the caller's, not the unit's. */
bool coupling_exchange_has_slope(const State *s, int across);

/* The step of `size` that begins is one more of the present exchange. */
bool coupling_exchange_goes_on(const State *s, double size);

/* Before a step of `size` that is not: find where the exchange that ends here has begun after all. */
void coupling_exchange_review(State *s, double size);

/* The impulses transmitted so far. */
typedef struct {
    double of[N_THROUGH];
} Impulses;
Impulses coupling_exchange_impulses(const State *s);

/* What the master is taken to hold of one through over the exchange: over one that it makes with the mean, and that
 * has not been made, what is predicted of it. */
double coupling_exchange_held(const State *s, const Exchange *exchange, int through);

/* What follows where the instance is, after these impulses, on an exchange that began earlier. */
Exchange coupling_exchange_after(const State *s, const Exchange *from, const Impulses *impulses);

/* The next one begins, after these impulses, and with the work done so far. */
void coupling_exchange_next(State *s, const Impulses *impulses);

#endif
#endif
