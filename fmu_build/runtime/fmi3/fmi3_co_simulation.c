/* FMI 3.0 for Co-Simulation. */
#include <math.h>

#include "model_exchange.h"
#include "derivatives.h"
#include "fmi3_component.h"
#include "co_simulation.h"

fmi3Status fmi3EnterStepMode(fmi3Instance instance)
{
    Component *component = legal(instance, ENTER_STEP_MODE);
    return component == NULL ? fmi3Error : to_fmi3(instance_leave_event_mode(&component->instance));
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                    size_t nValueReferences, const fmi3Int32 orders[], fmi3Float64 values[],
                                    size_t nValues)
{
    Component *component = legal_array(instance, GET_OUTPUT_DERIVATIVES, values, nValues, nValueReferences);
    if (component == NULL) {
        return fmi3Error;
    }
    if (nValues > 0 && (valueReferences == NULL || orders == NULL)) {
        return null_argument(component, GET_OUTPUT_DERIVATIVES);
    }
    const References variables = {valueReferences, nValueReferences};
    return to_fmi3(instance_time_derivatives(&component->instance, variables, orders, values));
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
    Component *component = legal(instance, DO_STEP);
    StepResult result;
    if (component == NULL) {
        return fmi3Error;
    }
    if (eventHandlingNeeded == NULL || terminateSimulation == NULL || earlyReturn == NULL ||
        lastSuccessfulTime == NULL) {
        return null_argument(component, DO_STEP);
    }
    const StepOptions options = {.may_return_early = component->early_return_allowed,
                                 .intermediate = component->intermediate_update != NULL ? ask : NULL,
                                 .receiver = component};
    const Status status =
        instance_step(&component->instance, currentCommunicationPoint, communicationStepSize, &options, &result);
    *eventHandlingNeeded = result.event;
    *terminateSimulation = result.ended;
    *earlyReturn = result.early;
    *lastSuccessfulTime = result.time;
    return to_fmi3(status);
}
