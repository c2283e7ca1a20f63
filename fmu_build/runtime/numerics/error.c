#include "error.h"

#include <math.h>

double error_allowed(int state, double value, double tolerance)
{
    return tolerance * (variable_info[FIRST_STATE + state].nominal + fabs(value));
}

/* Of two numbers; fmax, which thinks of NaN, is a call. */
static double larger(double a, double b) { return a > b ? a : b; }

static double allowed_over_step(const Rodas *r, int state, double tolerance)
{
    return error_allowed(state, larger(fabs(r->path.state[state]), fabs(r->path.end[state])), tolerance);
}

static double relative_error(const Rodas *r, int state, double tolerance)
{
    return fabs(r->error[state]) / allowed_over_step(r, state, tolerance);
}

double error_norm(const Rodas *r, double tolerance)
{
    double norm = 0.0;
    for (int i = 0; i < N_STATES; i++) {
        norm = larger(relative_error(r, i, tolerance), norm);
    }
    return norm;
}

bool error_is_below(const Rodas *r, double tolerance, double weight)
{
    bool is_below = true;
    for (int i = 0; i < N_STATES; i++) {
        is_below &= weight * fabs(r->error[i]) <= allowed_over_step(r, i, tolerance);
    }
    return is_below;
}

int error_worst_state(const Rodas *r, double tolerance)
{
    int worst = 0;
    for (int i = 1; i < N_STATES; i++) {
        worst = relative_error(r, i, tolerance) > relative_error(r, worst, tolerance) ? i : worst;
    }
    return worst;
}

int error_fastest_state(const Rodas *r, double tolerance)
{
    int fastest = 0;
    double most = 0.0;
    for (int i = 0; i < N_STATES; i++) {
        const double speed = fabs(r->derivative[i]) / error_allowed(i, r->path.state[i], tolerance);
        fastest = speed > most ? i : fastest;
        most = larger(speed, most);
    }
    return fastest;
}
