#include "brief_steps.h"

#include <math.h>
#include <string.h>

#include "error.h"
#include "events.h"

static const double BRIEF_SAFETY = 0.8;
static const double BRIEF_SHRINK = 0.2;

/* Where inputs change at every communication point, steps end there, short of the length that the control would choose.
 * Behind the first few they are made by a method that takes half of the work. Over that length the errors estimated may
 * add up to so many allowed ones: they are those of the embedded solution, and the one that goes on is much better.
 * Where one has been more, such steps are tried again when they may be a little longer each. */
static const double MOST_ERROR = 3.0;
static const double BRIEF_ORDER = 3.0; /* of the error over the step's share of that length */
static const double BRIEF_GROWTH = 1.02;
/* Up to this share of the length switching points are looked for at the end alone; Rodas5P's steps have four samples.
 */
static const double BRIEF_SAMPLE = 0.25;

/* One matrix serves for some steps, as long as the error is below this part of the one that may be: of what the matrix
 * is off by, which is of second order, twenty times as much is in the estimate as in the solution (0.283 to 0.0146, by
 * the coefficients). Where it has not served, fewer steps are made with the next one; slowly they become more again. */
static const double MATRIX_ERROR = 0.05;
static const double MOST_REACH = 16.0;
static const double MORE_REACH = 0.125;
static const double SAME_LENGTH = 1e-6;

/* Whether the step that has just been tried passes a switching point. */
static bool passes_event(const Integrator *m, Rodas *r, Variables *v, const bool holds[])
{
    Event event;
    if (N_RELATIONS == 0) {
        return false;
    }
    if (HAS_EVENTS || r->path.length > BRIEF_SAMPLE * m->length) {
        brief_bend(r);
        return events_find(r, v, holds, false, &event);
    }
    v->time = r->path.time + r->path.length;
    ramp_apply(r->ramp, v);
    memcpy(&v->at[FIRST_STATE], r->path.end, N_STATES * sizeof(double));
    return events_have_changed(v, holds);
}

/* A step of this length may do, as far as is known. */
static bool may_do(const Integrator *m, double length)
{
    return m->cuts >= BRIEF_CUTS && length <= m->length && !(m->brief > 0.0 && length > m->brief);
}

static double brief_weight(const Integrator *m, double length) { return m->length / (MOST_ERROR * length); }

/* The error that the last trial may have, or a part of it. */
static bool is_allowed(const Integrator *m, const Rodas *r, double tolerance, double part)
{
    return error_is_below(r, tolerance, brief_weight(m, r->path.length) / part);
}

bool brief_steps_again(Integrator *m, Rodas *r, Variables *v, const bool holds[], double length, double tolerance)
{
    BriefMatrix *matrix = &m->matrix;
    m->brief = m->brief < m->length ? BRIEF_GROWTH * m->brief : 0.0;
    const double steps = (r->path.time - matrix->time) / length; /* that have been made with it */
    if (!(fabs(length - matrix->length) <= SAME_LENGTH * length) || steps > floor(matrix->reach) + 0.5 ||
        (m->restart && m->behind <= 0.0) || !may_do(m, length)) {
        return false;
    }
    m->counters.evaluations += BRIEF_EVALUATIONS;
    if (brief_try(r, matrix, length, false, v, holds) == FINITE && is_allowed(m, r, tolerance, MATRIX_ERROR) &&
        !passes_event(m, r, v, holds)) {
        return true;
    }
    matrix->length = 0.0;
    matrix->reach = floor(steps - 0.5);
    rodas_back(r, v);
    (void)rodas_derivative(v, holds, r->derivative);
    m->counters.evaluations++;
    return false;
}

/* Not inlined: the other steps, which are most where inputs are constant, would take 2 % longer. */
NOT_INLINED bool brief_steps_afresh(Integrator *m, Rodas *r, Variables *v, const bool holds[], double length,
                                    double tolerance)
{
    BriefMatrix *matrix = &m->matrix;
    if (!may_do(m, length) || !brief_factorize(matrix, r, length)) {
        return false;
    }
    m->counters.evaluations += BRIEF_EVALUATIONS;
    const int not_finite = brief_try(r, matrix, length, true, v, holds);
    matrix->reach = fmin(MOST_REACH, matrix->reach + MORE_REACH);
    if (not_finite == FINITE && is_allowed(m, r, tolerance, 1.0)) {
        matrix->length = is_allowed(m, r, tolerance, MATRIX_ERROR) ? length : 0.0;
        const bool passes = passes_event(m, r, v, holds);
        m->counters.repeated += passes;
        return !passes;
    }
    matrix->length = 0.0;
    const double error = not_finite == FINITE ? brief_weight(m, length) * error_norm(r, tolerance) : (double)INFINITY;
    m->counters.rejected++;
    m->brief = length * fmax(BRIEF_SHRINK, BRIEF_SAFETY * pow(error, -1.0 / BRIEF_ORDER));
    return false;
}
