#include "model_exchange.h"

#include <math.h>
#include <string.h>

#include "discrete.h"
#include "log.h"
#include "loops.h"
#include "settle.h"
#include "validation.h"

/* Shift of an event indicator, times the nominal value of its residual: far below what a root finder locates. */
static const double INDICATOR_SHIFT = 1e-12;

Status model_exchange_enter_event_mode(Instance *instance)
{
    State *s = &instance->state;
    Message why;
    s->phase = EVENT_MODE;
    s->calm = s->course.open = false;
    discrete_remember(s);
    discrete_expect(s);
    if (s->event_waits) { /* the step has found out what the truths will be, and no fresh look would tell on a surface
                           */
        memcpy(s->holds, s->next_holds, sizeof s->holds);
        s->event_waits = false;
        s->freshness = STALE;
        if (!discrete_settle(s, false, &why)) {
            return log_error(instance, &why);
        }
    } else {
        s->settled = false;
        s->freshness = STALE;
    }
    return STATUS_OK;
}

Status model_exchange_evaluate_event(Instance *instance)
{
    Message why;
    return settle_variables(instance, &why) ? STATUS_OK : log_error(instance, &why);
}

/* An event that was set off, or left to the caller, and that has not been handled yet. */
static bool handle_event(Instance *instance, Message *why)
{
    return settle_truths(instance, why) && discrete_event(instance, why) && settle_variables(instance, why) &&
           discrete_check(instance, why);
}

Status model_exchange_handle_event(Instance *instance, EventResult *result)
{
    State *s = &instance->state;
    Message why;
    *result = (EventResult){.next_time = (double)INFINITY};
    if (!handle_event(instance, &why)) {
        return log_error(instance, &why);
    }
    *result = (EventResult){.ended = discrete_has_ended(s),
                            .states_changed = discrete_states_changed(s),
                            .next_time = discrete_next_time(s)};
    return STATUS_OK;
}

Status model_exchange_complete_step(Instance *instance)
{
    Message why;
    return discrete_check(instance, &why) ? STATUS_OK : log_error(instance, &why);
}

Status model_exchange_leave_event_mode(Instance *instance)
{
    State *s = &instance->state;
    Message why;
    const bool handled = !discrete_is_pending(s) || handle_event(instance, &why); /* a caller may have left that out */
    if (!handled || !settle_variables(instance, &why) || !valid_variables(&s->v, &why)) {
        return log_error(instance, &why);
    }
    s->phase = s->use == MODEL_EXCHANGE ? CONTINUOUS : STEPPING;
    return STATUS_OK;
}

Status model_exchange_set_time(Instance *instance, double time)
{
    State *s = &instance->state;
    Message why;
    if (!isfinite(time)) {
        message_write(&why, "time = %s is not allowed: it must be finite", quantity(time, "s").text);
        return log_error(instance, &why);
    }
    if (s->v.time != time) {
        s->freshness = STALE;
        s->settled = s->settled && s->phase == CONTINUOUS; /* in event mode truths follow */
        s->v.time = time;
    }
    return STATUS_OK;
}

Status model_exchange_set_states(Instance *instance, const double states[], size_t n)
{
    Message why;
    if (!call_has_array(instance, SET_CONTINUOUS_STATES, states, n, N_STATES)) {
        return STATUS_ERROR;
    }
    State *s = &instance->state;
    Point p = {.time = s->v.time};
    for (int i = 0; i < N_STATES; i++) {
        if (!valid_result((unsigned)(FIRST_STATE + i), states[i], s->v.time, &why)) {
            return log_discard(instance, &why);
        }
    }
    memcpy(p.state, states, N_STATES * sizeof(double));
    if (!valid_states(&p, s->tolerance, &why)) {
        return log_discard(instance, &why);
    }
    memcpy(&s->v.at[FIRST_STATE], states, N_STATES * sizeof(double));
    s->freshness = STALE;
    return STATUS_OK;
}

/* Values in v->at[first], ... to the caller; discarded if one of them is not finite. */
static Status copy_out(const Instance *instance, int first, int n, double values[])
{
    const Variables *v = &instance->state.v;
    Message why;
    for (int i = 0; i < n; i++) {
        values[i] = v->at[first + i];
        if (!valid_result((unsigned)(first + i), values[i], v->time, &why)) {
            loops_explain(v, &why);
            return log_discard(instance, &why);
        }
    }
    return STATUS_OK;
}

Status model_exchange_get_states(Instance *instance, double states[], size_t n)
{
    Message why;
    if (!call_has_array(instance, GET_CONTINUOUS_STATES, states, n, N_STATES)) {
        return STATUS_ERROR;
    }
    if (!settle_truths(instance, &why)) { /* start values may follow from parameters */
        return log_error(instance, &why);
    }
    return copy_out(instance, FIRST_STATE, N_STATES, states);
}

Status model_exchange_get_derivatives(Instance *instance, double derivatives[], size_t n)
{
    Message why;
    if (!call_has_array(instance, GET_CONTINUOUS_STATE_DERIVATIVES, derivatives, n, N_STATES)) {
        return STATUS_ERROR;
    }
    State *s = &instance->state;
    if (!settle_truths(instance, &why)) {
        return log_error(instance, &why);
    }
    if (s->freshness != CURRENT) {
        model_derivatives(&s->v, s->holds);
    }
    return copy_out(instance, FIRST_DERIVATIVE, N_STATES, derivatives);
}

Status model_exchange_get_nominals(Instance *instance, double nominals[], size_t n)
{
    if (!call_has_array(instance, GET_NOMINALS_OF_CONTINUOUS_STATES, nominals, n, N_STATES)) {
        return STATUS_ERROR;
    }
    for (int i = 0; i < N_STATES; i++) {
        nominals[i] = variable_info[FIRST_STATE + i].nominal;
    }
    return STATUS_OK;
}

Status model_exchange_get_indicators(Instance *instance, double indicators[], size_t n)
{
    Message why;
    double z[AT_LEAST_ONE(N_RELATIONS)];
    if (!call_has_array(instance, GET_EVENT_INDICATORS, indicators, n, N_RELATIONS)) {
        return STATUS_ERROR;
    }
    State *s = &instance->state;
    if (!settle_truths(instance, &why)) {
        return log_error(instance, &why);
    }
    model_relations(&s->v, s->holds, z);
    for (int i = 0; i < N_RELATIONS; i++) {
        const double nominal = variable_info[relation_reference[i]].nominal;
        const double shift = INDICATOR_SHIFT * (nominal > 0.0 ? nominal : 1.0);
        indicators[i] = s->holds[i] ? z[i] + shift : z[i] - shift;
        if (!valid_result(relation_reference[i], indicators[i], s->v.time, &why)) {
            return log_discard(instance, &why);
        }
    }
    return STATUS_OK;
}
