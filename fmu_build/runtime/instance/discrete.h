/* Discrete variables: what an event changes beside the truths of relations, and the times at which events are due.
 *
 * At an event all discrete variables are computed from their values before it; then those become the values before, and
 * so on until nothing changes. A model without discrete variables (HAS_EVENTS 0) pays nothing for this. */
#ifndef DISCRETE_H
#define DISCRETE_H

#include <math.h>

#include "state.h"

#if HAS_EVENTS

/* Make truths and discrete variables agree with each other, the values before staying as they are. By sign: truths are
 * told by the residuals' signs alone; otherwise a residual that is zero but for rounding leaves its truth as it is.
 * False: what does not come to rest. */
bool discrete_settle(State *s, bool by_sign, Message *why);

/* Keep the values before an event of variables that are continuous; to be called before truths change. */
void discrete_remember(State *s);

/* There may be something to do at the time in v, and whether there is. */
static inline void discrete_expect(State *s) { s->discrete.pending = true; }
static inline bool discrete_is_pending(const State *s) { return s->discrete.pending; }

/* The event at s->v.time, whose truths are in s->holds: discrete variables and states get their new values. */
bool discrete_event(Instance *instance, Message *why);

/* Initialization is over: what has been computed becomes what was before. */
bool discrete_start(Instance *instance, Message *why);

/* The simulation is over: when terminal(). */
void discrete_terminate(Instance *instance);

/* The time of the next event that is known beforehand; INFINITY if there is none. */
double discrete_next_time(const State *s);

/* What makes events that are known beforehand so many: behind what is said of them. */
void discrete_explain_times(const State *s, Message *why);

/* Whether an event that is due at `next` is to be handled in a step to `time`: callers sum up their times. */
bool discrete_is_due_at(double time, double next);

/* Look at the checks (assertions) that concern any time. False: an error, and why. */
bool discrete_check(Instance *instance, Message *why);

/* The model has asked to end the simulation. */
static inline bool discrete_has_ended(const State *s) { return s->discrete.ended; }

/* Whether states have got new values at events since this was last asked. */
bool discrete_states_changed(State *s);

#else

static inline bool discrete_settle(State *s, bool by_sign, Message *why)
{
    return !by_sign || events_settle(&s->v, s->holds, why);
}

static inline void discrete_remember(State *s) { (void)s; }

static inline void discrete_expect(State *s) { (void)s; }

static inline bool discrete_is_pending(const State *s)
{
    (void)s;
    return false;
}

static inline bool discrete_event(Instance *instance, Message *why)
{
    (void)instance;
    (void)why;
    return true;
}

static inline bool discrete_start(Instance *instance, Message *why)
{
    (void)instance;
    (void)why;
    return true;
}

static inline void discrete_terminate(Instance *instance) { (void)instance; }

static inline double discrete_next_time(const State *s)
{
    (void)s;
    return (double)INFINITY;
}

static inline void discrete_explain_times(const State *s, Message *why)
{
    (void)s;
    (void)why;
}

static inline bool discrete_is_due_at(double time, double next)
{
    (void)time;
    (void)next;
    return false;
}

static inline bool discrete_check(Instance *instance, Message *why)
{
    (void)instance;
    (void)why;
    return true;
}

static inline bool discrete_has_ended(const State *s)
{
    (void)s;
    return false;
}

static inline bool discrete_states_changed(State *s)
{
    (void)s;
    return false;
}

#endif
#endif
