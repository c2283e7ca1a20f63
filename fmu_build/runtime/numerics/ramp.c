#include "ramp.h"

#include <string.h>

static void forget_if_over(Ramp *ramp)
{
    if (ramp->over && ramp->is_set) {
        memset(ramp, 0, sizeof *ramp);
    }
    ramp->over = false;
}

void ramp_set(Ramp *ramp, int input, double slope)
{
    forget_if_over(ramp);
    ramp->slope[input] = slope;
    ramp->given[input] = ramp->is_set = true;
}

void ramp_begin(Ramp *ramp, const Variables *v)
{
    forget_if_over(ramp);
    ramp->moves = false;
    if (!ramp->is_set) {
        return;
    }
    ramp->start = v->time;
    for (int i = 0; i < N_INPUTS; i++) {
        ramp->from[i] = v->at[FIRST_INPUT + i];
        ramp->moves = ramp->moves || ramp->slope[i] != 0.0;
    }
}

double ramp_limited(int input, double value)
{
    const VariableInfo *info = &variable_info[FIRST_INPUT + input];
    return value < info->min ? info->min : value > info->max ? info->max : value;
}

void ramp_apply(const Ramp *ramp, Variables *v)
{
    bool moves = false;
    for (int i = 0; i < N_INPUTS && ramp->moves; i++) {
        v->at[FIRST_INPUT + i] = ramp_limited(i, ramp->from[i] + ramp->slope[i] * (v->time - ramp->start));
        moves = moves || (moves_steady[i] && ramp->slope[i] != 0.0);
    }
    if (moves) {
        model_steady(v);
    }
}

void ramp_rates(const Ramp *ramp, const Variables *v, Variables *d)
{
    for (int i = 0; i < N_INPUTS; i++) {
        const VariableInfo *info = &variable_info[FIRST_INPUT + i];
        const double value = v->at[FIRST_INPUT + i];
        const bool stays = ramp->slope[i] > 0.0 ? value >= info->max : value <= info->min;
        d->at[FIRST_INPUT + i] = stays ? 0.0 : ramp->slope[i];
    }
}

void ramp_end(Ramp *ramp)
{
    ramp->moves = false;
    ramp->over = true;
}
