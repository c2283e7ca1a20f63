/* FMI 2.0 for Co-Simulation: steps, slopes of inputs and outputs. Every step is made at once, so all questions about
 * the status of one that is still going on are answered by fmi2Discard. */
#include "derivatives.h"
#include "discrete.h"
#include "fmi2_component.h"
#include "co_simulation.h"

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[])
{
    Component *component = legal(c, SET_REAL_INPUT_DERIVATIVES);
    Message message;
    if (component == NULL) {
        return fmi2Error;
    }
    if (nvr > 0 && (vr == NULL || order == NULL || value == NULL)) {
        return null_argument(component, SET_REAL_INPUT_DERIVATIVES);
    }
    for (size_t i = 0; i < nvr; i++) {
        if (order[i] != 1) {
            message_write(&message, "fmi2SetRealInputDerivatives: order %d is not offered, it must be 1", order[i]);
            return report(component, STATUS_ERROR, &message);
        }
    }
    return to_fmi2(instance_set_slopes(&component->instance, vr, nvr, value));
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[])
{
    Component *component = legal(c, GET_REAL_OUTPUT_DERIVATIVES);
    if (component == NULL) {
        return fmi2Error;
    }
    if (nvr > 0 && (vr == NULL || order == NULL || value == NULL)) {
        return null_argument(component, GET_REAL_OUTPUT_DERIVATIVES);
    }
    return to_fmi2(instance_time_derivatives(&component->instance, (References){vr, nvr}, order, value));
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint, fmi2Real communicationStepSize,
                      fmi2Boolean noSetFMUStatePriorToCurrentPoint)
{
    (void)noSetFMUStatePriorToCurrentPoint;
    const StepOptions options = {0};
    StepResult result;
    Component *component = legal(c, DO_STEP);
    if (component == NULL) {
        return fmi2Error;
    }
    const Status status =
        instance_step(&component->instance, currentCommunicationPoint, communicationStepSize, &options, &result);
    return status == STATUS_OK && result.ended ? fmi2Discard : to_fmi2(status); /* fmi2Terminated tells which it is */
}

/* The standard's answer to a question about a status that the unit cannot tell. */
static fmi2Status no_status(Component *component, Function function)
{
    Message message;
    if (component == NULL) {
        return fmi2Error;
    }
    message_write(&message, "%s: this status is not available", function_name(function));
    return report(component, STATUS_DISCARD, &message);
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
    *value = discrete_has_ended(&component->instance.state);
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

fmi2Status fmi2CancelStep(fmi2Component c)
{
    (void)legal(c, CANCEL_STEP); /* never */
    return fmi2Error;
}
