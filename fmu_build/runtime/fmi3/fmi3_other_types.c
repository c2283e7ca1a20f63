/* FMI 3.0: variables that are no Float64, clocks, and model partitions. */
#include "fmi3_component.h"

/* fmi3GetInt8 and fmi3SetInt8, and so on: eight pairs that differ in nothing but the type. */
#define NO_VARIABLES_OF_TYPE(Type)                                                                                     \
    fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference valueReferences[],                        \
                             size_t nValueReferences, fmi3##Type values[], size_t nValues)                             \
    {                                                                                                                  \
        (void)valueReferences;                                                                                         \
        (void)values;                                                                                                  \
        return no_variables(instance, GET_OTHER_TYPE, nValueReferences | nValues);                                     \
    }                                                                                                                  \
    fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference valueReferences[],                        \
                             size_t nValueReferences, const fmi3##Type values[], size_t nValues)                       \
    {                                                                                                                  \
        (void)valueReferences;                                                                                         \
        (void)values;                                                                                                  \
        return no_variables(instance, SET_OTHER_TYPE, nValueReferences | nValues);                                     \
    }

NO_VARIABLES_OF_TYPE(Float32)
NO_VARIABLES_OF_TYPE(Int8)
NO_VARIABLES_OF_TYPE(UInt8)
NO_VARIABLES_OF_TYPE(Int16)
NO_VARIABLES_OF_TYPE(UInt16)
NO_VARIABLES_OF_TYPE(UInt32)
NO_VARIABLES_OF_TYPE(UInt64)
NO_VARIABLES_OF_TYPE(String)

/* What Modelica calls Integer, an enumeration, and Boolean. */
#define VARIABLES_OF_TYPE(Type, TYPE)                                                                                  \
    fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference valueReferences[],                        \
                             size_t nValueReferences, fmi3##Type values[], size_t nValues)                             \
    {                                                                                                                  \
        Component *component = legal_array(instance, GET_OTHER_TYPE, values, nValues, nValueReferences);               \
        Status status = STATUS_OK;                                                                                     \
        if (component == NULL) {                                                                                       \
            return fmi3Error;                                                                                          \
        }                                                                                                              \
        if (nValues > 0 && valueReferences == NULL) {                                                                  \
            return null_argument(component, GET_OTHER_TYPE);                                                           \
        }                                                                                                              \
        for (size_t i = 0; i < nValues && status == STATUS_OK; i++) {                                                  \
            double number = 0.0;                                                                                       \
            status = instance_get(&component->instance, TYPE, &valueReferences[i], 1, &number);                        \
            values[i] = (fmi3##Type)number;                                                                            \
        }                                                                                                              \
        return to_fmi3(status);                                                                                        \
    }                                                                                                                  \
    fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference valueReferences[],                        \
                             size_t nValueReferences, const fmi3##Type values[], size_t nValues)                       \
    {                                                                                                                  \
        Component *component = legal_array(instance, SET_OTHER_TYPE, values, nValues, nValueReferences);               \
        Status status = STATUS_OK;                                                                                     \
        if (component == NULL) {                                                                                       \
            return fmi3Error;                                                                                          \
        }                                                                                                              \
        if (nValues > 0 && valueReferences == NULL) {                                                                  \
            return null_argument(component, SET_OTHER_TYPE);                                                           \
        }                                                                                                              \
        for (size_t i = 0; i < nValues && status == STATUS_OK; i++) {                                                  \
            const double number = (double)values[i];                                                                   \
            status = instance_set(&component->instance, TYPE, &valueReferences[i], 1, &number);                        \
        }                                                                                                              \
        return to_fmi3(status);                                                                                        \
    }

VARIABLES_OF_TYPE(Int32, INTEGER)
VARIABLES_OF_TYPE(Int64, ENUMERATION)
VARIABLES_OF_TYPE(Boolean, BOOLEAN)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                         size_t valueSizes[], fmi3Binary values[], size_t nValues)
{
    (void)valueReferences;
    (void)valueSizes;
    (void)values;
    return no_variables(instance, GET_OTHER_TYPE, nValueReferences | nValues);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                         const size_t valueSizes[], const fmi3Binary values[], size_t nValues)
{
    (void)valueReferences;
    (void)valueSizes;
    (void)values;
    return no_variables(instance, SET_OTHER_TYPE, nValueReferences | nValues);
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                        fmi3Clock values[])
{
    (void)valueReferences;
    (void)values;
    return no_variables(instance, GET_CLOCK, nValueReferences);
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                        const fmi3Clock values[])
{
    (void)valueReferences;
    (void)values;
    return no_variables(instance, SET_CLOCK, nValueReferences);
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                  size_t nValueReferences, fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[])
{
    (void)valueReferences;
    (void)intervals;
    (void)qualifiers;
    return no_variables(instance, GET_INTERVAL, nValueReferences);
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                   size_t nValueReferences, fmi3UInt64 counters[], fmi3UInt64 resolutions[],
                                   fmi3IntervalQualifier qualifiers[])
{
    (void)valueReferences;
    (void)counters;
    (void)resolutions;
    (void)qualifiers;
    return no_variables(instance, GET_INTERVAL, nValueReferences);
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                               size_t nValueReferences, fmi3Float64 shifts[])
{
    (void)valueReferences;
    (void)shifts;
    return no_variables(instance, GET_SHIFT, nValueReferences);
}

fmi3Status fmi3GetShiftFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                size_t nValueReferences, fmi3UInt64 counters[], fmi3UInt64 resolutions[])
{
    (void)valueReferences;
    (void)counters;
    (void)resolutions;
    return no_variables(instance, GET_SHIFT, nValueReferences);
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                  size_t nValueReferences, const fmi3Float64 intervals[])
{
    (void)valueReferences;
    (void)intervals;
    return no_variables(instance, SET_INTERVAL, nValueReferences);
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                   size_t nValueReferences, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
{
    (void)valueReferences;
    (void)counters;
    (void)resolutions;
    return no_variables(instance, SET_INTERVAL, nValueReferences);
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                               size_t nValueReferences, const fmi3Float64 shifts[])
{
    (void)valueReferences;
    (void)shifts;
    return no_variables(instance, SET_SHIFT, nValueReferences);
}

fmi3Status fmi3SetShiftFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                size_t nValueReferences, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
{
    (void)valueReferences;
    (void)counters;
    (void)resolutions;
    return no_variables(instance, SET_SHIFT, nValueReferences);
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clockReference,
                                      fmi3Float64 activationTime)
{
    (void)clockReference;
    (void)activationTime;
    (void)legal(instance, ACTIVATE_MODEL_PARTITION); /* never */
    return fmi3Error;
}
