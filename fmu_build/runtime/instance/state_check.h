/* Whether a state that comes from bytes can be believed: whoever made them, it must not lead the runtime out of its
 * arrays, to a truth that is neither true nor false, or to steps without end. */
#ifndef STATE_CHECK_H
#define STATE_CHECK_H

#include "state.h"

/* False: what cannot be. */
bool state_check(const State *s, Message *why);

#endif
