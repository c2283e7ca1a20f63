#include "coupling.h"

#if N_COUPLINGS > 0

#include <math.h>
#include <string.h>

#include "coupling_exchange.h"
#include "coupling_prediction.h"
#include "coupling_values.h"
#include "finite.h"
#include "lu.h"
#include "settle.h"

/* A change of u over an exchange so much shorter than the next one is mostly rounding: the slope stays what it was. */
static const double TELLING = 1e-6;

static double *across(State *s, int i) { return &s->v.at[coupling_info.across[i].input]; }

/* Each u was wrong by an error at the end of an exchange of this size. The integral of that over the exchange, times
 * df/du, is what the states lack; how that has gone on until now is right to second order, and bounded where the model
 * is stiff. */
static void correct(Instance *instance, const double errors[], double size)
{
    State *s = &instance->state;
    Rodas *r = &instance->rodas; /* room for the work */
    Variables d = {.at = {0.0}};
    double q = 0.0;
    for (int i = 0; i < N_ACROSS; i++) {
        d.at[coupling_info.across[i].input] = errors[i] * size * (0.5 - coupling_exchange_bend(s, i, size) / 6.0);
        q += coupling_exchange_bend(s, i, size) / N_ACROSS;
    }
    model_input_tangent(&s->v, s->holds, &d);
    model_jacobian(&s->v, s->holds, r->jacobian, r->time_derivative);
    const double per_lag = (6.0 - 2.0 * q) / (size * (2.0 - q));
    if (!lu_factorize(r->jacobian, per_lag, r->factors)) {
        return;
    }
    lu_solve(r->factors, &d.at[FIRST_DERIVATIVE], r->path.end); /* (I - lag J) x = d: (I / lag - J) x = d / lag */
    for (int i = 0; i < N_STATES; i++) {
        r->path.end[i] = s->v.at[FIRST_STATE + i] + per_lag * r->path.end[i];
    }
    if (first_not_finite(r->path.end, N_STATES) == FINITE) {
        memcpy(&s->v.at[FIRST_STATE], r->path.end, N_STATES * sizeof(double));
        s->settled = false;
        s->freshness = STALE;
        integrator_discontinuity(&s->integrator);
    }
}

static void put(State *s, int i, double value)
{
    if (*across(s, i) != value) {
        *across(s, i) = value;
        settle_later(s, coupling_info.across[i].input);
    }
}

/* Inside an exchange u goes on, whether or not its value has been set again. */
static void go_on(State *s)
{
    Coupling *c = &s->coupling;
    c->parted = true;
    for (int i = 0; i < N_ACROSS; i++) {
        put(s, i, c->across[i]);
        if (c->across[i] != c->now.across[i]) {
            integrator_discontinuity(&s->integrator);
        }
    }
}

/* Settle the exchange that ends here, now that u is known, and begin the next one. */
static void exchange(Instance *instance, double size)
{
    State *s = &instance->state;
    const Coupling *c = &s->coupling;
    const Impulses impulses = coupling_exchange_impulses(s);
    double errors[N_ACROSS];
    bool wrong = false;
    for (int i = 0; i < N_ACROSS; i++) {
        errors[i] = *across(s, i) - c->across[i];
        wrong = wrong || errors[i] != 0.0;
    }
    coupling_exchange_review(s, size);
    if (wrong && s->v.at[coupling_info.extrapolate] > 0.5) {
        correct(instance, errors, s->v.time - c->now.time);
    }
    coupling_exchange_next(s, &impulses);
}

static void begin_first(State *s)
{
    Coupling *c = &s->coupling;
    c->now = (Exchange){.time = s->v.time, .work = s->v.at[coupling_info.work]};
    for (int i = 0; i < N_ACROSS; i++) {
        c->now.across[i] = *across(s, i);
    }
    for (int i = 0; i < N_THROUGH; i++) {
        const Through *through = &coupling_info.through[i];
        c->through[i] = c->hold[i] = s->v.at[through->output];
        c->now.through[i] = c->now.hold[i] = c->through[i];
        c->now.impulse[i] = s->v.at[through->impulse];
    }
    c->applied = c->through[0];
    c->change = c->now;
}

/* The slope of u that is expected, and over which time before the exchange it has been observed. What acts there beside
 * the force is taken to go on as it was. */
static double expected_slope(const State *s, int i, double size, double *span)
{
    const Coupling *c = &s->coupling;
    const double given = s->v.at[coupling_info.across[i].derivative];
    const bool extrapolates = c->stepped && s->v.at[coupling_info.extrapolate] > 0.5;
    const double more =
        extrapolates ? coupling_values_response(s, i) * (coupling_exchange_held(s, &c->now, 0) - c->applied) : 0.0;
    if (given != 0.0) {
        *span = 0.0;
        return given + more;
    }
    if (!extrapolates) {
        *span = (double)INFINITY;
        return 0.0;
    }
    if (s->v.time > c->now.time || c->interval < TELLING * size) {
        return c->slope[i];
    }
    *span = c->interval;
    return (c->now.across[i] - c->before[i]) / c->interval + more;
}

static void incline(State *s, double size)
{
    Coupling *c = &s->coupling;
    for (int i = 0; i < N_ACROSS; i++) {
        const int input = (int)coupling_info.across[i].input - FIRST_INPUT;
        c->moves[i] = !coupling_exchange_has_slope(s, i);
        if (!c->moves[i]) {
            c->span[i] = 0.0;
            c->slope[i] = s->ramp.slope[input];
            continue;
        }
        const double slope = expected_slope(s, i, size, &c->span[i]);
        c->slope[i] = isfinite(slope) ? slope : 0.0;
        if (c->slope[i] != 0.0) {
            ramp_set(&s->ramp, input, c->slope[i]);
        }
    }
}

/* Find where u is at the start of a step of `size`. False: why the instance cannot be there. */
static bool take_up(Instance *instance, double size, Message *why)
{
    State *s = &instance->state;
    Coupling *c = &s->coupling;
    if (coupling_exchange_goes_on(s, size)) {
        go_on(s);
        return settle_variables(instance, why);
    }
    for (int i = 0; i < N_ACROSS; i++) {
        if (c->moves[i] && !c->is_set[i] && *across(s, i) != c->now.across[i]) { /* not the caller has moved it */
            put(s, i, c->now.across[i]);
            integrator_discontinuity(&s->integrator);
        }
    }
    if (!settle_variables(instance, why)) {
        return false;
    }
    if (s->v.time > c->now.time) {
        exchange(instance, size);
    } else { /* the last step has come to an end at once */
        for (int i = 0; i < N_ACROSS; i++) {
            c->now.across[i] = *across(s, i);
            c->change.across[i] = c->stands ? c->change.across[i] : c->now.across[i];
        }
    }
    return true;
}

bool coupling_begin(Instance *instance, double size, Message *why)
{
    State *s = &instance->state;
    if (s->coupling.stepped) {
        if (!take_up(instance, size, why)) {
            return false;
        }
    } else if (settle_variables(instance, why)) {
        begin_first(s);
    } else {
        return false;
    }
    incline(s, size);
    return settle_truths(instance, why);
}

/* What to hold of each through over the next exchange: its mean, and what is owed, within its range. */
static void choose_holds(Instance *instance, double size, const Exchange *next)
{
    Coupling *c = &instance->state.coupling;
    double means[N_THROUGH];
    coupling_predict(instance, size, next->owed[0] / next->period, means);
    for (int i = 0; i < N_THROUGH; i++) {
        const VariableInfo *range = &variable_info[coupling_info.through[i].hold];
        c->hold[i] = fmin(range->max, fmax(range->min, means[i] + next->owed[i] / next->period));
    }
}

void coupling_end(Instance *instance, double start)
{
    State *s = &instance->state;
    Coupling *c = &s->coupling;
    if (s->v.time > start) { /* otherwise nothing has been transmitted: an event at the start has ended the step */
        const double size = s->v.time - c->now.time;
        const Impulses impulses = coupling_exchange_impulses(s);
        for (int i = 0; i < N_ACROSS; i++) {
            c->across[i] = *across(s, i);
            c->is_set[i] = false;
        }
        for (int i = 0; i < N_THROUGH; i++) {
            c->mean[i] = (impulses.of[i] - c->now.impulse[i]) / size;
            c->through[i] = s->v.at[coupling_info.through[i].output];
        }
        const Exchange next = coupling_exchange_after(s, &c->now, &impulses);
        choose_holds(instance, size, &next);
        c->stepped = true;
    }
    coupling_values_show(s);
}

#endif
