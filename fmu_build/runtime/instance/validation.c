#include "validation.h"

#include <math.h>

#include "error.h"
#include "event_time.h"
#include "finite.h"
#include "loops.h"

static const double LOOSEST_TOLERANCE = 1e-2;
static const double TIGHTEST_TOLERANCE = 1e-12;

/* Of a step. Callers sum up their communication points in various ways, and some round them, to 1e-6 s for instance. A
 * point so near is taken for where the instance is; one beyond the first share is no rounding error of a sum. */
static const double SAME_POINT = 1e-9;
static const double NEAR_POINT = 1e-2;

bool valid_reference(unsigned reference, Message *why)
{
    if (reference < N_VARIABLES) {
        return true;
    }
    message_write(why, "there is no variable with value reference %u: the last one is %d", reference, N_VARIABLES - 1);
    return false;
}

static const char type_names[][16] = {
    [REAL] = "a Real", [INTEGER] = "an Integer", [BOOLEAN] = "a Boolean", [ENUMERATION] = "an enumeration"};

void explain_type(unsigned reference, const char *type, Message *why)
{
    if (valid_reference(reference, why)) {
        message_write(why, "%s is %s, not %s", variable_info[reference].name, type_names[variable_info[reference].type],
                      type);
    }
}

bool valid_type(unsigned reference, ValueType type, Message *why)
{
    if (reference < N_VARIABLES && variable_info[reference].type == type) {
        return true;
    }
    explain_type(reference, type_names[type], why);
    return false;
}

/* NULL if a variable may be set in the phase, otherwise why not. */
static const char *why_not_set(VariableKind kind, ValueType type, Phase phase)
{
    const bool before_start = phase == INSTANTIATED || phase == INITIALIZING;
    switch (kind) {
    case INPUT:
        return type != REAL && phase == CONTINUOUS
                   ? "it is no Real, which can be set in event mode but not between events"
                   : NULL;
    case PARAMETER:
        return phase == CONTINUOUS ? "it is a parameter, which can be set in event mode but not between events" : NULL;
    case STATE:
        return before_start || phase == CONTINUOUS
                   ? NULL
                   : "it is a state, which can be set before and during initialization only";
    case FIXED_PARAMETER:
        return before_start ? NULL : "it is a parameter that only start values depend on";
    case STATE_CALCULATED:
        return phase == CONTINUOUS ? NULL : "it is a state whose start value follows from parameters";
    case TIME:
        return "it is the time";
    case DERIVATIVE:
    case CALCULATED_PARAMETER:
    case OTHER:
        break;
    }
    return "it is calculated";
}

static bool refuse_value(const VariableInfo *info, double value, Message *why)
{
    message_write(why, "%s = %s is not allowed: its range is %s to %s", info->name, quantity(value, info->unit).text,
                  quantity(info->min, info->unit).text, quantity(info->max, info->unit).text);
    return false;
}

bool valid_setting(unsigned reference, double value, Phase phase, Message *why)
{
    if (!valid_reference(reference, why)) {
        return false;
    }
    const VariableInfo *info = &variable_info[reference];
    const char *obstacle = why_not_set(info->kind, info->type, phase);
    if (obstacle != NULL) {
        message_write(why, "%s cannot be set: %s", info->name, obstacle);
        return false;
    }
    return isfinite(value) || refuse_value(info, value, why);
}

bool valid_range(unsigned reference, double value, Message *why)
{
    const VariableInfo *info = &variable_info[reference];
    return (info->kind == INPUT && info->type == REAL) || (value >= info->min && value <= info->max) ||
           refuse_value(info, value, why);
}

bool valid_slope(unsigned reference, double slope, Message *why)
{
    if (!valid_reference(reference, why)) {
        return false;
    }
    const VariableInfo *info = &variable_info[reference];
    if (info->kind != INPUT || info->type != REAL || !isfinite(slope)) {
        message_write(why, "the time derivative of %s cannot be set to %s: %s", info->name, quantity(slope, "").text,
                      info->kind != INPUT  ? "it is no input"
                      : info->type != REAL ? "it is no Real"
                                           : "it must be finite");
        return false;
    }
    return true;
}

bool valid_result(unsigned reference, double value, double time, Message *why)
{
    if (isfinite(value)) {
        return true;
    }
    const VariableInfo *info = &variable_info[reference];
    message_write(why, "%s = %s is not finite at t = %s", info->name, quantity(value, info->unit).text,
                  quantity(time, "s").text);
    return false;
}

bool valid_experiment(const double *tolerance, double start, const double *stop, Message *why)
{
    if (tolerance != NULL && !(*tolerance >= TIGHTEST_TOLERANCE && *tolerance <= LOOSEST_TOLERANCE)) {
        message_write(why, "tolerance = %s is not allowed: its range is %g to %g", quantity(*tolerance, "").text,
                      TIGHTEST_TOLERANCE, LOOSEST_TOLERANCE);
        return false;
    }
    if (!isfinite(start)) {
        message_write(why, "start time = %s is not allowed: it must be finite", quantity(start, "s").text);
        return false;
    }
    if (stop != NULL && !(*stop >= start)) {
        message_write(why, "stop time = %s is not allowed: the start time is %s", quantity(*stop, "s").text,
                      quantity(start, "s").text);
        return false;
    }
    return true;
}

/* The distance of two times may be a share of the step, and what rounding makes of times of their size. */
static bool within(const State *s, double time, double size, double share)
{
    return fabs(time - s->v.time) <= share * size + SAME_TIME * fabs(s->v.time);
}

bool same_point(const State *s, double time, double size) { return within(s, time, size, SAME_POINT); }

bool valid_step(const State *s, double time, double size, Message *why)
{
    if (!(size > 0.0) || !isfinite(size)) {
        message_write(why, "communication step size = %s is not allowed: it must be positive and finite",
                      quantity(size, "s").text);
        return false;
    }
    if (!within(s, time, size, NEAR_POINT) || !isfinite(time + size)) {
        message_write(why, "communication point = %.17g s is not allowed: the instance is at t = %.17g s", time,
                      s->v.time);
        return false;
    }
    if (s->event_waits) {
        message_write(why, "no step can be made from t = %s: there is an event, which event mode has to handle first",
                      quantity(s->v.time, "s").text);
        return false;
    }
    if (time >= s->stop) { /* a step that begins before it is made whole: see docs/fmu.md */
        message_write(why, "a step from %s to %s is not allowed: the stop time is %s", quantity(time, "s").text,
                      quantity(time + size, "s").text, quantity(s->stop, "s").text);
        return false;
    }
    return true;
}

/* Most often they are, and there is no need to ask what the tolerance allows. */
static bool are_within(const double states[])
{
    bool within = true;
    for (int i = 0; i < N_STATES; i++) {
        const VariableInfo *info = &variable_info[FIRST_STATE + i];
        within &= (states[i] >= info->min) & (states[i] <= info->max);
    }
    return within;
}

bool valid_states(const Point *p, double tolerance, Message *why)
{
    if (are_within(p->state)) {
        return true;
    }
    for (int i = 0; i < N_STATES; i++) {
        const VariableInfo *info = &variable_info[FIRST_STATE + i];
        const double value = p->state[i];
        const double slack = error_allowed(i, value, tolerance);
        const bool low = value < info->min - slack;
        if (low || value > info->max + slack) {
            message_write(why, "%s = %s has %s of %s at t = %s", info->name, quantity(value, info->unit).text,
                          low ? "fallen below its minimum" : "risen above its maximum",
                          quantity(low ? info->min : info->max, info->unit).text, quantity(p->time, "s").text);
            return false;
        }
    }
    return true;
}

/* What has been set, inputs and parameters, is finite. */
static int first_bad_variable(const Variables *v)
{
    static const int first_calculated = FIRST_PARAMETER + N_PARAMETERS;
    const int bad = first_not_finite(v->at, FIRST_INPUT);
    if (bad != FINITE) {
        return bad;
    }
    const int other = first_not_finite(&v->at[first_calculated], N_VARIABLES - first_calculated);
    return other != FINITE ? first_calculated + other : FINITE;
}

bool valid_variables(const Variables *v, Message *why)
{
    const int bad = first_bad_variable(v);
    if (bad == FINITE) {
        return true;
    }
    (void)valid_result((unsigned)bad, v->at[bad], v->time, why);
    loops_explain(v, why);
    return false;
}
