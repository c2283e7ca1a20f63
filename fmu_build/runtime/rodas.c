#include "rodas.h"

#include <math.h>
#include <string.h>

#include "lu.h"

typedef double Stages[RODAS_STAGES][AT_LEAST_ONE(N_STATES)];

static int first_not_finite(const double a[])
{
    for (int i = 0; i < N_STATES; i++) {
        if (!isfinite(a[i])) {
            return i;
        }
    }
    return FINITE;
}

int rodas_start(Rodas *r, Variables *v, const bool holds[])
{
    r->time = v->time;
    for (int i = 0; i < N_STATES; i++) {
        r->state[i] = v->at[FIRST_STATE + i];
    }
    model_derivatives(v, holds);
    for (int i = 0; i < N_STATES; i++) {
        r->derivative[i] = v->at[FIRST_DERIVATIVE + i];
    }
    model_jacobian(v, holds, r->jacobian, r->time_derivative);
    const int bad = first_not_finite(r->derivative);
    if (bad != FINITE) {
        return bad;
    }
    for (int i = 0; i < N_STATES; i++) {
        double sum = r->time_derivative[i];
        for (int j = 0; j < N_STATES; j++) {
            sum += r->jacobian[i * N_STATES + j];
        }
        if (!isfinite(sum)) {
            return i;
        }
    }
    return FINITE;
}

/* sum = sum over the stages before `stage` of weight[j] u[j] */
static void combine(double sum[], const double weight[], double u[][AT_LEAST_ONE(N_STATES)], int stages)
{
    for (int i = 0; i < N_STATES; i++) {
        sum[i] = 0.0;
    }
    for (int j = 0; j < stages; j++) {
        for (int i = 0; i < N_STATES; i++) {
            sum[i] += weight[j] * u[j][i];
        }
    }
}

/* f at a stage's argument, into the derivatives in v */
static int stage_derivative(const Rodas *r, int stage, double u[][AT_LEAST_ONE(N_STATES)], Variables *v,
                            const bool holds[])
{
    double increment[AT_LEAST_ONE(N_STATES)];
    combine(increment, RODAS_A[stage], u, stage);
    v->time = r->time + RODAS_NODE[stage] * r->length;
    for (int i = 0; i < N_STATES; i++) {
        v->at[FIRST_STATE + i] = r->state[i] + increment[i];
    }
    if (stage == 0) {
        memcpy(&v->at[FIRST_DERIVATIVE], r->derivative, N_STATES * sizeof(double));
    } else {
        model_derivatives(v, holds);
    }
    return first_not_finite(&v->at[FIRST_DERIVATIVE]);
}

static bool factor_matrix(const Rodas *r, double lu[], int pivot[])
{
    for (int i = 0; i < N_STATES * N_STATES; i++) {
        lu[i] = -r->jacobian[i];
    }
    for (int i = 0; i < N_STATES; i++) {
        lu[i * N_STATES + i] += 1.0 / (RODAS_GAMMA * r->length);
    }
    return lu_factor(lu, pivot);
}

int rodas_try(Rodas *r, double length, Variables *v, const bool holds[])
{
    Stages u;
    double lu[AT_LEAST_ONE(N_STATES * N_STATES)];
    int pivot[AT_LEAST_ONE(N_STATES)];
    r->length = length;
    if (!factor_matrix(r, lu, pivot)) {
        return 0;
    }
    for (int stage = 0; stage < RODAS_STAGES; stage++) {
        const int bad = stage_derivative(r, stage, u, v, holds);
        if (bad != FINITE) {
            return bad;
        }
        combine(u[stage], RODAS_C[stage], u, stage);
        for (int i = 0; i < N_STATES; i++) {
            u[stage][i] =
                v->at[FIRST_DERIVATIVE + i] + u[stage][i] / length + RODAS_D[stage] * length * r->time_derivative[i];
        }
        lu_solve(lu, pivot, u[stage]);
    }
    for (int i = 0; i < N_STATES; i++) { /* v still holds the argument of the last stage, the embedded solution */
        r->error[i] = u[RODAS_STAGES - 1][i];
        r->end[i] = v->at[FIRST_STATE + i] + r->error[i];
    }
    for (int l = 0; l < RODAS_DENSE; l++) {
        combine(r->dense[l], RODAS_BEND[l], u, RODAS_STAGES);
    }
    return first_not_finite(r->end);
}

void rodas_dense(const Rodas *r, double fraction, double state[])
{
    const double s = fraction;
    for (int i = 0; i < N_STATES; i++) {
        const double bend = r->dense[0][i] + s * (r->dense[1][i] + s * r->dense[2][i]);
        /* written as an increment, so that a short way from the start loses nothing to rounding */
        state[i] = s < 1.0 ? r->state[i] + s * (r->end[i] - r->state[i] + (1.0 - s) * bend) : r->end[i];
    }
}
