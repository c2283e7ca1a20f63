/* FMI 3.0 for Co-Simulation. */
#include <math.h>

#include "co_simulation.h"
#include "derivatives.h"
#include "fmi3_component.h"
#include "model_exchange.h"

fmi3Status fmi3EnterStepMode(fmi3Instance instance)
{
    return call_is_legal(instance, ENTER_STEP_MODE) ? to_fmi3(model_exchange_leave_event_mode(instance)) : fmi3Error;
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                    size_t nValueReferences, const fmi3Int32 orders[], fmi3Float64 values[],
                                    size_t nValues)
{
    const References variables = {valueReferences, nValueReferences};
    return to_fmi3(derivatives_by_time(instance, variables, orders, values, nValues));
}

static double ask(void *receiver, double time)
{
    const Component *component = receiver;
    fmi3Boolean requested = fmi3False;
    fmi3Float64 end = time;
    component->intermediate_update(component->environment, time, fmi3False, fmi3True, fmi3True,
                                   component->early_return_allowed, &requested, &end);
    return requested ? end : (double)INFINITY;
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint, fmi3Float64 communicationStepSize,
                      fmi3Boolean noSetFMUStatePriorToCurrentPoint, fmi3Boolean *eventHandlingNeeded,
                      fmi3Boolean *terminateSimulation, fmi3Boolean *earlyReturn, fmi3Float64 *lastSuccessfulTime)
{
    (void)noSetFMUStatePriorToCurrentPoint;
    const Component *component = instance;
    StepResult result;
    if (!call_is_complete(instance, DO_STEP,
                          eventHandlingNeeded != NULL && terminateSimulation != NULL && earlyReturn != NULL &&
                              lastSuccessfulTime != NULL)) {
        return fmi3Error;
    }
    const StepOptions options = {.may_return_early = component->early_return_allowed,
                                 .intermediate = component->intermediate_update != NULL ? ask : NULL,
                                 .receiver = instance};
    const Status status =
        co_simulation_step(instance, currentCommunicationPoint, communicationStepSize, &options, &result);
    *eventHandlingNeeded = result.event;
    *terminateSimulation = result.ended;
    *earlyReturn = result.early;
    *lastSuccessfulTime = result.time;
    return to_fmi3(status);
}
