/* FMI 2.0 for Model Exchange. */
#include <math.h>

#include "model_exchange.h"
#include "fmi2_component.h"

fmi2Status fmi2EnterEventMode(fmi2Component c)
{
    Component *component = legal(c, ENTER_EVENT_MODE);
    return component == NULL ? fmi2Error : to_fmi2(instance_enter_event_mode(&component->instance));
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *eventInfo)
{
    Component *component = legal(c, NEW_DISCRETE_STATES);
    if (component == NULL) {
        return fmi2Error;
    }
    if (eventInfo == NULL) {
        return null_argument(component, NEW_DISCRETE_STATES);
    }
    EventResult result;
    const Status status = instance_handle_event(&component->instance, &result);
    *eventInfo = (fmi2EventInfo){.newDiscreteStatesNeeded = fmi2False,
                                 .terminateSimulation = result.ended,
                                 .nominalsOfContinuousStatesChanged = fmi2False,
                                 .valuesOfContinuousStatesChanged = result.states_changed,
                                 .nextEventTimeDefined = isfinite(result.next_time),
                                 .nextEventTime = isfinite(result.next_time) ? result.next_time : 0.0};
    return to_fmi2(status);
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c)
{
    Component *component = legal(c, ENTER_CONTINUOUS_TIME_MODE);
    return component == NULL ? fmi2Error : to_fmi2(instance_leave_event_mode(&component->instance));
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi2Boolean *enterEventMode, fmi2Boolean *terminateSimulation)
{
    (void)noSetFMUStatePriorToCurrentPoint;
    Component *component = legal(c, COMPLETED_INTEGRATOR_STEP);
    if (component == NULL) {
        return fmi2Error;
    }
    if (enterEventMode == NULL || terminateSimulation == NULL) {
        return null_argument(component, COMPLETED_INTEGRATOR_STEP);
    }
    *enterEventMode = fmi2False;
    *terminateSimulation = fmi2False;
    return to_fmi2(instance_complete_step(&component->instance));
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time)
{
    Component *component = legal(c, SET_TIME);
    return component == NULL ? fmi2Error : to_fmi2(instance_set_time(&component->instance, time));
}

/* The component, if the call is legal and the vector has as many elements as it should. */
static Component *legal_vector(fmi2Component c, Function function, const fmi2Real vector[], size_t n, int needed)
{
    Component *component = legal(c, function);
    if (component == NULL) {
        return NULL;
    }
    if (n != (size_t)needed) {
        (void)wrong_length(component, function, n, needed);
        return NULL;
    }
    if (vector == NULL && n > 0) {
        (void)null_argument(component, function);
        return NULL;
    }
    return component;
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t nx)
{
    Component *component = legal_vector(c, SET_CONTINUOUS_STATES, x, nx, N_STATES);
    return component == NULL ? fmi2Error : to_fmi2(instance_set_states(&component->instance, x));
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t nx)
{
    Component *component = legal_vector(c, GET_CONTINUOUS_STATES, x, nx, N_STATES);
    return component == NULL ? fmi2Error : to_fmi2(instance_get_states(&component->instance, x));
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t nx)
{
    Component *component = legal_vector(c, GET_DERIVATIVES, derivatives, nx, N_STATES);
    return component == NULL ? fmi2Error : to_fmi2(instance_get_derivatives(&component->instance, derivatives));
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real eventIndicators[], size_t ni)
{
    Component *component = legal_vector(c, GET_EVENT_INDICATORS, eventIndicators, ni, N_RELATIONS);
    return component == NULL ? fmi2Error : to_fmi2(instance_get_indicators(&component->instance, eventIndicators));
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real x_nominal[], size_t nx)
{
    Component *component = legal_vector(c, GET_NOMINALS_OF_CONTINUOUS_STATES, x_nominal, nx, N_STATES);
    if (component == NULL) {
        return fmi2Error;
    }
    instance_get_nominals(x_nominal);
    return fmi2OK;
}
