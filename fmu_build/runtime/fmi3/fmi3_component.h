/* An instance of FMI 3.0: that of the model and its caller's callbacks. */
#ifndef FMI3_COMPONENT_H
#define FMI3_COMPONENT_H

#include "calls.h"
#include "fmi3Functions.h"

typedef struct {
    Instance instance; /* first, so that a component is its instance */
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log_message;
    fmi3IntermediateUpdateCallback intermediate_update;
    bool early_return_allowed;
} Component;

/* Functions of FMI 3 alone. */
enum {
    GET_FLOAT64 = N_COMMON_CALLS,
    SET_FLOAT64,
    GET_OTHER_TYPE,
    SET_OTHER_TYPE,
    GET_CLOCK,
    SET_CLOCK,
    GET_NUMBER_OF_VARIABLE_DEPENDENCIES,
    GET_VARIABLE_DEPENDENCIES,
    GET_ADJOINT_DERIVATIVE,
    ENTER_CONFIGURATION_MODE,
    EXIT_CONFIGURATION_MODE,
    GET_INTERVAL,
    SET_INTERVAL,
    GET_SHIFT,
    SET_SHIFT,
    EVALUATE_DISCRETE_STATES,
    GET_NUMBER_OF_EVENT_INDICATORS,
    GET_NUMBER_OF_CONTINUOUS_STATES,
    ENTER_STEP_MODE,
    ACTIVATE_MODEL_PARTITION
};

/* A new component; NULL if there is no memory. */
Component *fmi3_component_create(Use use, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log_message);

fmi3Status to_fmi3(Status status);

#endif
