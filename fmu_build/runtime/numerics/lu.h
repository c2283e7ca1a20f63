/* The matrix s I - J of the model's Jacobian J as a product L D U of sparse triangular matrices.
 *
 * Pivots come from the diagonal, in the order that the generator has chosen: where the factors are not zero is known
 * when the model is built. Nothing is exchanged for the sake of size. Where s is large nothing has to be, as the
 * diagonal prevails; otherwise factors may grow, and digits be lost. lu_error tells how many. */
#ifndef LU_H
#define LU_H

#include <stdbool.h>

#include "model.h"

/* The factors of shift I - J: D inverted on the diagonal; on those of L and U, which is not stored, there are ones.
 * False: a pivot is zero or not finite. */
bool lu_factorize(const double jacobian[], double shift, double factors[]);

/* (shift I - J) x = b; x and b do not overlap. */
void lu_solve(const double factors[], const double b[], double x[]);

/* The error of a solution x, to its leading digits: the solution for its residual. */
void lu_error(const double jacobian[], double shift, const double factors[], const double b[], const double x[],
              double error[]);

#endif
