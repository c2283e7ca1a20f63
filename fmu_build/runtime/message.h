/* Texts for the user: written where something goes wrong, handed up, logged once by the instance. */
#ifndef MESSAGE_H
#define MESSAGE_H

#include "unit.h"

#if defined __GNUC__
#define PRINTF_LIKE(text, first) __attribute__((format(printf, text, first)))
#else
#define PRINTF_LIKE(text, first)
#endif

typedef struct {
    char text[512];
} Message;

typedef struct {
    char text[96];
} Quantity;

/* Longer texts are cut off. */
void message_write(Message *message, const char *format, ...) PRINTF_LIKE(2, 3);

/* The same, behind what is there. */
void message_append(Message *message, const char *format, ...) PRINTF_LIKE(2, 3);

/* A value with its unit: "0.1 m/s", "infinity", "NaN". */
Quantity quantity(double value, const char *unit);

#endif
