#include "stepping.h"

#include <math.h>
#include <string.h>

#include "coupling.h"
#include "discrete.h"
#include "validation.h"

/* More steps than this between two communication points are taken for a run without end. */
enum { MAX_STEPS = 1000000 };

Status instance_set_slopes(Instance *instance, const unsigned references[], size_t n, const double slopes[])
{
    Message why;
    for (size_t i = 0; i < n; i++) {
        if (!valid_slope(references[i], slopes[i], &why)) {
            return instance_refuse(instance, &why);
        }
    }
    for (size_t i = 0; i < n; i++) {
        ramp_set(&instance->state.ramp, (int)references[i] - FIRST_INPUT, slopes[i]);
    }
    return STATUS_OK;
}

static void log_events(const Instance *instance, const Point *arrival)
{
    for (int i = 0; i < N_RELATIONS && instance->logs[LOG_EVENT]; i++) {
        if (arrival->holds[i] != instance->state.holds[i]) {
            Message event;
            message_write(&event, "%s becomes %s at t = %.17g s", relation_text[i],
                          arrival->holds[i] ? "true" : "false", arrival->time);
            instance_log(instance, LOG_EVENT, STATUS_OK, &event);
        }
    }
}

/* At an event that waits for the caller the old truths go on to hold. */
static void commit(State *s, const Point *arrival, bool event, bool waits)
{
    s->v.time = arrival->time;
    memcpy(&s->v.at[FIRST_STATE], arrival->state, N_STATES * sizeof(double));
    ramp_apply(&s->ramp, &s->v);
    if (event) {
        discrete_remember(s);
    }
    memcpy(s->next_holds, arrival->holds, sizeof s->next_holds);
    s->event_waits = waits;
    if (!waits) {
        memcpy(s->holds, arrival->holds, sizeof s->holds);
    }
}

/* The end that the caller wants, seen at an intermediate point. */
static double intermediate(Instance *instance, const StepOptions *options)
{
    State *s = &instance->state;
    s->phase = UPDATING;
    const double end = options->intermediate(options->receiver, s->v.time);
    s->phase = STEPPING;
    return options->may_return_early ? fmax(end, s->v.time) : (double)INFINITY;
}

/* One integrator step. If none can be made, why, and the instance stays where it is. */
static bool advance(Instance *instance, double target, bool events_wait, Message *why)
{
    State *s = &instance->state;
    Point arrival;
    const double next = discrete_next_time(s);
    const double end = discrete_is_due_at(target, next) ? next : target; /* exactly there, for the sake of truths */
    s->current = false;
    bool fine = integrator_step(&s->integrator, &instance->rodas, &s->v, s->holds, &s->ramp, end, s->tolerance,
                                &arrival, why) &&
                valid_states(&arrival, s->tolerance, why);
    if (fine && arrival.event) {
        log_events(instance, &arrival);
        s->chattering = events_too_dense(&s->density, arrival.time, s->holds, arrival.holds, why);
        fine = !s->chattering;
    }
    if (!fine) {
        rodas_back(&instance->rodas, &s->v);
        return false;
    }
    const bool event = arrival.event || arrival.time >= next;
    commit(s, &arrival, event, event && events_wait);
    return discrete_check(instance, why) && (!event || events_wait || discrete_event(instance, why));
}

bool stepping_integrate(Instance *instance, double target, const StepOptions *options, Message *why)
{
    State *s = &instance->state;
    const bool events_wait = s->use == CO_SIMULATION_WITH_EVENTS && options->may_return_early;
    for (int steps = 0; s->v.time < target && !s->event_waits && !discrete_has_ended(s); steps++) {
        const double start = s->v.time;
        if (steps == MAX_STEPS) {
            message_write(why, "%d integrator steps have led from the communication point to t = %s only", MAX_STEPS,
                          quantity(start, "s").text);
            return false;
        }
        if (!advance(instance, target, events_wait, why)) {
            return false;
        }
        if (options->intermediate != NULL && s->v.time > start) {
            target = fmin(target, intermediate(instance, options));
        }
    }
    return true;
}

Status instance_step(Instance *instance, double time, double size, const StepOptions *options, StepResult *result)
{
    State *s = &instance->state;
    const double target = time + size;
    Message why;
    *result = (StepResult){.time = s->v.time};
    if (!valid_step(s, time, size, &why) || !valid_ramp(s, target, &why) || !instance_settle(instance, &why)) {
        return instance_refuse(instance, &why);
    }
    if (discrete_has_ended(s)) {
        message_write(&why, "no step can be made from t = %s: the model has ended the simulation there",
                      quantity(s->v.time, "s").text);
        return instance_refuse(instance, &why);
    }
    if (!s->after_event) {
        events_watch(&s->density, s->v.time, target);
    }
    const double start = s->v.time;
    const bool begun = coupling_begin(instance, size, &why);
    ramp_begin(&s->ramp, &s->v);
    const bool arrived = begun && stepping_integrate(instance, target, options, &why);
    ramp_end(&s->ramp);
    if (!s->current) { /* the caller may have read them in between */
        model_outputs(&s->v, s->holds);
        coupling_show(s);
        s->current = true;
    }
    if (arrived) {
        coupling_end(instance, start);
    }
    s->after_event = s->event_waits;
    if (!arrived || !valid_variables(&s->v, &why)) {
        s->phase = FAILED;
        return s->chattering ? instance_discard(instance, &why) : instance_refuse(instance, &why);
    }
    *result = (StepResult){.event = s->event_waits,
                           .early = s->v.time < target && (options->may_return_early || !discrete_has_ended(s)),
                           .ended = discrete_has_ended(s),
                           .time = fmin(s->v.time, target)};
    return STATUS_OK;
}
