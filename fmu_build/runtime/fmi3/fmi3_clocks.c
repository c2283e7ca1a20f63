/* FMI 3.0: clocks and model partitions, of which there are none. */
#include "fmi3_component.h"
#include "values.h"

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                        fmi3Clock values[])
{
    return to_fmi3(
        values_none(instance, GET_CLOCK, "a Clock", valueReferences, nValueReferences, values, nValueReferences));
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                        const fmi3Clock values[])
{
    return to_fmi3(
        values_none(instance, SET_CLOCK, "a Clock", valueReferences, nValueReferences, values, nValueReferences));
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                  size_t nValueReferences, fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[])
{
    (void)qualifiers;
    return to_fmi3(
        values_none(instance, GET_INTERVAL, "a Clock", valueReferences, nValueReferences, intervals, nValueReferences));
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                   size_t nValueReferences, fmi3UInt64 counters[], fmi3UInt64 resolutions[],
                                   fmi3IntervalQualifier qualifiers[])
{
    (void)resolutions;
    (void)qualifiers;
    return to_fmi3(
        values_none(instance, GET_INTERVAL, "a Clock", valueReferences, nValueReferences, counters, nValueReferences));
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                               size_t nValueReferences, fmi3Float64 shifts[])
{
    return to_fmi3(
        values_none(instance, GET_SHIFT, "a Clock", valueReferences, nValueReferences, shifts, nValueReferences));
}

fmi3Status fmi3GetShiftFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                size_t nValueReferences, fmi3UInt64 counters[], fmi3UInt64 resolutions[])
{
    (void)resolutions;
    return to_fmi3(
        values_none(instance, GET_SHIFT, "a Clock", valueReferences, nValueReferences, counters, nValueReferences));
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                  size_t nValueReferences, const fmi3Float64 intervals[])
{
    return to_fmi3(
        values_none(instance, SET_INTERVAL, "a Clock", valueReferences, nValueReferences, intervals, nValueReferences));
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                   size_t nValueReferences, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
{
    (void)resolutions;
    return to_fmi3(
        values_none(instance, SET_INTERVAL, "a Clock", valueReferences, nValueReferences, counters, nValueReferences));
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                               size_t nValueReferences, const fmi3Float64 shifts[])
{
    return to_fmi3(
        values_none(instance, SET_SHIFT, "a Clock", valueReferences, nValueReferences, shifts, nValueReferences));
}

fmi3Status fmi3SetShiftFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                size_t nValueReferences, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
{
    (void)resolutions;
    return to_fmi3(
        values_none(instance, SET_SHIFT, "a Clock", valueReferences, nValueReferences, counters, nValueReferences));
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clockReference,
                                      fmi3Float64 activationTime)
{
    (void)clockReference;
    (void)activationTime;
    (void)call_is_legal(instance, ACTIVATE_MODEL_PARTITION); /* never */
    return fmi3Error;
}
