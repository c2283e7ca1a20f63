/* FMI 3.0 for Model Exchange. */
#include "fmi3_component.h"
#include "model_exchange.h"

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance)
{
    return call_is_legal(instance, ENTER_CONTINUOUS_TIME_MODE) ? to_fmi3(model_exchange_leave_event_mode(instance))
                                                               : fmi3Error;
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi3Boolean *enterEventMode, fmi3Boolean *terminateSimulation)
{
    (void)noSetFMUStatePriorToCurrentPoint;
    if (!call_is_complete(instance, COMPLETED_INTEGRATOR_STEP, enterEventMode != NULL && terminateSimulation != NULL)) {
        return fmi3Error;
    }
    *enterEventMode = fmi3False;
    *terminateSimulation = fmi3False;
    return to_fmi3(model_exchange_complete_step(instance));
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time)
{
    return call_is_legal(instance, SET_TIME) ? to_fmi3(model_exchange_set_time(instance, time)) : fmi3Error;
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 continuousStates[],
                                   size_t nContinuousStates)
{
    return to_fmi3(model_exchange_set_states(instance, continuousStates, nContinuousStates));
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 continuousStates[], size_t nContinuousStates)
{
    return to_fmi3(model_exchange_get_states(instance, continuousStates, nContinuousStates));
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 derivatives[], size_t nContinuousStates)
{
    return to_fmi3(model_exchange_get_derivatives(instance, derivatives, nContinuousStates));
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 eventIndicators[], size_t nEventIndicators)
{
    return to_fmi3(model_exchange_get_indicators(instance, eventIndicators, nEventIndicators));
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[], size_t nContinuousStates)
{
    return to_fmi3(model_exchange_get_nominals(instance, nominals, nContinuousStates));
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *nEventIndicators)
{
    if (!call_is_complete(instance, GET_NUMBER_OF_EVENT_INDICATORS, nEventIndicators != NULL)) {
        return fmi3Error;
    }
    *nEventIndicators = N_RELATIONS;
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *nContinuousStates)
{
    if (!call_is_complete(instance, GET_NUMBER_OF_CONTINUOUS_STATES, nContinuousStates != NULL)) {
        return fmi3Error;
    }
    *nContinuousStates = N_STATES;
    return fmi3OK;
}
