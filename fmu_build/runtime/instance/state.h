/* One instance of the model, in the terms of no particular FMI version: its types.
 *
 * Everything that changes during a simulation is in State, which holds no pointers: a snapshot is a copy of it. */
#ifndef STATE_H
#define STATE_H

#include <stddef.h>

#include "events.h"
#include "integrator.h"
#include "message.h"
#include "model.h"
#include "ramp.h"

/* Bits, so that a set of phases is a mask. */
typedef enum {
    INSTANTIATED = 1,
    INITIALIZING = 2,
    STEPPING = 4,    /* Co-Simulation: at a communication point */
    UPDATING = 8,    /* Co-Simulation: in the caller's callback between two integrator steps */
    EVENT_MODE = 16, /* truths follow what is set */
    CONTINUOUS = 32, /* Model Exchange: truths are held while the caller integrates */
    TERMINATED = 64,
    FAILED = 128 /* an assertion has failed; what is left is the last good point, for reading only, until reset */
} Phase;

typedef enum { CO_SIMULATION, CO_SIMULATION_WITH_EVENTS, MODEL_EXCHANGE } Use;

/* DISCARD: the model cannot be evaluated there; the caller may try another point. */
typedef enum { STATUS_OK, STATUS_WARNING, STATUS_DISCARD, STATUS_ERROR } Status;

typedef enum { LOG_ERROR, LOG_WARNING, LOG_EVENT, LOG_STEP, N_LOG_CATEGORIES } LogCategory;

typedef void LogFunction(void *receiver, LogCategory category, Status status, const char *message);

/* Which variables follow from what has been set: not all; all but for inputs that have been set since, on which neither
 * truths nor what is steady depend; all. */
typedef enum { STALE, STALE_BY_INPUTS, CURRENT, N_FRESHNESS } Freshness;

#if N_COUPLINGS > 0

/* Where an exchange of a coupling begins, and its accounts until then. */
typedef struct {
    double time;
    double across[N_ACROSS];   /* u there, as the caller has it */
    double through[N_THROUGH]; /* what the master can apply from here on: the force there */
    double hold[N_THROUGH];    /* or the one to hold */
    double impulse[N_THROUGH];
    double work;
    double owed[N_THROUGH]; /* the impulse transmitted so far less the one applied */
    double energy;          /* that the coupling has made so far */
    double period;          /* the longest of the last exchanges */
} Exchange;

/* What a coupling remembers, see coupling.h. */
typedef struct {
    bool stepped;            /* there has been a step that led on in time */
    bool moves[N_ACROSS];    /* the slope of u in the last one was the unit's own, so that its end is not what is set */
    bool is_set[N_ACROSS];   /* u has been set since */
    bool stands;             /* the present exchange has begun with the value of the one before */
    bool parted;             /* it has had more than one step */
    bool several;            /* and so had one of the last ones before it */
    Exchange now;            /* the present one */
    Exchange change;         /* the last one that has begun with a new value */
    double before[N_ACROSS]; /* u at the start of the exchange before the present one */
    double interval;         /* the length of that one; 0: there was none */
    double applied;          /* the force that the master held over that one */
    double usual;            /* the longest of the last ones from change to change; 0: there was none */
    int doubts;              /* for so many more changes a value that stands is taken for one that is held */
    double slope[N_ACROSS];  /* of u in the last step */
    double span[N_ACROSS];   /* the time before it from which it was taken: 0: given, INFINITY: there was none */
    /* At the end of the last step: */
    double across[N_ACROSS]; /* u as the slope has it */
    double through[N_THROUGH];
    double mean[N_THROUGH];
    double hold[N_THROUGH];
} Coupling;

#endif

/* An integrator step that leads beyond the communication point. As long as nothing is set, the next communication
 * points lie on its path. */
typedef struct {
    bool open;
    Path path;
    Point arrival;
} Course;

#if HAS_EVENTS
/* What discrete.h needs beside variables. */
typedef struct {
    double ticks[AT_LEAST_ONE(N_SAMPLES)]; /* the number of the next tick */
    bool warned[AT_LEAST_ONE(N_CHECKS)];   /* its warning has been given */
    bool pending;                          /* there is an event to handle before time goes on */
    bool states_changed;                   /* by an event, and the caller does not know yet */
    bool ended;                            /* the model has asked to end the simulation */
} Discrete;
#endif

typedef struct {
    Use use;
    Phase phase;
    bool calculated; /* calculated parameters and what is steady follow from what has been set */
    bool settled;    /* parameters, start values and holds follow from what has been set */
    Freshness freshness;
    bool since[AT_LEAST_ONE(N_INPUTS)]; /* STALE_BY_INPUTS: the inputs that have been set */
    double tolerance;
    double stop; /* INFINITY: not given */
    Variables v;
    bool holds[AT_LEAST_ONE(N_RELATIONS)];
    bool event_waits; /* the last step has ended at an event, which the caller has still to handle */
    bool after_event; /* the last step has ended so */
    bool next_holds[AT_LEAST_ONE(N_RELATIONS)]; /* the truths behind it; otherwise those that are held */
    EventDensity density;
    bool asserted; /* an assertion has failed in the step that is being made */
    Ramp ramp;
    Integrator integrator;
    bool calm; /* nothing has been set since the last step */
    Course course;
#if HAS_EVENTS
    Discrete discrete;
#endif
#if N_COUPLINGS > 0
    Coupling coupling;
#endif
} State;

typedef struct Standard Standard; /* see calls.h */

/* Whoever uses the instance, as the facade presents them. */
typedef struct {
    const Standard *standard;
    void *(*allocate)(size_t n, size_t size); /* zeroed, as calloc does; NULL: there is no memory */
    void (*release)(void *memory);
    LogFunction *log;
    void *receiver; /* of the log */
} Caller;

typedef struct {
    State state;
    Rodas rodas; /* room for the work inside a step: nothing in it survives the step */
    Caller caller;
    bool logs[N_LOG_CATEGORIES];                /* which categories the caller gets */
    bool told_of_range[AT_LEAST_ONE(N_INPUTS)]; /* the caller knows that an input has been beyond its range */
    bool told_of_clock; /* the caller knows that its communication points are not where the instance is */
    State before;       /* kept here while a step is made: what it is taken back to if it is given up */
    double given_up;    /* the end of a step that has been given up from there; NAN: of none */
    Message reason;     /* and why */
#if N_COUPLINGS > 0
    State present; /* kept here while a coupling lets the state run ahead */
#endif
} Instance;

#endif
