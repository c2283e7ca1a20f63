#include "message.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

void message_write(Message *message, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(message->text, sizeof message->text, format, arguments);
    va_end(arguments);
}

void message_append(Message *message, const char *format, ...)
{
    const size_t length = strlen(message->text);
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(message->text + length, sizeof message->text - length, format, arguments);
    va_end(arguments);
}

Quantity quantity(double value, const char *unit)
{
    Quantity q;
    const bool has_unit = unit[0] != '\0' && strcmp(unit, "1") != 0;
    if (isnan(value)) {
        (void)snprintf(q.text, sizeof q.text, "NaN");
    } else if (isinf(value)) {
        (void)snprintf(q.text, sizeof q.text, value > 0 ? "infinity" : "-infinity");
    } else {
        (void)snprintf(q.text, sizeof q.text, "%.9g%s%s", value, has_unit ? " " : "", has_unit ? unit : "");
    }
    return q;
}
