#include "fmi2_component.h"

#include <stdlib.h>
#include <string.h>

#include "instance.h"
#include "log.h"

/* Which call is legal in which state: the tables of sections 3.2.3 (Model Exchange) and 4.2.4 (Co-Simulation). Nothing
 * here is asynchronous, so the states stepInProgress, stepFailed and stepCanceled never occur; FAILED is "error".
 * Inputs may be set before initialization, though the standard forbids it: many importers do so. */
enum {
    FMI2_ANY_TIME = INSTANTIATED | INITIALIZING | STEPPING | EVENT_MODE | CONTINUOUS | TERMINATED | FAILED,
    FMI2_READABLE = INITIALIZING | STEPPING | EVENT_MODE | CONTINUOUS | TERMINATED | FAILED,
    FMI2_SETTABLE = INSTANTIATED | INITIALIZING | STEPPING | EVENT_MODE | CONTINUOUS,
    FMI2_STEPPED = STEPPING | TERMINATED | FAILED
};

static const Call fmi2_calls[] = {
    [SET_DEBUG_LOGGING] = {"fmi2SetDebugLogging", BOTH, FMI2_ANY_TIME, NULL},
    [SETUP_EXPERIMENT] = {"fmi2SetupExperiment", BOTH, INSTANTIATED, NULL},
    [ENTER_INITIALIZATION_MODE] = {"fmi2EnterInitializationMode", BOTH, INSTANTIATED, NULL},
    [EXIT_INITIALIZATION_MODE] = {"fmi2ExitInitializationMode", BOTH, INITIALIZING, NULL},
    [TERMINATE] = {"fmi2Terminate", BOTH, STEPPING | EVENT_MODE | CONTINUOUS, NULL},
    [RESET] = {"fmi2Reset", BOTH, FMI2_ANY_TIME, NULL},
    [GET_REAL] = {"fmi2GetReal", BOTH, FMI2_READABLE, NULL},
    [GET_INTEGER] = {"fmi2GetInteger", BOTH, FMI2_READABLE, NULL},
    [GET_BOOLEAN] = {"fmi2GetBoolean", BOTH, FMI2_READABLE, NULL},
    [GET_STRING] = {"fmi2GetString", BOTH, FMI2_READABLE, NULL},
    [SET_REAL] = {"fmi2SetReal", BOTH, FMI2_SETTABLE, NULL},
    [SET_INTEGER] = {"fmi2SetInteger", BOTH, FMI2_SETTABLE & ~CONTINUOUS, NULL},
    [SET_BOOLEAN] = {"fmi2SetBoolean", BOTH, FMI2_SETTABLE & ~CONTINUOUS, NULL},
    [SET_STRING] = {"fmi2SetString", BOTH, FMI2_SETTABLE & ~CONTINUOUS, NULL},
    [GET_FMU_STATE] = {"fmi2GetFMUstate", BOTH, FMI2_ANY_TIME, NULL},
    [SET_FMU_STATE] = {"fmi2SetFMUstate", BOTH, FMI2_ANY_TIME, NULL},
    [FREE_FMU_STATE] = {"fmi2FreeFMUstate", BOTH, FMI2_ANY_TIME, NULL},
    [SERIALIZED_FMU_STATE_SIZE] = {"fmi2SerializedFMUstateSize", BOTH, FMI2_ANY_TIME, NULL},
    [SERIALIZE_FMU_STATE] = {"fmi2SerializeFMUstate", BOTH, FMI2_ANY_TIME, NULL},
    [DESERIALIZE_FMU_STATE] = {"fmi2DeSerializeFMUstate", BOTH, FMI2_ANY_TIME, NULL},
    [GET_DIRECTIONAL_DERIVATIVE] = {"fmi2GetDirectionalDerivative", BOTH, FMI2_READABLE, NULL},
    [SET_REAL_INPUT_DERIVATIVES] = {"fmi2SetRealInputDerivatives", CS, FMI2_SETTABLE, NULL},
    [GET_OUTPUT_DERIVATIVES] = {"fmi2GetRealOutputDerivatives", CS, FMI2_STEPPED, NULL},
    [ENTER_EVENT_MODE] = {"fmi2EnterEventMode", ME, EVENT_MODE | CONTINUOUS, NULL},
    [UPDATE_DISCRETE_STATES] = {"fmi2NewDiscreteStates", ME, EVENT_MODE, NULL},
    [ENTER_CONTINUOUS_TIME_MODE] = {"fmi2EnterContinuousTimeMode", ME, EVENT_MODE, NULL},
    [COMPLETED_INTEGRATOR_STEP] = {"fmi2CompletedIntegratorStep", ME, CONTINUOUS, NULL},
    [SET_TIME] = {"fmi2SetTime", ME, EVENT_MODE | CONTINUOUS, NULL},
    [SET_CONTINUOUS_STATES] = {"fmi2SetContinuousStates", ME, CONTINUOUS, NULL},
    [GET_CONTINUOUS_STATE_DERIVATIVES] = {"fmi2GetDerivatives", ME, FMI2_READABLE, NULL},
    [GET_EVENT_INDICATORS] = {"fmi2GetEventIndicators", ME, FMI2_READABLE, NULL},
    [GET_CONTINUOUS_STATES] = {"fmi2GetContinuousStates", ME, FMI2_READABLE, NULL},
    [GET_NOMINALS_OF_CONTINUOUS_STATES] = {"fmi2GetNominalsOfContinuousStates", ME, FMI2_ANY_TIME, NULL},
    [DO_STEP] = {"fmi2DoStep", CS, STEPPING, NULL},
    [CANCEL_STEP] = {"fmi2CancelStep", CS, 0, NULL},
    [GET_STATUS] = {"fmi2GetStatus", CS, FMI2_STEPPED, NULL},
    [GET_REAL_STATUS] = {"fmi2GetRealStatus", CS, FMI2_STEPPED, NULL},
    [GET_INTEGER_STATUS] = {"fmi2GetIntegerStatus", CS, FMI2_STEPPED, NULL},
    [GET_BOOLEAN_STATUS] = {"fmi2GetBooleanStatus", CS, FMI2_STEPPED, NULL},
    [GET_STRING_STATUS] = {"fmi2GetStringStatus", CS, FMI2_STEPPED, NULL},
};

static const Standard fmi2_standard = {.array = "the vector", .calls = fmi2_calls};

fmi2Status to_fmi2(Status status)
{
    static const fmi2Status same[] = {[STATUS_OK] = fmi2OK,
                                      [STATUS_WARNING] = fmi2Warning,
                                      [STATUS_DISCARD] = fmi2Discard,
                                      [STATUS_ERROR] = fmi2Error};
    return same[status];
}

/* The message is an argument, never the format: it may quote the caller. */
static void fmi2_log(void *receiver, LogCategory category, Status status, const char *message)
{
    const Component *component = receiver;
    if (component->callbacks.logger != NULL) {
        component->callbacks.logger(component->callbacks.componentEnvironment, component->name, to_fmi2(status),
                                    log_category_name[category], "%s", message);
    }
}

Component *fmi2_component_create(const char *name, Use use, const fmi2CallbackFunctions *callbacks)
{
    const size_t length = strlen(name) + 1;
    const bool own_memory = callbacks->allocateMemory == NULL || callbacks->freeMemory == NULL;
    Caller caller = {.standard = &fmi2_standard,
                     .allocate = own_memory ? calloc : callbacks->allocateMemory,
                     .release = own_memory ? free : callbacks->freeMemory,
                     .log = fmi2_log};
    Component *component = caller.allocate(1, sizeof *component + length);
    if (component != NULL) {
        caller.receiver = component;
        component->callbacks = *callbacks;
        memcpy(component->name, name, length);
        instance_create(&component->instance, use, &caller);
    }
    return component;
}
