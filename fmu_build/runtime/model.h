/* The contract between a generated model and the runtime.
 *
 * The generator writes variables.h (sizes, the Variables union, the model's identity), elimination.h (the sizes of the
 * Jacobian and its factors), model.c and elimination.c (everything declared below). The runtime is written against this
 * header alone and is compiled once for each model, so that every size is a compile-time constant.
 *
 * Variables.at[] holds every variable of the model; its index is the FMI value reference. A Boolean is 0.0 or 1.0, an
 * Integer or an enumeration a whole number. The order is
 *     time | states | derivatives of the states, in their order | inputs | parameters | calculated parameters | others
 * and the same doubles have readable names in generated code, through the anonymous struct of the union.
 *
 * A relation (a condition such as `compression > eps` in an if-expression) keeps its truth value holds[i] while the
 * integrator runs between two events, so that the right-hand side is smooth there. Its residual z[i] is positive
 * exactly where the relation, evaluated afresh, would be true.
 */
#ifndef MODEL_H
#define MODEL_H

#include <stdbool.h>

#include "elimination.h"
#include "glibc.h"
#include "variables.h"

/* variables.h defines (example of a model with 2 states, 1 input, 2 parameters and 1 relation):
 *
 *   #define MODEL_NAME "Example"
 *   #define MODEL_TOKEN "{...}"                    content hash: FMI 2 guid, FMI 3 instantiation token
 *   enum { N_STATES = 2, N_INPUTS = 1, N_PARAMETERS = 2, N_RELATIONS = 1, N_VARIABLES = 12 };
 *   typedef union {
 *       struct { double time; double x; double v; double der_x; double der_v; ... };
 *       double at[N_VARIABLES];
 *   } Variables;                                   the struct may end with what model_steady keeps
 */

/* and #define N_COUPLINGS 0, or 1, and HAS_EVENTS 0, or 1: macros, because they decide what is compiled (see
 * coupling_info and model_discrete below). N_LOOPS, how many algebraic loops there are, may be left out: none. */

/* ISO C has no arrays of length zero, and a model may have no states or no relations. */
#define AT_LEAST_ONE(n) ((n) > 0 ? (n) : 1)

/* Pieces of a function that is too long for a compiler stay pieces. */
#if defined __GNUC__
#define NOT_INLINED __attribute__((noinline))
#else
#define NOT_INLINED
#endif

enum { FIRST_STATE = 1, FIRST_DERIVATIVE = FIRST_STATE + N_STATES, FIRST_INPUT = FIRST_DERIVATIVE + N_STATES };
enum { FIRST_PARAMETER = FIRST_INPUT + N_INPUTS };

typedef enum {
    TIME,             /* the independent variable */
    STATE,            /* its start value may be set before initialization ends */
    STATE_CALCULATED, /* its start value follows from parameters */
    DERIVATIVE,
    INPUT,           /* one that is no Real changes at events only */
    PARAMETER,       /* tunable: takes effect at the next step */
    FIXED_PARAMETER, /* only start values depend on it: may be set before initialization ends */
    CALCULATED_PARAMETER,
    OTHER /* algebraic variables, outputs among them */
} VariableKind;

typedef enum { REAL, INTEGER, BOOLEAN, ENUMERATION } ValueType;

typedef struct {
    const char *name; /* Modelica name, as in modelDescription.xml */
    const char *unit; /* "" if the model gives none; "1" is dimensionless */
    ValueType type;
    VariableKind kind;
    double start, min, max, nominal; /* min, max: -INFINITY, INFINITY if the model gives none */
} VariableInfo;

extern const VariableInfo variable_info[N_VARIABLES];

/* The residual of every relation as text, "compression > eps", for messages; one empty string if there are none. */
extern const char *const relation_text[AT_LEAST_ONE(N_RELATIONS)];

/* The residuals as variables: their indices in Variables.at[]; one 0 if there are none. One whose nominal value is 0
 * has no rounding errors: it is a time less the present one. */
extern const unsigned relation_reference[AT_LEAST_ONE(N_RELATIONS)];

#if N_COUPLINGS > 0

/* The variables of a coupling, see coupling.h: their indices in Variables.at[]. variables.h says N_ACROSS and
 * N_THROUGH, how many quantities a master exchanges each way; the first through acts at every across, the others
 * elsewhere. */

/* What a master holds over its steps, such as the speed of a body. */
typedef struct {
    unsigned input;
    unsigned derivative; /* input: its derivative by time, 0 if the master does not know it */
    unsigned inertia;    /* parameter: what the first through accelerates there, 0 if it is not known; none: the time */
    double sign;         /* 1 or -1: the sense in which the first through acts there */
} Across;

/* What is given back for it, such as a force. In the model's equations mean and hold equal the output. */
typedef struct {
    unsigned output;
    unsigned impulse; /* state: its integral */
    unsigned mean;    /* output: its mean over the last step */
    unsigned hold;    /* output: what a master should hold over the next step; it keeps to its range */
} Through;

/* Nothing may depend on means, holds and the energy, which is zero in the model's equations, because Co-Simulation
 * replaces them. */
typedef struct {
    Across across[N_ACROSS];
    Through through[N_THROUGH];
    unsigned extrapolate; /* parameter: above 0.5, each across goes on as it has changed over the last step */
    unsigned work;        /* state: the integral of the power that is given, first through * sum of sign * across */
    unsigned applied;     /* parameter: what the master applies: 1 the output itself, 2 mean, 3 hold */
    unsigned energy;      /* output: energy that the coupling has made so far */
} CouplingInfo;

extern const CouplingInfo coupling_info;

#endif

/* Where the N_JACOBIAN entries of the Jacobian J stand, and where its N_FACTORS factors do: those of L, D, U in the
 * product L D U = shift I - J with rows and columns in the order in which the states are eliminated, row by row. */
extern const int jacobian_row[AT_LEAST_ONE(N_JACOBIAN)];
extern const int jacobian_column[AT_LEAST_ONE(N_JACOBIAN)];
extern const int jacobian_factor[AT_LEAST_ONE(N_JACOBIAN)]; /* the factor that takes the entry's place */
extern const int pivot_state[AT_LEAST_ONE(N_STATES)];       /* the order of elimination */
extern const int pivot_factor[AT_LEAST_ONE(N_STATES)];      /* the factor on the diagonal of each row */
extern const int first_factor[N_STATES + 1];                /* of each row, and the end of the last */
extern const int factor_column[AT_LEAST_ONE(N_FACTORS)];

/* What lu.h declares, a line for each operation; there are so few if ELIMINATION_WRITTEN_OUT is 1 (a macro, because it
 * decides what is compiled). */
#if ELIMINATION_WRITTEN_OUT
void model_factorize(const double *restrict jacobian, double shift, double *restrict factors);
void model_solve(const double *restrict factors, const double *restrict b, double *restrict x);
void model_subtract_product(const double *restrict jacobian, double shift, const double *restrict x,
                            double *restrict b); /* b -= (shift I - J) x */
#endif

/* Every function reads and writes v only; unless it says otherwise, each computes all intermediate variables that it
 * needs. */

/* Calculated parameters, from parameters. */
void model_parameters(Variables *v);

/* What follows from parameters, calculated ones included, and inputs alone: some variables, and quotients and functions
 * of them that the others need. It has to follow before any of those below is called; moves_steady tells on which
 * inputs it depends. */
void model_steady(Variables *v);

extern const bool moves_steady[AT_LEAST_ONE(N_INPUTS)];

/* Start values of the states of kind STATE_CALCULATED, from parameters (calculated ones included) and all that is given
 * at the start; it may write other variables on the way. */
void model_start(Variables *v, const bool holds[]);

/* Derivatives of the states, from time, states, inputs, parameters. */
void model_derivatives(Variables *v, const bool holds[]);

/* The same where nothing has changed since they were computed but this input, on which neither truths nor what is
 * steady depend: moves_truths, moves_steady. */
void model_derivatives_by(Variables *v, const bool holds[], int input);

extern const bool moves_truths[AT_LEAST_ONE(N_INPUTS)];

/* All variables but those that change at events alone. */
void model_outputs(Variables *v, const bool holds[]);

/* jacobian[e] = d derivative[jacobian_row[e]] / d state[jacobian_column[e]], time_derivative[i] = d derivative[i] / d
 * time, partial; exact between events. Entries of the Jacobian that are always zero have no e. v must be as
 * model_derivatives has left it. */
void model_jacobian(const Variables *v, const bool holds[], double jacobian[], double time_derivative[]);

/* Residuals of the relations. */
void model_relations(Variables *v, const bool holds[], double z[]);

/* Chain rule, forward: d bears the tangents of what is known (time, states, inputs, parameters; zero where there is no
 * seed), and gets the tangents of all that is calculated. v must be current. At the start the states of kind
 * STATE_CALCULATED are calculated, otherwise they are known. */
void model_tangent(const Variables *v, const bool holds[], bool at_start, Variables *d);

/* The same of the derivatives alone, and of what is on the way to them, with seeds of time and inputs alone; all else
 * in d is zero. */
void model_input_tangent(const Variables *v, const bool holds[], Variables *d);

/* Chain rule, reverse: d bears the seeds of what is calculated, zero elsewhere, and gets the adjoints of what is known
 * (those of what is calculated are left over from the way). */
void model_adjoint(const Variables *v, const bool holds[], bool at_start, Variables *d);

#if HAS_EVENTS

#include "message.h"

/* Beside N_STATES and so on variables.h says N_MEMORIES, N_REINITS, N_SAMPLES, N_TIME_EVENTS, N_CHECKS, N_EVENT_CHECKS,
 * and the indices of two Boolean variables, INITIAL and TERMINAL. All that follows are indices in Variables.at[] too.
 */

/* What a variable was before an event: pre(variable). A discrete one that has changed makes one more event. */
typedef struct {
    unsigned variable, before;
    bool discrete;
} Memory;

/* The state gets the value where the Boolean variable active is true. */
typedef struct {
    unsigned state, active, value;
} Reinit;

/* The Boolean variable is true at the times start + i * interval, i = 0, 1, ..., during the event there. */
typedef struct {
    unsigned flag, start, interval;
} Sample;

/* Where the Boolean variable is true: a warning, an error, or the end of the simulation. */
typedef enum { WARN, FAIL, END } CheckKind;
typedef struct {
    unsigned violated;
    CheckKind kind;
} Check;

extern const Memory memories[AT_LEAST_ONE(N_MEMORIES)];
extern const Reinit reinits[AT_LEAST_ONE(N_REINITS)];
extern const Sample samples[AT_LEAST_ONE(N_SAMPLES)];
extern const Check checks[AT_LEAST_ONE(N_CHECKS)]; /* the first N_EVENT_CHECKS are computed by model_discrete */

/* The times at which relations in the time alone change. */
extern const unsigned time_events[AT_LEAST_ONE(N_TIME_EVENTS)];

/* All discrete variables, from those before the event, and what belongs to reinits, samples, time events and checks. */
void model_discrete(Variables *v, const bool holds[]);

/* The other checks. */
void model_checks(Variables *v, const bool holds[]);

/* The text of a check. */
void model_message(const Variables *v, int check, Message *message);

#endif
#endif
