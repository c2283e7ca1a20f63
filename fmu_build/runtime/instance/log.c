#include "log.h"

#include <string.h>

const char *const log_category_name[N_LOG_CATEGORIES] = {
    [LOG_ERROR] = "logStatusError",
    [LOG_WARNING] = "logStatusWarning",
    [LOG_EVENT] = "logEvents",
    [LOG_STEP] = "logSteps",
};

void log_write(const Instance *instance, LogCategory category, Status status, const Message *message)
{
    if (instance->logs[category]) {
        instance->caller.log(instance->caller.receiver, category, status, message->text);
    }
}

Status log_error(const Instance *instance, const Message *why)
{
    log_write(instance, LOG_ERROR, STATUS_ERROR, why);
    return STATUS_ERROR;
}

Status log_discard(const Instance *instance, const Message *why)
{
    log_write(instance, LOG_WARNING, STATUS_DISCARD, why);
    return STATUS_DISCARD;
}

/* The category of that name; N_LOG_CATEGORIES if there is none. */
static int category_index(const char *name)
{
    for (int i = 0; i < N_LOG_CATEGORIES; i++) {
        if (name != NULL && strcmp(name, log_category_name[i]) == 0) {
            return i;
        }
    }
    return N_LOG_CATEGORIES;
}

Status log_choose(Instance *instance, const char *function, LogCategory first, bool on, const char *const names[],
                  size_t n)
{
    Status status = STATUS_OK;
    for (int i = (int)first; i < N_LOG_CATEGORIES && n == 0; i++) {
        instance->logs[i] = on;
    }
    for (size_t i = 0; i < n; i++) {
        const int category = category_index(names[i]);
        if (category == N_LOG_CATEGORIES) {
            Message message;
            message_write(&message, "%s: there is no log category %s", function, names[i] != NULL ? names[i] : "NULL");
            log_write(instance, LOG_WARNING, STATUS_WARNING, &message);
            status = STATUS_WARNING;
        } else if (category >= (int)first) {
            instance->logs[category] = on;
        }
    }
    return status;
}
