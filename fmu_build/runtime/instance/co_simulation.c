#include "co_simulation.h"

#include <math.h>

#include "coupling.h"
#include "discrete.h"
#include "log.h"
#include "settle.h"
#include "validation.h"

Status co_simulation_set_slopes(Instance *instance, const unsigned references[], size_t n, const double slopes[])
{
    Message why;
    for (size_t i = 0; i < n; i++) {
        if (!valid_slope(references[i], slopes[i], &why)) {
            return log_error(instance, &why);
        }
    }
    for (size_t i = 0; i < n; i++) {
        ramp_set(&instance->state.ramp, (int)references[i] - FIRST_INPUT, slopes[i]);
    }
    return STATUS_OK;
}

/* Whether a step can be asked for. */
static bool can_step(Instance *instance, double time, double size, Message *why)
{
    const State *s = &instance->state;
    if (!valid_step(s, time, size, why) || !valid_ramp(s, time + size, why) || !settle_truths(instance, why)) {
        return false;
    }
    if (discrete_has_ended(s)) {
        message_write(why, "no step can be made from t = %s: the model has ended the simulation there",
                      quantity(s->v.time, "s").text);
        return false;
    }
    return true;
}

/* The step, the coupling's share in it included. False: why it has not arrived. */
static bool make_way(Instance *instance, double target, double size, const StepOptions *options, Message *why)
{
    State *s = &instance->state;
    const double start = s->v.time;
    const bool begun = coupling_begin(instance, size, why);
    ramp_begin(&s->ramp, &s->v);
    s->course.open = s->course.open && !s->ramp.moves;
    bool arrived = begun && advance_to(instance, target, options, why);
    ramp_end(&s->ramp);
    settle_outputs(s); /* the caller may have read them in between */
    if (s->course.open && !events_hold(&s->v, s->holds)) {
        arrived = advance_again(instance, start, target, options, why);
        settle_outputs(s);
    }
    if (arrived) {
        coupling_end(instance, start);
    }
    return arrived;
}

Status co_simulation_step(Instance *instance, double time, double size, const StepOptions *options, StepResult *result)
{
    State *s = &instance->state;
    const double target = time + size;
    Message why;
    *result = (StepResult){.time = s->v.time};
    if (!can_step(instance, time, size, &why)) {
        return log_error(instance, &why);
    }
    if (!s->after_event) {
        events_watch(&s->density, s->v.time, target);
    }
    const bool arrived = make_way(instance, target, size, options, &why);
    s->after_event = s->event_waits;
    s->calm = true;
    if (!arrived || !valid_variables(&s->v, &why)) {
        s->phase = FAILED;
        return s->chattering ? log_discard(instance, &why) : log_error(instance, &why);
    }
    *result = (StepResult){.event = s->event_waits,
                           .early = s->v.time < target && (options->may_return_early || !discrete_has_ended(s)),
                           .ended = discrete_has_ended(s),
                           .time = fmin(s->v.time, target)};
    return STATUS_OK;
}
