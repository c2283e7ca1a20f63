/* Messages to the caller, by category, and the status that goes with them. */
#ifndef LOG_H
#define LOG_H

#include "state.h"

extern const char *const log_category_name[N_LOG_CATEGORIES];

/* Unless the category is switched off. */
void log_write(const Instance *instance, LogCategory category, Status status, const Message *message);

/* Log, and return STATUS_ERROR or STATUS_DISCARD. */
Status log_error(const Instance *instance, const Message *why);
Status log_discard(const Instance *instance, const Message *why);

/* Switch the named categories on or off, but for those before `first`; without names all. STATUS_WARNING if there is no
 * category of some name. function: what the caller has called, for messages. */
Status log_choose(Instance *instance, const char *function, LogCategory first, bool on, const char *const names[],
                  size_t n);

#endif
