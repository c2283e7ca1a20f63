#include "inverse.h"

#include <math.h>
#include <string.h>

static int largest_in_column(const double a[], int column)
{
    int row = column;
    double largest = fabs(a[column * N_STATES + column]);
    for (int i = column + 1; i < N_STATES; i++) {
        const double entry = fabs(a[i * N_STATES + column]);
        if (entry > largest) {
            largest = entry;
            row = i;
        }
    }
    return row;
}

static void swap_rows(double *a, int i, int j)
{
    for (int k = 0; k < N_STATES; k++) {
        const double entry = a[i * N_STATES + k];
        a[i * N_STATES + k] = a[j * N_STATES + k];
        a[j * N_STATES + k] = entry;
    }
}

static void swap_columns(double *a, int i, int j)
{
    for (int k = 0; k < N_STATES; k++) {
        const double entry = a[k * N_STATES + i];
        a[k * N_STATES + i] = a[k * N_STATES + j];
        a[k * N_STATES + j] = entry;
    }
}

/* With the row of the pivot divided by it, put zeros above and below it; the places that become free take the inverse.
 */
static void eliminate(double *restrict a, int k, double inverse_pivot)
{
    double row[AT_LEAST_ONE(N_STATES)];
    a[k * N_STATES + k] = 1.0;
    for (int j = 0; j < N_STATES; j++) {
        row[j] = a[k * N_STATES + j] * inverse_pivot;
        a[k * N_STATES + j] = row[j];
    }
    for (int i = 0; i < N_STATES; i++) {
        const double factor = a[i * N_STATES + k];
        if (i == k || factor == 0.0) { /* many are: few states act on many others */
            continue;
        }
        a[i * N_STATES + k] = 0.0;
        for (int j = 0; j < N_STATES; j++) {
            a[i * N_STATES + j] -= factor * row[j];
        }
    }
}

bool inverse_make(double a[])
{
    int exchanged[AT_LEAST_ONE(N_STATES)];
    for (int k = 0; k < N_STATES; k++) {
        exchanged[k] = largest_in_column(a, k);
        if (exchanged[k] != k) {
            swap_rows(a, k, exchanged[k]);
        }
        const double inverse_pivot = 1.0 / a[k * N_STATES + k];
        if (!isfinite(inverse_pivot) || inverse_pivot == 0.0) { /* also if the pivot is NaN or infinite */
            return false;
        }
        eliminate(a, k, inverse_pivot);
    }
    for (int k = N_STATES - 1; k >= 0; k--) {
        if (exchanged[k] != k) {
            swap_columns(a, k, exchanged[k]);
        }
    }
    return true;
}

void inverse_apply(const double *restrict a, const double *restrict b, double *restrict x)
{
    double sum[AT_LEAST_ONE(N_STATES)] = {0.0};
    for (int j = 0; j < N_STATES; j++) {
        for (int i = 0; i < N_STATES; i++) {
            sum[i] += a[j * N_STATES + i] * b[j];
        }
    }
    memcpy(x, sum, N_STATES * sizeof(double));
}
