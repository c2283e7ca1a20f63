#include "fmi3_component.h"

#include <stdlib.h>

#include "instance.h"
#include "log.h"

/* Which call is legal in which state: sections 2.3, 3.2 and 4.2. FAILED is the state Terminated that an error leads to;
 * a call that is refused leads nowhere. */
enum {
    FMI3_ANY_TIME = INSTANTIATED | INITIALIZING | STEPPING | EVENT_MODE | CONTINUOUS | TERMINATED | FAILED,
    FMI3_INITIALIZED = STEPPING | EVENT_MODE | CONTINUOUS,
    FMI3_EVALUABLE = INITIALIZING | FMI3_INITIALIZED | TERMINATED | FAILED,
    FMI3_SETTABLE = INSTANTIATED | INITIALIZING | FMI3_INITIALIZED
};

static const Call fmi3_calls[] = {
    [SET_DEBUG_LOGGING] = {"fmi3SetDebugLogging", BOTH, FMI3_ANY_TIME, NULL},
    [ENTER_INITIALIZATION_MODE] = {"fmi3EnterInitializationMode", BOTH, INSTANTIATED, NULL},
    [EXIT_INITIALIZATION_MODE] = {"fmi3ExitInitializationMode", BOTH, INITIALIZING, NULL},
    [ENTER_EVENT_MODE] = {"fmi3EnterEventMode", CS_WITH_EVENTS | ME, STEPPING | CONTINUOUS,
                          " must not be called: the instance was made with eventModeUsed = fmi3False"},
    [TERMINATE] = {"fmi3Terminate", BOTH, FMI3_INITIALIZED, NULL},
    [RESET] = {"fmi3Reset", BOTH, FMI3_ANY_TIME, NULL},
    [GET_FLOAT64] = {"fmi3GetFloat64", BOTH, FMI3_ANY_TIME | UPDATING, NULL},
    [SET_FLOAT64] = {"fmi3SetFloat64", BOTH, FMI3_SETTABLE, NULL},
    [GET_OTHER_TYPE] = {"fmi3Get{VariableType}", BOTH, FMI3_ANY_TIME | UPDATING, NULL},
    [SET_OTHER_TYPE] = {"fmi3Set{VariableType}", BOTH, FMI3_SETTABLE & ~CONTINUOUS, NULL},
    [GET_CLOCK] = {"fmi3GetClock", BOTH, INITIALIZING | EVENT_MODE, NULL},
    [SET_CLOCK] = {"fmi3SetClock", BOTH, INITIALIZING | EVENT_MODE, NULL},
    [GET_NUMBER_OF_VARIABLE_DEPENDENCIES] = {"fmi3GetNumberOfVariableDependencies", BOTH, FMI3_ANY_TIME, NULL},
    [GET_VARIABLE_DEPENDENCIES] = {"fmi3GetVariableDependencies", BOTH, FMI3_ANY_TIME, NULL},
    [GET_FMU_STATE] = {"fmi3GetFMUState", BOTH, FMI3_ANY_TIME, NULL},
    [SET_FMU_STATE] = {"fmi3SetFMUState", BOTH, FMI3_ANY_TIME, NULL},
    [FREE_FMU_STATE] = {"fmi3FreeFMUState", BOTH, FMI3_ANY_TIME, NULL},
    [SERIALIZED_FMU_STATE_SIZE] = {"fmi3SerializedFMUStateSize", BOTH, FMI3_ANY_TIME, NULL},
    [SERIALIZE_FMU_STATE] = {"fmi3SerializeFMUState", BOTH, FMI3_ANY_TIME, NULL},
    [DESERIALIZE_FMU_STATE] = {"fmi3DeserializeFMUState", BOTH, FMI3_ANY_TIME, NULL},
    [GET_DIRECTIONAL_DERIVATIVE] = {"fmi3GetDirectionalDerivative", BOTH, FMI3_EVALUABLE, NULL},
    [GET_ADJOINT_DERIVATIVE] = {"fmi3GetAdjointDerivative", BOTH, FMI3_EVALUABLE, NULL},
    [ENTER_CONFIGURATION_MODE] = {"fmi3EnterConfigurationMode", 0, 0,
                                  " is of no use: there are no structural parameters"},
    [EXIT_CONFIGURATION_MODE] = {"fmi3ExitConfigurationMode", 0, 0,
                                 " is of no use: there are no structural parameters"},
    [GET_INTERVAL] = {"fmi3GetInterval{Decimal|Fraction}", BOTH, INITIALIZING | EVENT_MODE, NULL},
    [SET_INTERVAL] = {"fmi3SetInterval{Decimal|Fraction}", BOTH, INITIALIZING | EVENT_MODE, NULL},
    [GET_SHIFT] = {"fmi3GetShift{Decimal|Fraction}", BOTH, INITIALIZING, NULL},
    [SET_SHIFT] = {"fmi3SetShift{Decimal|Fraction}", BOTH, INITIALIZING, NULL},
    [EVALUATE_DISCRETE_STATES] = {"fmi3EvaluateDiscreteStates", BOTH, EVENT_MODE, NULL},
    [UPDATE_DISCRETE_STATES] = {"fmi3UpdateDiscreteStates", BOTH, EVENT_MODE, NULL},
    [ENTER_CONTINUOUS_TIME_MODE] = {"fmi3EnterContinuousTimeMode", ME, EVENT_MODE, NULL},
    [COMPLETED_INTEGRATOR_STEP] = {"fmi3CompletedIntegratorStep", ME, CONTINUOUS, NULL},
    [SET_TIME] = {"fmi3SetTime", ME, CONTINUOUS, NULL},
    [SET_CONTINUOUS_STATES] = {"fmi3SetContinuousStates", ME, CONTINUOUS, NULL},
    [GET_CONTINUOUS_STATE_DERIVATIVES] = {"fmi3GetContinuousStateDerivatives", ME, FMI3_EVALUABLE, NULL},
    [GET_EVENT_INDICATORS] = {"fmi3GetEventIndicators", ME, FMI3_EVALUABLE, NULL},
    [GET_CONTINUOUS_STATES] = {"fmi3GetContinuousStates", ME, FMI3_EVALUABLE, NULL},
    [GET_NOMINALS_OF_CONTINUOUS_STATES] = {"fmi3GetNominalsOfContinuousStates", ME, FMI3_EVALUABLE, NULL},
    [GET_NUMBER_OF_EVENT_INDICATORS] = {"fmi3GetNumberOfEventIndicators", ME, FMI3_ANY_TIME, NULL},
    [GET_NUMBER_OF_CONTINUOUS_STATES] = {"fmi3GetNumberOfContinuousStates", ME, FMI3_ANY_TIME, NULL},
    [ENTER_STEP_MODE] = {"fmi3EnterStepMode", CS, EVENT_MODE, NULL},
    [GET_OUTPUT_DERIVATIVES] = {"fmi3GetOutputDerivatives", CS, STEPPING | UPDATING | TERMINATED | FAILED, NULL},
    [DO_STEP] = {"fmi3DoStep", CS, STEPPING, NULL},
    [ACTIVATE_MODEL_PARTITION] = {"fmi3ActivateModelPartition", 0, 0,
                                  " is for Scheduled Execution, which is not offered"},
};

static const Standard fmi3_standard = {.array = "an array", .calls = fmi3_calls};

fmi3Status to_fmi3(Status status)
{
    static const fmi3Status same[] = {[STATUS_OK] = fmi3OK,
                                      [STATUS_WARNING] = fmi3Warning,
                                      [STATUS_DISCARD] = fmi3Discard,
                                      [STATUS_ERROR] = fmi3Error};
    return same[status];
}

static void fmi3_log(void *receiver, LogCategory category, Status status, const char *message)
{
    const Component *component = receiver;
    if (component->log_message != NULL) {
        component->log_message(component->environment, to_fmi3(status), log_category_name[category], message);
    }
}

Component *fmi3_component_create(Use use, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log_message)
{
    Component *component = calloc(1, sizeof *component);
    if (component != NULL) {
        const Caller caller = {
            .standard = &fmi3_standard, .allocate = calloc, .release = free, .log = fmi3_log, .receiver = component};
        component->environment = environment;
        component->log_message = log_message;
        instance_create(&component->instance, use, &caller);
    }
    return component;
}
