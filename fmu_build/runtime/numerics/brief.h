/* A step that is brief beside what Rodas5P could make, by GRK4T: linearly implicit too, with three right-hand sides. */
#ifndef BRIEF_H
#define BRIEF_H

#include "rodas.h"

enum { BRIEF_EVALUATIONS = 2 }; /* beside that of the start */

/* Try a length from the start that rodas_start has fixed; as rodas_try. The error estimate, of the embedded solution of
 * order 3, goes with the fourth power of the length. */
int brief_try(Rodas *r, double length, Variables *v, const bool holds[]);

/* Prepare rodas_dense for the last trial: of order 2. */
void brief_bend(Rodas *r);

#endif
