/* Algebraic loops: equations that determine their unknowns together, solved at run time.
 *
 * A linear loop takes one elimination. Another one takes Newton's method, with the exact matrix and damped steps, from
 * where the last solution was; the start values of the unknowns are where it begins, and where it tries again. A loop
 * without a solution leaves NaN in its unknowns, so that whatever depends on them is refused. */
#ifndef LOOPS_H
#define LOOPS_H

#include "message.h"
#include "model.h"

typedef struct {
    const char *text; /* the unknowns and where their equations stand, for messages */
    unsigned size;
    unsigned n_iterated; /* Newton's method looks for the first ones; residuals computes the rest from them */
    bool linear;
    const unsigned *unknowns; /* indices in Variables.at[] */
    const unsigned *guesses;  /* the same, for each that is iterated */
    /* Linear: the residuals where all unknowns are zero. Otherwise those of the iterated unknowns. */
    void (*residuals)(Variables *v, const bool holds[], double residual[]);
    /* slope[i * size + j] = d residual[i] / d unknown[j]; only what is not zero is written. */
    void (*slopes)(const Variables *v, const bool holds[], double slope[]);
} Loop;

/* The doubles that a loop of that size needs to work with. */
#define LOOP_WORK(size) ((size) * ((size) + 4))

/* Find the unknowns. */
void loop_solve(const Loop *loop, Variables *v, const bool holds[], double work[], unsigned pivots[]);

/* The factors of the slopes at v, into the first doubles of work, for loop_back. */
void loop_factor(const Loop *loop, const Variables *v, const bool holds[], double work[], unsigned pivots[]);

/* right becomes the inverse of the slopes times right; NaN if they are singular. */
void loop_back(const Loop *loop, const double work[], const unsigned pivots[], double right[]);

/* The chain rule. Forward: right has minus the tangents of the residuals at fixed unknowns, d gets those of the
 * unknowns. Reverse: d has the adjoints of the unknowns, right gets minus those of the residuals. */
void loop_tangent(const Loop *loop, const Variables *v, const bool holds[], double right[], Variables *d, double work[],
                  unsigned pivots[]);
void loop_adjoint(const Loop *loop, const Variables *v, const bool holds[], const Variables *d, double right[],
                  double work[], unsigned pivots[]);

/* If a loop has no solution at v, add to the message which. */
void loops_explain(const Variables *v, Message *why);

#if N_LOOPS > 0
extern const Loop *const model_loops[N_LOOPS];
#endif

#endif
