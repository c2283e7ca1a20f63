#include "coupling.h"

#if N_COUPLINGS > 0

#include <math.h>
#include <string.h>

#include "advance.h"
#include "coupling_exchange.h"
#include "coupling_values.h"
#include "finite.h"
#include "lu.h"
#include "settle.h"

/* A change of u over an exchange so much shorter than the next one is mostly rounding: the slope stays what it was. */
static const double TELLING = 1e-6;

static double *across(State *s) { return &s->v.at[coupling_info.across]; }

/* u was wrong by `error` at the end of an exchange of this size. On the way there, at the share s of it, it was wrong
 * by error ((1 - q) s + q s^2): q is 0 if u was held while it moved steadily, 1 if its slope was right at the start, in
 * between if the slope was that of the exchange before. The integral of this, times df/du, is what the states lack; how
 * that has gone on until now is right to second order, and bounded where the model is stiff. */
static void correct(Instance *instance, double error, double size)
{
    State *s = &instance->state;
    Rodas *r = &instance->rodas; /* room for the work */
    const double q = size / (size + s->coupling.span);
    Variables d = {.at = {0.0}};
    d.at[coupling_info.across] = error * size * (0.5 - q / 6.0);
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
        s->settled = s->current = false;
        integrator_discontinuity(&s->integrator);
    }
}

static void put(State *s, double value)
{
    if (*across(s) != value) {
        *across(s) = value;
        s->settled = s->current = false;
    }
}

/* Inside an exchange u goes on, whether or not its value has been set again. */
static void go_on(State *s)
{
    Coupling *c = &s->coupling;
    c->parted = true;
    put(s, c->across);
    if (c->across != c->now.across) {
        integrator_discontinuity(&s->integrator);
    }
}

/* Settle the exchange that ends here, now that u is known, and begin the next one. */
static void exchange(Instance *instance, double size)
{
    State *s = &instance->state;
    const Coupling *c = &s->coupling;
    const double impulse = s->v.at[coupling_info.impulse];
    const double error = *across(s) - c->across;
    coupling_exchange_review(s, size);
    if (error != 0.0 && s->v.at[coupling_info.extrapolate] > 0.5) {
        correct(instance, error, s->v.time - c->now.time);
    }
    coupling_exchange_next(s, impulse);
}

static void begin_first(State *s)
{
    Coupling *c = &s->coupling;
    c->through = c->hold = s->v.at[coupling_info.through];
    c->now = (Exchange){.time = s->v.time,
                        .across = *across(s),
                        .through = c->through,
                        .hold = c->hold,
                        .impulse = s->v.at[coupling_info.impulse],
                        .work = s->v.at[coupling_info.work]};
    c->change = c->now;
}

/* The slope of u that is expected, and over which time before the exchange it has been observed. */
static double expected_slope(const State *s, double size, double *span)
{
    const Coupling *c = &s->coupling;
    const double given = s->v.at[coupling_info.across_derivative];
    if (given != 0.0) {
        *span = 0.0;
        return given;
    }
    if (!c->stepped || s->v.at[coupling_info.extrapolate] <= 0.5) {
        *span = (double)INFINITY;
        return 0.0;
    }
    if (s->v.time > c->now.time || c->interval < TELLING * size) {
        return c->slope;
    }
    *span = c->interval;
    return (c->now.across - c->before) / c->interval;
}

static void incline(State *s, double size)
{
    const int input = (int)coupling_info.across - FIRST_INPUT;
    Coupling *c = &s->coupling;
    c->moves = !coupling_exchange_has_slope(s);
    if (!c->moves) {
        c->span = 0.0;
        c->slope = s->ramp.slope[input];
        return;
    }
    const double slope = expected_slope(s, size, &c->span);
    c->slope = isfinite(slope) ? slope : 0.0;
    if (c->slope != 0.0) {
        ramp_set(&s->ramp, input, c->slope);
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
    if (c->moves && !c->is_set && *across(s) != c->now.across) { /* it was not the caller who moved it */
        put(s, c->now.across);
        integrator_discontinuity(&s->integrator);
    }
    if (!settle_variables(instance, why)) {
        return false;
    }
    if (s->v.time > c->now.time) {
        exchange(instance, size);
    } else { /* the last step has come to an end at once */
        c->now.across = *across(s);
        c->change.across = c->stands ? c->change.across : c->now.across;
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

/* The mean over one more exchange as long as the present one, with the inputs moving on: the state goes there and back.
 */
static double predict(Instance *instance, double size)
{
    static const StepOptions alone = {0};
    State *s = &instance->state;
    const double start = s->v.time;
    const double impulse = s->v.at[coupling_info.impulse];
    double mean = s->v.at[coupling_info.through];
    const bool logs = instance->logs[LOG_EVENT];
    Message why;
    memcpy(&instance->present, s, sizeof *s);
    instance->logs[LOG_EVENT] = false;
    memcpy(s->holds, s->next_holds, sizeof s->holds);
    s->event_waits = false;
    s->ramp.over = false;
    ramp_begin(&s->ramp, &s->v);
    events_watch(&s->density, start, start + size);
    if (advance_to(instance, start + size, &alone, &why) && s->v.time > start) {
        mean = (s->v.at[coupling_info.impulse] - impulse) / (s->v.time - start);
    }
    instance->logs[LOG_EVENT] = logs;
    memcpy(s, &instance->present, sizeof *s);
    return mean;
}

void coupling_end(Instance *instance, double start)
{
    State *s = &instance->state;
    Coupling *c = &s->coupling;
    if (s->v.time > start) { /* otherwise nothing has been transmitted: an event at the start has ended the step */
        const double size = s->v.time - c->now.time;
        const double impulse = s->v.at[coupling_info.impulse];
        c->mean = (impulse - c->now.impulse) / size;
        c->across = *across(s);
        c->through = s->v.at[coupling_info.through];
        const Exchange next = coupling_exchange_after(s, &c->now, impulse);
        c->hold = predict(instance, size) + next.owed / next.period;
        c->stepped = true;
        c->is_set = false;
    }
    coupling_values_show(s);
}

#endif
