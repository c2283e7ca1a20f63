#include "coupling_values.h"

#if N_COUPLINGS > 0

void coupling_values_note(State *s, unsigned reference)
{
    s->coupling.is_set = s->coupling.is_set || reference == coupling_info.across;
}

void coupling_values_show(State *s)
{
    const Coupling *c = &s->coupling;
    if (c->stepped) { /* until then they are what the model's equations make them */
        s->v.at[coupling_info.mean] = c->mean;
        s->v.at[coupling_info.hold] = c->hold;
        s->v.at[coupling_info.energy] = c->now.energy;
    }
}

void coupling_values_still(const State *s, Variables *derivatives)
{
    if (s->coupling.stepped) {
        derivatives->at[coupling_info.mean] = 0.0;
        derivatives->at[coupling_info.hold] = 0.0;
        derivatives->at[coupling_info.energy] = 0.0;
    }
}

#endif
