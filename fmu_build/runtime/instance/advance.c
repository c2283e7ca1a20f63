#include "advance.h"

#include <math.h>
#include <string.h>

#include "discrete.h"
#include "error.h"
#include "log.h"
#include "settle.h"
#include "validation.h"

/* More steps than this between two communication points are taken for a run without end. */
enum { MAX_INTEGRATOR_STEPS = 1000000 };

static void log_events(const Instance *instance, const Point *arrival)
{
    for (int i = 0; i < N_RELATIONS && instance->logs[LOG_EVENT]; i++) {
        if (arrival->holds[i] != instance->state.holds[i]) {
            Message event;
            message_write(&event, "%s becomes %s at t = %.17g s", relation_text[i],
                          arrival->holds[i] ? "true" : "false", arrival->time);
            log_write(instance, LOG_EVENT, STATUS_OK, &event);
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

void advance_follow(State *s, double time)
{
    const Path *path = &s->course.path;
    s->v.time = time;
    rodas_dense(path, (time - path->time) / path->length, &s->v.at[FIRST_STATE]);
    ramp_apply(&s->ramp, &s->v);
}

/* One integrator step from where the instance is, at most to `limit`; whether the derivatives there are known. */
static bool make_step(Instance *instance, double limit, bool derived, Message *why)
{
    State *s = &instance->state;
    Course *course = &s->course;
    if (!integrator_step(&s->integrator, &instance->rodas, &s->v, s->holds, &s->ramp, derived, limit, s->tolerance,
                         &course->arrival, why) ||
        !valid_states(&course->arrival, s->tolerance, why)) {
        rodas_back(&instance->rodas, &s->v);
        return false;
    }
    return true;
}

/* Begin a step. While nothing is set it may lead beyond the communication point, so that its length is up to its error
 * alone, but not beyond the next time event; the stop time is none, so that it leaves no trace. It is not worth while
 * where inputs change from step to step, nor with a coupling, whose input always does. */
static bool set_out(Instance *instance, double target, double next, bool derived, Message *why)
{
    State *s = &instance->state;
    Course *course = &s->course;
    const bool may_pass = N_COUPLINGS == 0 && s->calm && !s->ramp.moves;
    if (may_pass) {
        integrator_go_free(&s->integrator);
    }
    /* What makes a longer step fail may never happen. */
    if (!(may_pass && make_step(instance, next, derived, why)) &&
        !make_step(instance, target, derived && !may_pass, why)) {
        return false;
    }
    course->open = course->arrival.time > target;
    if (course->open && N_RELATIONS == 0) { /* otherwise the search for events has done so */
        rodas_bend(&instance->rodas);
    }
    if (course->open) {
        course->path = instance->rodas.path;
    }
    return true;
}

/* The end of the course has been reached: an event may lie there. */
static bool arrive(Instance *instance, double next, bool events_wait, Message *why)
{
    State *s = &instance->state;
    const Point *arrival = &s->course.arrival;
    const bool event = arrival->event || arrival->time >= next;
    s->course.open = false;
    if (arrival->event) {
        log_events(instance, arrival);
        if (events_too_dense(&s->density, arrival->time, s->holds, arrival->holds, why)) {
            return false;
        }
    }
    commit(s, arrival, event, event && events_wait);
    return discrete_check(instance, why) && (!event || events_wait || discrete_event(instance, why));
}

/* Go on along the course, at most to target. */
static bool advance(Instance *instance, double target, bool events_wait, Message *why)
{
    State *s = &instance->state;
    const double next = discrete_next_time(s);
    const double end = discrete_is_due_at(target, next) ? next : target; /* exactly there, for the sake of truths */
    const bool derived = !s->course.open && settle_derivatives(s);
    s->freshness = STALE;
    if (!s->course.open && !set_out(instance, end, next, derived, why)) {
        return false;
    }
    if (s->course.open && s->course.arrival.time > end) {
        advance_follow(s, end);
        return discrete_check(instance, why);
    }
    return arrive(instance, next, events_wait, why);
}

/* Either the error keeps steps short, or they could be longer and times of events do; events of relations would have
 * been taken for chattering before. */
static bool explain_number(const Instance *instance, double start, Message *why)
{
    const State *s = &instance->state;
    const double mean = (s->v.time - start) / MAX_INTEGRATOR_STEPS;
    message_write(why, "%d integrator steps have led from t = %s to t = %s only", MAX_INTEGRATOR_STEPS,
                  quantity(start, "s").text, quantity(s->v.time, "s").text);
    if (N_STATES == 0 || s->integrator.length > 4.0 * mean) {
        discrete_explain_times(s, why);
    } else {
        message_append(why, ": the error of %s allows no longer ones; a larger tolerance does",
                       variable_info[FIRST_STATE + error_worst_state(&instance->rodas, s->tolerance)].name);
    }
    return false;
}

bool advance_to(Instance *instance, double target, const StepOptions *options, Message *why)
{
    State *s = &instance->state;
    const bool events_wait = s->use == CO_SIMULATION_WITH_EVENTS && options->may_return_early;
    const double begin = s->v.time;
    for (int steps = 0; s->v.time < target && !s->event_waits && !discrete_has_ended(s); steps++) {
        const double start = s->v.time;
        if (steps == MAX_INTEGRATOR_STEPS) {
            return explain_number(instance, begin, why);
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

bool advance_again(Instance *instance, double start, double target, const StepOptions *options, Message *why)
{
    State *s = &instance->state;
    advance_follow(s, fmax(start, s->course.path.time));
    s->calm = s->course.open = false;
    return advance_to(instance, target, options, why);
}
