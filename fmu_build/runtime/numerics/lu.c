#include "lu.h"

#include <math.h>
#include <string.h>

#if ELIMINATION_WRITTEN_OUT

static void factorize(const double jacobian[], double shift, double factors[])
{
    model_factorize(jacobian, shift, factors);
}

void lu_solve(const double factors[], const double b[], double x[]) { model_solve(factors, b, x); }

static void subtract_product(const double jacobian[], double shift, const double x[], double b[])
{
    model_subtract_product(jacobian, shift, x, b);
}

#else

static void fill_in(const double jacobian[], double shift, double factors[])
{
    for (int p = 0; p < N_FACTORS; p++) {
        factors[p] = 0.0;
    }
    for (int e = 0; e < N_JACOBIAN; e++) {
        factors[jacobian_factor[e]] = -jacobian[e];
    }
    for (int i = 0; i < N_STATES; i++) {
        factors[pivot_factor[i]] += shift;
    }
}

/* Row by row; each in turn is spread out, so that its places are found by their column. */
static void factorize(const double jacobian[], double shift, double factors[])
{
    double row[N_STATES] = {0.0};
    fill_in(jacobian, shift, factors);
    for (int i = 0; i < N_STATES; i++) {
        const int pivot = pivot_factor[i];
        for (int p = first_factor[i]; p < first_factor[i + 1]; p++) {
            row[factor_column[p]] = factors[p];
        }
        for (int p = first_factor[i]; p < pivot; p++) {
            const int k = factor_column[p];
            for (int q = pivot_factor[k] + 1; q < first_factor[k + 1]; q++) {
                row[factor_column[q]] -= row[k] * factors[q];
            }
        }
        factors[pivot] = 1.0 / row[i];
        for (int p = first_factor[i]; p < pivot; p++) {
            factors[p] = row[factor_column[p]] * factors[pivot_factor[factor_column[p]]];
        }
        for (int p = pivot + 1; p < first_factor[i + 1]; p++) {
            factors[p] = row[factor_column[p]] * factors[pivot];
        }
    }
}

void lu_solve(const double factors[], const double b[], double x[])
{
    double y[N_STATES] = {0.0};
    for (int i = 0; i < N_STATES; i++) {
        double sum = b[pivot_state[i]];
        for (int p = first_factor[i]; p < pivot_factor[i]; p++) {
            sum -= factors[p] * y[factor_column[p]];
        }
        y[i] = sum;
    }
    for (int i = N_STATES - 1; i >= 0; i--) {
        double sum = y[i] * factors[pivot_factor[i]];
        for (int p = first_factor[i + 1] - 1; p > pivot_factor[i]; p--) {
            sum -= factors[p] * y[factor_column[p]];
        }
        x[pivot_state[i]] = y[i] = sum;
    }
}

/* b -= (shift I - J) x */
static void subtract_product(const double jacobian[], double shift, const double x[], double b[])
{
    for (int i = 0; i < N_STATES; i++) {
        b[i] -= shift * x[i];
    }
    for (int e = 0; e < N_JACOBIAN; e++) {
        b[jacobian_row[e]] += jacobian[e] * x[jacobian_column[e]];
    }
}

#endif

bool lu_factorize(const double jacobian[], double shift, double factors[])
{
    factorize(jacobian, shift, factors);
    for (int i = 0; i < N_STATES; i++) {
        const double inverse_pivot = factors[pivot_factor[i]];
        if (!isfinite(inverse_pivot) || inverse_pivot == 0.0) { /* also if the pivot is NaN or infinite */
            return false;
        }
    }
    return true;
}

void lu_error(const double jacobian[], double shift, const double factors[], const double b[], const double x[],
              double error[])
{
    double residual[AT_LEAST_ONE(N_STATES)];
    memcpy(residual, b, N_STATES * sizeof(double));
    subtract_product(jacobian, shift, x, residual);
    lu_solve(factors, residual, error);
}
