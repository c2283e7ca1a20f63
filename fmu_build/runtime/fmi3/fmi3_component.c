#include "fmi3_component.h"

#include <stdlib.h>
#include <string.h>

/* Which call is legal in which state: sections 2.3, 3.2 and 4.2. FAILED is the state Terminated that an error leads to;
 * a call that is refused leads nowhere. */
enum {
    ANY_TIME = INSTANTIATED | INITIALIZING | STEPPING | EVENT_MODE | CONTINUOUS | TERMINATED | FAILED,
    INITIALIZED = STEPPING | EVENT_MODE | CONTINUOUS,
    EVALUABLE = INITIALIZING | INITIALIZED | TERMINATED | FAILED,
    SETTABLE = INSTANTIATED | INITIALIZING | INITIALIZED
};

typedef enum { CS = 1, ME = 2, BOTH = CS | ME } Interface;

static const struct {
    const char *name;
    Interface interface;
    int legal_in;
} rules[] = {
    [SET_DEBUG_LOGGING] = {"fmi3SetDebugLogging", BOTH, ANY_TIME},
    [ENTER_INITIALIZATION_MODE] = {"fmi3EnterInitializationMode", BOTH, INSTANTIATED},
    [EXIT_INITIALIZATION_MODE] = {"fmi3ExitInitializationMode", BOTH, INITIALIZING},
    [ENTER_EVENT_MODE] = {"fmi3EnterEventMode", BOTH, STEPPING | CONTINUOUS},
    [TERMINATE] = {"fmi3Terminate", BOTH, INITIALIZED},
    [RESET] = {"fmi3Reset", BOTH, ANY_TIME},
    [GET_FLOAT64] = {"fmi3GetFloat64", BOTH, ANY_TIME | UPDATING},
    [SET_FLOAT64] = {"fmi3SetFloat64", BOTH, SETTABLE},
    [GET_OTHER_TYPE] = {"fmi3Get{VariableType}", BOTH, ANY_TIME | UPDATING},
    [SET_OTHER_TYPE] = {"fmi3Set{VariableType}", BOTH, SETTABLE & ~CONTINUOUS},
    [GET_CLOCK] = {"fmi3GetClock", BOTH, INITIALIZING | EVENT_MODE},
    [SET_CLOCK] = {"fmi3SetClock", BOTH, INITIALIZING | EVENT_MODE},
    [GET_NUMBER_OF_VARIABLE_DEPENDENCIES] = {"fmi3GetNumberOfVariableDependencies", BOTH, ANY_TIME},
    [GET_VARIABLE_DEPENDENCIES] = {"fmi3GetVariableDependencies", BOTH, ANY_TIME},
    [GET_FMU_STATE] = {"fmi3GetFMUState", BOTH, ANY_TIME},
    [SET_FMU_STATE] = {"fmi3SetFMUState", BOTH, ANY_TIME},
    [FREE_FMU_STATE] = {"fmi3FreeFMUState", BOTH, ANY_TIME},
    [SERIALIZED_FMU_STATE_SIZE] = {"fmi3SerializedFMUStateSize", BOTH, ANY_TIME},
    [SERIALIZE_FMU_STATE] = {"fmi3SerializeFMUState", BOTH, ANY_TIME},
    [DESERIALIZE_FMU_STATE] = {"fmi3DeserializeFMUState", BOTH, ANY_TIME},
    [GET_DIRECTIONAL_DERIVATIVE] = {"fmi3GetDirectionalDerivative", BOTH, EVALUABLE},
    [GET_ADJOINT_DERIVATIVE] = {"fmi3GetAdjointDerivative", BOTH, EVALUABLE},
    [ENTER_CONFIGURATION_MODE] = {"fmi3EnterConfigurationMode", BOTH, 0},
    [EXIT_CONFIGURATION_MODE] = {"fmi3ExitConfigurationMode", BOTH, 0},
    [GET_INTERVAL] = {"fmi3GetInterval{Decimal|Fraction}", BOTH, INITIALIZING | EVENT_MODE},
    [SET_INTERVAL] = {"fmi3SetInterval{Decimal|Fraction}", BOTH, INITIALIZING | EVENT_MODE},
    [GET_SHIFT] = {"fmi3GetShift{Decimal|Fraction}", BOTH, INITIALIZING},
    [SET_SHIFT] = {"fmi3SetShift{Decimal|Fraction}", BOTH, INITIALIZING},
    [EVALUATE_DISCRETE_STATES] = {"fmi3EvaluateDiscreteStates", BOTH, EVENT_MODE},
    [UPDATE_DISCRETE_STATES] = {"fmi3UpdateDiscreteStates", BOTH, EVENT_MODE},
    [ENTER_CONTINUOUS_TIME_MODE] = {"fmi3EnterContinuousTimeMode", ME, EVENT_MODE},
    [COMPLETED_INTEGRATOR_STEP] = {"fmi3CompletedIntegratorStep", ME, CONTINUOUS},
    [SET_TIME] = {"fmi3SetTime", ME, CONTINUOUS},
    [SET_CONTINUOUS_STATES] = {"fmi3SetContinuousStates", ME, CONTINUOUS},
    [GET_CONTINUOUS_STATE_DERIVATIVES] = {"fmi3GetContinuousStateDerivatives", ME, EVALUABLE},
    [GET_EVENT_INDICATORS] = {"fmi3GetEventIndicators", ME, EVALUABLE},
    [GET_CONTINUOUS_STATES] = {"fmi3GetContinuousStates", ME, EVALUABLE},
    [GET_NOMINALS_OF_CONTINUOUS_STATES] = {"fmi3GetNominalsOfContinuousStates", ME, EVALUABLE},
    [GET_NUMBER_OF_EVENT_INDICATORS] = {"fmi3GetNumberOfEventIndicators", ME, ANY_TIME},
    [GET_NUMBER_OF_CONTINUOUS_STATES] = {"fmi3GetNumberOfContinuousStates", ME, ANY_TIME},
    [ENTER_STEP_MODE] = {"fmi3EnterStepMode", CS, EVENT_MODE},
    [GET_OUTPUT_DERIVATIVES] = {"fmi3GetOutputDerivatives", CS, STEPPING | UPDATING | TERMINATED | FAILED},
    [DO_STEP] = {"fmi3DoStep", CS, STEPPING},
    [ACTIVATE_MODEL_PARTITION] = {"fmi3ActivateModelPartition", BOTH, 0},
};

fmi3Status to_fmi3(Status status)
{
    static const fmi3Status same[] = {[STATUS_OK] = fmi3OK,
                                      [STATUS_WARNING] = fmi3Warning,
                                      [STATUS_DISCARD] = fmi3Discard,
                                      [STATUS_ERROR] = fmi3Error};
    return same[status];
}

static void log_to_callback(void *receiver, LogCategory category, Status status, const char *message)
{
    const Component *component = receiver;
    if (component->log_message != NULL) {
        component->log_message(component->environment, to_fmi3(status), category_name[category], message);
    }
}

fmi3Status report(Component *component, Status status, const Message *message)
{
    instance_log(&component->instance, status == STATUS_ERROR ? LOG_ERROR : LOG_WARNING, status, message);
    return to_fmi3(status);
}

/* NULL if the call is legal, otherwise why not. */
static const char *obstacle(const State *s, Function function)
{
    const Interface interface = s->use == MODEL_EXCHANGE ? ME : CS;
    if (function == ENTER_CONFIGURATION_MODE || function == EXIT_CONFIGURATION_MODE) {
        return "is of no use: there are no structural parameters";
    }
    if (function == ACTIVATE_MODEL_PARTITION) {
        return "is for Scheduled Execution, which is not offered";
    }
    if ((rules[function].interface & interface) == 0) {
        return interface == ME ? "is not for Model Exchange" : "is not for Co-Simulation";
    }
    if (function == ENTER_EVENT_MODE && s->use == CO_SIMULATION) {
        return "must not be called: the instance was made with eventModeUsed = fmi3False";
    }
    if ((rules[function].legal_in & (int)s->phase) == 0) {
        return s->phase == FAILED
                   ? "must not be called now: a step has failed, fmi3Reset or fmi3SetFMUState comes first"
               : s->phase == UPDATING ? "must not be called during an intermediate update"
                                      : "must not be called now";
    }
    return NULL;
}

Component *legal(fmi3Instance instance, Function function)
{
    Component *component = instance;
    Message message;
    if (component == NULL) {
        return NULL;
    }
    const char *why = obstacle(&component->instance.state, function);
    if (why != NULL) {
        message_write(&message, "%s %s", rules[function].name, why);
        (void)report(component, STATUS_ERROR, &message);
        return NULL;
    }
    return component;
}

fmi3Status null_argument(Component *component, Function function)
{
    Message message;
    message_write(&message, "%s: an argument is NULL", rules[function].name);
    return report(component, STATUS_ERROR, &message);
}

fmi3Status wrong_length(Component *component, Function function, size_t n, size_t needed)
{
    Message message;
    message_write(&message, "%s: an array has %zu elements instead of %zu", rules[function].name, n, needed);
    return report(component, STATUS_ERROR, &message);
}

Component *legal_array(fmi3Instance instance, Function function, const void *array, size_t n, size_t needed)
{
    Component *component = legal(instance, function);
    if (component == NULL) {
        return NULL;
    }
    if (n != needed) {
        (void)wrong_length(component, function, n, needed);
        return NULL;
    }
    if (array == NULL && n > 0) {
        (void)null_argument(component, function);
        return NULL;
    }
    return component;
}

fmi3Status no_variables(fmi3Instance instance, Function function, size_t n)
{
    Message message;
    Component *component = legal(instance, function);
    if (component == NULL) {
        return fmi3Error;
    }
    if (n == 0) {
        return fmi3OK;
    }
    message_write(&message, "%s: there are no variables of this type", rules[function].name);
    return report(component, STATUS_ERROR, &message);
}

Component *component_create(Use use, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log_message)
{
    Component *component = calloc(1, sizeof *component);
    if (component != NULL) {
        component->environment = environment;
        component->log_message = log_message;
        instance_create(&component->instance, use, log_to_callback, component);
    }
    return component;
}
