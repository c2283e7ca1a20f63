/* Event mode, and Model Exchange: the caller integrates. */
#ifndef CONTINUOUS_H
#define CONTINUOUS_H

#include "instance.h"

Status instance_enter_event_mode(Instance *instance);

/* Truths from what has been set. There is nothing else that is discrete: no new event follows, no state is changed. */
Status instance_update_truths(Instance *instance);

/* To CONTINUOUS in Model Exchange, to STEPPING in Co-Simulation. */
Status instance_leave_event_mode(Instance *instance);

Status instance_set_time(Instance *instance, double time);
Status instance_set_states(Instance *instance, const double states[]);
Status instance_get_states(Instance *instance, double states[]);
Status instance_get_derivatives(Instance *instance, double derivatives[]);
void instance_get_nominals(double nominals[]);

/* The residuals of the relations, shifted so that none is zero as long as its truth is the one that is held: an
 * indicator that starts exactly on its surface is seen to leave it. */
Status instance_get_indicators(Instance *instance, double indicators[]);

#endif
