#include "instance.h"

#include <math.h>
#include <string.h>

#include "events.h"
#include "validation.h"

/* More steps than this between two communication points are taken for a run without end. */
enum { MAX_STEPS = 1000000 };

void instance_log(const Instance *instance, LogCategory category, const Message *message)
{
    if (instance->log != NULL && instance->logs[category]) {
        instance->log(instance->receiver, category, message->text);
    }
}

static Status refuse(const Instance *instance, const Message *why)
{
    instance_log(instance, LOG_ERROR, why);
    return STATUS_ERROR;
}

void instance_create(Instance *instance, LogFunction *log, void *receiver)
{
    memset(instance, 0, sizeof *instance);
    instance->log = log;
    instance->receiver = receiver;
    instance->logs[LOG_ERROR] = true;
    instance->logs[LOG_WARNING] = true;
    instance_reset(instance);
}

void instance_reset(Instance *instance)
{
    State *s = &instance->state;
    memset(s, 0, sizeof *s);
    memset(&instance->workspace, 0, sizeof instance->workspace);
    s->phase = INSTANTIATED;
    s->tolerance = DEFAULT_TOLERANCE;
    s->stop = (double)INFINITY;
    for (int i = 0; i < N_VARIABLES; i++) {
        s->v.at[i] = variable_info[i].start;
    }
    s->v.time = 0.0;
}

/* Calculate all that depends on what has been set. */
static bool update(State *s, Message *why)
{
    if (s->current) {
        return true;
    }
    model_parameters(&s->v);
    if (s->phase == INSTANTIATED || s->phase == INITIALIZING) {
        model_start(&s->v);
    }
    if (!events_settle(&s->v, s->holds, why)) {
        return false;
    }
    model_outputs(&s->v, s->holds);
    s->current = true;
    return true;
}

Status instance_setup(Instance *instance, const double *tolerance, double start, const double *stop)
{
    State *s = &instance->state;
    Message why;
    if (!valid_experiment(tolerance, start, stop, &why)) {
        return refuse(instance, &why);
    }
    s->tolerance = tolerance != NULL ? *tolerance : DEFAULT_TOLERANCE;
    s->stop = stop != NULL ? *stop : (double)INFINITY;
    s->v.time = start;
    s->current = false;
    return STATUS_OK;
}

Status instance_enter_initialization(Instance *instance)
{
    instance->state.phase = INITIALIZING;
    return STATUS_OK;
}

static Point point_of(const State *s)
{
    Point p = {.time = s->v.time, .event = false};
    memcpy(p.state, &s->v.at[FIRST_STATE], N_STATES * sizeof(double));
    memcpy(p.holds, s->holds, sizeof p.holds);
    return p;
}

Status instance_exit_initialization(Instance *instance)
{
    State *s = &instance->state;
    Message why;
    if (!update(s, &why)) {
        return refuse(instance, &why);
    }
    const Point start = point_of(s);
    if (!valid_variables(&s->v, &why) || !valid_states(&start, s->tolerance, &why)) {
        return refuse(instance, &why);
    }
    s->phase = STEPPING;
    return STATUS_OK;
}

Status instance_terminate(Instance *instance)
{
    instance->state.phase = TERMINATED;
    return STATUS_OK;
}

Status instance_get(Instance *instance, const unsigned references[], size_t n, double values[])
{
    State *s = &instance->state;
    Message why;
    for (size_t i = 0; i < n; i++) {
        if (!valid_reference(references[i], &why)) {
            return refuse(instance, &why);
        }
    }
    if (n > 0 && !update(s, &why)) {
        return refuse(instance, &why);
    }
    for (size_t i = 0; i < n; i++) {
        const VariableInfo *info = &variable_info[references[i]];
        values[i] = s->v.at[references[i]];
        if (!isfinite(values[i])) {
            message_write(&why, "%s = %s is not finite", info->name, quantity(values[i], info->unit).text);
            return refuse(instance, &why);
        }
    }
    return STATUS_OK;
}

Status instance_set(Instance *instance, const unsigned references[], size_t n, const double values[])
{
    State *s = &instance->state;
    Message why;
    for (size_t i = 0; i < n; i++) {
        if (!valid_value(references[i], values[i], s->phase, &why)) {
            return refuse(instance, &why);
        }
    }
    for (size_t i = 0; i < n; i++) {
        double *value = &s->v.at[references[i]];
        if (*value != values[i]) { /* an input held constant must leave no trace in the integration */
            *value = values[i];
            s->current = false;
            integrator_discontinuity(&s->integrator);
        }
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
            instance_log(instance, LOG_EVENT, &event);
        }
    }
}

static void commit(State *s, const Point *arrival)
{
    s->v.time = arrival->time;
    memcpy(&s->v.at[FIRST_STATE], arrival->state, N_STATES * sizeof(double));
    memcpy(s->holds, arrival->holds, sizeof s->holds);
}

static bool integrate(Instance *instance, double target, Message *why)
{
    State *s = &instance->state;
    EventDensity density = events_watch(s->v.time, target);
    for (int steps = 0; s->v.time < target; steps++) {
        Point arrival;
        if (steps == MAX_STEPS) {
            message_write(why, "%d integrator steps have led from the communication point to t = %s only", MAX_STEPS,
                          quantity(s->v.time, "s").text);
            return false;
        }
        if (!integrator_step(&s->integrator, &instance->workspace, &s->v, s->holds, target, s->tolerance, &arrival,
                             why) ||
            !valid_states(&arrival, s->tolerance, why)) {
            return false;
        }
        if (arrival.event) {
            log_events(instance, &arrival);
            if (events_too_dense(&density, arrival.time, s->holds, arrival.holds, why)) {
                return false;
            }
        }
        commit(s, &arrival);
    }
    return true;
}

Status instance_step(Instance *instance, double time, double size)
{
    State *s = &instance->state;
    Message why;
    if (!valid_step(s, time, size, &why) || !update(s, &why)) {
        return refuse(instance, &why);
    }
    const bool arrived = integrate(instance, time + size, &why);
    model_outputs(&s->v, s->holds);
    if (!arrived || !valid_variables(&s->v, &why)) {
        s->phase = FAILED;
        return refuse(instance, &why);
    }
    return STATUS_OK;
}
