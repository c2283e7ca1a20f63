#include "integrator.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "brief_steps.h"
#include "error.h"
#include "events.h"
#include "gradient.h"
#include "loops.h"

/* The error estimate, of the embedded solution of order 4, goes with the fifth power of the length. */
static const double ERROR_ORDER = 5.0;
static const double SAFETY = 0.8;
static const double MAX_GROWTH = 5.0;
static const double MAX_SHRINK = 0.2;
/* Below this error (1 is allowed) a step cut short says nothing against a longer one: it may be all rounding. */
static const double TELLING_ERROR = 1e-3;
/* A step may be stretched so much to end where it should. */
static const double STRETCH = 1.05;

/* At time zero nothing else would limit how short a step may be; its inverse has to be finite. */
static const double SHORTEST = DBL_MIN / DBL_EPSILON;

/* Behind an event, or a jump of an input, the length learned before it may be far too long. Start again with this part
 * of a first step, which by itself overlooks the transients that a kink excites. (On a car/trailer at 1e-6 that takes
 * nine rejections in ten away and adds one step in fifty.) */
static const double CAUTION = 0.5;

/* The dense output, of order 4, is less accurate than the step, but agrees with it at both ends. So if an event lies
 * between these shares of a step, repeat the step with a length that ends a little behind the event. */
static const double NEAR_START = 0.01;
static const double NEAR_END = 0.9;
static const double BEHIND_EVENT = 1.0 + 1.0 / 32.0;
enum { MAX_REPEATS = 5 };

void integrator_discontinuity(Integrator *m)
{
    m->error_constant = 0.0;
    m->restart = true;
    m->has_left_surface = false;
}

void integrator_go_free(Integrator *m) { m->cuts = 0; }

void integrator_forget(Integrator *m)
{
    integrator_discontinuity(m);
    m->matrix.length = 0.0;
}

/* Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, section II.4, algorithm 4.14; the second
 * derivative comes from the Jacobian instead of a difference quotient. */
static double first_length(const Rodas *r, double tolerance)
{
    Vector second;
    memcpy(second, r->time_derivative, sizeof second);
    for (int e = 0; e < N_JACOBIAN; e++) {
        second[jacobian_row[e]] += r->jacobian[e] * r->derivative[jacobian_column[e]];
    }
    double d0 = 0.0;
    double d1 = 0.0;
    double d2 = 0.0;
    for (int i = 0; i < N_STATES; i++) {
        const double allowed = error_allowed(i, r->path.state[i], tolerance);
        d0 = fmax(d0, fabs(r->path.state[i]) / allowed);
        d1 = fmax(d1, fabs(r->derivative[i]) / allowed);
        d2 = fmax(d2, fabs(second[i]) / allowed);
    }
    const double h0 = d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : 0.01 * d0 / d1;
    const double d = fmax(d1, d2);
    const double h1 = d <= 1e-15 ? fmax(1e-6, 1e-3 * h0) : pow(0.01 / d, 1.0 / ERROR_ORDER);
    return fmin(100.0 * h0, h1);
}

/* Never leave a sliver: stretch the last step, or halve the last two. */
static double fit(double length, double remaining)
{
    if (remaining <= STRETCH * length) {
        return remaining;
    }
    return remaining < 2.0 * length ? 0.5 * remaining : length;
}

/* The length whose error would just be allowed, by the last step's error alone. */
static double elementary(double length, double error)
{
    return SAFETY * length * pow(fmax(error, 1e-12), -1.0 / ERROR_ORDER);
}

/* Choose the next length after a good step. Gustafsson's predictive control: if error / length^5 is rising, expect it
 * to rise on. A step that was cut short may lengthen the next one, but shortens it only if its error says so. */
static void learn(Integrator *m, double length, double error, bool rejected)
{
    const double limit = rejected ? length : MAX_GROWTH * length;
    const bool cut = length < 0.99 * m->length;
    if (cut && limit <= m->length && error <= TELLING_ERROR) { /* so it does neither: spare the powers */
        m->error_constant = 0.0;
        return;
    }
    const double square = length * length;
    const double constant = error / (square * square * length);
    double best = elementary(length, error);
    if (m->error_constant > 0.0 && constant > m->error_constant && error > TELLING_ERROR) {
        best *= fmax(0.5, pow(m->error_constant / constant, 1.0 / ERROR_ORDER));
    }
    if (!cut) {
        m->length = fmax(MAX_SHRINK * length, fmin(best, limit));
    } else if (best > m->length) {
        m->length = fmax(m->length, fmin(best, limit));
    } else if (error > TELLING_ERROR) {
        m->length = best;
    }
    m->error_constant = error > TELLING_ERROR ? constant : 0.0;
}

static bool explain_start(const Rodas *r, const Variables *v, int state, Message *why)
{
    const VariableInfo *info = &variable_info[FIRST_STATE + state];
    message_write(why, "the derivative of %s, or its Jacobian, is not finite at t = %s, where %s = %s", info->name,
                  quantity(r->path.time, "s").text, info->name, quantity(r->path.state[state], info->unit).text);
    loops_explain(v, why);
    return false;
}

/* v is left where the last trial has ended. */
static bool explain_collapse(const Rodas *r, const Variables *v, int not_finite, double tolerance, Message *why)
{
    const bool overflown = not_finite != FINITE && (isfinite(v->at[FIRST_DERIVATIVE + not_finite]) ||
                                                    first_not_finite(&v->at[FIRST_STATE], N_STATES) != FINITE);
    const int state = not_finite == FINITE ? error_worst_state(r, tolerance)
                      : overflown          ? error_fastest_state(r, tolerance)
                                           : not_finite;
    message_write(why, "no step can be made from t = %s, however small: %s %s%s", quantity(r->path.time, "s").text,
                  not_finite == FINITE ? "the largest error is that of"
                  : overflown          ? "beyond all numbers leads the derivative of"
                                       : "not finite is the derivative of",
                  N_STATES > 0 ? variable_info[FIRST_STATE + state].name : "nothing",
                  not_finite == FINITE ? ", as where its derivative jumps outside of an event or grows without bound"
                                       : "");
    loops_explain(v, why);
    return false;
}

/* Shorten a trial until its error is allowed. */
static bool accept(Integrator *m, Rodas *r, Variables *v, const bool holds[], double *length, double tolerance,
                   bool *rejected, double shortest, double *error, Message *why)
{
    for (;;) {
        const int not_finite = rodas_try(r, *length, v, holds);
        m->counters.evaluations += RODAS_STAGES - 1;
        *error = not_finite == FINITE ? error_norm(r, tolerance) : (double)INFINITY;
        if (*error <= 1.0) {
            return true;
        }
        m->counters.rejected++;
        *rejected = true;
        const double shrunk = isfinite(*error) ? elementary(*length, *error) : 0.0;
        *length = fmax(MAX_SHRINK * *length, shrunk);
        m->length = *length;
        if (*length < shortest) {
            return explain_collapse(r, v, not_finite, tolerance, why);
        }
    }
}

static void arrive_at_end(Integrator *m, const Rodas *r, const bool holds[], double target, Point *arrival)
{
    m->counters.steps++;
    arrival->time = r->path.length >= target - r->path.time
                        ? target
                        : r->path.time + r->path.length; /* t + (target - t) may not be target */
    memcpy(arrival->state, r->path.end, sizeof arrival->state);
    memcpy(arrival->holds, holds, sizeof arrival->holds);
    arrival->event = false;
}

/* Time moves on by an event, be it by the least possible amount, unless it lies exactly at the start. */
static bool arrive_at_event(Integrator *m, const Rodas *r, Variables *v, const Event *event, double target,
                            Point *arrival, Message *why)
{
    m->counters.events++;
    integrator_forget(m);
    m->behind = 0.0;
    memcpy(arrival->holds, event->truths, sizeof arrival->holds);
    arrival->event = true;
    rodas_dense(&r->path, event->fraction, arrival->state);
    if (event->fraction == 0.0) {
        m->left_surface = arrival->time = r->path.time;
        m->has_left_surface = true;
        return true;
    }
    m->counters.steps++;
    arrival->time =
        fmin(target, fmax(r->path.time + event->fraction * r->path.length, nextafter(r->path.time, target)));
    v->time = arrival->time;
    ramp_apply(r->ramp, v);
    memcpy(&v->at[FIRST_STATE], arrival->state, N_STATES * sizeof(double));
    return events_settle(v, arrival->holds, why);
}

/* The slopes at the start, and what they tell of the length. */
static bool start(Integrator *m, Rodas *r, Variables *v, const bool holds[], double tolerance, Message *why)
{
    m->counters.jacobians++;
    const int not_finite = gradient(r->ramp, v, holds, r->derivative, r->jacobian, r->time_derivative);
    if (not_finite != FINITE) {
        return explain_start(r, v, not_finite, why);
    }
    if (m->length <= 0.0) {
        m->length = first_length(r, tolerance);
    } else if (m->restart && m->behind <= 0.0) {
        m->length = fmin(m->length, CAUTION * first_length(r, tolerance));
    }
    return true;
}

static void count_cuts(Integrator *m, double length, double remaining)
{
    if (remaining > MAX_GROWTH * length) {
        m->cuts = 0;
    } else if (remaining <= length && length < m->length) {
        m->cuts = m->cuts < BRIEF_CUTS ? m->cuts + 1 : BRIEF_CUTS;
    }
}

/* A step that is not brief. */
static bool step(Integrator *m, Rodas *r, Variables *v, const bool holds[], double target, double tolerance,
                 Point *arrival, Message *why)
{
    const double remaining = target - r->path.time;
    const bool leaving = !(m->has_left_surface && m->left_surface == r->path.time);
    double length = fit(m->length, remaining);
    const double shortest = fmax(SHORTEST, 4.0 * DBL_EPSILON * fmax(fabs(r->path.time), length));
    double error = 0.0;
    bool rejected = false;
    bool found = false;
    Event event;
    for (int repeat = 0;; repeat++) {
        if (!accept(m, r, v, holds, &length, tolerance, &rejected, shortest, &error, why)) {
            return false;
        }
        if (N_RELATIONS > 0) {
            rodas_bend(r);
        }
        found = events_find(r, v, holds, leaving, &event);
        if (!found || event.fraction < NEAR_START || event.fraction > NEAR_END || repeat == MAX_REPEATS) {
            break;
        }
        m->counters.repeated++;
        length *= event.fraction * BEHIND_EVENT;
    }
    count_cuts(m, length, remaining);
    learn(m, length, error, rejected);
    m->behind = m->restart ? m->length : m->behind;
    m->restart = false;
    if (found) {
        return arrive_at_event(m, r, v, &event, target, arrival, why);
    }
    arrive_at_end(m, r, holds, target, arrival);
    return true;
}

bool integrator_step(Integrator *m, Rodas *r, Variables *v, const bool holds[], const Ramp *ramp, bool derived,
                     double target, double tolerance, Point *arrival, Message *why)
{
    m->counters.evaluations++;
    const int not_finite = rodas_start(r, v, holds, ramp, derived);
    if (not_finite != FINITE) {
        return explain_start(r, v, not_finite, why);
    }
    const double remaining = target - r->path.time;
    if (m->restart && m->behind > 0.0) {
        m->length = fmin(m->length, m->behind); /* what was learned behind the last jump of an input serves again */
    }
    bool is_brief = brief_steps_again(m, r, v, holds, remaining, tolerance);
    if (!is_brief) {
        if (!start(m, r, v, holds, tolerance, why)) {
            return false;
        }
        is_brief = brief_steps_afresh(m, r, v, holds, remaining, tolerance);
    }
    if (!is_brief) {
        return step(m, r, v, holds, target, tolerance, arrival, why);
    }
    m->restart = false;
    arrive_at_end(m, r, holds, target, arrival);
    return true;
}
