/* One step of Rodas5P: linearly implicit, with the exact Jacobian, an error estimate and dense output. */
#ifndef RODAS_H
#define RODAS_H

#include "finite.h"
#include "model.h"
#include "ramp.h"
#include "rodas5p.h"

typedef double Vector[AT_LEAST_ONE(N_STATES)];

/* The states over a step. */
typedef struct {
    double time; /* where it starts */
    double length;
    Vector state;             /* at its start */
    Vector end;               /* at time + length */
    Vector bend[RODAS_DENSE]; /* after rodas_bend */
} Path;

typedef struct {
    Path path; /* its start is that of the step, the rest what the last trial of a length gave */
    /* At the start */
    const Ramp *ramp;
    Vector derivative;
    double jacobian[AT_LEAST_ONE(N_JACOBIAN)];
    Vector time_derivative;
    /* Of the last trial */
    double factors[AT_LEAST_ONE(N_FACTORS)]; /* of I / (gamma length) - J */
    Vector error;                            /* estimated: of the method, and of the linear algebra */
    Vector u[RODAS_STAGES];
} Rodas;

/* The derivatives at the point in v. Returns FINITE, or the index of the first one that is not finite. */
int rodas_derivative(Variables *v, const bool holds[], double derivative[]);

/* Fix the start of a step at the time and the states in v: evaluates the derivatives there, if v does not bear them
 * already, once for all trials of the step, which need the gradient too. The ramp, which moves the inputs, has to live
 * as long. Returns FINITE, or the index of the first state whose derivative is not finite. */
int rodas_start(Rodas *r, Variables *v, const bool holds[], const Ramp *ramp, bool derived);

/* v back to the start of the step. */
void rodas_back(const Rodas *r, Variables *v);

/* Try a length. v serves as working space (its inputs and parameters are read). Returns FINITE, or the index of the
 * first state whose derivative, or whose value, is not finite. */
int rodas_try(Rodas *r, double length, Variables *v, const bool holds[]);

/* Prepare rodas_dense for the last trial. */
void rodas_bend(Rodas *r);

/* The states at time + fraction * length, 0 <= fraction <= 1: dense output, of order 4. They lie elsewhere than the
 * path. */
void rodas_dense(const Path *restrict path, double fraction, double *restrict state);

#endif
