/* Is every number finite? */
#ifndef FINITE_H
#define FINITE_H

#include <math.h>

enum { FINITE = -1 }; /* otherwise: an index */

/* The index of the first number that is not finite. Of such numbers the sum is not finite either, whatever the others
 * are; if that of large ones overflows, each is looked at. There are eight sums because a processor adds to some while
 * the others are still on the way. */
static inline int first_not_finite(const double a[], int n)
{
    double sums[8] = {0.0};
    const int whole = n - n % 8;
    for (int i = 0; i < whole; i += 8) {
        for (int k = 0; k < 8; k++) {
            sums[k] += a[i + k];
        }
    }
    for (int i = whole; i < n; i++) {
        sums[i - whole] += a[i];
    }
    for (int half = 4; half > 0; half /= 2) {
        for (int k = 0; k < half; k++) {
            sums[k] += sums[k + half];
        }
    }
    for (int i = 0; i < n && !isfinite(sums[0]); i++) {
        if (!isfinite(a[i])) {
            return i;
        }
    }
    return FINITE;
}

#endif
