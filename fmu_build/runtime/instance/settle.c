#include "settle.h"

#include <math.h>
#include <string.h>

#include "coupling_values.h"
#include "discrete.h"

static const double SAME_STATE = 1e-12; /* of its size or nominal value: rounding */

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

void settle_later(State *s, unsigned reference)
{
    const bool is_input = variable_info[reference].kind == INPUT;
    const int input = is_input ? (int)reference - FIRST_INPUT : 0;
    s->calculated = s->calculated && is_input && !moves_steady[input];
    if (!is_input || moves_steady[input] || moves_truths[input]) {
        s->settled = false;
        s->freshness = STALE;
    } else if (s->freshness != STALE) {
        s->since[input] = true;
        s->freshness = STALE_BY_INPUTS;
    }
}

bool settle_truths(Instance *instance, Message *why)
{
    State *s = &instance->state;
    bool holds[AT_LEAST_ONE(N_RELATIONS)];
    const bool before_start = (s->phase & (INSTANTIATED | INITIALIZING)) != 0;
    if (s->settled) {
        return true;
    }
    if (!s->calculated) {
        model_parameters(&s->v);
        model_steady(&s->v);
        s->calculated = true;
    }
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

void settle_outputs(State *s)
{
    if (s->freshness != CURRENT) {
        model_outputs(&s->v, s->holds);
        coupling_values_show(s);
        memset(s->since, 0, sizeof s->since); /* that variables are read leaves no trace */
        s->freshness = CURRENT;
    }
}

bool settle_derivatives(State *s)
{
    for (int i = 0; i < N_INPUTS && s->freshness == STALE_BY_INPUTS; i++) {
        if (s->since[i]) {
            model_derivatives_by(&s->v, s->holds, i);
        }
    }
    return s->freshness != STALE;
}

bool settle_variables(Instance *instance, Message *why)
{
    if (instance->state.freshness != CURRENT && !settle_truths(instance, why)) {
        return false;
    }
    settle_outputs(&instance->state);
    return true;
}
