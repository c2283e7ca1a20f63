#include "coupling_exchange.h"

#if N_COUPLINGS > 0

#include <math.h>

/* The longest of the last exchanges is looked for, each forgetting so much. What is owed is paid back over it: after a
 * short one the debt of long ones must not be asked for at once, as the force of that would be held over a long one. */
static const double MEMORY = 0.9;

/* A value that stands for no more than FEW usual exchanges, and then changes, may have been held all the time. The
 * first time this is not believed; if it comes again within DOUBTS changes, it is. */
static const double FEW = 10.0;
enum { DOUBTS = 10 };

/* Where values are held over several steps, one that stands for so many usual exchanges has been exchanged. */
static const double PATIENCE = 2.0;

bool coupling_exchange_has_slope(const State *s)
{
    return !s->ramp.over && s->ramp.given[coupling_info.across - FIRST_INPUT];
}

/* Neither in the last step nor in the next one does the caller give u a slope. */
static bool is_without_slopes(const State *s) { return s->coupling.moves && !coupling_exchange_has_slope(s); }

static bool has_changed_input(const State *s)
{
    const Coupling *c = &s->coupling;
    return !is_without_slopes(s) || (c->is_set && s->v.at[coupling_info.across] != c->now.across);
}

/* Whether the present exchange has lasted as long as is to be expected, or will have by the middle of the step. */
static bool is_due(const State *s, double size)
{
    const Coupling *c = &s->coupling;
    const double longest = c->several ? PATIENCE * c->usual : c->interval;
    return s->v.time - c->now.time + 0.5 * size > longest;
}

bool coupling_exchange_goes_on(const State *s, double size)
{
    return s->v.time > s->coupling.now.time && !has_changed_input(s) && !is_due(s, size);
}

/* It is not long that the value has stood. */
static bool has_stood_shortly(const State *s)
{
    const Coupling *c = &s->coupling;
    return c->usual == 0.0 || s->v.time - c->change.time <= FEW * c->usual;
}

void coupling_exchange_review(State *s, double size)
{
    Coupling *c = &s->coupling;
    if (!has_changed_input(s) || !is_without_slopes(s)) {
        return;
    }
    if (!c->stands && c->parted) {
        c->now = c->change; /* the same exchange; so values are held, and were so before */
    } else if (c->stands && has_stood_shortly(s) && (c->doubts > 0 || !is_due(s, size))) {
        c->now = c->change; /* the value was held, and so was the force */
        c->span = (double)INFINITY;
    }
}

Exchange coupling_exchange_after(const State *s, const Exchange *from, double impulse)
{
    const Coupling *c = &s->coupling;
    const double u = s->v.at[coupling_info.across];
    const double work = s->v.at[coupling_info.work];
    const double choice = s->v.at[coupling_info.applied];
    const bool gets_mean = choice >= 1.5 && choice < 2.5;
    const double applied = gets_mean ? c->mean : choice < 1.5 ? from->through : from->hold;
    const double size = s->v.time - from->time;
    return (Exchange){
        .time = s->v.time,
        .across = u,
        .through = c->through,
        .hold = c->hold,
        .impulse = impulse,
        .work = work,
        .owed = from->owed + (gets_mean ? 0.0 : impulse - from->impulse - size * applied),
        .energy = from->energy + (applied * size * 0.5 * (from->across + u) - (work - from->work)),
        .period = fmax(size, MEMORY * from->period),
    };
}

/* After a change: for how many more ones values that stand are taken for such as are held. */
static int doubts_left(const State *s)
{
    const Coupling *c = &s->coupling;
    if (!is_without_slopes(s)) {
        return 0;
    }
    if (c->parted || (c->stands && has_stood_shortly(s))) {
        return DOUBTS;
    }
    return c->usual > 0.0 && c->doubts > 0 ? c->doubts - 1 : 0;
}

void coupling_exchange_next(State *s, double impulse)
{
    Coupling *c = &s->coupling;
    const Exchange last = c->now;
    const bool news = has_changed_input(s);
    c->before = last.across;
    c->interval = s->v.time - last.time;
    c->now = coupling_exchange_after(s, &last, impulse);
    if (news) {
        const bool may_be_held = !c->stands || has_stood_shortly(s);
        const bool whole = last.time == c->change.time;
        c->doubts = doubts_left(s);
        c->several = c->doubts > 0 && (c->several || (whole && (c->parted || c->stands)));
        c->usual = whole ? fmax(c->interval, MEMORY * c->usual) : c->usual;
        c->change = c->doubts > 0 && may_be_held ? coupling_exchange_after(s, &c->change, impulse) : c->now;
    }
    c->stands = !news;
    c->parted = false;
}

#endif
