#include "input_range.h"

#include <math.h>

#include "log.h"

/* Of the limit, or of the nominal value. Importers' solvers keep a limit to within their tolerance, which is rarely
 * finer, so that less says nothing. */
static const double ROUNDING = 1e-6;

double input_range_limited(Instance *instance, int input, double value)
{
    const VariableInfo *info = &variable_info[FIRST_INPUT + input];
    const double acting = ramp_limited(input, value);
    Message warning;
    if (!instance->told_of_range[input] && fabs(value - acting) > ROUNDING * fmax(info->nominal, fabs(acting))) {
        instance->told_of_range[input] = true;
        message_write(&warning,
                      "%s = %s is beyond its range, which is %s to %s: its limit acts, now and where it is so again",
                      info->name, quantity(value, info->unit).text, quantity(info->min, info->unit).text,
                      quantity(info->max, info->unit).text);
        log_write(instance, LOG_WARNING, STATUS_WARNING, &warning);
    }
    return acting;
}

void input_range_look_ahead(Instance *instance, double end)
{
    const State *s = &instance->state;
    for (int i = 0; i < N_INPUTS && s->ramp.is_set && !s->ramp.over; i++) {
        (void)input_range_limited(instance, i, s->v.at[FIRST_INPUT + i] + s->ramp.slope[i] * (end - s->v.time));
    }
}
