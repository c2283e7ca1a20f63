/* The inverse of a matrix with as many rows as the model has states.
 *
 * A step solves eight systems with one matrix, each waiting for the solution of the one before. Substitution is a chain
 * of operations that wait for each other; a product with the inverse is not, and for few states takes a quarter of the
 * time, which pays for the inversion. */
#ifndef INVERSE_H
#define INVERSE_H

#include <stdbool.h>

#include "model.h"

/* a (column by column) becomes its inverse: Gauss-Jordan elimination, rows exchanged for the largest pivot. False: a is
 * singular or not finite. */
bool inverse_make(double a[]);

/* x = a b */
void inverse_apply(const double a[], const double b[], double x[]);

#endif
