/* Relations: their held truth values, and the points at which these change. */
#ifndef EVENTS_H
#define EVENTS_H

#include "message.h"
#include "model.h"
#include "rodas.h"

enum { NO_RELATION = -1 };

/* Evaluate all truths once at the point in v, from the truths that it has now. Not by sign: a residual that is zero but
 * for rounding leaves its truth as it is. A relation that has changed, or NO_RELATION. */
int events_take(Variables *v, bool holds[], bool by_sign);

/* The message about a relation that does not come to rest. */
void events_explain(int relation, double time, Message *why);

/* Evaluate all truths afresh at the point in v, repeatedly, because a relation may depend on another one's truth.
 * False if they do not come to rest (the message names a relation). */
bool events_settle(Variables *v, bool holds[], Message *why);

typedef struct {
    double fraction;                        /* of the trial's length, just behind the crossing; 0: at its start */
    bool truths[AT_LEAST_ONE(N_RELATIONS)]; /* there */
} Event;

/* Look in the last trial of r for the first point at which a truth differs from the held one. v serves as working
 * space.
 *
 * A trial may start exactly on a surface (z = 0), where a truth says nothing about where the solution goes. If the
 * truth soon differs and `leaving` allows it, the event is at the start, and its truth is that of the side gone to. */
bool events_find(const Rodas *r, Variables *v, const bool holds[], bool leaving, Event *event);

/* Does some truth at the point in v differ from the held one? */
bool events_have_changed(Variables *v, const bool holds[]);

/* Are the truths held those of the residuals in v, which are up to date? */
bool events_hold(const Variables *v, const bool holds[]);

/* Guards against events without end (sliding along a surface, accumulating events): over one communication step. */
typedef struct {
    double span; /* events_too_dense tolerates a batch of events in a longer time than this */
    double since;
    int count;
} EventDensity;

void events_watch(EventDensity *density, double time, double target);

/* To be called at each event, with the truths before and after it; the message names a relation. */
bool events_too_dense(EventDensity *density, double time, const bool before[], const bool after[], Message *why);

#endif
