/* A component of FMI 2.0: an instance, its caller's callbacks, and the rules about which call is legal when. */
#ifndef FMI2_COMPONENT_H
#define FMI2_COMPONENT_H

#include "fmi2_header.h"
#include "instance.h"

typedef struct {
    Instance instance; /* first, so that a component is its instance */
    fmi2CallbackFunctions callbacks;
    char name[];
} Component;

typedef enum {
    SET_DEBUG_LOGGING,
    SETUP_EXPERIMENT,
    ENTER_INITIALIZATION_MODE,
    EXIT_INITIALIZATION_MODE,
    TERMINATE,
    RESET,
    GET_REAL,
    GET_INTEGER,
    GET_BOOLEAN,
    GET_STRING,
    SET_REAL,
    SET_INTEGER,
    SET_BOOLEAN,
    SET_STRING,
    GET_FMU_STATE,
    SET_FMU_STATE,
    FREE_FMU_STATE,
    SERIALIZED_FMU_STATE_SIZE,
    SERIALIZE_FMU_STATE,
    DESERIALIZE_FMU_STATE,
    GET_DIRECTIONAL_DERIVATIVE,
    SET_REAL_INPUT_DERIVATIVES,
    GET_REAL_OUTPUT_DERIVATIVES,
    ENTER_EVENT_MODE,
    NEW_DISCRETE_STATES,
    ENTER_CONTINUOUS_TIME_MODE,
    COMPLETED_INTEGRATOR_STEP,
    SET_TIME,
    SET_CONTINUOUS_STATES,
    GET_DERIVATIVES,
    GET_EVENT_INDICATORS,
    GET_CONTINUOUS_STATES,
    GET_NOMINALS_OF_CONTINUOUS_STATES,
    DO_STEP,
    CANCEL_STEP,
    GET_STATUS,
    GET_REAL_STATUS,
    GET_INTEGER_STATUS,
    GET_BOOLEAN_STATUS,
    GET_STRING_STATUS
} Function;

/* Takes note of the callbacks; *component has room for the name. */
void component_create(Component *component, const char *name, Use use, const fmi2CallbackFunctions *callbacks);

/* The component, if the call is legal in its state; otherwise NULL, and the reason is logged. */
Component *legal(fmi2Component c, Function function);

/* Each logs a message that names the function and returns fmi2Error. */
fmi2Status null_argument(Component *component, Function function);
fmi2Status wrong_length(Component *component, Function function, size_t n, int needed);

/* The caller's memory, or that of the C library where the caller gives none. */
void *allocate(const fmi2CallbackFunctions *callbacks, size_t size);
void release(const fmi2CallbackFunctions *callbacks, void *memory);

/* For variables of types that the model does not have: an empty list is fine. */
fmi2Status no_variables(fmi2Component c, Function function, size_t n);

fmi2Status to_fmi2(Status status);

const char *function_name(Function function);

/* Log, and return the status. */
fmi2Status report(Component *component, Status status, const Message *message);

#endif
