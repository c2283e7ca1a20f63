#include "brief.h"

#include <math.h>
#include <string.h>

#include "gradient.h"
#include "grk4t.h"
#include "lu.h"

/* f at the argument of a stage behind the first. */
static void brief_derivative(const Rodas *r, int stage, Variables *v, const bool holds[], double f[])
{
    double *restrict argument = &v->at[FIRST_STATE];
    const double *a = GRK4T_A[stage];
    for (int i = 0; i < N_STATES; i++) {
        const double second = stage > 1 ? a[1] * r->u[1][i] : 0.0;
        argument[i] = r->path.state[i] + (a[0] * r->u[0][i] + second);
    }
    v->time = r->path.time + GRK4T_NODE[stage] * r->path.length;
    ramp_apply(r->ramp, v);
    (void)rodas_derivative(v, holds, f); /* what is not finite shows at the end */
}

/* u of a stage, from f there. */
static void brief_solve(Rodas *r, const BriefMatrix *matrix, int stage, const double f[], double right[])
{
    const double per_length = 1.0 / r->path.length;
    const double weight = GRK4T_D[stage] * r->path.length;
    const double *by_time = r->ramp->moves ? r->time_derivative : matrix->time_derivative;
    Vector sum = {0.0};
    for (int j = 0; j < stage; j++) {
        for (int i = 0; i < N_STATES; i++) {
            sum[i] += GRK4T_C[stage][j] * r->u[j][i];
        }
    }
    for (int i = 0; i < N_STATES; i++) {
        right[i] = f[i] + sum[i] * per_length;
    }
    for (int i = 0; i < N_STATES && (r->ramp->moves || matrix->depends_on_time); i++) {
        right[i] += weight * by_time[i];
    }
    lu_solve(matrix->factors, right, r->u[stage]);
}

/* The end and its error; what the solution of the first system has lost is part of it. */
static void brief_finish(Rodas *r, const double lost[])
{
    Vector way = {0.0};
    Vector error = {0.0};
    for (int j = 0; j < GRK4T_STAGES; j++) {
        for (int i = 0; i < N_STATES; i++) {
            way[i] += GRK4T_WEIGHT[j] * r->u[j][i];
            error[i] += GRK4T_ERROR[j] * r->u[j][i];
        }
    }
    for (int i = 0; i < N_STATES; i++) {
        r->path.end[i] = r->path.state[i] + way[i];
        r->error[i] = fabs(error[i]) + fabs(GRK4T_WEIGHT[0] * lost[i]);
    }
}

bool brief_factorize(BriefMatrix *matrix, const Rodas *r, double length)
{
    const bool is_regular = lu_factorize(r->jacobian, 1.0 / (GRK4T_GAMMA * length), matrix->factors);
    if (!is_regular) {
        memset(matrix->factors, 0, sizeof matrix->factors); /* a saved state bears finite numbers alone */
    }
    matrix->length = is_regular ? length : 0.0;
    matrix->time = r->path.time;
    matrix->depends_on_time = false;
    for (int i = 0; i < N_STATES; i++) {
        matrix->time_derivative[i] = r->time_derivative[i];
        matrix->depends_on_time |= r->time_derivative[i] != 0.0;
    }
    return is_regular;
}

int brief_try(Rodas *r, const BriefMatrix *matrix, double length, bool is_new, Variables *v, const bool holds[])
{
    Vector f;
    Vector right;
    Vector lost = {0.0}; /* by the solution of the first system; with an earlier matrix not known */
    r->path.length = length;
    if (!is_new && r->ramp->moves) {
        gradient_by_time(r->ramp, v, holds, r->time_derivative);
    }
    brief_solve(r, matrix, 0, r->derivative, right);
    if (is_new) {
        lu_error(r->jacobian, 1.0 / (GRK4T_GAMMA * length), matrix->factors, right, r->u[0], lost);
    }
    for (int stage = 1; stage < GRK4T_ARGUMENTS; stage++) {
        brief_derivative(r, stage, v, holds, f);
        brief_solve(r, matrix, stage, f, right);
    }
    brief_solve(r, matrix, GRK4T_STAGES - 1, f, right);
    brief_finish(r, lost);
    return first_not_finite(r->path.end, N_STATES);
}

void brief_bend(Rodas *r)
{
    memset(r->path.bend, 0, sizeof r->path.bend);
    for (int i = 0; i < N_STATES; i++) {
        r->path.bend[0][i] = r->path.length * r->derivative[i] - (r->path.end[i] - r->path.state[i]);
    }
}
