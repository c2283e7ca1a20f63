#include "ramp.h"

#include <math.h>
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

void ramp_apply(const Ramp *ramp, Variables *v)
{
    for (int i = 0; i < N_INPUTS && ramp->moves; i++) {
        const VariableInfo *info = &variable_info[FIRST_INPUT + i];
        const double value = ramp->from[i] + ramp->slope[i] * (v->time - ramp->start);
        v->at[FIRST_INPUT + i] = fmin(info->max, fmax(info->min, value));
    }
}

void ramp_end(Ramp *ramp)
{
    ramp->moves = false;
    ramp->over = true;
}
