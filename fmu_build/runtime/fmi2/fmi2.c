/* FMI 2.0 (version 2.0.5 of the standard), a thin facade over one instance: functions that Model Exchange and
 * Co-Simulation share. Those of one alone are in fmi2_model_exchange.c and fmi2_co_simulation.c. */
#include <stdbool.h>
#include <string.h>

#include "derivatives.h"
#include "fmi2_component.h"

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }

const char *fmi2GetVersion(void) { return fmi2Version; }

/* Why an instance cannot be made, NULL if it can. */
static const char *obstacle(fmi2String name, fmi2Type type, fmi2String guid)
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
    const char *why = obstacle(instanceName, fmuType, fmuGUID);
    if (why != NULL) {
        if (callbacks->logger != NULL) {
            callbacks->logger(callbacks->componentEnvironment, instanceName != NULL ? instanceName : "", fmi2Error,
                              category_name[LOG_ERROR], "%s", why);
        }
        return NULL;
    }
    const size_t size = sizeof(Component) + strlen(instanceName) + 1;
    Component *component = allocate(callbacks, size);
    if (component == NULL) {
        return NULL;
    }
    component_create(component, instanceName, fmuType == fmi2ModelExchange ? MODEL_EXCHANGE : CO_SIMULATION, callbacks);
    component->instance.logs[LOG_EVENT] = loggingOn != fmi2False;
    return component;
}

void fmi2FreeInstance(fmi2Component c)
{
    Component *component = c;
    if (component != NULL) {
        const fmi2CallbackFunctions callbacks = component->callbacks; /* they are freed with it */
        release(&callbacks, component);
    }
}

/* Errors and warnings are reported whatever is asked for: an fmi2Error without a reason helps nobody. */
fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories, const fmi2String names[])
{
    Component *component = legal(c, SET_DEBUG_LOGGING);
    Message message;
    if (component == NULL) {
        return fmi2Error;
    }
    if (nCategories > 0 && names == NULL) {
        return null_argument(component, SET_DEBUG_LOGGING);
    }
    bool chosen[N_LOG_CATEGORIES + 1] = {false};
    for (size_t i = 0; i < nCategories; i++) {
        const int category = category_index(names[i]);
        chosen[category] = true;
        if (category == N_LOG_CATEGORIES) {
            message_write(&message, "fmi2SetDebugLogging: there is no log category %s",
                          names[i] != NULL ? names[i] : "NULL");
            (void)report(component, STATUS_WARNING, &message);
        }
    }
    if (nCategories == 0 || chosen[LOG_EVENT]) {
        component->instance.logs[LOG_EVENT] = loggingOn != fmi2False;
    }
    return chosen[N_LOG_CATEGORIES] ? fmi2Warning : fmi2OK;
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance, fmi2Real startTime,
                               fmi2Boolean stopTimeDefined, fmi2Real stopTime)
{
    Component *component = legal(c, SETUP_EXPERIMENT);
    if (component == NULL) {
        return fmi2Error;
    }
    return to_fmi2(instance_setup(&component->instance, toleranceDefined != fmi2False ? &tolerance : NULL, startTime,
                                  stopTimeDefined != fmi2False ? &stopTime : NULL));
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    Component *component = legal(c, ENTER_INITIALIZATION_MODE);
    return component == NULL ? fmi2Error : to_fmi2(instance_enter_initialization(&component->instance));
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    Component *component = legal(c, EXIT_INITIALIZATION_MODE);
    return component == NULL ? fmi2Error : to_fmi2(instance_exit_initialization(&component->instance));
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    Component *component = legal(c, TERMINATE);
    return component == NULL ? fmi2Error : to_fmi2(instance_terminate(&component->instance));
}

fmi2Status fmi2Reset(fmi2Component c)
{
    Component *component = legal(c, RESET);
    if (component == NULL) {
        return fmi2Error;
    }
    instance_reset(&component->instance);
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Real value[])
{
    Component *component = legal(c, GET_REAL);
    if (component == NULL) {
        return fmi2Error;
    }
    if (nvr > 0 && (vr == NULL || value == NULL)) {
        return null_argument(component, GET_REAL);
    }
    return to_fmi2(instance_get(&component->instance, REAL, vr, nvr, value));
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Real value[])
{
    Component *component = legal(c, SET_REAL);
    if (component == NULL) {
        return fmi2Error;
    }
    if (nvr > 0 && (vr == NULL || value == NULL)) {
        return null_argument(component, SET_REAL);
    }
    return to_fmi2(instance_set(&component->instance, REAL, vr, nvr, value));
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference vUnknown_ref[], size_t nUnknown,
                                        const fmi2ValueReference vKnown_ref[], size_t nKnown, const fmi2Real dvKnown[],
                                        fmi2Real dvUnknown[])
{
    Component *component = legal(c, GET_DIRECTIONAL_DERIVATIVE);
    if (component == NULL) {
        return fmi2Error;
    }
    if ((nUnknown > 0 && (vUnknown_ref == NULL || dvUnknown == NULL)) ||
        (nKnown > 0 && (vKnown_ref == NULL || dvKnown == NULL))) {
        return null_argument(component, GET_DIRECTIONAL_DERIVATIVE);
    }
    return to_fmi2(instance_directional(&component->instance, (References){vUnknown_ref, nUnknown},
                                        (References){vKnown_ref, nKnown}, dvKnown, dvUnknown));
}
