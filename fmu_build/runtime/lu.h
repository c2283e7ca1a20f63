/* Dense linear systems with as many unknowns as the model has states. */
#ifndef LU_H
#define LU_H

#include <stdbool.h>

#include "model.h"

/* a (row by row) becomes its LU factors, rows exchanged for the largest pivot; on the diagonal are the inverse pivots.
 * False: a is singular or not finite. */
bool lu_factor(double a[], int pivot[]);

/* b becomes the solution of a x = b; lu and pivot are what lu_factor left. */
void lu_solve(const double lu[], const int pivot[], double b[]);

#endif
