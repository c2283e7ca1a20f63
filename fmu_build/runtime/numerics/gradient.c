#include "gradient.h"

#include <math.h>
#include <string.h>

/* How far beside a point, over nominal value and size: the cube root of rounding is best for a smooth function. */
static const double BESIDE = 6e-6;

typedef double Slopes[AT_LEAST_ONE(N_STATES)];

void gradient_by_time(const Ramp *ramp, const Variables *v, const bool holds[], double time_derivative[])
{
    Variables d = {.at = {0.0}};
    d.time = 1.0;
    ramp_rates(ramp, v, &d);
    model_input_tangent(v, holds, &d);
    memcpy(time_derivative, &d.at[FIRST_DERIVATIVE], N_STATES * sizeof(double));
}

static int first_bad(const double jacobian[], const double time_derivative[])
{
    const int entry = first_not_finite(jacobian, N_JACOBIAN);
    return entry != FINITE ? jacobian_row[entry] : first_not_finite(time_derivative, N_STATES);
}

/* The slopes of all derivatives with the state or the time at[index]. */
static void beside(const Ramp *ramp, Variables *v, const bool holds[], const double derivative[], int index,
                   double slope[])
{
    const double middle = v->at[index];
    const double step = BESIDE * (variable_info[index].nominal + fabs(middle));
    Slopes sides[2];
    for (int side = 0; side < 2; side++) {
        v->at[index] = side == 0 ? middle - step : middle + step;
        ramp_apply(ramp, v);
        model_derivatives(v, holds);
        memcpy(sides[side], &v->at[FIRST_DERIVATIVE], N_STATES * sizeof(double));
    }
    v->at[index] = middle;
    ramp_apply(ramp, v);
    model_derivatives(v, holds);
    for (int i = 0; i < N_STATES; i++) {
        const bool before = isfinite(sides[0][i]);
        const bool after = isfinite(sides[1][i]);
        const double rise = (after ? sides[1][i] : derivative[i]) - (before ? sides[0][i] : derivative[i]);
        slope[i] = before || after ? rise / (before && after ? 2.0 * step : step) : (double)NAN;
    }
}

/* Put what is beside in place of what is not finite. */
static void mend(const Ramp *ramp, Variables *v, const bool holds[], const double derivative[], double jacobian[],
                 double time_derivative[])
{
    Slopes slope;
    for (int j = 0; j < N_STATES; j++) {
        bool known = false;
        for (int e = 0; e < N_JACOBIAN; e++) {
            if (jacobian_column[e] == j && !isfinite(jacobian[e])) {
                if (!known) {
                    beside(ramp, v, holds, derivative, FIRST_STATE + j, slope);
                    known = true;
                }
                jacobian[e] = slope[jacobian_row[e]];
            }
        }
    }
    if (first_not_finite(time_derivative, N_STATES) != FINITE) {
        beside(ramp, v, holds, derivative, 0, slope);
        for (int i = 0; i < N_STATES; i++) {
            time_derivative[i] = isfinite(time_derivative[i]) ? time_derivative[i] : slope[i];
        }
    }
}

int gradient(const Ramp *ramp, Variables *v, const bool holds[], const double derivative[], double jacobian[],
             double time_derivative[])
{
    model_jacobian(v, holds, jacobian, time_derivative);
    if (ramp->moves) {
        gradient_by_time(ramp, v, holds, time_derivative);
    }
    if (first_bad(jacobian, time_derivative) == FINITE) {
        return FINITE;
    }
    mend(ramp, v, holds, derivative, jacobian, time_derivative);
    return first_bad(jacobian, time_derivative);
}
