#include "derivatives.h"

#include <math.h>

#include "coupling_values.h"
#include "log.h"
#include "settle.h"
#include "validation.h"

static bool at_start(const State *s) { return (s->phase & (INSTANTIATED | INITIALIZING)) != 0; }

static bool is_known(VariableKind kind, bool start)
{
    return kind == TIME || kind == INPUT || kind == PARAMETER || kind == STATE ||
           kind == (start ? FIXED_PARAMETER : STATE_CALCULATED);
}

static bool is_unknown(VariableKind kind) { return kind != TIME && kind != PARAMETER && kind != FIXED_PARAMETER; }

static bool valid_lists(const State *s, References unknown, References known, Message *why)
{
    const bool start = at_start(s);
    for (size_t i = 0; i < unknown.n + known.n; i++) {
        const bool of_known = i >= unknown.n;
        const unsigned reference = of_known ? known.references[i - unknown.n] : unknown.references[i];
        if (!valid_reference(reference, why)) {
            return false;
        }
        const VariableInfo *info = &variable_info[reference];
        if (of_known ? !is_known(info->kind, start) : !is_unknown(info->kind)) {
            message_write(why, "no derivative can be had %s %s: it is not %s %s", of_known ? "with respect to" : "of",
                          info->name, of_known ? "known" : "calculated",
                          start ? "during initialization" : "after initialization");
            return false;
        }
    }
    return true;
}

static bool plant(Variables *d, References references, const double seed[], Message *why)
{
    for (size_t i = 0; i < references.n; i++) {
        if (!isfinite(seed[i])) {
            message_write(why, "the seed of %s is %s: it must be finite", variable_info[references.references[i]].name,
                          quantity(seed[i], "").text);
            return false;
        }
        d->at[references.references[i]] += seed[i];
    }
    return true;
}

static bool harvest(const Variables *d, References references, double values[], Message *why)
{
    for (size_t i = 0; i < references.n; i++) {
        values[i] = d->at[references.references[i]];
        if (!isfinite(values[i])) {
            message_write(why, "the derivative of, or with respect to, %s is not finite",
                          variable_info[references.references[i]].name);
            return false;
        }
    }
    return true;
}

/* One seed and one sensitivity for each variable of the two lists. */
static bool has_lists(Instance *instance, int function, References from, const double seed[], size_t n_seed,
                      References to, const double sensitivity[], size_t n_sensitivity)
{
    return call_has_array(instance, function, seed, n_seed, from.n) &&
           call_has_length(instance, function, n_sensitivity, to.n) &&
           call_has_arguments(instance, function,
                              (from.n == 0 || from.references != NULL) &&
                                  (to.n == 0 || (to.references != NULL && sensitivity != NULL)));
}

Status derivatives_chain(Instance *instance, int function, References unknown, References known, const double seed[],
                         size_t n_seed, double sensitivity[], size_t n_sensitivity)
{
    const bool forward = function == GET_DIRECTIONAL_DERIVATIVE;
    const References from = forward ? known : unknown;
    const References to = forward ? unknown : known;
    Variables d = {.at = {0.0}};
    Message why;
    if (!has_lists(instance, function, from, seed, n_seed, to, sensitivity, n_sensitivity)) {
        return STATUS_ERROR;
    }
    const State *s = &instance->state;
    if (!valid_lists(s, unknown, known, &why) || !plant(&d, from, seed, &why) || !settle_variables(instance, &why)) {
        return log_error(instance, &why);
    }
    (forward ? model_tangent : model_adjoint)(&s->v, s->holds, at_start(s), &d);
    return harvest(&d, to, sensitivity, &why) ? STATUS_OK : log_error(instance, &why);
}

static bool valid_orders(References variables, const int orders[], Message *why)
{
    for (size_t i = 0; i < variables.n; i++) {
        if (!valid_reference(variables.references[i], why)) {
            return false;
        }
        if (orders[i] != 1) {
            message_write(why, "the time derivative of order %d of %s is not offered: the order must be 1", orders[i],
                          variable_info[variables.references[i]].name);
            return false;
        }
    }
    return true;
}

Status derivatives_by_time(Instance *instance, References variables, const int orders[], double values[],
                           size_t n_values)
{
    Variables d = {.at = {0.0}};
    Message why;
    if (!call_has_values(instance, GET_OUTPUT_DERIVATIVES, variables.references, variables.n, values, n_values) ||
        !call_has_arguments(instance, GET_OUTPUT_DERIVATIVES, n_values == 0 || orders != NULL)) {
        return STATUS_ERROR;
    }
    if (!valid_orders(variables, orders, &why) || !settle_variables(instance, &why)) {
        return log_error(instance, &why);
    }
    const State *s = &instance->state;
    d.time = 1.0;
    for (int i = 0; i < N_STATES; i++) {
        d.at[FIRST_STATE + i] = s->v.at[FIRST_DERIVATIVE + i];
    }
    ramp_rates(&s->ramp, &s->v, &d);
    model_tangent(&s->v, s->holds, false, &d);
    coupling_values_still(s, &d);
    return harvest(&d, variables, values, &why) ? STATUS_OK : log_error(instance, &why);
}

static bool is_independent(VariableKind kind, bool start)
{
    return is_known(kind, start) && (start || kind != PARAMETER);
}

/* A seed that is not a number gets, by the chain rule, to all that the variable depends on, and nowhere else. */
Status derivatives_dependencies(Instance *instance, unsigned reference, unsigned independents[], size_t room,
                                size_t *count)
{
    const State *s = &instance->state;
    Variables d = {.at = {0.0}};
    Message why;
    if (!valid_reference(reference, &why) || !settle_variables(instance, &why)) {
        return log_error(instance, &why);
    }
    d.at[reference] = (double)NAN;
    model_adjoint(&s->v, s->holds, at_start(s), &d);
    *count = 0;
    for (unsigned i = 0; i < N_VARIABLES; i++) {
        if (isnan(d.at[i]) && is_independent(variable_info[i].kind, at_start(s))) {
            if (*count < room) {
                independents[*count] = i;
            }
            ++*count;
        }
    }
    return STATUS_OK;
}
