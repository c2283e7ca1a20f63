#include "coupling_prediction.h"

#if N_COUPLINGS > 0

#include <math.h>
#include <string.h>

#include "advance.h"
#include "coupling_exchange.h"
#include "coupling_values.h"

/* The slope of each u if the master holds `force` over the next exchange. */
static void incline_for(State *s, double force)
{
    const Coupling *c = &s->coupling;
    const double more = force - coupling_exchange_held(s, &c->now, 0);
    for (int i = 0; i < N_ACROSS; i++) {
        const bool goes_on = !c->moves[i] || s->v.at[coupling_info.extrapolate] > 0.5;
        if (goes_on && coupling_values_response(s, i) != 0.0) {
            ramp_set(&s->ramp, (int)coupling_info.across[i].input - FIRST_INPUT,
                     c->slope[i] + coupling_values_response(s, i) * more);
        }
    }
}

/* The means over one more exchange as long as the present one, over which the master holds `force`: the state goes
 * there and back. */
static void look_ahead(Instance *instance, double size, double force, double means[])
{
    static const StepOptions alone = {0};
    State *s = &instance->state;
    const double start = s->v.time;
    const Impulses before = coupling_exchange_impulses(s);
    const bool logs = instance->logs[LOG_EVENT];
    Message why;
    for (int i = 0; i < N_THROUGH; i++) {
        means[i] = s->v.at[coupling_info.through[i].output];
    }
    memcpy(&instance->present, s, sizeof *s);
    instance->logs[LOG_EVENT] = false;
    memcpy(s->holds, s->next_holds, sizeof s->holds);
    s->freshness = s->event_waits ? STALE : s->freshness;
    s->event_waits = false;
    s->ramp.over = false;
    incline_for(s, force);
    ramp_begin(&s->ramp, &s->v);
    events_watch(&s->density, start, start + size);
    if (advance_to(instance, start + size, &alone, &why) && s->v.time > start) {
        for (int i = 0; i < N_THROUGH; i++) {
            means[i] = (s->v.at[coupling_info.through[i].impulse] - before.of[i]) / (s->v.time - start);
        }
    }
    instance->logs[LOG_EVENT] = logs;
    memcpy(s, &instance->present, sizeof *s);
}

static bool is_inertia_known(const State *s)
{
    bool is_known = false;
    for (int i = 0; i < N_ACROSS; i++) {
        is_known = is_known || coupling_values_response(s, i) != 0.0;
    }
    return is_known;
}

void coupling_predict(Instance *instance, double size, double owed, double means[])
{
    State *s = &instance->state;
    const double first = coupling_exchange_held(s, &s->coupling.now, 0);
    double again[N_THROUGH];
    look_ahead(instance, size, first, means);
    const double change = means[0] + owed - first;
    if (change == 0.0 || !is_inertia_known(s)) {
        return;
    }
    look_ahead(instance, size, first + change, again);
    const double share = change / (change - (again[0] - means[0])); /* of the way to the second trial */
    for (int i = 0; i < N_THROUGH && isfinite(share); i++) {
        means[i] += share * (again[i] - means[i]);
    }
}

#endif
