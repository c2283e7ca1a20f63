/* FMI 2.0 for Model Exchange. */
#include <math.h>

#include "fmi2_component.h"
#include "model_exchange.h"

fmi2Status fmi2EnterEventMode(fmi2Component c)
{
    return call_is_legal(c, ENTER_EVENT_MODE) ? to_fmi2(model_exchange_enter_event_mode(c)) : fmi2Error;
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *eventInfo)
{
    EventResult result;
    if (!call_is_complete(c, UPDATE_DISCRETE_STATES, eventInfo != NULL)) {
        return fmi2Error;
    }
    const Status status = model_exchange_handle_event(c, &result);
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
    return call_is_legal(c, ENTER_CONTINUOUS_TIME_MODE) ? to_fmi2(model_exchange_leave_event_mode(c)) : fmi2Error;
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi2Boolean *enterEventMode, fmi2Boolean *terminateSimulation)
{
    (void)noSetFMUStatePriorToCurrentPoint;
    if (!call_is_complete(c, COMPLETED_INTEGRATOR_STEP, enterEventMode != NULL && terminateSimulation != NULL)) {
        return fmi2Error;
    }
    *enterEventMode = fmi2False;
    *terminateSimulation = fmi2False;
    return to_fmi2(model_exchange_complete_step(c));
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time)
{
    return call_is_legal(c, SET_TIME) ? to_fmi2(model_exchange_set_time(c, time)) : fmi2Error;
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t nx)
{
    return to_fmi2(model_exchange_set_states(c, x, nx));
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t nx)
{
    return to_fmi2(model_exchange_get_states(c, x, nx));
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t nx)
{
    return to_fmi2(model_exchange_get_derivatives(c, derivatives, nx));
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real eventIndicators[], size_t ni)
{
    return to_fmi2(model_exchange_get_indicators(c, eventIndicators, ni));
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real x_nominal[], size_t nx)
{
    return to_fmi2(model_exchange_get_nominals(c, x_nominal, nx));
}
