/* Variables to and from arrays of the types that versions of the standard have. */
#ifndef VALUES_H
#define VALUES_H

#include "calls.h"

/* What an array holds, and as what. */
typedef enum {
    REALS,                     /* double */
    INTEGERS,                  /* int32_t */
    ENUMERATIONS,              /* int64_t */
    BOOLEANS,                  /* bool */
    INTEGERS_AND_ENUMERATIONS, /* int32_t, as in FMI 2 */
    INTEGER_BOOLEANS           /* int32_t, false if 0, as in FMI 2 */
} ArrayType;

/* The calls `function`, with what they have to refuse. A list is set whole or not at all. */
Status values_get(Instance *instance, int function, ArrayType type, const unsigned references[], size_t n, void *values,
                  size_t n_values);
Status values_set(Instance *instance, int function, ArrayType type, const unsigned references[], size_t n,
                  const void *values, size_t n_values);

/* The same for `type` ("a String"), of which there are no variables: of what is asked for, the first one is refused by
 * name. */
Status values_none(Instance *instance, int function, const char *type, const unsigned references[], size_t n,
                   const void *values, size_t n_values);

#endif
