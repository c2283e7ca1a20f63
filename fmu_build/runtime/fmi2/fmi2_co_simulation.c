/* FMI 2.0 for Co-Simulation: steps, slopes of inputs and outputs. Every step is made at once, so all questions about
 * the status of one that is still going on are answered by fmi2Discard. */
#include "co_simulation.h"
#include "derivatives.h"
#include "discrete.h"
#include "fmi2_component.h"
#include "log.h"

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[])
{
    const bool given = nvr == 0 || (vr != NULL && order != NULL && value != NULL);
    Message why;
    if (!call_is_complete(c, SET_REAL_INPUT_DERIVATIVES, given)) {
        return fmi2Error;
    }
    for (size_t i = 0; i < nvr; i++) {
        if (order[i] != 1) {
            message_write(&why, "fmi2SetRealInputDerivatives: order %d is not offered, it must be 1", order[i]);
            return to_fmi2(log_error(c, &why));
        }
    }
    return to_fmi2(co_simulation_set_slopes(c, vr, nvr, value));
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[])
{
    return to_fmi2(derivatives_by_time(c, (References){vr, nvr}, order, value, nvr));
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint, fmi2Real communicationStepSize,
                      fmi2Boolean noSetFMUStatePriorToCurrentPoint)
{
    (void)noSetFMUStatePriorToCurrentPoint;
    const StepOptions options = {0};
    StepResult result;
    if (!call_is_legal(c, DO_STEP)) {
        return fmi2Error;
    }
    const Status status = co_simulation_step(c, currentCommunicationPoint, communicationStepSize, &options, &result);
    return status == STATUS_OK && result.ended ? fmi2Discard : to_fmi2(status); /* fmi2Terminated tells which it is */
}

/* The standard's answer to a question about a status that the unit cannot tell. */
static fmi2Status no_status(fmi2Component c, int function)
{
    Message why;
    message_write(&why, "%s: this status is not available", call_name(c, function));
    return to_fmi2(log_discard(c, &why));
}

/* The last accepted integrator step counts, not the last communication step: that is as far as the values reach. */
fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind s, fmi2Real *value)
{
    const Instance *instance = c;
    if (!call_is_complete(c, GET_REAL_STATUS, value != NULL)) {
        return fmi2Error;
    }
    if (s != fmi2LastSuccessfulTime) {
        return no_status(c, GET_REAL_STATUS);
    }
    *value = instance->state.v.time;
    return fmi2OK;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind s, fmi2Boolean *value)
{
    const Instance *instance = c;
    if (!call_is_complete(c, GET_BOOLEAN_STATUS, value != NULL)) {
        return fmi2Error;
    }
    if (s != fmi2Terminated) {
        return no_status(c, GET_BOOLEAN_STATUS);
    }
    *value = discrete_has_ended(&instance->state);
    return fmi2OK;
}

/* The other statuses are those of asynchronous steps, of which there are none. */
fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind s, fmi2Status *value)
{
    (void)s;
    (void)value;
    return call_is_legal(c, GET_STATUS) ? no_status(c, GET_STATUS) : fmi2Error;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind s, fmi2Integer *value)
{
    (void)s;
    (void)value;
    return call_is_legal(c, GET_INTEGER_STATUS) ? no_status(c, GET_INTEGER_STATUS) : fmi2Error;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind s, fmi2String *value)
{
    (void)s;
    (void)value;
    return call_is_legal(c, GET_STRING_STATUS) ? no_status(c, GET_STRING_STATUS) : fmi2Error;
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    (void)call_is_legal(c, CANCEL_STEP); /* never */
    return fmi2Error;
}
