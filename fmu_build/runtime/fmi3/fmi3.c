/* FMI 3.0 (version 3.0.2 of the standard), a thin facade over one instance: what Model Exchange and Co-Simulation
 * share, but for making an instance (fmi3_instantiate.c), variables (fmi3_values.c), clocks (fmi3_clocks.c), saved
 * states (fmi3_state.c) and partial derivatives (fmi3_derivatives.c). */
#include <math.h>

#include "fmi3_component.h"
#include "instance.h"
#include "log.h"
#include "model_exchange.h"

const char *fmi3GetVersion(void) { return fmi3Version; }

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories,
                               const fmi3String categories[])
{
    if (!call_is_complete(instance, SET_DEBUG_LOGGING, nCategories == 0 || categories != NULL)) {
        return fmi3Error;
    }
    const char *function = call_name(instance, SET_DEBUG_LOGGING);
    return to_fmi3(log_choose(instance, function, LOG_ERROR, loggingOn, categories, nCategories));
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined, fmi3Float64 tolerance,
                                       fmi3Float64 startTime, fmi3Boolean stopTimeDefined, fmi3Float64 stopTime)
{
    if (!call_is_legal(instance, ENTER_INITIALIZATION_MODE)) {
        return fmi3Error;
    }
    const Status status =
        instance_setup(instance, toleranceDefined ? &tolerance : NULL, startTime, stopTimeDefined ? &stopTime : NULL);
    return to_fmi3(status == STATUS_OK ? instance_enter_initialization(instance) : status);
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    return call_is_legal(instance, EXIT_INITIALIZATION_MODE) ? to_fmi3(instance_exit_initialization(instance))
                                                             : fmi3Error;
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance)
{
    return call_is_legal(instance, ENTER_EVENT_MODE) ? to_fmi3(model_exchange_enter_event_mode(instance)) : fmi3Error;
}

fmi3Status fmi3Terminate(fmi3Instance instance)
{
    return call_is_legal(instance, TERMINATE) ? to_fmi3(instance_terminate(instance)) : fmi3Error;
}

fmi3Status fmi3Reset(fmi3Instance instance)
{
    if (!call_is_legal(instance, RESET)) {
        return fmi3Error;
    }
    instance_reset(instance);
    return fmi3OK;
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance)
{
    return call_is_legal(instance, EVALUATE_DISCRETE_STATES) ? to_fmi3(model_exchange_evaluate_event(instance))
                                                             : fmi3Error;
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate,
                                    fmi3Boolean *terminateSimulation, fmi3Boolean *nominalsOfContinuousStatesChanged,
                                    fmi3Boolean *valuesOfContinuousStatesChanged, fmi3Boolean *nextEventTimeDefined,
                                    fmi3Float64 *nextEventTime)
{
    EventResult result;
    if (!call_is_complete(instance, UPDATE_DISCRETE_STATES,
                          discreteStatesNeedUpdate != NULL && terminateSimulation != NULL &&
                              nominalsOfContinuousStatesChanged != NULL && valuesOfContinuousStatesChanged != NULL &&
                              nextEventTimeDefined != NULL && nextEventTime != NULL)) {
        return fmi3Error;
    }
    const Status status = model_exchange_handle_event(instance, &result);
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
    (void)call_is_legal(instance, ENTER_CONFIGURATION_MODE);
    return fmi3Error;
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance)
{
    (void)call_is_legal(instance, EXIT_CONFIGURATION_MODE);
    return fmi3Error;
}
