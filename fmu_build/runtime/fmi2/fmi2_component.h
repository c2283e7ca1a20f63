/* A component of FMI 2.0: an instance and its caller's callbacks. */
#ifndef FMI2_COMPONENT_H
#define FMI2_COMPONENT_H

#include "calls.h"
#include "fmi2Functions.h"

typedef struct {
    Instance instance; /* first, so that a component is its instance */
    fmi2CallbackFunctions callbacks;
    char name[];
} Component;

/* Functions of FMI 2 alone. */
enum {
    SETUP_EXPERIMENT = N_COMMON_CALLS,
    GET_REAL,
    GET_INTEGER,
    GET_BOOLEAN,
    GET_STRING,
    SET_REAL,
    SET_INTEGER,
    SET_BOOLEAN,
    SET_STRING,
    SET_REAL_INPUT_DERIVATIVES,
    CANCEL_STEP,
    GET_STATUS,
    GET_REAL_STATUS,
    GET_INTEGER_STATUS,
    GET_BOOLEAN_STATUS,
    GET_STRING_STATUS
};

/* A new component, in the caller's memory or that of the C library where the caller gives none; NULL if there is no
 * memory. */
Component *fmi2_component_create(const char *name, Use use, const fmi2CallbackFunctions *callbacks);

fmi2Status to_fmi2(Status status);

#endif
