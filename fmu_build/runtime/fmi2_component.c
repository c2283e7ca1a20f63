#include "fmi2_component.h"

#include <string.h>

/* Which call is legal in which state: the table of section 4.2.4. Nothing here is asynchronous, so its states
 * stepInProgress, stepFailed and stepCanceled never occur; FAILED is its "error". Inputs may be set before
 * initialization, though the standard forbids it: many importers do so. */
enum {
    ANY_TIME = INSTANTIATED | INITIALIZING | STEPPING | TERMINATED | FAILED,
    READABLE = INITIALIZING | STEPPING | TERMINATED | FAILED,
    SETTABLE = INSTANTIATED | INITIALIZING | STEPPING
};

static const struct {
    const char *name;
    int legal_in;
} rules[] = {
    [SET_DEBUG_LOGGING] = {"fmi2SetDebugLogging", ANY_TIME},
    [SETUP_EXPERIMENT] = {"fmi2SetupExperiment", INSTANTIATED},
    [ENTER_INITIALIZATION_MODE] = {"fmi2EnterInitializationMode", INSTANTIATED},
    [EXIT_INITIALIZATION_MODE] = {"fmi2ExitInitializationMode", INITIALIZING},
    [TERMINATE] = {"fmi2Terminate", STEPPING},
    [RESET] = {"fmi2Reset", ANY_TIME},
    [GET_REAL] = {"fmi2GetReal", READABLE},
    [GET_INTEGER] = {"fmi2GetInteger", READABLE},
    [GET_BOOLEAN] = {"fmi2GetBoolean", READABLE},
    [GET_STRING] = {"fmi2GetString", READABLE},
    [SET_REAL] = {"fmi2SetReal", SETTABLE},
    [SET_INTEGER] = {"fmi2SetInteger", SETTABLE},
    [SET_BOOLEAN] = {"fmi2SetBoolean", SETTABLE},
    [SET_STRING] = {"fmi2SetString", SETTABLE},
    [GET_FMU_STATE] = {"fmi2GetFMUstate", ANY_TIME},
    [SET_FMU_STATE] = {"fmi2SetFMUstate", ANY_TIME},
    [FREE_FMU_STATE] = {"fmi2FreeFMUstate", ANY_TIME},
    [SERIALIZED_FMU_STATE_SIZE] = {"fmi2SerializedFMUstateSize", ANY_TIME},
    [SERIALIZE_FMU_STATE] = {"fmi2SerializeFMUstate", ANY_TIME},
    [DESERIALIZE_FMU_STATE] = {"fmi2DeSerializeFMUstate", ANY_TIME},
    [GET_DIRECTIONAL_DERIVATIVE] = {"fmi2GetDirectionalDerivative", READABLE},
    [SET_REAL_INPUT_DERIVATIVES] = {"fmi2SetRealInputDerivatives", SETTABLE},
    [GET_REAL_OUTPUT_DERIVATIVES] = {"fmi2GetRealOutputDerivatives", STEPPING | TERMINATED | FAILED},
    [DO_STEP] = {"fmi2DoStep", STEPPING},
    [CANCEL_STEP] = {"fmi2CancelStep", 0},
    [GET_STATUS] = {"fmi2GetStatus", STEPPING | TERMINATED | FAILED},
    [GET_REAL_STATUS] = {"fmi2GetRealStatus", STEPPING | TERMINATED | FAILED},
    [GET_INTEGER_STATUS] = {"fmi2GetIntegerStatus", STEPPING | TERMINATED | FAILED},
    [GET_BOOLEAN_STATUS] = {"fmi2GetBooleanStatus", STEPPING | TERMINATED | FAILED},
    [GET_STRING_STATUS] = {"fmi2GetStringStatus", STEPPING | TERMINATED | FAILED},
};

const char *const category_name[N_LOG_CATEGORIES] = {
    [LOG_ERROR] = "logStatusError",
    [LOG_WARNING] = "logStatusWarning",
    [LOG_EVENT] = "logEvents",
};

/* The message is an argument, never the format: it may quote the caller. */
static void log_to_callback(void *receiver, LogCategory category, const char *message)
{
    static const fmi2Status status[N_LOG_CATEGORIES] = {
        [LOG_ERROR] = fmi2Error, [LOG_WARNING] = fmi2Warning, [LOG_EVENT] = fmi2OK};
    const Component *component = receiver;
    if (component->callbacks.logger != NULL) {
        component->callbacks.logger(component->callbacks.componentEnvironment, component->name, status[category],
                                    category_name[category], "%s", message);
    }
}

const char *function_name(Function function) { return rules[function].name; }

fmi2Status report(Component *component, fmi2Status status, const Message *message)
{
    instance_log(&component->instance, status == fmi2Error ? LOG_ERROR : LOG_WARNING, message);
    return status;
}

Component *legal(fmi2Component c, Function function)
{
    Component *component = c;
    Message message;
    if (component == NULL) {
        return NULL;
    }
    if ((rules[function].legal_in & (int)component->instance.state.phase) == 0) {
        message_write(&message, "%s must not be called now%s", rules[function].name,
                      component->instance.state.phase == FAILED ? ": a step has failed, fmi2Reset comes first" : "");
        (void)report(component, fmi2Error, &message);
        return NULL;
    }
    return component;
}

fmi2Status null_argument(Component *component, Function function)
{
    Message message;
    message_write(&message, "%s: an argument is NULL", rules[function].name);
    return report(component, fmi2Error, &message);
}

fmi2Status not_offered(fmi2Component c, Function function)
{
    Message message;
    Component *component = legal(c, function);
    if (component == NULL) {
        return fmi2Error;
    }
    message_write(&message, "%s: this capability is not offered, see modelDescription.xml", rules[function].name);
    return report(component, fmi2Error, &message);
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
    message_write(&message, "%s: all variables are of type Real", rules[function].name);
    return report(component, fmi2Error, &message);
}

int category_index(fmi2String name)
{
    for (int i = 0; i < N_LOG_CATEGORIES; i++) {
        if (name != NULL && strcmp(name, category_name[i]) == 0) {
            return i;
        }
    }
    return N_LOG_CATEGORIES;
}

void component_create(Component *component, const char *name, const fmi2CallbackFunctions *callbacks)
{
    component->callbacks = *callbacks;
    memcpy(component->name, name, strlen(name) + 1);
    instance_create(&component->instance, log_to_callback, component);
}
