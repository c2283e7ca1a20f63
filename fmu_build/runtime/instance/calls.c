#include "calls.h"

#include "log.h"

const char *call_name(const Instance *instance, int function)
{
    return instance->caller.standard->calls[function].name;
}

/* Log what is wrong with a call: "fmi2Reset must not be called now". */
static bool refuse_call(const Instance *instance, int function, const char *text)
{
    Message why;
    message_write(&why, "%s%s", call_name(instance, function), text);
    (void)log_error(instance, &why);
    return false;
}

static bool refuse_use(const Instance *instance, int function)
{
    const char *refusal = instance->caller.standard->calls[function].refusal;
    if (refusal != NULL) {
        return refuse_call(instance, function, refusal);
    }
    return refuse_call(instance, function,
                       instance->state.use == MODEL_EXCHANGE ? " is not for Model Exchange"
                                                             : " is not for Co-Simulation");
}

static bool refuse_phase(const Instance *instance, int function)
{
    Message why;
    if (instance->state.phase != FAILED) {
        return refuse_call(instance, function,
                           instance->state.phase == UPDATING ? " must not be called during an intermediate update"
                                                             : " must not be called now");
    }
    message_write(&why, " must not be called now: a step has failed, %s or %s comes first", call_name(instance, RESET),
                  call_name(instance, SET_FMU_STATE));
    return refuse_call(instance, function, why.text);
}

bool call_is_legal(Instance *instance, int function)
{
    if (instance == NULL) {
        return false;
    }
    const State *s = &instance->state;
    const Call *call = &instance->caller.standard->calls[function];
    if ((call->uses & 1 << s->use) == 0) {
        return refuse_use(instance, function);
    }
    return (call->phases & (int)s->phase) != 0 || refuse_phase(instance, function);
}

bool call_has_arguments(const Instance *instance, int function, bool given)
{
    return given || refuse_call(instance, function, ": an argument is NULL");
}

bool call_has_length(const Instance *instance, int function, size_t n, size_t needed)
{
    Message why;
    if (n == needed) {
        return true;
    }
    message_write(&why, ": %s has %zu elements instead of %zu", instance->caller.standard->array, n, needed);
    return refuse_call(instance, function, why.text);
}

bool call_is_complete(Instance *instance, int function, bool given)
{
    return call_is_legal(instance, function) && call_has_arguments(instance, function, given);
}

bool call_has_array(Instance *instance, int function, const void *array, size_t n, size_t needed)
{
    return call_is_legal(instance, function) && call_has_length(instance, function, n, needed) &&
           call_has_arguments(instance, function, n == 0 || array != NULL);
}

bool call_has_values(Instance *instance, int function, const unsigned references[], size_t n, const void *values,
                     size_t n_values)
{
    return call_has_array(instance, function, values, n_values, n) &&
           call_has_arguments(instance, function, n == 0 || references != NULL);
}
