#include "fmi2_component.h"

#include <stdlib.h>
#include <string.h>

/* Which call is legal in which state: the tables of sections 3.2.3 (Model Exchange) and 4.2.4 (Co-Simulation). Nothing
 * here is asynchronous, so the states stepInProgress, stepFailed and stepCanceled never occur; FAILED is "error".
 * Inputs may be set before initialization, though the standard forbids it: many importers do so. */
enum {
    ANY_TIME = INSTANTIATED | INITIALIZING | STEPPING | EVENT_MODE | CONTINUOUS | TERMINATED | FAILED,
    READABLE = INITIALIZING | STEPPING | EVENT_MODE | CONTINUOUS | TERMINATED | FAILED,
    SETTABLE = INSTANTIATED | INITIALIZING | STEPPING | EVENT_MODE | CONTINUOUS,
    STEPPED = STEPPING | TERMINATED | FAILED
};

typedef enum { CS = 1, ME = 2, BOTH = CS | ME } Interface;

static const struct {
    const char *name;
    Interface interface;
    int legal_in;
} rules[] = {
    [SET_DEBUG_LOGGING] = {"fmi2SetDebugLogging", BOTH, ANY_TIME},
    [SETUP_EXPERIMENT] = {"fmi2SetupExperiment", BOTH, INSTANTIATED},
    [ENTER_INITIALIZATION_MODE] = {"fmi2EnterInitializationMode", BOTH, INSTANTIATED},
    [EXIT_INITIALIZATION_MODE] = {"fmi2ExitInitializationMode", BOTH, INITIALIZING},
    [TERMINATE] = {"fmi2Terminate", BOTH, STEPPING | EVENT_MODE | CONTINUOUS},
    [RESET] = {"fmi2Reset", BOTH, ANY_TIME},
    [GET_REAL] = {"fmi2GetReal", BOTH, READABLE},
    [GET_INTEGER] = {"fmi2GetInteger", BOTH, READABLE},
    [GET_BOOLEAN] = {"fmi2GetBoolean", BOTH, READABLE},
    [GET_STRING] = {"fmi2GetString", BOTH, READABLE},
    [SET_REAL] = {"fmi2SetReal", BOTH, SETTABLE},
    [SET_INTEGER] = {"fmi2SetInteger", BOTH, SETTABLE & ~CONTINUOUS},
    [SET_BOOLEAN] = {"fmi2SetBoolean", BOTH, SETTABLE & ~CONTINUOUS},
    [SET_STRING] = {"fmi2SetString", BOTH, SETTABLE & ~CONTINUOUS},
    [GET_FMU_STATE] = {"fmi2GetFMUstate", BOTH, ANY_TIME},
    [SET_FMU_STATE] = {"fmi2SetFMUstate", BOTH, ANY_TIME},
    [FREE_FMU_STATE] = {"fmi2FreeFMUstate", BOTH, ANY_TIME},
    [SERIALIZED_FMU_STATE_SIZE] = {"fmi2SerializedFMUstateSize", BOTH, ANY_TIME},
    [SERIALIZE_FMU_STATE] = {"fmi2SerializeFMUstate", BOTH, ANY_TIME},
    [DESERIALIZE_FMU_STATE] = {"fmi2DeSerializeFMUstate", BOTH, ANY_TIME},
    [GET_DIRECTIONAL_DERIVATIVE] = {"fmi2GetDirectionalDerivative", BOTH, READABLE},
    [SET_REAL_INPUT_DERIVATIVES] = {"fmi2SetRealInputDerivatives", CS, SETTABLE},
    [GET_REAL_OUTPUT_DERIVATIVES] = {"fmi2GetRealOutputDerivatives", CS, STEPPED},
    [ENTER_EVENT_MODE] = {"fmi2EnterEventMode", ME, EVENT_MODE | CONTINUOUS},
    [NEW_DISCRETE_STATES] = {"fmi2NewDiscreteStates", ME, EVENT_MODE},
    [ENTER_CONTINUOUS_TIME_MODE] = {"fmi2EnterContinuousTimeMode", ME, EVENT_MODE},
    [COMPLETED_INTEGRATOR_STEP] = {"fmi2CompletedIntegratorStep", ME, CONTINUOUS},
    [SET_TIME] = {"fmi2SetTime", ME, EVENT_MODE | CONTINUOUS},
    [SET_CONTINUOUS_STATES] = {"fmi2SetContinuousStates", ME, CONTINUOUS},
    [GET_DERIVATIVES] = {"fmi2GetDerivatives", ME, READABLE},
    [GET_EVENT_INDICATORS] = {"fmi2GetEventIndicators", ME, READABLE},
    [GET_CONTINUOUS_STATES] = {"fmi2GetContinuousStates", ME, READABLE},
    [GET_NOMINALS_OF_CONTINUOUS_STATES] = {"fmi2GetNominalsOfContinuousStates", ME, ANY_TIME},
    [DO_STEP] = {"fmi2DoStep", CS, STEPPING},
    [CANCEL_STEP] = {"fmi2CancelStep", CS, 0},
    [GET_STATUS] = {"fmi2GetStatus", CS, STEPPED},
    [GET_REAL_STATUS] = {"fmi2GetRealStatus", CS, STEPPED},
    [GET_INTEGER_STATUS] = {"fmi2GetIntegerStatus", CS, STEPPED},
    [GET_BOOLEAN_STATUS] = {"fmi2GetBooleanStatus", CS, STEPPED},
    [GET_STRING_STATUS] = {"fmi2GetStringStatus", CS, STEPPED},
};

fmi2Status to_fmi2(Status status)
{
    static const fmi2Status same[] = {[STATUS_OK] = fmi2OK,
                                      [STATUS_WARNING] = fmi2Warning,
                                      [STATUS_DISCARD] = fmi2Discard,
                                      [STATUS_ERROR] = fmi2Error};
    return same[status];
}

/* The message is an argument, never the format: it may quote the caller. */
static void log_to_callback(void *receiver, LogCategory category, Status status, const char *message)
{
    const Component *component = receiver;
    if (component->callbacks.logger != NULL) {
        component->callbacks.logger(component->callbacks.componentEnvironment, component->name, to_fmi2(status),
                                    category_name[category], "%s", message);
    }
}

const char *function_name(Function function) { return rules[function].name; }

fmi2Status report(Component *component, Status status, const Message *message)
{
    instance_log(&component->instance, status == STATUS_ERROR ? LOG_ERROR : LOG_WARNING, status, message);
    return to_fmi2(status);
}

Component *legal(fmi2Component c, Function function)
{
    Component *component = c;
    Message message;
    if (component == NULL) {
        return NULL;
    }
    const State *s = &component->instance.state;
    const Interface interface = s->use == MODEL_EXCHANGE ? ME : CS;
    if ((rules[function].interface & interface) == 0) {
        message_write(&message, "%s is not for %s", rules[function].name,
                      interface == ME ? "Model Exchange" : "Co-Simulation");
    } else if ((rules[function].legal_in & (int)s->phase) == 0) {
        message_write(&message, "%s must not be called now%s", rules[function].name,
                      s->phase == FAILED ? ": a step has failed, fmi2Reset or fmi2SetFMUstate comes first" : "");
    } else {
        return component;
    }
    (void)report(component, STATUS_ERROR, &message);
    return NULL;
}

fmi2Status null_argument(Component *component, Function function)
{
    Message message;
    message_write(&message, "%s: an argument is NULL", rules[function].name);
    return report(component, STATUS_ERROR, &message);
}

fmi2Status wrong_length(Component *component, Function function, size_t n, int needed)
{
    Message message;
    message_write(&message, "%s: the vector has %zu elements instead of %d", rules[function].name, n, needed);
    return report(component, STATUS_ERROR, &message);
}

static bool own_memory(const fmi2CallbackFunctions *callbacks)
{
    return callbacks->allocateMemory == NULL || callbacks->freeMemory == NULL;
}

void *allocate(const fmi2CallbackFunctions *callbacks, size_t size)
{
    return own_memory(callbacks) ? calloc(1, size) : callbacks->allocateMemory(1, size);
}

void release(const fmi2CallbackFunctions *callbacks, void *memory)
{
    if (own_memory(callbacks)) {
        free(memory);
    } else {
        callbacks->freeMemory(memory);
    }
}

fmi2Status no_variables(fmi2Component c, Function function, size_t n)
{
    Message message;
    Component *component = legal(c, function);
    if (component == NULL) {
        return fmi2Error;
    }
    if (n == 0) {
        return fmi2OK;
    }
    message_write(&message, "%s: there are no variables of this type", rules[function].name);
    return report(component, STATUS_ERROR, &message);
}

void component_create(Component *component, const char *name, Use use, const fmi2CallbackFunctions *callbacks)
{
    component->callbacks = *callbacks;
    memcpy(component->name, name, strlen(name) + 1);
    instance_create(&component->instance, use, log_to_callback, component);
}
