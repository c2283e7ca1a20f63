/* FMI 2.0: variables. There are no strings. */
#include "fmi2_component.h"
#include "values.h"

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Real value[])
{
    return to_fmi2(values_get(c, GET_REAL, REALS, vr, nvr, value, nvr));
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Integer value[])
{
    return to_fmi2(values_get(c, GET_INTEGER, INTEGERS_AND_ENUMERATIONS, vr, nvr, value, nvr));
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Boolean value[])
{
    return to_fmi2(values_get(c, GET_BOOLEAN, INTEGER_BOOLEANS, vr, nvr, value, nvr));
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2String value[])
{
    return to_fmi2(values_none(c, GET_STRING, "a String", vr, nvr, value, nvr));
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Real value[])
{
    return to_fmi2(values_set(c, SET_REAL, REALS, vr, nvr, value, nvr));
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Integer value[])
{
    return to_fmi2(values_set(c, SET_INTEGER, INTEGERS_AND_ENUMERATIONS, vr, nvr, value, nvr));
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Boolean value[])
{
    return to_fmi2(values_set(c, SET_BOOLEAN, INTEGER_BOOLEANS, vr, nvr, value, nvr));
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2String value[])
{
    return to_fmi2(values_none(c, SET_STRING, "a String", vr, nvr, value, nvr));
}
