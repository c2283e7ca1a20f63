/* FMI 3.0 (version 3.0.2 of the standard), a thin facade over one instance: what Model Exchange and Co-Simulation
 * share, but for making an instance (fmi3_instantiate.c), saved states (fmi3_state.c) and partial derivatives
 * (fmi3_derivatives.c). */
#include <math.h>

#include "model_exchange.h"
#include "fmi3_component.h"

const char *fmi3GetVersion(void) { return fmi3Version; }

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories,
                               const fmi3String categories[])
{
    Component *component = legal(instance, SET_DEBUG_LOGGING);
    Message message;
    if (component == NULL) {
        return fmi3Error;
    }
    if (nCategories > 0 && categories == NULL) {
        return null_argument(component, SET_DEBUG_LOGGING);
    }
    bool *logs = component->instance.logs;
    for (int i = 0; i < N_LOG_CATEGORIES && nCategories == 0; i++) {
        logs[i] = loggingOn;
    }
    fmi3Status status = fmi3OK;
    for (size_t i = 0; i < nCategories; i++) {
        const int category = category_index(categories[i]);
        if (category < N_LOG_CATEGORIES) {
            logs[category] = loggingOn;
        } else {
            message_write(&message, "fmi3SetDebugLogging: there is no log category %s",
                          categories[i] != NULL ? categories[i] : "NULL");
            status = report(component, STATUS_WARNING, &message);
        }
    }
    return status;
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined, fmi3Float64 tolerance,
                                       fmi3Float64 startTime, fmi3Boolean stopTimeDefined, fmi3Float64 stopTime)
{
    Component *component = legal(instance, ENTER_INITIALIZATION_MODE);
    if (component == NULL) {
        return fmi3Error;
    }
    const Status status = instance_setup(&component->instance, toleranceDefined ? &tolerance : NULL, startTime,
                                         stopTimeDefined ? &stopTime : NULL);
    return status != STATUS_OK ? to_fmi3(status) : to_fmi3(instance_enter_initialization(&component->instance));
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    Component *component = legal(instance, EXIT_INITIALIZATION_MODE);
    return component == NULL ? fmi3Error : to_fmi3(instance_exit_initialization(&component->instance));
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance)
{
    Component *component = legal(instance, ENTER_EVENT_MODE);
    return component == NULL ? fmi3Error : to_fmi3(instance_enter_event_mode(&component->instance));
}

fmi3Status fmi3Terminate(fmi3Instance instance)
{
    Component *component = legal(instance, TERMINATE);
    return component == NULL ? fmi3Error : to_fmi3(instance_terminate(&component->instance));
}

fmi3Status fmi3Reset(fmi3Instance instance)
{
    Component *component = legal(instance, RESET);
    if (component == NULL) {
        return fmi3Error;
    }
    instance_reset(&component->instance);
    return fmi3OK;
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                          fmi3Float64 values[], size_t nValues)
{
    Component *component = legal_array(instance, GET_FLOAT64, values, nValues, nValueReferences);
    if (component == NULL) {
        return fmi3Error;
    }
    if (nValues > 0 && valueReferences == NULL) {
        return null_argument(component, GET_FLOAT64);
    }
    return to_fmi3(instance_get(&component->instance, REAL, valueReferences, nValueReferences, values));
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                          const fmi3Float64 values[], size_t nValues)
{
    Component *component = legal_array(instance, SET_FLOAT64, values, nValues, nValueReferences);
    if (component == NULL) {
        return fmi3Error;
    }
    if (nValues > 0 && valueReferences == NULL) {
        return null_argument(component, SET_FLOAT64);
    }
    return to_fmi3(instance_set(&component->instance, REAL, valueReferences, nValueReferences, values));
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance)
{
    Component *component = legal(instance, EVALUATE_DISCRETE_STATES);
    return component == NULL ? fmi3Error : to_fmi3(instance_evaluate_event(&component->instance));
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate,
                                    fmi3Boolean *terminateSimulation, fmi3Boolean *nominalsOfContinuousStatesChanged,
                                    fmi3Boolean *valuesOfContinuousStatesChanged, fmi3Boolean *nextEventTimeDefined,
                                    fmi3Float64 *nextEventTime)
{
    Component *component = legal(instance, UPDATE_DISCRETE_STATES);
    if (component == NULL) {
        return fmi3Error;
    }
    if (discreteStatesNeedUpdate == NULL || terminateSimulation == NULL || nominalsOfContinuousStatesChanged == NULL ||
        valuesOfContinuousStatesChanged == NULL || nextEventTimeDefined == NULL || nextEventTime == NULL) {
        return null_argument(component, UPDATE_DISCRETE_STATES);
    }
    EventResult result;
    const Status status = instance_handle_event(&component->instance, &result);
    *discreteStatesNeedUpdate = fmi3False;
    *terminateSimulation = result.ended;
    *nominalsOfContinuousStatesChanged = fmi3False;
    *valuesOfContinuousStatesChanged = result.states_changed;
    *nextEventTimeDefined = isfinite(result.next_time);
    *nextEventTime = isfinite(result.next_time) ? result.next_time : 0.0;
    return to_fmi3(status);
}

/* Never legal: there are no structural parameters to configure. */
fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance)
{
    (void)legal(instance, ENTER_CONFIGURATION_MODE);
    return fmi3Error;
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance)
{
    (void)legal(instance, EXIT_CONFIGURATION_MODE);
    return fmi3Error;
}
