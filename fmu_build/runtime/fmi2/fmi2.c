/* FMI 2.0 (version 2.0.5 of the standard), a thin facade over one instance: functions that Model Exchange and
 * Co-Simulation share, but for variables (fmi2_values.c) and saved states (fmi2_state.c). */
#include <string.h>

#include "derivatives.h"
#include "fmi2_component.h"
#include "instance.h"
#include "log.h"

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }

const char *fmi2GetVersion(void) { return fmi2Version; }

/* Why an instance cannot be made, NULL if it can. */
static const char *fmi2_obstacle(fmi2String name, fmi2Type type, fmi2String guid)
{
    if (name == NULL || name[0] == '\0') {
        return "fmi2Instantiate: the instance needs a name";
    }
    if (type != fmi2CoSimulation && type != fmi2ModelExchange) {
        return "fmi2Instantiate: the type must be fmi2ModelExchange or fmi2CoSimulation";
    }
    if (guid == NULL || strcmp(guid, MODEL_TOKEN) != 0) {
        return "fmi2Instantiate: the GUID is not the one of this model: modelDescription.xml and binary do not match";
    }
    return NULL;
}

fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType, fmi2String fmuGUID,
                              fmi2String fmuResourceLocation, const fmi2CallbackFunctions *functions,
                              fmi2Boolean visible, fmi2Boolean loggingOn)
{
    (void)fmuResourceLocation; /* no resources are needed, and there is nothing to show */
    (void)visible;
    const fmi2CallbackFunctions none = {0};
    const fmi2CallbackFunctions *callbacks = functions != NULL ? functions : &none;
    const Use use = fmuType == fmi2ModelExchange ? MODEL_EXCHANGE : CO_SIMULATION;
    const char *why = fmi2_obstacle(instanceName, fmuType, fmuGUID);
    Component *component = why == NULL ? fmi2_component_create(instanceName, use, callbacks) : NULL;
    if (component != NULL) {
        component->instance.logs[LOG_EVENT] = loggingOn != fmi2False;
    } else if (callbacks->logger != NULL) {
        callbacks->logger(callbacks->componentEnvironment, instanceName != NULL ? instanceName : "", fmi2Error,
                          log_category_name[LOG_ERROR], "%s",
                          why != NULL ? why : "fmi2Instantiate: there is no memory for an instance");
    }
    return component;
}

void fmi2FreeInstance(fmi2Component c) { instance_free(c); }

/* Errors and warnings are reported whatever is asked for: an fmi2Error without a reason helps nobody. */
fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories, const fmi2String names[])
{
    if (!call_is_complete(c, SET_DEBUG_LOGGING, nCategories == 0 || names != NULL)) {
        return fmi2Error;
    }
    const char *function = call_name(c, SET_DEBUG_LOGGING);
    return to_fmi2(log_choose(c, function, LOG_EVENT, loggingOn != fmi2False, names, nCategories));
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance, fmi2Real startTime,
                               fmi2Boolean stopTimeDefined, fmi2Real stopTime)
{
    if (!call_is_legal(c, SETUP_EXPERIMENT)) {
        return fmi2Error;
    }
    return to_fmi2(instance_setup(c, toleranceDefined != fmi2False ? &tolerance : NULL, startTime,
                                  stopTimeDefined != fmi2False ? &stopTime : NULL));
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    return call_is_legal(c, ENTER_INITIALIZATION_MODE) ? to_fmi2(instance_enter_initialization(c)) : fmi2Error;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    return call_is_legal(c, EXIT_INITIALIZATION_MODE) ? to_fmi2(instance_exit_initialization(c)) : fmi2Error;
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    return call_is_legal(c, TERMINATE) ? to_fmi2(instance_terminate(c)) : fmi2Error;
}

fmi2Status fmi2Reset(fmi2Component c)
{
    if (!call_is_legal(c, RESET)) {
        return fmi2Error;
    }
    instance_reset(c);
    return fmi2OK;
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference vUnknown_ref[], size_t nUnknown,
                                        const fmi2ValueReference vKnown_ref[], size_t nKnown, const fmi2Real dvKnown[],
                                        fmi2Real dvUnknown[])
{
    return to_fmi2(derivatives_chain(c, GET_DIRECTIONAL_DERIVATIVE, (References){vUnknown_ref, nUnknown},
                                     (References){vKnown_ref, nKnown}, dvKnown, nKnown, dvUnknown, nUnknown));
}
