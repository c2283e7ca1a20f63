/* A step that is brief beside what Rodas5P could make, by GRK4T: linearly implicit too, with three right-hand sides. */
#ifndef BRIEF_H
#define BRIEF_H

#include "rodas.h"

enum { BRIEF_EVALUATIONS = 2 }; /* beside that of the start */

/* That of one or more steps: I / (gamma length) - J as factors, and the derivatives by time. */
typedef struct {
    double length; /* of the steps that it is for; 0: there is none */
    double time;   /* where it has been made */
    double reach;  /* it serves for so many more steps, as far as is known */
    double factors[AT_LEAST_ONE(N_FACTORS)];
    Vector time_derivative;
    bool depends_on_time; /* they are not all zero */
} BriefMatrix;

/* Of the gradient in r. False: a pivot is zero, and there is no matrix. */
bool brief_factorize(BriefMatrix *matrix, const Rodas *r, double length);

/* Try a length from the start that rodas_start has fixed, with the matrix there or, if it is not new, of an earlier
 * step, which is an approximation: what that makes the error larger is in its estimate. Returns what rodas_try does.
 * The error estimate, of the embedded solution of order 3, goes with the fourth power of the length. */
int brief_try(Rodas *r, const BriefMatrix *matrix, double length, bool is_new, Variables *v, const bool holds[]);

/* Prepare rodas_dense for the last trial: of order 2. */
void brief_bend(Rodas *r);

#endif
