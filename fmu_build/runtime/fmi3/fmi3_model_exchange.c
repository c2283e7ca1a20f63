/* FMI 3.0 for Model Exchange. */
#include "model_exchange.h"
#include "fmi3_component.h"

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance)
{
    Component *component = legal(instance, ENTER_CONTINUOUS_TIME_MODE);
    return component == NULL ? fmi3Error : to_fmi3(instance_leave_event_mode(&component->instance));
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi3Boolean *enterEventMode, fmi3Boolean *terminateSimulation)
{
    (void)noSetFMUStatePriorToCurrentPoint;
    Component *component = legal(instance, COMPLETED_INTEGRATOR_STEP);
    if (component == NULL) {
        return fmi3Error;
    }
    if (enterEventMode == NULL || terminateSimulation == NULL) {
        return null_argument(component, COMPLETED_INTEGRATOR_STEP);
    }
    *enterEventMode = fmi3False;
    *terminateSimulation = fmi3False;
    return to_fmi3(instance_complete_step(&component->instance));
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time)
{
    Component *component = legal(instance, SET_TIME);
    return component == NULL ? fmi3Error : to_fmi3(instance_set_time(&component->instance, time));
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 continuousStates[],
                                   size_t nContinuousStates)
{
    Component *component = legal_array(instance, SET_CONTINUOUS_STATES, continuousStates, nContinuousStates, N_STATES);
    return component == NULL ? fmi3Error : to_fmi3(instance_set_states(&component->instance, continuousStates));
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 continuousStates[], size_t nContinuousStates)
{
    Component *component = legal_array(instance, GET_CONTINUOUS_STATES, continuousStates, nContinuousStates, N_STATES);
    return component == NULL ? fmi3Error : to_fmi3(instance_get_states(&component->instance, continuousStates));
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 derivatives[], size_t nContinuousStates)
{
    Component *component =
        legal_array(instance, GET_CONTINUOUS_STATE_DERIVATIVES, derivatives, nContinuousStates, N_STATES);
    return component == NULL ? fmi3Error : to_fmi3(instance_get_derivatives(&component->instance, derivatives));
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 eventIndicators[], size_t nEventIndicators)
{
    Component *component = legal_array(instance, GET_EVENT_INDICATORS, eventIndicators, nEventIndicators, N_RELATIONS);
    return component == NULL ? fmi3Error : to_fmi3(instance_get_indicators(&component->instance, eventIndicators));
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[], size_t nContinuousStates)
{
    Component *component =
        legal_array(instance, GET_NOMINALS_OF_CONTINUOUS_STATES, nominals, nContinuousStates, N_STATES);
    if (component == NULL) {
        return fmi3Error;
    }
    instance_get_nominals(nominals);
    return fmi3OK;
}

static fmi3Status get_number(fmi3Instance instance, Function function, size_t number, size_t *result)
{
    Component *component = legal(instance, function);
    if (component == NULL) {
        return fmi3Error;
    }
    if (result == NULL) {
        return null_argument(component, function);
    }
    *result = number;
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *nEventIndicators)
{
    return get_number(instance, GET_NUMBER_OF_EVENT_INDICATORS, N_RELATIONS, nEventIndicators);
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *nContinuousStates)
{
    return get_number(instance, GET_NUMBER_OF_CONTINUOUS_STATES, N_STATES, nContinuousStates);
}
