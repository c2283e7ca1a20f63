#include "model_exchange.h"

#include <math.h>
#include <string.h>

#include "discrete.h"
#include "validation.h"

/* Shift of an event indicator, times the nominal value of its residual: far below what a root finder locates. */
static const double INDICATOR_SHIFT = 1e-12;

Status instance_enter_event_mode(Instance *instance)
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
        s->current = false;
        if (!discrete_settle(s, false, &why)) {
            return instance_refuse(instance, &why);
        }
    } else {
        s->settled = s->current = false;
    }
    return STATUS_OK;
}

Status instance_evaluate_event(Instance *instance)
{
    Message why;
    return instance_update(instance, &why) ? STATUS_OK : instance_refuse(instance, &why);
}

/* An event that was set off, or left to the caller, and that has not been handled yet. */
static bool handle_event(Instance *instance, Message *why)
{
    return instance_settle(instance, why) && discrete_event(instance, why) && instance_update(instance, why) &&
           discrete_check(instance, why);
}

Status instance_handle_event(Instance *instance, EventResult *result)
{
    State *s = &instance->state;
    Message why;
    *result = (EventResult){.next_time = (double)INFINITY};
    if (!handle_event(instance, &why)) {
        return instance_refuse(instance, &why);
    }
    *result = (EventResult){.ended = discrete_has_ended(s),
                            .states_changed = discrete_states_changed(s),
                            .next_time = discrete_next_time(s)};
    return STATUS_OK;
}

Status instance_complete_step(Instance *instance)
{
    Message why;
    return discrete_check(instance, &why) ? STATUS_OK : instance_refuse(instance, &why);
}

Status instance_leave_event_mode(Instance *instance)
{
    State *s = &instance->state;
    Message why;
    const bool handled = !discrete_is_pending(s) || handle_event(instance, &why); /* a caller may have left that out */
    if (!handled || !instance_update(instance, &why) || !valid_variables(&s->v, &why)) {
        return instance_refuse(instance, &why);
    }
    s->phase = s->use == MODEL_EXCHANGE ? CONTINUOUS : STEPPING;
    return STATUS_OK;
}

Status instance_set_time(Instance *instance, double time)
{
    State *s = &instance->state;
    Message why;
    if (!isfinite(time)) {
        message_write(&why, "time = %s is not allowed: it must be finite", quantity(time, "s").text);
        return instance_refuse(instance, &why);
    }
    if (s->v.time != time) {
        s->current = false;
        s->settled = s->settled && s->phase == CONTINUOUS; /* in event mode truths follow */
        s->v.time = time;
    }
    return STATUS_OK;
}

Status instance_set_states(Instance *instance, const double states[])
{
    State *s = &instance->state;
    Message why;
    Point p = {.time = s->v.time};
    for (int i = 0; i < N_STATES; i++) {
        if (!valid_result((unsigned)(FIRST_STATE + i), states[i], s->v.time, &why)) {
            return instance_discard(instance, &why);
        }
    }
    memcpy(p.state, states, N_STATES * sizeof(double));
    if (!valid_states(&p, s->tolerance, &why)) {
        return instance_discard(instance, &why);
    }
    memcpy(&s->v.at[FIRST_STATE], states, N_STATES * sizeof(double));
    s->current = false;
    return STATUS_OK;
}

Status instance_get_states(Instance *instance, double states[])
{
    Message why;
    if (!instance_settle(instance, &why)) { /* start values may follow from parameters */
        return instance_refuse(instance, &why);
    }
    return instance_copy(instance, FIRST_STATE, N_STATES, states);
}

Status instance_get_derivatives(Instance *instance, double derivatives[])
{
    State *s = &instance->state;
    Message why;
    if (!instance_settle(instance, &why)) {
        return instance_refuse(instance, &why);
    }
    if (!s->current) {
        model_derivatives(&s->v, s->holds);
    }
    return instance_copy(instance, FIRST_DERIVATIVE, N_STATES, derivatives);
}

void instance_get_nominals(double nominals[])
{
    for (int i = 0; i < N_STATES; i++) {
        nominals[i] = variable_info[FIRST_STATE + i].nominal;
    }
}

Status instance_get_indicators(Instance *instance, double indicators[])
{
    State *s = &instance->state;
    Message why;
    double z[AT_LEAST_ONE(N_RELATIONS)];
    if (!instance_settle(instance, &why)) {
        return instance_refuse(instance, &why);
    }
    model_relations(&s->v, s->holds, z);
    for (int i = 0; i < N_RELATIONS; i++) {
        const double nominal = variable_info[relation_reference[i]].nominal;
        const double shift = INDICATOR_SHIFT * (nominal > 0.0 ? nominal : 1.0);
        indicators[i] = s->holds[i] ? z[i] + shift : z[i] - shift;
        if (!valid_result(relation_reference[i], indicators[i], s->v.time, &why)) {
            return instance_discard(instance, &why);
        }
    }
    return STATUS_OK;
}
