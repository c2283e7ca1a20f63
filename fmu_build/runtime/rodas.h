/* One step of Rodas5P: linearly implicit, with the exact Jacobian, an error estimate and dense output. */
#ifndef RODAS_H
#define RODAS_H

#include "model.h"
#include "rodas5p.h"

typedef struct {
    /* Where the step starts */
    double time;
    double state[AT_LEAST_ONE(N_STATES)];
    double derivative[AT_LEAST_ONE(N_STATES)];
    double jacobian[AT_LEAST_ONE(N_STATES * N_STATES)];
    double time_derivative[AT_LEAST_ONE(N_STATES)];
    /* What the last trial of a length gave */
    double length;
    double end[AT_LEAST_ONE(N_STATES)];   /* state at time + length */
    double error[AT_LEAST_ONE(N_STATES)]; /* its estimated error */
    double dense[RODAS_DENSE][AT_LEAST_ONE(N_STATES)];
} Rodas;

enum { FINITE = -1 }; /* otherwise: the index of the first state whose derivative, or whose value, is not finite */

/* Fix the start of a step at the time and the states in v: evaluates the derivatives and the Jacobian there, once for
 * all trials of the step. Returns FINITE or an index. */
int rodas_start(Rodas *r, Variables *v, const bool holds[]);

/* Try a length. v serves as working space (its inputs and parameters are read). Returns FINITE or an index. */
int rodas_try(Rodas *r, double length, Variables *v, const bool holds[]);

/* The states at time + fraction * length of the last trial, 0 <= fraction <= 1. */
void rodas_dense(const Rodas *r, double fraction, double state[]);

#endif
