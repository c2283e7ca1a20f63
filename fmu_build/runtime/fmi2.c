/* FMI 2.0 for Co-Simulation (version 2.0.5 of the standard), a thin facade over one instance. The functions of
 * capabilities that are not offered are in fmi2_not_offered.c. */
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2_component.h"

static fmi2Status to_fmi2(Status status)
{
    return status == STATUS_OK ? fmi2OK : status == STATUS_WARNING ? fmi2Warning : fmi2Error;
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }

const char *fmi2GetVersion(void) { return fmi2Version; }

/* Why an instance cannot be made, NULL if it can. */
static const char *obstacle(fmi2String name, fmi2Type type, fmi2String guid)
{
    if (name == NULL || name[0] == '\0') {
        return "fmi2Instantiate: the instance needs a name";
    }
    if (type != fmi2CoSimulation) {
        return "fmi2Instantiate: only co-simulation is offered";
    }
    if (guid == NULL || strcmp(guid, MODEL_TOKEN) != 0) {
        return "fmi2Instantiate: the GUID is not the one of this model: modelDescription.xml and binary do not match";
    }
    return NULL;
}

static bool own_memory(const fmi2CallbackFunctions *callbacks)
{
    return callbacks->allocateMemory == NULL || callbacks->freeMemory == NULL;
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
    Component *component = own_memory(callbacks) ? calloc(1, size) : callbacks->allocateMemory(1, size);
    if (component == NULL) {
        return NULL;
    }
    component_create(component, instanceName, callbacks);
    component->instance.logs[LOG_EVENT] = loggingOn != fmi2False;
    return component;
}

void fmi2FreeInstance(fmi2Component c)
{
    Component *component = c;
    if (component == NULL) {
        return;
    }
    if (own_memory(&component->callbacks)) {
        free(component);
    } else {
        component->callbacks.freeMemory(component);
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
            (void)report(component, fmi2Warning, &message);
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
    return to_fmi2(instance_get(&component->instance, vr, nvr, value));
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
    return to_fmi2(instance_set(&component->instance, vr, nvr, value));
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint, fmi2Real communicationStepSize,
                      fmi2Boolean noSetFMUStatePriorToCurrentPoint)
{
    (void)noSetFMUStatePriorToCurrentPoint;
    Component *component = legal(c, DO_STEP);
    if (component == NULL) {
        return fmi2Error;
    }
    return to_fmi2(instance_step(&component->instance, currentCommunicationPoint, communicationStepSize));
}

/* The standard's answer to a question about a status that the unit cannot tell. */
static fmi2Status no_status(Component *component, Function function)
{
    Message message;
    if (component == NULL) {
        return fmi2Error;
    }
    message_write(&message, "%s: this status is not available", function_name(function));
    return report(component, fmi2Discard, &message);
}

/* The last accepted integrator step counts, not the last communication step: that is as far as the values reach. */
fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind s, fmi2Real *value)
{
    Component *component = legal(c, GET_REAL_STATUS);
    if (component == NULL) {
        return fmi2Error;
    }
    if (value == NULL) {
        return null_argument(component, GET_REAL_STATUS);
    }
    if (s != fmi2LastSuccessfulTime) {
        return no_status(component, GET_REAL_STATUS);
    }
    *value = component->instance.state.v.time;
    return fmi2OK;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind s, fmi2Boolean *value)
{
    Component *component = legal(c, GET_BOOLEAN_STATUS);
    if (component == NULL) {
        return fmi2Error;
    }
    if (value == NULL) {
        return null_argument(component, GET_BOOLEAN_STATUS);
    }
    if (s != fmi2Terminated) {
        return no_status(component, GET_BOOLEAN_STATUS);
    }
    *value = fmi2False; /* the model never asks to end the simulation */
    return fmi2OK;
}

/* The other statuses are those of asynchronous steps, of which there are none. */
fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind s, fmi2Status *value)
{
    (void)s;
    (void)value;
    return no_status(legal(c, GET_STATUS), GET_STATUS);
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind s, fmi2Integer *value)
{
    (void)s;
    (void)value;
    return no_status(legal(c, GET_INTEGER_STATUS), GET_INTEGER_STATUS);
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind s, fmi2String *value)
{
    (void)s;
    (void)value;
    return no_status(legal(c, GET_STRING_STATUS), GET_STRING_STATUS);
}
