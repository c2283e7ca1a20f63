/* An instance of FMI 3.0: that of the model, its caller's callbacks, and the rules about which call is legal when. */
#ifndef FMI3_COMPONENT_H
#define FMI3_COMPONENT_H

#include "fmi3_header.h"
#include "instance.h"

typedef struct {
    Instance instance; /* first, so that a component is its instance */
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log_message;
    fmi3IntermediateUpdateCallback intermediate_update;
    bool early_return_allowed;
} Component;

typedef enum {
    SET_DEBUG_LOGGING,
    ENTER_INITIALIZATION_MODE,
    EXIT_INITIALIZATION_MODE,
    ENTER_EVENT_MODE,
    TERMINATE,
    RESET,
    GET_FLOAT64,
    SET_FLOAT64,
    GET_OTHER_TYPE,
    SET_OTHER_TYPE,
    GET_CLOCK,
    SET_CLOCK,
    GET_NUMBER_OF_VARIABLE_DEPENDENCIES,
    GET_VARIABLE_DEPENDENCIES,
    GET_FMU_STATE,
    SET_FMU_STATE,
    FREE_FMU_STATE,
    SERIALIZED_FMU_STATE_SIZE,
    SERIALIZE_FMU_STATE,
    DESERIALIZE_FMU_STATE,
    GET_DIRECTIONAL_DERIVATIVE,
    GET_ADJOINT_DERIVATIVE,
    ENTER_CONFIGURATION_MODE,
    EXIT_CONFIGURATION_MODE,
    GET_INTERVAL,
    SET_INTERVAL,
    GET_SHIFT,
    SET_SHIFT,
    EVALUATE_DISCRETE_STATES,
    UPDATE_DISCRETE_STATES,
    ENTER_CONTINUOUS_TIME_MODE,
    COMPLETED_INTEGRATOR_STEP,
    SET_TIME,
    SET_CONTINUOUS_STATES,
    GET_CONTINUOUS_STATE_DERIVATIVES,
    GET_EVENT_INDICATORS,
    GET_CONTINUOUS_STATES,
    GET_NOMINALS_OF_CONTINUOUS_STATES,
    GET_NUMBER_OF_EVENT_INDICATORS,
    GET_NUMBER_OF_CONTINUOUS_STATES,
    ENTER_STEP_MODE,
    GET_OUTPUT_DERIVATIVES,
    DO_STEP,
    ACTIVATE_MODEL_PARTITION
} Function;

/* A new component; NULL if there is no memory. */
Component *component_create(Use use, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log_message);

/* The component, if the call is legal in its state; otherwise NULL, and the reason is logged. */
Component *legal(fmi3Instance instance, Function function);

/* Each logs a message that names the function and returns fmi3Error. */
fmi3Status null_argument(Component *component, Function function);
fmi3Status wrong_length(Component *component, Function function, size_t n, size_t needed);

/* The component, if the call is legal and the arrays are there and as long as they should be; otherwise NULL. */
Component *legal_array(fmi3Instance instance, Function function, const void *array, size_t n, size_t needed);

/* For variables of types that the model does not have: an empty list is fine. */
fmi3Status no_variables(fmi3Instance instance, Function function, size_t n);

/* Log, and return the status. */
fmi3Status report(Component *component, Status status, const Message *message);

fmi3Status to_fmi3(Status status);

#endif
