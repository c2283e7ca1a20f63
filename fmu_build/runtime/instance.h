/* One instance of the model, in the terms of no particular FMI version. The facades translate to and from it.
 *
 * Everything that changes during a simulation is in State, which holds no pointers: a snapshot is a copy of it.
 * Every function that can fail says why through the log callback, and changes nothing if it refuses its arguments. */
#ifndef INSTANCE_H
#define INSTANCE_H

#include <stddef.h>

#include "integrator.h"
#include "message.h"
#include "model.h"

/* Bits, so that a set of phases is a mask. */
typedef enum {
    INSTANTIATED = 1,
    INITIALIZING = 2,
    STEPPING = 4,
    TERMINATED = 8,
    FAILED = 16 /* a step could not be made; what is left is the last good point, for reading only, until reset */
} Phase;

typedef enum { STATUS_OK, STATUS_WARNING, STATUS_ERROR } Status;

typedef enum { LOG_ERROR, LOG_WARNING, LOG_EVENT, N_LOG_CATEGORIES } LogCategory;

typedef void LogFunction(void *receiver, LogCategory category, const char *message);

typedef struct {
    Phase phase;
    bool current; /* all of v, and holds, follow from what has been set */
    double tolerance;
    double stop; /* INFINITY: not given */
    Variables v;
    bool holds[AT_LEAST_ONE(N_RELATIONS)];
    Integrator integrator;
} State;

typedef struct {
    State state;
    Workspace workspace;
    LogFunction *log;
    void *receiver;
    bool logs[N_LOG_CATEGORIES]; /* which categories the receiver gets */
} Instance;

/* Fills in *instance; errors and warnings are logged, events are not. */
void instance_create(Instance *instance, LogFunction *log, void *receiver);

/* Back to where instance_create left it, but for the log. */
void instance_reset(Instance *instance);

/* Tolerance and stop time: NULL if not given. */
Status instance_setup(Instance *instance, const double *tolerance, double start, const double *stop);
Status instance_enter_initialization(Instance *instance);
Status instance_exit_initialization(Instance *instance);
Status instance_terminate(Instance *instance);

/* Values by value reference: the index in Variables. */
Status instance_get(Instance *instance, const unsigned references[], size_t n, double values[]);
Status instance_set(Instance *instance, const unsigned references[], size_t n, const double values[]);

/* Integrate from the communication point `time`, where the instance must be, to time + size. */
Status instance_step(Instance *instance, double time, double size);

void instance_log(const Instance *instance, LogCategory category, const Message *message);

#endif
