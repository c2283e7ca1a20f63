#include "instance.h"

#include <math.h>
#include <string.h>

#include "coupling.h"
#include "discrete.h"
#include "loops.h"
#include "validation.h"

static const double SAME_STATE = 1e-12; /* of its size or nominal value: rounding */

const char *const category_name[N_LOG_CATEGORIES] = {
    [LOG_ERROR] = "logStatusError",
    [LOG_WARNING] = "logStatusWarning",
    [LOG_EVENT] = "logEvents",
};

int category_index(const char *name)
{
    for (int i = 0; i < N_LOG_CATEGORIES; i++) {
        if (name != NULL && strcmp(name, category_name[i]) == 0) {
            return i;
        }
    }
    return N_LOG_CATEGORIES;
}

void instance_log(const Instance *instance, LogCategory category, Status status, const Message *message)
{
    if (instance->log != NULL && instance->logs[category]) {
        instance->log(instance->receiver, category, status, message->text);
    }
}

Status instance_refuse(const Instance *instance, const Message *why)
{
    instance_log(instance, LOG_ERROR, STATUS_ERROR, why);
    return STATUS_ERROR;
}

Status instance_discard(const Instance *instance, const Message *why)
{
    instance_log(instance, LOG_WARNING, STATUS_DISCARD, why);
    return STATUS_DISCARD;
}

void instance_create(Instance *instance, Use use, LogFunction *log, void *receiver)
{
    memset(instance, 0, sizeof *instance);
    instance->log = log;
    instance->receiver = receiver;
    instance->logs[LOG_ERROR] = true;
    instance->logs[LOG_WARNING] = true;
    instance->state.use = use;
    instance_reset(instance);
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

void instance_disturb(State *s)
{
    s->calm = s->course.open = false;
    integrator_discontinuity(&s->integrator);
}

/* While the caller integrates, and when all is over, truths are held. */
static bool truths_follow(Phase phase) { return (phase & (INSTANTIATED | INITIALIZING | STEPPING | EVENT_MODE)) != 0; }

/* Whether states are the same but for rounding: Newton's method need not end at the same bits twice. */
static bool same_states(const double a[], const double b[])
{
    for (int i = 0; i < N_STATES; i++) {
        const double nominal = variable_info[FIRST_STATE + i].nominal;
        if (!(fabs(a[i] - b[i]) <= SAME_STATE * (nominal + fabs(b[i]))) && memcmp(&a[i], &b[i], sizeof a[i]) != 0) {
            return false;
        }
    }
    return true;
}

/* Start values may depend on truths, and truths on start values. */
static bool settle_start(State *s, Message *why)
{
    double before[AT_LEAST_ONE(N_STATES)];
    model_start(&s->v, s->holds);
    for (int round = 0; round < 2 * N_RELATIONS + 2; round++) {
        if (!discrete_settle(s, true, why)) {
            return false;
        }
        memcpy(before, &s->v.at[FIRST_STATE], N_STATES * sizeof(double));
        model_start(&s->v, s->holds);
        if (same_states(before, &s->v.at[FIRST_STATE])) {
            return true;
        }
    }
    message_write(why, "the start values do not settle: they depend on conditions, which depend on them");
    return false;
}

bool instance_settle(Instance *instance, Message *why)
{
    State *s = &instance->state;
    bool holds[AT_LEAST_ONE(N_RELATIONS)];
    const bool before_start = (s->phase & (INSTANTIATED | INITIALIZING)) != 0;
    if (s->settled) {
        return true;
    }
    model_parameters(&s->v);
    if (truths_follow(s->phase)) {
        memcpy(holds, s->holds, sizeof holds);
        if (!(before_start ? settle_start(s, why) : discrete_settle(s, true, why))) {
            memcpy(s->holds, holds, sizeof holds);
            return false;
        }
        memcpy(s->next_holds, s->holds, sizeof holds);
        if (s->phase == STEPPING && !discrete_event(instance, why)) {
            return false;
        }
    }
    s->settled = true;
    return true;
}

bool instance_update(Instance *instance, Message *why)
{
    State *s = &instance->state;
    if (s->current) {
        return true;
    }
    if (!instance_settle(instance, why)) {
        return false;
    }
    model_outputs(&s->v, s->holds);
    coupling_show(s);
    s->current = true;
    return true;
}

Status instance_setup(Instance *instance, const double *tolerance, double start, const double *stop)
{
    State *s = &instance->state;
    Message why;
    if (!valid_experiment(tolerance, start, stop, &why)) {
        return instance_refuse(instance, &why);
    }
    s->tolerance = tolerance != NULL ? *tolerance : DEFAULT_TOLERANCE;
    s->stop = stop != NULL ? *stop : (double)INFINITY;
    s->v.time = start;
    s->settled = s->current = false;
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
    if (!instance_update(instance, &why)) {
        return instance_refuse(instance, &why);
    }
    const Point start = point_of(s);
    if (!valid_variables(&s->v, &why) || !valid_states(&start, s->tolerance, &why)) {
        return instance_refuse(instance, &why);
    }
    if (!discrete_start(instance, &why)) {
        return instance_refuse(instance, &why);
    }
    s->phase = s->use == CO_SIMULATION ? STEPPING : EVENT_MODE;
    return instance_settle(instance, &why) ? STATUS_OK : instance_refuse(instance, &why);
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
            return instance_refuse(instance, &why);
        }
    }
    if (n > 0 && !instance_update(instance, &why)) {
        return instance_refuse(instance, &why);
    }
    for (size_t i = 0; i < n; i++) {
        values[i] = s->v.at[references[i]];
        if (!valid_result(references[i], values[i], s->v.time, &why)) {
            loops_explain(&s->v, &why);
            return instance_refuse(instance, &why);
        }
    }
    return STATUS_OK;
}

Status instance_set(Instance *instance, ValueType type, const unsigned references[], size_t n, const double values[])
{
    State *s = &instance->state;
    Message why;
    for (size_t i = 0; i < n; i++) {
        if (!valid_type(references[i], type, &why) || !valid_value(references[i], values[i], s->phase, &why)) {
            return instance_refuse(instance, &why);
        }
    }
    for (size_t i = 0; i < n; i++) {
        double *value = &s->v.at[references[i]];
        coupling_note(s, references[i]);
        if (*value != values[i]) { /* an input held constant must leave no trace in the integration */
            *value = values[i];
            s->settled = s->current = false;
            discrete_expect(s);
            instance_disturb(s);
        }
    }
    return STATUS_OK;
}

Status instance_copy(const Instance *instance, int first, int n, double values[])
{
    const Variables *v = &instance->state.v;
    Message why;
    for (int i = 0; i < n; i++) {
        values[i] = v->at[first + i];
        if (!valid_result((unsigned)(first + i), values[i], v->time, &why)) {
            loops_explain(v, &why);
            return instance_discard(instance, &why);
        }
    }
    return STATUS_OK;
}
