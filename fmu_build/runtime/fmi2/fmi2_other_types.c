/* FMI 2.0: variables that are no Reals. There are no strings. */
#include "fmi2_component.h"

/* Integers, of which enumerations are some. */
static ValueType integer_type(fmi2ValueReference reference)
{
    return reference < N_VARIABLES && variable_info[reference].type == ENUMERATION ? ENUMERATION : INTEGER;
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Integer value[])
{
    Component *component = legal(c, GET_INTEGER);
    Status status = STATUS_OK;
    if (component == NULL) {
        return fmi2Error;
    }
    if (nvr > 0 && (vr == NULL || value == NULL)) {
        return null_argument(component, GET_INTEGER);
    }
    for (size_t i = 0; i < nvr && status == STATUS_OK; i++) {
        double number = 0.0;
        status = instance_get(&component->instance, integer_type(vr[i]), &vr[i], 1, &number);
        value[i] = (fmi2Integer)number;
    }
    return to_fmi2(status);
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Boolean value[])
{
    Component *component = legal(c, GET_BOOLEAN);
    Status status = STATUS_OK;
    if (component == NULL) {
        return fmi2Error;
    }
    if (nvr > 0 && (vr == NULL || value == NULL)) {
        return null_argument(component, GET_BOOLEAN);
    }
    for (size_t i = 0; i < nvr && status == STATUS_OK; i++) {
        double number = 0.0;
        status = instance_get(&component->instance, BOOLEAN, &vr[i], 1, &number);
        value[i] = number > 0.5 ? fmi2True : fmi2False;
    }
    return to_fmi2(status);
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2String value[])
{
    (void)vr;
    (void)value;
    return no_variables(c, GET_STRING, nvr);
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Integer value[])
{
    Component *component = legal(c, SET_INTEGER);
    Status status = STATUS_OK;
    if (component == NULL) {
        return fmi2Error;
    }
    if (nvr > 0 && (vr == NULL || value == NULL)) {
        return null_argument(component, SET_INTEGER);
    }
    for (size_t i = 0; i < nvr && status == STATUS_OK; i++) {
        const double number = value[i];
        status = instance_set(&component->instance, integer_type(vr[i]), &vr[i], 1, &number);
    }
    return to_fmi2(status);
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Boolean value[])
{
    Component *component = legal(c, SET_BOOLEAN);
    Status status = STATUS_OK;
    if (component == NULL) {
        return fmi2Error;
    }
    if (nvr > 0 && (vr == NULL || value == NULL)) {
        return null_argument(component, SET_BOOLEAN);
    }
    for (size_t i = 0; i < nvr && status == STATUS_OK; i++) {
        const double number = value[i] != fmi2False ? 1.0 : 0.0;
        status = instance_set(&component->instance, BOOLEAN, &vr[i], 1, &number);
    }
    return to_fmi2(status);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2String value[])
{
    (void)vr;
    (void)value;
    return no_variables(c, SET_STRING, nvr);
}
