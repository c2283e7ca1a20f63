/* Steps that end at their target, far below the length that the error control would choose, by the brief method. */
#ifndef BRIEF_STEPS_H
#define BRIEF_STEPS_H

#include "integrator.h"

enum { BRIEF_CUTS = 2 }; /* behind so many steps that were cut short */

/* A step of this length from the start that rodas_start has fixed, with the matrix of an earlier one. False: it will
 * not do, or there is an event; v is as rodas_start has left it. */
bool brief_steps_again(Integrator *m, Rodas *r, Variables *v, const bool holds[], double length, double tolerance);

/* The same with the matrix there, of the gradient in r. */
bool brief_steps_afresh(Integrator *m, Rodas *r, Variables *v, const bool holds[], double length, double tolerance);

#endif
