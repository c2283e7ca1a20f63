#include "coupling_values.h"

#if N_COUPLINGS > 0

void coupling_values_note(State *s, unsigned reference)
{
    for (int i = 0; i < N_ACROSS; i++) {
        s->coupling.is_set[i] = s->coupling.is_set[i] || reference == coupling_info.across[i].input;
    }
}

void coupling_values_show(State *s)
{
    const Coupling *c = &s->coupling;
    if (c->stepped) { /* until then they are what the model's equations make them */
        for (int i = 0; i < N_THROUGH; i++) {
            s->v.at[coupling_info.through[i].mean] = c->mean[i];
            s->v.at[coupling_info.through[i].hold] = c->hold[i];
        }
        s->v.at[coupling_info.energy] = c->now.energy;
    }
}

void coupling_values_still(const State *s, Variables *derivatives)
{
    if (s->coupling.stepped) {
        for (int i = 0; i < N_THROUGH; i++) {
            derivatives->at[coupling_info.through[i].mean] = 0.0;
            derivatives->at[coupling_info.through[i].hold] = 0.0;
        }
        derivatives->at[coupling_info.energy] = 0.0;
    }
}

#endif
