#include "events.h"

#include <float.h>
#include <math.h>

/* Points of a step at which the truths are looked at: a surface crossed and crossed back between two of them is taken
 * not to have been crossed. */
enum { SAMPLES = 4 };

/* Events in a row that may happen in one thousandth of a communication step. */
enum { BATCH = 100 };
static const double BATCH_SHARE = 1e-3;

/* Inside a step a residual that is zero but for rounding leaves the truth as it is: a drawbar that nothing loads stays
 * on its surface for a whole run, now on this side of it and now on the other by 1e-17 m, and each time would be an
 * event. What holds where a run is started, or where something has been set, is told by the sign alone. */
static const double RESIDUAL_ROUNDING = 1e-12; /* of the relation's nominal value */

static double band(int relation) { return RESIDUAL_ROUNDING * variable_info[relation_reference[relation]].nominal; }

static bool truth(int relation, double z, bool held) { return held ? z > -band(relation) : z > band(relation); }

/* Has it changed? Most often the sign alone tells that it has not. */
static bool changes(int relation, double z, bool held) { return (z > 0.0) != held && truth(relation, z, held) != held; }

static void take_truths(const double z[], const bool held[], bool truths[])
{
    for (int i = 0; i < N_RELATIONS; i++) {
        truths[i] = truth(i, z[i], held[i]);
    }
}

int events_take(Variables *v, bool holds[], bool by_sign)
{
    double z[AT_LEAST_ONE(N_RELATIONS)];
    int changed = NO_RELATION;
    model_relations(v, holds, z);
    for (int i = 0; i < N_RELATIONS; i++) {
        const bool now = by_sign ? z[i] > 0.0 : truth(i, z[i], holds[i]);
        if (now != holds[i]) {
            holds[i] = now;
            changed = i;
        }
    }
    return changed;
}

void events_explain(int relation, double time, Message *why)
{
    message_write(why, "the relation %s does not settle at t = %s: its truth depends on itself",
                  relation_text[relation], quantity(time, "s").text);
}

bool events_settle(Variables *v, bool holds[], Message *why)
{
    int changed = NO_RELATION;
    for (int round = 0; round < 2 * N_RELATIONS + 2; round++) {
        changed = events_take(v, holds, true);
        if (changed == NO_RELATION) {
            return true;
        }
    }
    events_explain(changed, v->time, why);
    return false;
}

static bool any_changes(const double z[], const bool holds[])
{
    for (int i = 0; i < N_RELATIONS; i++) {
        if (changes(i, z[i], holds[i])) {
            return true;
        }
    }
    return false;
}

bool events_have_changed(Variables *v, const bool holds[])
{
    double z[AT_LEAST_ONE(N_RELATIONS)];
    model_relations(v, holds, z);
    return any_changes(z, holds);
}

/* Residuals at a point of the trial. */
static bool changed_at(const Rodas *r, double fraction, Variables *v, const bool holds[], double z[])
{
    v->time = r->path.time + fraction * r->path.length;
    ramp_apply(r->ramp, v);
    rodas_dense(&r->path, fraction, &v->at[FIRST_STATE]);
    model_relations(v, holds, z);
    return any_changes(z, holds);
}

/* The truths where a trial leaves the surfaces on which it starts; false if it starts on none of those that it crosses
 * before the point where the residuals are z. */
static bool leaves_surface(const Rodas *r, Variables *v, const bool holds[], const double z[], bool truths[])
{
    double start[AT_LEAST_ONE(N_RELATIONS)];
    bool leaves = false;
    (void)changed_at(r, 0.0, v, holds, start);
    for (int i = 0; i < N_RELATIONS; i++) {
        const bool now = truth(i, z[i], holds[i]);
        const bool changes = now != holds[i] && fabs(start[i]) <= band(i);
        truths[i] = changes ? now : holds[i];
        leaves = leaves || changes;
    }
    return leaves;
}

/* Bisection: it needs nothing of the residuals but their signs, and fifty evaluations of the relations cost about as
 * much as a few steps. Several relations may change; what is found is a point where some truth has changed. */
static double bisect(const Rodas *r, double before, double behind, Variables *v, const bool holds[])
{
    double z[AT_LEAST_ONE(N_RELATIONS)];
    const double rounding =
        DBL_EPSILON * fmax(fabs(r->path.time), fabs(r->path.time + r->path.length)) / r->path.length;
    while (behind - before > fmax(rounding, DBL_EPSILON * behind)) {
        const double middle = 0.5 * (before + behind);
        if (changed_at(r, middle, v, holds, z)) {
            behind = middle;
        } else {
            before = middle;
        }
    }
    return behind;
}

#if HAS_EVENTS
/* Twice as many as long as a residual turns within three of them: one that swings faster than the states do would cross
 * its surface unseen. */
enum { MOST_SAMPLES = 256 };
static const double TURN = 0.5; /* of the residual, from the line through its neighbours */

static bool turns(const double before[], const double z[], const double behind[])
{
    for (int i = 0; i < N_RELATIONS; i++) {
        const double largest = fmax(fabs(z[i]), fmax(fabs(before[i]), fabs(behind[i])));
        if (fabs(z[i] - 0.5 * (before[i] + behind[i])) > TURN * largest + band(i)) {
            return true;
        }
    }
    return false;
}

static int samples_of(const Rodas *r, Variables *v, const bool holds[])
{
    double z[3][AT_LEAST_ONE(N_RELATIONS)];
    int count = SAMPLES;
    for (int i = 0; i <= count && count < MOST_SAMPLES; i++) {
        (void)changed_at(r, (double)i / (double)count, v, holds, z[i % 3]);
        if (i > 1 && turns(z[(i - 2) % 3], z[(i - 1) % 3], z[i % 3])) {
            count *= 2;
            i = -1;
        }
    }
    return count;
}
#else
static int samples_of(const Rodas *r, Variables *v, const bool holds[])
{
    (void)r;
    (void)v;
    (void)holds;
    return SAMPLES;
}
#endif

bool events_find(const Rodas *r, Variables *v, const bool holds[], bool leaving, Event *event)
{
    double z[AT_LEAST_ONE(N_RELATIONS)];
    int sample = 1;
    if (N_RELATIONS == 0) {
        return false;
    }
    const double count = samples_of(r, v, holds);
    while (!changed_at(r, sample / count, v, holds, z)) {
        if (sample == count) {
            return false;
        }
        sample++;
    }
    if (leaving && sample == 1 && leaves_surface(r, v, holds, z, event->truths)) {
        event->fraction = 0.0;
        return true;
    }
    event->fraction = bisect(r, (sample - 1) / count, sample / count, v, holds);
    (void)changed_at(r, event->fraction, v, holds, z);
    take_truths(z, holds, event->truths);
    return true;
}

bool events_hold(const Variables *v, const bool holds[])
{
    for (int i = 0; i < N_RELATIONS; i++) {
        if (changes(i, v->at[relation_reference[i]], holds[i])) {
            return false;
        }
    }
    return true;
}

void events_watch(EventDensity *density, double time, double target)
{
    density->span = BATCH_SHARE * (target - time);
    density->since = time;
    density->count = 0;
}

bool events_too_dense(EventDensity *density, double time, const bool before[], const bool after[], Message *why)
{
    if (density->count == 0) {
        density->since = time;
    }
    density->count++;
    if (density->count < BATCH) {
        return false;
    }
    density->count = 0;
    const bool dense = time - density->since < density->span;
    if (dense) {
        int changed = 0;
        while (changed < N_RELATIONS - 1 && before[changed] == after[changed]) {
            changed++;
        }
        message_write(why,
                      "the relation %s is chattering at t = %s: it changes without end; where either side leads back "
                      "to the other, as in dry friction, the model needs a smooth law, tanh(v/v_small) instead of "
                      "sign(v), or one with a deflection that sticks",
                      relation_text[changed], quantity(time, "s").text);
    }
    return dense;
}
