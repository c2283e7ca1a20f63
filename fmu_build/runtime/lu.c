#include "lu.h"

#include <math.h>

static int largest_in_column(const double a[], int column)
{
    int row = column;
    for (int i = column + 1; i < N_STATES; i++) {
        if (fabs(a[i * N_STATES + column]) > fabs(a[row * N_STATES + column])) {
            row = i;
        }
    }
    return row;
}

static void swap_rows(double a[], int i, int j)
{
    for (int k = 0; k < N_STATES; k++) {
        const double entry = a[i * N_STATES + k];
        a[i * N_STATES + k] = a[j * N_STATES + k];
        a[j * N_STATES + k] = entry;
    }
}

bool lu_factor(double a[], int pivot[])
{
    for (int k = 0; k < N_STATES; k++) {
        pivot[k] = largest_in_column(a, k);
        if (pivot[k] != k) {
            swap_rows(a, k, pivot[k]);
        }
        const double inverse = 1.0 / a[k * N_STATES + k];
        if (!isfinite(inverse) || inverse == 0.0) { /* also if the pivot is NaN or infinite */
            return false;
        }
        a[k * N_STATES + k] = inverse;
        for (int i = k + 1; i < N_STATES; i++) {
            const double factor = a[i * N_STATES + k] * inverse;
            a[i * N_STATES + k] = factor;
            for (int j = k + 1; j < N_STATES; j++) {
                a[i * N_STATES + j] -= factor * a[k * N_STATES + j];
            }
        }
    }
    return true;
}

void lu_solve(const double lu[], const int pivot[], double b[])
{
    for (int k = 0; k < N_STATES; k++) { /* whole rows were exchanged, factors included: permute first */
        const double entry = b[k];
        b[k] = b[pivot[k]];
        b[pivot[k]] = entry;
    }
    for (int i = 1; i < N_STATES; i++) {
        double sum = b[i];
        for (int j = 0; j < i; j++) {
            sum -= lu[i * N_STATES + j] * b[j];
        }
        b[i] = sum;
    }
    for (int i = N_STATES - 1; i >= 0; i--) {
        double sum = b[i];
        for (int j = i + 1; j < N_STATES; j++) {
            sum -= lu[i * N_STATES + j] * b[j];
        }
        b[i] = sum * lu[i * N_STATES + i];
    }
}
