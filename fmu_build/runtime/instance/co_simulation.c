#include "co_simulation.h"

#include <math.h>
#include <string.h>

#include "coupling.h"
#include "discrete.h"
#include "input_range.h"
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

/* What leads back to where a step has begun. Most steps do nothing but follow the course, which leads back itself:
 * copying the whole state would take longer than such a step. */
typedef struct {
    bool copied; /* into instance->before; otherwise back along the course, and what follows is as it was */
    double time;
    bool after_event, calm, ramp_over;
    Freshness freshness;
    EventDensity density;
} Departure;

static void copy(Instance *instance, Departure *departure)
{
    memcpy(&instance->before, &instance->state, sizeof instance->before);
    instance->given_up = (double)NAN;
    departure->copied = true;
}

static Departure depart(Instance *instance, double target)
{
    const State *s = &instance->state;
    const Course *course = &s->course;
    Departure departure = {.time = s->v.time,
                           .after_event = s->after_event,
                           .calm = s->calm,
                           .freshness = s->freshness,
                           .ramp_over = s->ramp.over,
                           .density = s->density};
    if (!s->settled || !course->open || course->arrival.time <= target || s->ramp.is_set ||
        discrete_is_due_at(target, discrete_next_time(s))) {
        copy(instance, &departure);
    }
    return departure;
}

static void go_back(Instance *instance, const Departure *departure)
{
    State *s = &instance->state;
    if (departure->copied) {
        memcpy(s, &instance->before, sizeof *s);
        return;
    }
    advance_follow(s, departure->time);
    s->after_event = departure->after_event;
    s->calm = departure->calm;
    s->ramp.over = departure->ramp_over;
    s->density = departure->density;
    s->asserted = false;
    s->freshness = STALE;
    settle_outputs(s);
    s->freshness = departure->freshness;
}

/* A step that cannot be made leaves nothing behind, so that the caller can try another one. An assertion that has
 * failed is an error: what the model says is that all is over. */
static Status give_up(Instance *instance, Departure *departure, double target, Message *why)
{
    if (instance->state.asserted) {
        instance->state.phase = FAILED;
        return log_error(instance, why);
    }
    go_back(instance, departure);
    copy(instance, departure);
    instance->given_up = target;
    instance->reason = *why;
    message_append(why, "; the instance is as before the step: a shorter one or other inputs may lead on");
    return log_discard(instance, why);
}

/* Some importers repeat a step that is discarded, over and over, as it was. */
static bool is_new(const Instance *instance, double target, const StepOptions *options, Message *why)
{
    if (options->intermediate != NULL || instance->given_up != target ||
        memcmp(&instance->before, &instance->state, sizeof instance->before) != 0) {
        return true;
    }
    message_write(why, "the step from %s to %s has been discarded before, and nothing has changed since: %s",
                  quantity(instance->state.v.time, "s").text, quantity(target, "s").text, instance->reason.text);
    return false;
}

/* The step, the coupling's share in it included. False: why it has not arrived. */
static bool make_way(Instance *instance, Departure *departure, double target, double size, const StepOptions *options,
                     Message *why)
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
        if (!departure->copied) {
            go_back(instance, departure);
            copy(instance, departure);
        }
        s->asserted = false;
        arrived = advance_again(instance, start, target, options, why);
        settle_outputs(s);
    }
    if (arrived) {
        coupling_end(instance, start);
    }
    return arrived && valid_variables(&s->v, why);
}

/* What a step takes, so that a user can see why a run is slow. One that follows the course takes nothing. */
static void log_step(const Instance *instance, const Departure *departure)
{
    const Counters *now = &instance->state.integrator.counters;
    const Counters *then = departure->copied ? &instance->before.integrator.counters : now;
    Message message;
    if (instance->logs[LOG_STEP]) {
        message_write(&message,
                      "from t = %.17g s to %.17g s: %lld steps, %lld rejected, %lld repeated, %lld events, %lld "
                      "evaluations, %lld Jacobians",
                      departure->time, instance->state.v.time, (long long)(now->steps - then->steps),
                      (long long)(now->rejected - then->rejected), (long long)(now->repeated - then->repeated),
                      (long long)(now->events - then->events), (long long)(now->evaluations - then->evaluations),
                      (long long)(now->jacobians - then->jacobians));
        log_write(instance, LOG_STEP, STATUS_OK, &message);
    }
}

/* A step leads from where the instance is to the caller's target, whatever lies between the two clocks. */
static void tell_of_clock(Instance *instance, double time, double size)
{
    Message warning;
    if (!instance->told_of_clock && !same_point(&instance->state, time, size)) {
        instance->told_of_clock = true;
        message_write(&warning,
                      "communication point = %.17g s is not quite where the instance is, t = %.17g s: steps "
                      "begin there, and end where they are asked to",
                      time, instance->state.v.time);
        log_write(instance, LOG_WARNING, STATUS_WARNING, &warning);
    }
}

Status co_simulation_step(Instance *instance, double time, double size, const StepOptions *options, StepResult *result)
{
    State *s = &instance->state;
    const double target = time + size;
    Message why;
    *result = (StepResult){.time = s->v.time};
    if (!valid_step(s, time, size, &why) || !is_new(instance, target, options, &why)) {
        return log_error(instance, &why);
    }
    tell_of_clock(instance, time, size);
    input_range_look_ahead(instance, target);
    Departure departure = depart(instance, target);
    s->asserted = false;
    if (!settle_truths(instance, &why)) {
        return give_up(instance, &departure, target, &why);
    }
    if (discrete_has_ended(s)) {
        message_write(&why, "no step can be made from t = %s: the model has ended the simulation there",
                      quantity(s->v.time, "s").text);
        return log_error(instance, &why);
    }
    if (!s->after_event) {
        events_watch(&s->density, s->v.time, target);
    }
    const bool arrived = make_way(instance, &departure, target, size, options, &why);
    log_step(instance, &departure);
    if (!arrived) {
        return give_up(instance, &departure, target, &why);
    }
    s->after_event = s->event_waits;
    s->calm = true;
    *result = (StepResult){.event = s->event_waits,
                           .early = s->v.time < target && (options->may_return_early || !discrete_has_ended(s)),
                           .ended = discrete_has_ended(s),
                           .time = fmin(s->v.time, target)};
    return STATUS_OK;
}
