/* Is every number finite? */
#ifndef FINITE_H
#define FINITE_H

#include <math.h>

enum { FINITE = -1 }; /* otherwise: an index */

/* The index of the first number that is not finite. Zero times a number is zero, unless that is infinite or NaN; there
 * are eight sums because a processor adds to some while the others are still on the way. */
static inline int first_not_finite(const double a[], int n)
{
    double zero[8] = {0.0};
    double sum = 0.0;
    const int whole = n - n % 8;
    for (int i = 0; i < whole; i += 8) {
        for (int k = 0; k < 8; k++) {
            zero[k] += 0.0 * a[i + k];
        }
    }
    for (int i = whole; i < n; i++) {
        zero[i - whole] += 0.0 * a[i];
    }
    for (int k = 0; k < 8; k++) {
        sum += zero[k];
    }
    for (int i = 0; i < n && sum != 0.0; i++) {
        if (!isfinite(a[i])) {
            return i;
        }
    }
    return FINITE;
}

#endif
