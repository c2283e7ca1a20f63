#include "instance.h"

#include <math.h>
#include <string.h>

#include "coupling_values.h"
#include "discrete.h"
#include "input_range.h"
#include "log.h"
#include "loops.h"
#include "settle.h"
#include "validation.h"

void instance_create(Instance *instance, Use use, const Caller *caller)
{
    memset(instance, 0, sizeof *instance);
    instance->caller = *caller;
    instance->logs[LOG_ERROR] = true;
    instance->logs[LOG_WARNING] = true;
    instance->state.use = use;
    instance_reset(instance);
}

void instance_free(Instance *instance)
{
    if (instance != NULL && instance->state.phase != UPDATING) {
        instance->caller.release(instance);
    }
}

void instance_reset(Instance *instance)
{
    State *s = &instance->state;
    const Use use = s->use;
    memset(s, 0, sizeof *s);
    memset(&instance->rodas, 0, sizeof instance->rodas);
    s->use = use;
    s->phase = INSTANTIATED;
    s->tolerance = DEFAULT_TOLERANCE;
    s->stop = (double)INFINITY;
    for (int i = 0; i < N_VARIABLES; i++) {
        s->v.at[i] = variable_info[i].start;
    }
    s->v.time = 0.0;
#if HAS_EVENTS
    s->v.at[INITIAL] = 1.0;
#endif
}

/* What has been set makes a difference: the integrator cannot go on as before. */
static void disturb(State *s, const VariableInfo *info)
{
    s->calm = s->course.open = false;
    if (info->kind == INPUT && info->type == REAL) {
        integrator_discontinuity(&s->integrator);
    } else {
        integrator_forget(&s->integrator);
    }
}

Status instance_setup(Instance *instance, const double *tolerance, double start, const double *stop)
{
    State *s = &instance->state;
    Message why;
    if (!valid_experiment(tolerance, start, stop, &why)) {
        return log_error(instance, &why);
    }
    s->tolerance = tolerance != NULL ? *tolerance : DEFAULT_TOLERANCE;
    s->stop = stop != NULL ? *stop : (double)INFINITY;
    s->v.time = start;
    s->settled = false;
    s->freshness = STALE;
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
    if (!settle_variables(instance, &why)) {
        return log_error(instance, &why);
    }
    const Point start = point_of(s);
    if (!valid_variables(&s->v, &why) || !valid_states(&start, s->tolerance, &why)) {
        return log_error(instance, &why);
    }
    if (!discrete_start(instance, &why)) {
        return log_error(instance, &why);
    }
    s->phase = s->use == CO_SIMULATION ? STEPPING : EVENT_MODE;
    return settle_truths(instance, &why) ? STATUS_OK : log_error(instance, &why);
}

Status instance_terminate(Instance *instance)
{
    discrete_terminate(instance);
    instance->state.phase = TERMINATED;
    return STATUS_OK;
}

Status instance_get(Instance *instance, ValueType type, const unsigned references[], size_t n, double values[])
{
    State *s = &instance->state;
    Message why;
    for (size_t i = 0; i < n; i++) {
        if (!valid_type(references[i], type, &why)) {
            return log_error(instance, &why);
        }
    }
    if (n > 0 && !settle_variables(instance, &why)) {
        return log_error(instance, &why);
    }
    for (size_t i = 0; i < n; i++) {
        values[i] = s->v.at[references[i]];
        if (!valid_result(references[i], values[i], s->v.time, &why)) {
            loops_explain(&s->v, &why);
            return log_error(instance, &why);
        }
    }
    return STATUS_OK;
}

Status instance_check(const Instance *instance, ValueType type, unsigned reference, double value)
{
    Message why;
    if (!valid_type(reference, type, &why) || !valid_setting(reference, value, instance->state.phase, &why)) {
        return log_error(instance, &why);
    }
    return valid_range(reference, value, &why) ? STATUS_OK : log_discard(instance, &why);
}

void instance_set(Instance *instance, unsigned reference, double value)
{
    State *s = &instance->state;
    const VariableInfo *info = &variable_info[reference];
    const double acting = info->kind == INPUT && info->type == REAL
                              ? input_range_limited(instance, (int)reference - FIRST_INPUT, value)
                              : value;
    coupling_values_note(s, reference);
    if (s->v.at[reference] != acting) { /* an input held constant must leave no trace in the integration */
        s->v.at[reference] = acting;
        settle_later(s, reference);
        discrete_expect(s);
        disturb(s, info);
    }
}
