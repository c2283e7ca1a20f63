#include "loops.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Newton's method. A step smaller than this, relative to the unknowns, is the last one: the error that it leaves is
 * about its square. */
static const double LAST_STEP = 1e-9;
static const double SHORTEST_DAMPING = 1e-9;
enum { MAX_NEWTON_STEPS = 200 };

/* Where the first search begins, in nominal values from the start values, if these lead nowhere: often the slopes are
 * zero there, as those of x^2 = 1 are at 0. */
static const double OFFSETS[] = {0.0, 1.0, -1.0, 0.1, -0.1, 10.0, -10.0};
enum { N_OFFSETS = sizeof OFFSETS / sizeof OFFSETS[0] };

/* A pivot below this share of its row's largest element is rounding. */
static const double SINGULAR = 4.0 * DBL_EPSILON;

/* LU factors in place, row by row, rows scaled by their largest element and exchanged. False: singular. The scales go
 * behind the matrix. */
static bool factor(unsigned n, double a[], unsigned pivots[])
{
    double *scale = a + n * n;
    for (unsigned i = 0; i < n; i++) {
        scale[i] = 0.0;
        for (unsigned j = 0; j < n; j++) {
            scale[i] = fmax(scale[i], fabs(a[i * n + j]));
        }
    }
    for (unsigned k = 0; k < n; k++) {
        unsigned best = k;
        for (unsigned i = k + 1; i < n; i++) {
            if (fabs(a[i * n + k]) * scale[best] > fabs(a[best * n + k]) * scale[i]) {
                best = i;
            }
        }
        pivots[k] = best;
        if (best != k) {
            for (unsigned j = 0; j < n; j++) {
                const double kept = a[k * n + j];
                a[k * n + j] = a[best * n + j];
                a[best * n + j] = kept;
            }
            scale[best] = scale[k];
        }
        const double pivot = a[k * n + k];
        if (!isfinite(pivot) || fabs(pivot) <= SINGULAR * scale[k]) {
            return false;
        }
        for (unsigned i = k + 1; i < n; i++) {
            const double share = a[i * n + k] / pivot;
            a[i * n + k] = share;
            for (unsigned j = k + 1; share != 0.0 && j < n; j++) {
                a[i * n + j] -= share * a[k * n + j];
            }
        }
    }
    return true;
}

static void back(unsigned n, const double a[], const unsigned pivots[], double b[])
{
    for (unsigned k = 0; k < n; k++) {
        const double kept = b[pivots[k]];
        b[pivots[k]] = b[k];
        b[k] = kept;
    }
    for (unsigned i = 1; i < n; i++) {
        for (unsigned j = 0; j < i; j++) {
            b[i] -= a[i * n + j] * b[j];
        }
    }
    for (unsigned i = n; i-- > 0;) {
        for (unsigned j = i + 1; j < n; j++) {
            b[i] -= a[i * n + j] * b[j];
        }
        b[i] /= a[i * n + i];
    }
}

/* The same with the transposed matrix. */
static void back_transposed(unsigned n, const double a[], const unsigned pivots[], double b[])
{
    for (unsigned i = 0; i < n; i++) {
        for (unsigned j = 0; j < i; j++) {
            b[i] -= a[j * n + i] * b[j];
        }
        b[i] /= a[i * n + i];
    }
    for (unsigned i = n; i-- > 0;) {
        for (unsigned j = i + 1; j < n; j++) {
            b[i] -= a[j * n + i] * b[j];
        }
    }
    for (unsigned k = n; k-- > 0;) {
        const double kept = b[pivots[k]];
        b[pivots[k]] = b[k];
        b[k] = kept;
    }
}

static bool make_factors(const Loop *loop, const Variables *v, const bool holds[], double a[], unsigned pivots[])
{
    memset(a, 0, loop->size * loop->size * sizeof a[0]);
    loop->slopes(v, holds, a);
    return factor(loop->size, a, pivots);
}

void loop_factor(const Loop *loop, const Variables *v, const bool holds[], double work[], unsigned pivots[])
{
    if (!make_factors(loop, v, holds, work, pivots)) {
        for (unsigned i = 0; i < loop->size * loop->size; i++) {
            work[i] = (double)NAN;
        }
        memset(pivots, 0, loop->size * sizeof pivots[0]);
    }
}

void loop_back(const Loop *loop, const double work[], const unsigned pivots[], double right[])
{
    back(loop->size, work, pivots, right);
}

void loop_tangent(const Loop *loop, const Variables *v, const bool holds[], double right[], Variables *d, double work[],
                  unsigned pivots[])
{
    loop_factor(loop, v, holds, work, pivots);
    back(loop->size, work, pivots, right);
    for (unsigned i = 0; i < loop->size; i++) {
        d->at[loop->unknowns[i]] = right[i];
    }
}

void loop_adjoint(const Loop *loop, const Variables *v, const bool holds[], const Variables *d, double right[],
                  double work[], unsigned pivots[])
{
    loop_factor(loop, v, holds, work, pivots);
    for (unsigned i = 0; i < loop->size; i++) {
        right[i] = d->at[loop->unknowns[i]];
    }
    back_transposed(loop->size, work, pivots, right);
}

static void fill(const Loop *loop, Variables *v, double value)
{
    for (unsigned i = 0; i < loop->size; i++) {
        v->at[loop->unknowns[i]] = value;
    }
}

static void solve_linear(const Loop *loop, Variables *v, const bool holds[], double work[], unsigned pivots[])
{
    double *right = work + loop->size * (loop->size + 1);
    if (!make_factors(loop, v, holds, work, pivots)) {
        fill(loop, v, (double)NAN);
        return;
    }
    loop->residuals(v, holds, right);
    back(loop->size, work, pivots, right);
    for (unsigned i = 0; i < loop->size; i++) {
        v->at[loop->unknowns[i]] = -right[i];
    }
}

/* From the residuals of the iterated unknowns at v, the step that would make them zero; its size, relative to the
 * unknowns; NaN where something is not finite. */
static double newton_step(const Loop *loop, Variables *v, const bool holds[], const double a[], const unsigned pivots[],
                          double result[])
{
    double size = 0.0;
    memset(result, 0, loop->size * sizeof result[0]);
    loop->residuals(v, holds, result);
    back(loop->size, a, pivots, result);
    for (unsigned i = 0; i < loop->n_iterated; i++) {
        const unsigned u = loop->unknowns[i];
        const double part = fabs(result[i]) / (variable_info[u].nominal + fabs(v->at[u]));
        if (!isfinite(part)) {
            return (double)NAN;
        }
        size = fmax(size, part);
    }
    return size;
}

/* Go along a step, from `from`, as far as the next step would be shorter (the natural monotonicity test of Deuflhard,
 * Newton Methods for Nonlinear Problems, section 3.3: it does not depend on how the residuals are scaled). */
static bool damped_step(const Loop *loop, Variables *v, const bool holds[], const double a[], const unsigned pivots[],
                        const double from[], const double along[], double size, double next[])
{
    for (double damping = 1.0; damping >= SHORTEST_DAMPING; damping *= 0.5) {
        for (unsigned i = 0; i < loop->n_iterated; i++) {
            v->at[loop->unknowns[i]] = from[i] - damping * along[i];
        }
        const double next_size = newton_step(loop, v, holds, a, pivots, next);
        if (next_size <= (1.0 - 0.25 * damping) * size || (size <= LAST_STEP && isfinite(next_size))) {
            return true;
        }
    }
    return false;
}

static bool newton(const Loop *loop, Variables *v, const bool holds[], double work[], unsigned pivots[])
{
    const unsigned n = loop->size;
    double *from = work + n * (n + 1);
    double *along = from + n;
    double *next = along + n;
    memset(along, 0, n * sizeof along[0]);
    loop->residuals(v, holds, along); /* the explicit unknowns, for the slopes */
    for (int i = 0; i < MAX_NEWTON_STEPS; i++) {
        if (!make_factors(loop, v, holds, work, pivots)) {
            return false;
        }
        const double size = newton_step(loop, v, holds, work, pivots, along);
        for (unsigned j = 0; j < loop->n_iterated; j++) {
            from[j] = v->at[loop->unknowns[j]];
        }
        if (!isfinite(size) || !damped_step(loop, v, holds, work, pivots, from, along, size, next)) {
            return false;
        }
        if (size <= LAST_STEP) {
            return true;
        }
    }
    return false;
}

static bool search(const Loop *loop, Variables *v, const bool holds[], double work[], unsigned pivots[])
{
    if (!newton(loop, v, holds, work, pivots)) {
        return false;
    }
    for (unsigned i = 0; i < loop->n_iterated; i++) {
        v->at[loop->guesses[i]] = v->at[loop->unknowns[i]];
    }
    return true;
}

void loop_solve(const Loop *loop, Variables *v, const bool holds[], double work[], unsigned pivots[])
{
    if (loop->linear) {
        solve_linear(loop, v, holds, work, pivots);
        return;
    }
    bool is_first = true;
    for (unsigned i = 0; i < loop->n_iterated; i++) {
        const unsigned guess = loop->guesses[i];
        is_first = is_first && v->at[guess] == variable_info[guess].start;
        v->at[loop->unknowns[i]] = v->at[guess];
    }
    bool found = search(loop, v, holds, work, pivots);
    for (int attempt = is_first ? 1 : 0; !found && attempt < (is_first ? N_OFFSETS : 1); attempt++) {
        for (unsigned i = 0; i < loop->n_iterated; i++) {
            const unsigned u = loop->unknowns[i];
            const double share = OFFSETS[attempt] * (1.0 + (double)i / loop->n_iterated); /* no two the same */
            v->at[u] = variable_info[loop->guesses[i]].start + share * variable_info[u].nominal;
        }
        found = search(loop, v, holds, work, pivots);
    }
    if (!found) {
        fill(loop, v, (double)NAN);
    }
}

#if N_LOOPS > 0

void loops_explain(const Variables *v, Message *why)
{
    for (int i = 0; i < N_LOOPS; i++) {
        if (isnan(v->at[model_loops[i]->unknowns[0]])) {
            message_append(why, "; no solution was found of the %s equations of %s",
                           model_loops[i]->linear ? "linear" : "nonlinear", model_loops[i]->text);
            return;
        }
    }
}

#else

void loops_explain(const Variables *v, Message *why)
{
    (void)v;
    (void)why;
}

#endif
