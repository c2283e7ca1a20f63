/* FMI 3.0: variables. */
#include "fmi3_component.h"
#include "values.h"

/* What Modelica calls Real, Integer, an enumeration, and Boolean. */
#define VARIABLES_OF_TYPE(Type, FUNCTION, ARRAY)                                                                       \
    fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference valueReferences[],                        \
                             size_t nValueReferences, fmi3##Type values[], size_t nValues)                             \
    {                                                                                                                  \
        return to_fmi3(                                                                                                \
            values_get(instance, GET_##FUNCTION, ARRAY, valueReferences, nValueReferences, values, nValues));          \
    }                                                                                                                  \
    fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference valueReferences[],                        \
                             size_t nValueReferences, const fmi3##Type values[], size_t nValues)                       \
    {                                                                                                                  \
        return to_fmi3(                                                                                                \
            values_set(instance, SET_##FUNCTION, ARRAY, valueReferences, nValueReferences, values, nValues));          \
    }

VARIABLES_OF_TYPE(Float64, FLOAT64, REALS)
VARIABLES_OF_TYPE(Int32, OTHER_TYPE, INTEGERS)
VARIABLES_OF_TYPE(Int64, OTHER_TYPE, ENUMERATIONS)
VARIABLES_OF_TYPE(Boolean, OTHER_TYPE, BOOLEANS)

#undef VARIABLES_OF_TYPE

/* fmi3GetInt8 and fmi3SetInt8, and so on: types that Modelica does not have. */
#define NO_VARIABLES_OF_TYPE(Type, TYPE)                                                                               \
    fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference valueReferences[],                        \
                             size_t nValueReferences, fmi3##Type values[], size_t nValues)                             \
    {                                                                                                                  \
        return to_fmi3(                                                                                                \
            values_none(instance, GET_OTHER_TYPE, TYPE, valueReferences, nValueReferences, values, nValues));          \
    }                                                                                                                  \
    fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference valueReferences[],                        \
                             size_t nValueReferences, const fmi3##Type values[], size_t nValues)                       \
    {                                                                                                                  \
        return to_fmi3(                                                                                                \
            values_none(instance, SET_OTHER_TYPE, TYPE, valueReferences, nValueReferences, values, nValues));          \
    }

NO_VARIABLES_OF_TYPE(Float32, "a Float32")
NO_VARIABLES_OF_TYPE(Int8, "an Int8")
NO_VARIABLES_OF_TYPE(UInt8, "a UInt8")
NO_VARIABLES_OF_TYPE(Int16, "an Int16")
NO_VARIABLES_OF_TYPE(UInt16, "a UInt16")
NO_VARIABLES_OF_TYPE(UInt32, "a UInt32")
NO_VARIABLES_OF_TYPE(UInt64, "a UInt64")
NO_VARIABLES_OF_TYPE(String, "a String")

#undef NO_VARIABLES_OF_TYPE

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                         size_t valueSizes[], fmi3Binary values[], size_t nValues)
{
    (void)valueSizes;
    return to_fmi3(
        values_none(instance, GET_OTHER_TYPE, "a Binary", valueReferences, nValueReferences, values, nValues));
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                         const size_t valueSizes[], const fmi3Binary values[], size_t nValues)
{
    (void)valueSizes;
    return to_fmi3(
        values_none(instance, SET_OTHER_TYPE, "a Binary", valueReferences, nValueReferences, values, nValues));
}
