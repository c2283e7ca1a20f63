/* Event mode, and Model Exchange: the caller integrates. */
#ifndef MODEL_EXCHANGE_H
#define MODEL_EXCHANGE_H

#include "calls.h"

Status model_exchange_enter_event_mode(Instance *instance);

/* Truths and discrete variables from what has been set, the values before the event staying as they are. */
Status model_exchange_evaluate_event(Instance *instance);

/* What an event has led to. */
typedef struct {
    bool ended;          /* the model asks to end the simulation */
    bool states_changed; /* and so the caller has to read them again */
    double next_time;    /* of the next event that is known beforehand; INFINITY if there is none */
} EventResult;

/* The event, to its end: none follows at the same time. */
Status model_exchange_handle_event(Instance *instance, EventResult *result);

/* The caller has made a step and stays in continuous time: assertions are looked at. */
Status model_exchange_complete_step(Instance *instance);

/* To CONTINUOUS in Model Exchange, to STEPPING in Co-Simulation. */
Status model_exchange_leave_event_mode(Instance *instance);

Status model_exchange_set_time(Instance *instance, double time);

/* Calls of the same names, with what they have to refuse: n must be the number of states. */
Status model_exchange_set_states(Instance *instance, const double states[], size_t n);
Status model_exchange_get_states(Instance *instance, double states[], size_t n);
Status model_exchange_get_derivatives(Instance *instance, double derivatives[], size_t n);
Status model_exchange_get_nominals(Instance *instance, double nominals[], size_t n);

/* The residuals of the relations, shifted so that none is zero as long as its truth is the one that is held: an
 * indicator that starts exactly on its surface is seen to leave it. n must be their number. */
Status model_exchange_get_indicators(Instance *instance, double indicators[], size_t n);

#endif
