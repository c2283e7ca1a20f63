#include "rodas.h"

#include <math.h>
#include <string.h>

#include "lu.h"

/* The derivatives, which the model has just stored one by one. They are loaded one by one as well (volatile): compilers
 * would load them in pairs, for which processors wait until both stores have reached the cache. (6 % of a run.) */
static void take_derivatives(const Variables *v, double derivative[])
{
    const volatile double *stored = &v->at[FIRST_DERIVATIVE];
    for (int i = 0; i < N_STATES; i++) {
        derivative[i] = stored[i];
    }
}

int rodas_derivative(Variables *v, const bool holds[], double derivative[])
{
    model_derivatives(v, holds);
    take_derivatives(v, derivative);
    return first_not_finite(derivative, N_STATES);
}

int rodas_start(Rodas *r, Variables *v, const bool holds[], const Ramp *ramp, bool derived)
{
    r->ramp = ramp;
    r->path.time = v->time;
    memcpy(r->path.state, &v->at[FIRST_STATE], N_STATES * sizeof(double));
    if (!derived) {
        return rodas_derivative(v, holds, r->derivative);
    }
    take_derivatives(v, r->derivative);
    return first_not_finite(r->derivative, N_STATES);
}

void rodas_back(const Rodas *r, Variables *v)
{
    v->time = r->path.time;
    memcpy(&v->at[FIRST_STATE], r->path.state, N_STATES * sizeof(double));
    ramp_apply(r->ramp, v);
}

/* sum = sum over the stages before `stages` of weight[j] u[j] */
static void combine(double *restrict sum, const double *restrict weight, Vector u[restrict], int stages)
{
    Vector total = {0.0};
    for (int j = 0; j < stages; j++) {
        for (int i = 0; i < N_STATES; i++) {
            total[i] += weight[j] * u[j][i];
        }
    }
    memcpy(sum, total, N_STATES * sizeof(double));
}

/* f at a stage's argument. Each of the last arguments is the one before and one more u. */
static int stage_derivative(Rodas *r, int stage, Variables *v, const bool holds[], double f[])
{
    double *restrict argument = &v->at[FIRST_STATE];
    Vector increment;
    if (stage <= RODAS_STAGES - 3) {
        combine(increment, RODAS_A[stage], r->u, stage);
        for (int i = 0; i < N_STATES; i++) {
            argument[i] = r->path.state[i] + increment[i];
        }
    } else {
        for (int i = 0; i < N_STATES; i++) {
            argument[i] += r->u[stage - 1][i];
        }
    }
    v->time = r->path.time + RODAS_NODE[stage] * r->path.length;
    if (r->ramp->moves) {
        ramp_apply(r->ramp, v);
    }
    if (stage == 0) {
        memcpy(f, r->derivative, N_STATES * sizeof(double));
        return FINITE;
    }
    return rodas_derivative(v, holds, f);
}

int rodas_try(Rodas *r, double length, Variables *v, const bool holds[])
{
    Vector f;
    Vector right;
    Vector lost = {0.0}; /* by the solution of the first system */
    const double shift = 1.0 / (RODAS_GAMMA * length);
    r->path.length = length;
    if (!lu_factorize(r->jacobian, shift, r->factors)) {
        return 0;
    }
    const double per_length = 1.0 / length;
    for (int stage = 0; stage < RODAS_STAGES; stage++) {
        const double weight = RODAS_D[stage] * length;
        const int bad = stage_derivative(r, stage, v, holds, f);
        if (bad != FINITE) {
            return bad;
        }
        combine(right, RODAS_C[stage], r->u, stage);
        for (int i = 0; i < N_STATES; i++) {
            right[i] = f[i] + right[i] * per_length + weight * r->time_derivative[i];
        }
        lu_solve(r->factors, right, r->u[stage]);
        if (stage == 0) {
            lu_error(r->jacobian, shift, r->factors, right, r->u[0], lost);
        }
    }
    for (int i = 0; i < N_STATES; i++) { /* v still holds the argument of the last stage, the embedded solution */
        r->path.end[i] = v->at[FIRST_STATE + i] + r->u[RODAS_STAGES - 1][i];
        r->error[i] = fabs(r->u[RODAS_STAGES - 1][i]) + fabs(RODAS_A[RODAS_STAGES - 1][0] * lost[i]);
    }
    return first_not_finite(r->path.end, N_STATES);
}

void rodas_bend(Rodas *r)
{
    for (int l = 0; l < RODAS_DENSE; l++) {
        combine(r->path.bend[l], RODAS_BEND[l], r->u, RODAS_STAGES);
    }
}

void rodas_dense(const Path *restrict path, double fraction, double *restrict state)
{
    const double s = fraction;
    if (!(s < 1.0)) {
        memcpy(state, path->end, N_STATES * sizeof(double));
        return;
    }
    for (int i = 0; i < N_STATES; i++) {
        const double bend = path->bend[0][i] + s * (path->bend[1][i] + s * path->bend[2][i]);
        /* written as an increment, so that a short way from the start loses nothing to rounding */
        state[i] = path->state[i] + s * (path->end[i] - path->state[i] + (1.0 - s) * bend);
    }
}
