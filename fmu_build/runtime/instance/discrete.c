#include "discrete.h"

#if HAS_EVENTS

#include <math.h>
#include <string.h>

#include "event_time.h"
#include "log.h"
#include "validation.h"

/* Times at one event that discrete variables may change, one after another, before that is taken to be without end. */
enum { MAX_ROUNDS = 1000 };

static bool is_set(const State *s, unsigned variable) { return s->v.at[variable] > 0.5; }

static void copy_discrete(const Variables *v, double values[])
{
    for (int i = 0; i < N_MEMORIES; i++) {
        values[i] = memories[i].discrete ? v->at[memories[i].variable] : 0.0;
    }
    for (int i = 0; i < N_TIME_EVENTS; i++) {
        values[N_MEMORIES + i] = v->at[time_events[i]];
    }
}

bool discrete_settle(State *s, bool by_sign, Message *why)
{
    double before[AT_LEAST_ONE(N_MEMORIES + N_TIME_EVENTS)] = {0.0};
    double behind[AT_LEAST_ONE(N_MEMORIES + N_TIME_EVENTS)] = {0.0};
    int changed = NO_RELATION;
    for (int round = 0; round < 2 * (N_RELATIONS + N_MEMORIES) + 2; round++) {
        changed = events_take(&s->v, s->holds, by_sign);
        copy_discrete(&s->v, before);
        model_discrete(&s->v, s->holds);
        copy_discrete(&s->v, behind);
        if (changed == NO_RELATION && memcmp(before, behind, sizeof before) == 0) {
            return true;
        }
    }
    if (changed != NO_RELATION) {
        events_explain(changed, s->v.time, why);
        return false;
    }
    int i = 0;
    while (i < N_MEMORIES - 1 && before[i] == behind[i]) {
        i++;
    }
    message_write(why, "%s does not settle at t = %s: it depends on itself", variable_info[memories[i].variable].name,
                  quantity(s->v.time, "s").text);
    return false;
}

/* What has been computed becomes what was before. The first discrete variable that changes, -1 if none does. */
static int take_memories(State *s)
{
    int changed = -1;
    for (int i = 0; i < N_MEMORIES; i++) {
        const double value = s->v.at[memories[i].variable];
        if (memories[i].discrete && value != s->v.at[memories[i].before] && changed < 0) {
            changed = i;
        }
        s->v.at[memories[i].before] = value;
    }
    return changed;
}

void discrete_remember(State *s)
{
    model_outputs(&s->v, s->holds);
    for (int i = 0; i < N_MEMORIES; i++) {
        if (!memories[i].discrete) {
            s->v.at[memories[i].before] = s->v.at[memories[i].variable];
        }
    }
}

/* The last reinit by which a state has got a value, be it the one that it had; -1 if none has. */
static int reinitialize(State *s)
{
    int last = -1;
    for (int i = 0; i < N_REINITS; i++) {
        if (is_set(s, reinits[i].active)) {
            s->v.at[reinits[i].state] = s->v.at[reinits[i].value];
            last = i;
        }
    }
    s->discrete.states_changed = s->discrete.states_changed || last >= 0;
    return last;
}

/* Checks from first to last - 1: warnings are given once, until what they warn of is over. */
static bool look_at(Instance *instance, int first, int last, Message *why)
{
    State *s = &instance->state;
    for (int i = first; i < last; i++) {
        const bool violated = is_set(s, checks[i].violated);
        if (violated && (checks[i].kind != WARN || !s->discrete.warned[i])) {
            model_message(&s->v, i, why);
            Message at;
            message_write(&at, "%s (t = %s)", why->text, quantity(s->v.time, "s").text);
            if (checks[i].kind == FAIL) {
                s->asserted = true;
                *why = at;
                return false;
            }
            log_write(instance, checks[i].kind == WARN ? LOG_WARNING : LOG_EVENT,
                      checks[i].kind == WARN ? STATUS_WARNING : STATUS_OK, &at);
            s->discrete.ended = s->discrete.ended || checks[i].kind == END;
        }
        s->discrete.warned[i] = violated;
    }
    return true;
}

bool discrete_check(Instance *instance, Message *why)
{
    if (N_CHECKS == N_EVENT_CHECKS) {
        return true;
    }
    model_checks(&instance->state.v, instance->state.holds);
    return look_at(instance, N_EVENT_CHECKS, N_CHECKS, why);
}

/* Iterate until nothing changes. */
static bool iterate(Instance *instance, bool *any, Message *why)
{
    State *s = &instance->state;
    int changed = -1;
    int reset = -1;
    for (int round = 0; round < MAX_ROUNDS; round++) {
        if (!discrete_settle(s, false, why) || !look_at(instance, 0, N_EVENT_CHECKS, why)) {
            return false;
        }
        reset = reinitialize(s);
        changed = take_memories(s);
        if (reset < 0 && changed < 0) {
            return true;
        }
        *any = true;
    }
    message_write(why, "the event at t = %s does not end: %s changes without end", quantity(s->v.time, "s").text,
                  variable_info[changed < 0 ? reinits[reset].state : memories[changed].variable].name);
    return false;
}

static double tick(const State *s, int sample)
{
    return s->v.at[samples[sample].start] + s->discrete.ticks[sample] * s->v.at[samples[sample].interval];
}

/* How far a tick may be ahead, for rounding, and be there: a start before 0 loses digits on the way. */
static double rounding(const State *s, int sample)
{
    return SAME_TIME * fmax(fabs(s->v.time), fabs(s->v.at[samples[sample].start]));
}

/* The number of the last tick up to now, but for rounding; -1 if there was none. */
static double ticks_passed(const State *s, int sample)
{
    const double start = s->v.at[samples[sample].start];
    const double since = s->v.time * (1.0 + SAME_TIME) - start;
    return since < 0.0 && !is_there(start, s->v.time) ? -1.0
                                                      : floor(fmax(since, 0.0) / s->v.at[samples[sample].interval]);
}

/* Flags of the samples that tick now; false if there are none. */
static bool begin_ticks(State *s)
{
    bool any = false;
    for (int i = 0; i < N_SAMPLES; i++) {
        const bool ticks = tick(s, i) - s->v.time <= rounding(s, i);
        s->v.at[samples[i].flag] = ticks ? 1.0 : 0.0;
        s->discrete.ticks[i] = ticks ? fmax(s->discrete.ticks[i], ticks_passed(s, i)) + 1.0 : s->discrete.ticks[i];
        any = any || ticks;
    }
    return any;
}

static void end_ticks(State *s)
{
    for (int i = 0; i < N_SAMPLES; i++) {
        s->v.at[samples[i].flag] = 0.0;
    }
}

bool discrete_event(Instance *instance, Message *why)
{
    State *s = &instance->state;
    bool any = false;
    const bool ticks = begin_ticks(s);
    bool fine = iterate(instance, &any, why);
    if (fine && ticks) {
        end_ticks(s);
        fine = iterate(instance, &any, why);
    }
    if (any) {
        integrator_forget(&s->integrator);
    }
    s->discrete.pending = false;
    s->settled = true;
    s->freshness = STALE;
    memcpy(s->next_holds, s->holds, sizeof s->holds);
    return fine;
}

/* The first tick that is not over. */
static bool first_ticks(State *s, Message *why)
{
    for (int i = 0; i < N_SAMPLES; i++) {
        const double start = s->v.at[samples[i].start];
        const double interval = s->v.at[samples[i].interval];
        if (!(interval > 0.0) || !isfinite(start)) {
            message_write(why, "sample(%s, %s) is not allowed: the interval must be positive",
                          quantity(start, "s").text, quantity(interval, "s").text);
            return false;
        }
        const double passed = ticks_passed(s, i);
        s->discrete.ticks[i] = passed;
        if (passed < 0.0 || !(fabs(tick(s, i) - s->v.time) <= rounding(s, i))) {
            s->discrete.ticks[i] = passed + 1.0; /* the one that has passed is over */
        }
    }
    return true;
}

bool discrete_start(Instance *instance, Message *why)
{
    State *s = &instance->state;
    if (!first_ticks(s, why) || !look_at(instance, 0, N_EVENT_CHECKS, why) || !discrete_check(instance, why)) {
        return false;
    }
    (void)reinitialize(s);
    (void)take_memories(s);
    s->v.at[INITIAL] = 0.0;
    s->discrete.pending = true;
    s->settled = false;
    s->freshness = STALE;
    return true;
}

void discrete_terminate(Instance *instance)
{
    State *s = &instance->state;
    Message why;
    s->v.at[TERMINAL] = 1.0;
    if (!discrete_event(instance, &why)) {
        log_write(instance, LOG_WARNING, STATUS_WARNING, &why);
    }
}

double discrete_next_time(const State *s)
{
    double next = (double)INFINITY;
    for (int i = 0; i < N_SAMPLES; i++) {
        const double time = tick(s, i);
        next = time > s->v.time ? fmin(next, time) : next;
    }
    for (int i = 0; i < N_TIME_EVENTS; i++) {
        const double time = s->v.at[time_events[i]];
        next = is_there(time, s->v.time) ? next : fmin(next, time);
    }
    return next;
}

/* The sample with the shortest interval, if there are samples. */
void discrete_explain_times(const State *s, Message *why)
{
    int shortest = 0;
    for (int i = 1; i < N_SAMPLES; i++) {
        shortest = s->v.at[samples[i].interval] < s->v.at[samples[shortest].interval] ? i : shortest;
    }
    if (N_SAMPLES == 0) {
        message_append(why, ": they end at events of the time alone");
        return;
    }
    message_append(why, ": they end at ticks, the densest those of sample(%s, %s)",
                   quantity(s->v.at[samples[shortest].start], "s").text,
                   quantity(s->v.at[samples[shortest].interval], "s").text);
}

bool discrete_is_due_at(double time, double next) { return isfinite(next) && is_there(next, time); }

bool discrete_states_changed(State *s)
{
    const bool changed = s->discrete.states_changed;
    s->discrete.states_changed = false;
    return changed;
}

#endif
