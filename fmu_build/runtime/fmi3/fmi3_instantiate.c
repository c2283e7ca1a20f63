/* FMI 3.0: making and freeing instances. */
#include <string.h>

#include "fmi3_component.h"
#include "instance.h"
#include "log.h"
#include "validation.h"

/* Why an instance cannot be made, NULL if it can. */
static const char *fmi3_obstacle(fmi3String name, fmi3String token)
{
    if (name == NULL || name[strspn(name, " \t\r\n")] == '\0') {
        return "the instance needs a name";
    }
    if (token == NULL || strcmp(token, MODEL_TOKEN) != 0) {
        return "the instantiation token is not the one of this model: modelDescription.xml and binary do not match";
    }
    return NULL;
}

/* No instance without a reason, be logging on or off. */
static void refuse(fmi3InstanceEnvironment environment, fmi3LogMessageCallback log_message, const char *why)
{
    if (log_message != NULL) {
        log_message(environment, fmi3Error, log_category_name[LOG_ERROR], why);
    }
}

static Component *instantiate(Use use, fmi3String name, fmi3String token, fmi3Boolean logging_on,
                              fmi3InstanceEnvironment environment, fmi3LogMessageCallback log_message)
{
    const char *why = fmi3_obstacle(name, token);
    Component *component = why == NULL ? fmi3_component_create(use, environment, log_message) : NULL;
    if (component == NULL) {
        refuse(environment, log_message, why != NULL ? why : "there is no memory for an instance");
        return NULL;
    }
    for (int i = 0; i < N_LOG_CATEGORIES; i++) {
        component->instance.logs[i] = logging_on && i != LOG_STEP; /* which has to be asked for */
    }
    return component;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String instanceName, fmi3String instantiationToken,
                                          fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                          fmi3InstanceEnvironment instanceEnvironment,
                                          fmi3LogMessageCallback logMessage)
{
    (void)resourcePath; /* no resources are needed, and there is nothing to show */
    (void)visible;
    return instantiate(MODEL_EXCHANGE, instanceName, instantiationToken, loggingOn, instanceEnvironment, logMessage);
}

/* During an intermediate update all variables may be read, not only the required ones. */
fmi3Instance fmi3InstantiateCoSimulation(fmi3String instanceName, fmi3String instantiationToken,
                                         fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                         fmi3Boolean eventModeUsed, fmi3Boolean earlyReturnAllowed,
                                         const fmi3ValueReference requiredIntermediateVariables[],
                                         size_t nRequiredIntermediateVariables,
                                         fmi3InstanceEnvironment instanceEnvironment, fmi3LogMessageCallback logMessage,
                                         fmi3IntermediateUpdateCallback intermediateUpdate)
{
    (void)resourcePath;
    (void)visible;
    Message why;
    for (size_t i = 0; i < nRequiredIntermediateVariables && requiredIntermediateVariables != NULL; i++) {
        if (!valid_reference(requiredIntermediateVariables[i], &why)) {
            refuse(instanceEnvironment, logMessage, why.text);
            return NULL;
        }
    }
    Component *component = instantiate(eventModeUsed ? CO_SIMULATION_WITH_EVENTS : CO_SIMULATION, instanceName,
                                       instantiationToken, loggingOn, instanceEnvironment, logMessage);
    if (component != NULL) {
        component->intermediate_update = intermediateUpdate;
        component->early_return_allowed = earlyReturnAllowed;
    }
    return component;
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String instanceName, fmi3String instantiationToken,
                                               fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                               fmi3InstanceEnvironment instanceEnvironment,
                                               fmi3LogMessageCallback logMessage, fmi3ClockUpdateCallback clockUpdate,
                                               fmi3LockPreemptionCallback lockPreemption,
                                               fmi3UnlockPreemptionCallback unlockPreemption)
{
    (void)instanceName;
    (void)instantiationToken;
    (void)resourcePath;
    (void)visible;
    (void)loggingOn;
    (void)clockUpdate;
    (void)lockPreemption;
    (void)unlockPreemption;
    refuse(instanceEnvironment, logMessage, "Scheduled Execution is not offered");
    return NULL;
}

void fmi3FreeInstance(fmi3Instance instance) { instance_free(instance); }
