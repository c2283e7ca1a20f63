/* What a unit adds of its own where a master of co-simulation exchanges values at communication points only.
 *
 * Each input u (across) goes on between two exchanges as it can be expected to, be it over one step or over several; at
 * the next one, where the truth is known, the states are corrected for the difference. What is given back for it
 * (through) has an integral among the states, the impulse, so that its mean since the exchange is known exactly; it is
 * also predicted for an exchange ahead, for masters that hold it, together with what such a master still owes. Where
 * the inertia is known that the first through, the force, has to accelerate at u, what is held tells how the slope of u
 * changes from one exchange to the next. The energy that the coupling makes is added up, exchange by exchange. Which
 * steps belong together: coupling_exchange.h.
 *
 * All this is for Co-Simulation. Without a coupling (N_COUPLINGS 0) it costs nothing. */
#ifndef COUPLING_H
#define COUPLING_H

#include "state.h"

#if N_COUPLINGS > 0

/* Before a step of `size`: if an exchange ends here settle it, now that u is known, and give u a slope. False: why the
 * instance cannot be there. */
bool coupling_begin(Instance *instance, double size, Message *why);

/* After a step that began at `start`, with all variables current. */
void coupling_end(Instance *instance, double start);

#else

static inline bool coupling_begin(Instance *instance, double size, Message *why)
{
    (void)instance;
    (void)size;
    (void)why;
    return true;
}

static inline void coupling_end(Instance *instance, double start)
{
    (void)instance;
    (void)start;
}

#endif
#endif
