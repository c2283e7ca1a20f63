#include "coupling.h"

#if N_COUPLINGS > 0

#include <math.h>
#include <string.h>

#include "advance.h"
#include "coupling_values.h"
#include "finite.h"
#include "lu.h"
#include "settle.h"

/* A change of u over a step so much shorter than the next one is mostly rounding: the slope stays what it was. */
static const double TELLING = 1e-6;

/* What is owed is paid back over the longest of the last steps, each step forgetting so much. After one short step the
 * debt of long ones must not be asked for at once: the force of that would be held over a long step. */
static const double MEMORY = 0.9;

static double *across(State *s) { return &s->v.at[coupling_info.across]; }

static void begin_first(State *s)
{
    Coupling *c = &s->coupling;
    c->through = c->hold = s->v.at[coupling_info.through];
    c->impulse = s->v.at[coupling_info.impulse];
    c->work = s->v.at[coupling_info.work];
}

/* u was wrong by `error` at the end of the last step. On the way there, at the share s of the step, it was wrong by
 * error ((1 - q) s + q s^2): q is 0 if u was held while it moved steadily, 1 if its slope was right at the start, in
 * between if the slope was that of the step before. The integral of this, times df/du, is what the states lack; how
 * that has gone on until now is right to second order, and bounded where the model is stiff. */
static void correct(Instance *instance, double error)
{
    State *s = &instance->state;
    Rodas *r = &instance->rodas; /* room for the work */
    const Coupling *c = &s->coupling;
    const double q = c->size / (c->size + c->span);
    Variables d = {.at = {0.0}};
    d.at[coupling_info.across] = error * c->size * (0.5 - q / 6.0);
    model_tangent(&s->v, s->holds, false, &d);
    model_jacobian(&s->v, s->holds, r->jacobian, r->time_derivative);
    const double per_lag = (6.0 - 2.0 * q) / (c->size * (2.0 - q));
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

/* The slope of u that is expected, and over which time before the step it has been observed. */
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
    if (c->size < TELLING * size) {
        *span = c->span;
        return s->ramp.slope[coupling_info.across - FIRST_INPUT];
    }
    *span = c->size;
    return (s->v.at[coupling_info.across] - c->start) / c->size;
}

static void incline(State *s, double size)
{
    const int input = (int)coupling_info.across - FIRST_INPUT;
    Coupling *c = &s->coupling;
    c->moves = s->ramp.over || !s->ramp.given[input];
    c->span = 0.0;
    if (c->moves) {
        const double slope = expected_slope(s, size, &c->span);
        if (slope != 0.0 && isfinite(slope)) {
            ramp_set(&s->ramp, input, slope);
        }
    }
}

bool coupling_begin(Instance *instance, double size, Message *why)
{
    State *s = &instance->state;
    Coupling *c = &s->coupling;
    if (c->stepped && c->moves && !c->is_set && *across(s) != c->start) { /* it was not the caller who moved it */
        *across(s) = c->start;
        s->settled = s->current = false;
        integrator_discontinuity(&s->integrator);
    }
    if (!settle_variables(instance, why)) {
        return false;
    }
    if (!c->stepped) {
        begin_first(s);
    } else if (c->pending) {
        const double error = *across(s) - c->expected;
        const bool corrects = s->v.at[coupling_info.extrapolate] > 0.5;
        if (error != 0.0 && corrects) {
            correct(instance, error);
        }
        const double work = s->v.at[coupling_info.work];
        c->energy += c->applied * c->size * 0.5 * (c->start + *across(s)) - (work - c->work);
        c->work = work;
        c->pending = false;
    }
    incline(s, size);
    c->next_start = *across(s);
    return settle_truths(instance, why);
}

/* The mean over one more step as long as the last one, with the inputs moving on: the state goes there and back. */
static double predict(Instance *instance)
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
    events_watch(&s->density, start, start + s->coupling.size);
    if (advance_to(instance, start + s->coupling.size, &alone, &why) && s->v.time > start) {
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
    const double size = s->v.time - start;
    if (size > 0.0) { /* otherwise nothing has been transmitted: an event at the start has ended the step */
        const double transmitted = s->v.at[coupling_info.impulse] - c->impulse;
        const double choice = s->v.at[coupling_info.applied];
        c->mean = transmitted / size;
        c->applied = choice < 1.5 ? c->through : choice < 2.5 ? c->mean : c->hold;
        c->owed += choice >= 1.5 && choice < 2.5 ? 0.0 : transmitted - size * c->applied;
        c->size = size;
        c->period = fmax(size, MEMORY * c->period);
        c->start = c->next_start;
        c->expected = *across(s);
        c->through = s->v.at[coupling_info.through];
        c->impulse = s->v.at[coupling_info.impulse];
        c->hold = predict(instance) + c->owed / c->period;
        c->stepped = c->pending = true;
        c->is_set = false;
    }
    coupling_values_show(s);
}

#endif
