#include "coupling_exchange.h"

#if N_COUPLINGS > 0

#include <math.h>
#include <string.h>

/* The longest of the last exchanges is looked for, each forgetting so much. What is owed is paid back over it: after a
 * short one the debt of long ones must not be asked for at once, as the force of that would be held over a long one. */
static const double MEMORY = 0.9;

/* A value that stands for no more than FEW usual exchanges, and then changes, may have been held all the time. The
 * first time this is not believed; if it comes again within DOUBTS changes, it is. */
static const double FEW = 10.0;
enum { DOUBTS = 10 };

/* Where values are held over several steps, one that stands for so many usual exchanges has been exchanged. */
static const double PATIENCE = 2.0;

bool coupling_exchange_has_slope(const State *s, int across)
{
    return !s->ramp.over && s->ramp.given[coupling_info.across[across].input - FIRST_INPUT];
}

/* Neither in the last step nor in the next one does the caller give any u a slope. */
static bool is_without_slopes(const State *s)
{
    for (int i = 0; i < N_ACROSS; i++) {
        if (!s->coupling.moves[i] || coupling_exchange_has_slope(s, i)) {
            return false;
        }
    }
    return true;
}

static bool has_changed_input(const State *s)
{
    const Coupling *c = &s->coupling;
    for (int i = 0; i < N_ACROSS; i++) {
        if (c->is_set[i] && s->v.at[coupling_info.across[i].input] != c->now.across[i]) {
            return true;
        }
    }
    return !is_without_slopes(s);
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
        for (int i = 0; i < N_ACROSS; i++) {
            c->span[i] = (double)INFINITY;
        }
    }
}

static bool gets_mean(const State *s)
{
    return s->v.at[coupling_info.applied] >= 1.5 && s->v.at[coupling_info.applied] < 2.5;
}

Impulses coupling_exchange_impulses(const State *s)
{
    Impulses impulses;
    for (int i = 0; i < N_THROUGH; i++) {
        impulses.of[i] = s->v.at[coupling_info.through[i].impulse];
    }
    return impulses;
}

double coupling_exchange_held(const State *s, const Exchange *exchange, int through)
{
    return s->v.at[coupling_info.applied] < 1.5 ? exchange->through[through] : exchange->hold[through];
}

/* What the master has applied over the exchange that ends where the instance is. */
static double applied(const State *s, const Exchange *from, int through)
{
    return gets_mean(s) ? s->coupling.mean[through] : coupling_exchange_held(s, from, through);
}

Exchange coupling_exchange_after(const State *s, const Exchange *from, const Impulses *impulses)
{
    const Coupling *c = &s->coupling;
    const double size = s->v.time - from->time;
    double sum = 0.0; /* of u at the start and at the end */
    Exchange next = {
        .time = s->v.time, .work = s->v.at[coupling_info.work], .period = fmax(size, MEMORY * from->period)};
    for (int i = 0; i < N_ACROSS; i++) {
        next.across[i] = s->v.at[coupling_info.across[i].input];
        sum += coupling_info.across[i].sign * (from->across[i] + next.across[i]);
    }
    for (int i = 0; i < N_THROUGH; i++) {
        const double missing = impulses->of[i] - from->impulse[i] - size * applied(s, from, i);
        next.through[i] = c->through[i];
        next.hold[i] = c->hold[i];
        next.impulse[i] = impulses->of[i];
        next.owed[i] = from->owed[i] + (gets_mean(s) ? 0.0 : missing);
    }
    next.energy = from->energy + (applied(s, from, 0) * size * 0.5 * sum - (next.work - from->work));
    return next;
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

void coupling_exchange_next(State *s, const Impulses *impulses)
{
    Coupling *c = &s->coupling;
    const Exchange last = c->now;
    const bool news = has_changed_input(s);
    memcpy(c->before, last.across, sizeof c->before);
    c->interval = s->v.time - last.time;
    c->applied = applied(s, &last, 0);
    c->now = coupling_exchange_after(s, &last, impulses);
    if (news) {
        const bool may_be_held = !c->stands || has_stood_shortly(s);
        const bool whole = last.time == c->change.time;
        c->doubts = doubts_left(s);
        c->several = c->doubts > 0 && (c->several || (whole && (c->parted || c->stands)));
        c->usual = whole ? fmax(c->interval, MEMORY * c->usual) : c->usual;
        c->change = c->doubts > 0 && may_be_held ? coupling_exchange_after(s, &c->change, impulses) : c->now;
    }
    c->stands = !news;
    c->parted = false;
}

#endif
