/* What every function of a facade refuses: a call that is not legal now, and arguments that are not there.
 *
 * A facade has a table of its functions. Those that both versions of the standard have come first, in one order and
 * under FMI 3's names; the version's own follow. Functions of the instance that fill or read the caller's arrays look
 * at the call and at these arrays themselves; before others the facade does so. */
#ifndef CALLS_H
#define CALLS_H

#include "state.h"

enum {
    SET_DEBUG_LOGGING,
    ENTER_INITIALIZATION_MODE,
    EXIT_INITIALIZATION_MODE,
    TERMINATE,
    RESET,
    GET_FMU_STATE,
    SET_FMU_STATE,
    FREE_FMU_STATE,
    SERIALIZED_FMU_STATE_SIZE,
    SERIALIZE_FMU_STATE,
    DESERIALIZE_FMU_STATE,
    GET_DIRECTIONAL_DERIVATIVE,
    GET_OUTPUT_DERIVATIVES,
    ENTER_EVENT_MODE,
    UPDATE_DISCRETE_STATES,
    ENTER_CONTINUOUS_TIME_MODE,
    COMPLETED_INTEGRATOR_STEP,
    SET_TIME,
    SET_CONTINUOUS_STATES,
    GET_CONTINUOUS_STATES,
    GET_CONTINUOUS_STATE_DERIVATIVES,
    GET_EVENT_INDICATORS,
    GET_NOMINALS_OF_CONTINUOUS_STATES,
    DO_STEP,
    N_COMMON_CALLS
};

/* Uses of an instance, as a mask. */
enum {
    CS_WITH_EVENTS = 1 << CO_SIMULATION_WITH_EVENTS,
    CS = CS_WITH_EVENTS | 1 << CO_SIMULATION,
    ME = 1 << MODEL_EXCHANGE,
    BOTH = CS | ME
};

typedef struct {
    const char *name;    /* as the standard writes it */
    int uses;            /* in which it is legal */
    int phases;          /* in which it is legal then */
    const char *refusal; /* what follows the name in another use; NULL: that it is not for it */
} Call;

struct Standard {
    const char *array; /* what messages call one */
    const Call *calls; /* by function */
};

/* Where one of these returns false it has logged why, in the function's name. A NULL is no instance, and says nothing.
 */

bool call_is_legal(Instance *instance, int function);

/* Of a call that is legal: no argument is NULL that must not be; an array is as long as it should be. */
bool call_has_arguments(const Instance *instance, int function, bool given);
bool call_has_length(const Instance *instance, int function, size_t n, size_t needed);

/* Legal, and the arguments are there. */
bool call_is_complete(Instance *instance, int function, bool given);

/* Legal, and the array is there and as long as it should be. */
bool call_has_array(Instance *instance, int function, const void *array, size_t n, size_t needed);

/* The same of an array with one value for each of the references, which are there too. */
bool call_has_values(Instance *instance, int function, const unsigned references[], size_t n, const void *values,
                     size_t n_values);

const char *call_name(const Instance *instance, int function);

#endif
