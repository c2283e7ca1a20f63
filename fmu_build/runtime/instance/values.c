#include "values.h"

#include <stdint.h>

#include "instance.h"
#include "log.h"
#include "validation.h"

/* The type that a variable in such an array must have. */
static ValueType needed_type(ArrayType type, unsigned reference)
{
    switch (type) {
    case REALS:
        return REAL;
    case ENUMERATIONS:
        return ENUMERATION;
    case BOOLEANS:
    case INTEGER_BOOLEANS:
        return BOOLEAN;
    case INTEGERS_AND_ENUMERATIONS:
        return reference < N_VARIABLES && variable_info[reference].type == ENUMERATION ? ENUMERATION : INTEGER;
    case INTEGERS:
        break;
    }
    return INTEGER;
}

static void store(ArrayType type, void *values, size_t i, double number)
{
    switch (type) {
    case REALS:
        ((double *)values)[i] = number;
        break;
    case INTEGERS:
    case INTEGERS_AND_ENUMERATIONS:
        ((int32_t *)values)[i] = (int32_t)number;
        break;
    case ENUMERATIONS:
        ((int64_t *)values)[i] = (int64_t)number;
        break;
    case BOOLEANS:
        ((bool *)values)[i] = number > 0.5;
        break;
    case INTEGER_BOOLEANS:
        ((int32_t *)values)[i] = number > 0.5;
        break;
    }
}

static double load(ArrayType type, const void *values, size_t i)
{
    switch (type) {
    case REALS:
        break;
    case INTEGERS:
    case INTEGERS_AND_ENUMERATIONS:
        return ((const int32_t *)values)[i];
    case ENUMERATIONS:
        return (double)((const int64_t *)values)[i];
    case BOOLEANS:
        return ((const bool *)values)[i] ? 1.0 : 0.0;
    case INTEGER_BOOLEANS:
        return ((const int32_t *)values)[i] != 0 ? 1.0 : 0.0;
    }
    return ((const double *)values)[i];
}

Status values_get(Instance *instance, int function, ArrayType type, const unsigned references[], size_t n, void *values,
                  size_t n_values)
{
    if (!call_has_values(instance, function, references, n, values, n_values)) {
        return STATUS_ERROR;
    }
    if (type == REALS) {
        return instance_get(instance, REAL, references, n, values);
    }
    Status status = STATUS_OK;
    for (size_t i = 0; i < n && status == STATUS_OK; i++) {
        double number = 0.0;
        status = instance_get(instance, needed_type(type, references[i]), &references[i], 1, &number);
        store(type, values, i, number);
    }
    return status;
}

Status values_set(Instance *instance, int function, ArrayType type, const unsigned references[], size_t n,
                  const void *values, size_t n_values)
{
    if (!call_has_values(instance, function, references, n, values, n_values)) {
        return STATUS_ERROR;
    }
    Status status = STATUS_OK;
    for (size_t i = 0; i < n && status == STATUS_OK; i++) {
        status = instance_check(instance, needed_type(type, references[i]), references[i], load(type, values, i));
    }
    for (size_t i = 0; i < n && status == STATUS_OK; i++) {
        instance_set(instance, references[i], load(type, values, i));
    }
    return status;
}

Status values_none(Instance *instance, int function, const char *type, const unsigned references[], size_t n,
                   const void *values, size_t n_values)
{
    Message why;
    if (!call_has_values(instance, function, references, n, values, n_values)) {
        return STATUS_ERROR;
    }
    if (n == 0) {
        return STATUS_OK;
    }
    explain_type(references[0], type, &why);
    return log_error(instance, &why);
}
