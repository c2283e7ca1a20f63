#include "state_check.h"

#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "finite.h"
#include "validation.h"

typedef struct {
    char name[40];       /* not elsewhere: a pointer would have to be relocated */
    size_t offset, size; /* in bytes */
} Field;

#define FIELD(field) {#field, offsetof(State, field), sizeof(((State *)NULL)->field)}

static const Field bool_fields[] = {
    FIELD(calculated),
    FIELD(settled),
    FIELD(since),
    FIELD(holds),
    FIELD(event_waits),
    FIELD(after_event),
    FIELD(next_holds),
    FIELD(asserted),
    FIELD(ramp.moves),
    FIELD(ramp.given),
    FIELD(ramp.is_set),
    FIELD(ramp.over),
    FIELD(integrator.has_left_surface),
    FIELD(integrator.restart),
    FIELD(integrator.matrix.depends_on_time),
    FIELD(calm),
    FIELD(course.open),
    FIELD(course.arrival.holds),
    FIELD(course.arrival.event),
#if HAS_EVENTS
    FIELD(discrete.warned),
    FIELD(discrete.pending),
    FIELD(discrete.states_changed),
    FIELD(discrete.ended),
#endif
#if N_COUPLINGS > 0
    FIELD(coupling.stepped),
    FIELD(coupling.moves),
    FIELD(coupling.is_set),
    FIELD(coupling.stands),
    FIELD(coupling.parted),
    FIELD(coupling.several),
#endif
};

static const Field double_fields[] = {
    FIELD(v.time),
    FIELD(density.span),
    FIELD(density.since),
    FIELD(ramp.start),
    FIELD(ramp.from),
    FIELD(ramp.slope),
    FIELD(integrator.length),
    FIELD(integrator.left_surface),
    FIELD(integrator.behind),
    FIELD(integrator.brief),
    FIELD(integrator.matrix.length),
    FIELD(integrator.matrix.time),
    FIELD(integrator.matrix.reach),
    FIELD(integrator.matrix.factors),
    FIELD(integrator.matrix.time_derivative),
#if HAS_EVENTS
    FIELD(discrete.ticks),
#endif
#if N_COUPLINGS > 0
    FIELD(coupling.now), /* these two are of doubles alone */
    FIELD(coupling.change),
    FIELD(coupling.before),
    FIELD(coupling.interval),
    FIELD(coupling.usual),
    FIELD(coupling.applied),
    FIELD(coupling.slope),
    FIELD(coupling.across),
    FIELD(coupling.through),
    FIELD(coupling.mean),
    FIELD(coupling.hold),
#endif
};

static const Field course_fields[] = {
    FIELD(course.path.time), FIELD(course.path.length),  FIELD(course.path.state),    FIELD(course.path.end),
    FIELD(course.path.bend), FIELD(course.arrival.time), FIELD(course.arrival.state),
};

#undef FIELD

static bool disbelieve(const char *name, Message *why)
{
    message_write(why, "this state cannot be that of an instance: %s is not valid", name);
    return false;
}

/* Byte by byte: to read another value as a bool is undefined. */
static bool check_bools(const State *s, Message *why)
{
    for (size_t i = 0; i < sizeof bool_fields / sizeof *bool_fields; i++) {
        const unsigned char *bytes = (const unsigned char *)s + bool_fields[i].offset;
        for (size_t k = 0; k < bool_fields[i].size; k++) {
            if (bytes[k] > 1) {
                return disbelieve(bool_fields[i].name, why);
            }
        }
    }
    return true;
}

static bool check_doubles(const State *s, const Field fields[], size_t n, Message *why)
{
    for (size_t i = 0; i < n; i++) {
        const double *values = (const double *)(const void *)((const unsigned char *)s + fields[i].offset);
        if (first_not_finite(values, (int)(fields[i].size / sizeof *values)) != FINITE) {
            return disbelieve(fields[i].name, why);
        }
    }
    return true;
}

/* What is given has to be finite; what is calculated may have been out of the model's domain. All that is no Real is
 * whole, and fits into 32 bits. */
static bool check_variables(const Variables *v, Message *why)
{
    for (int i = 0; i < N_VARIABLES; i++) {
        const VariableInfo *info = &variable_info[i];
        const bool given = info->kind == INPUT || info->kind == PARAMETER || info->kind == FIXED_PARAMETER;
        const double value = v->at[i];
        if (info->type == REAL ? given && !isfinite(value)
                               : !(value >= INT32_MIN && value <= INT32_MAX) || value != floor(value)) {
            return disbelieve(info->name, why);
        }
    }
    return true;
}

static bool check_phase(const State *s, Message *why)
{
    static const int every = INSTANTIATED | INITIALIZING | TERMINATED;
    static const int phases[] = {[CO_SIMULATION] = every | STEPPING | FAILED,
                                 [CO_SIMULATION_WITH_EVENTS] = every | STEPPING | EVENT_MODE | FAILED,
                                 [MODEL_EXCHANGE] = every | EVENT_MODE | CONTINUOUS};
    const unsigned use = (unsigned)s->use;
    const unsigned phase = (unsigned)s->phase;
    if (use >= sizeof phases / sizeof *phases) {
        return disbelieve("use", why);
    }
    if ((unsigned)s->freshness >= N_FRESHNESS) {
        return disbelieve("freshness", why);
    }
    const bool one = phase != 0 && (phase & (phase - 1)) == 0;
    return (one && (phase & (unsigned)phases[use]) != 0) || disbelieve("phase", why);
}

static bool check_integrator(const Integrator *m, const EventDensity *density, Message *why)
{
    const int64_t counts[] = {m->counters.steps,       m->counters.rejected,  m->counters.repeated,
                              m->counters.evaluations, m->counters.jacobians, m->counters.events};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        if (counts[i] < 0 || counts[i] > INT64_MAX / 2) {
            return disbelieve("integrator.counters", why);
        }
    }
    if (!(m->length >= 0.0) || !(m->error_constant >= 0.0) || !(m->behind >= 0.0) || !(m->brief >= 0.0) ||
        m->cuts < 0) {
        return disbelieve("integrator", why);
    }
    return (density->count >= 0 && density->count < INT_MAX / 2) || disbelieve("density.count", why);
}

static bool check_course(const State *s, Message *why)
{
    const Course *course = &s->course;
    if (!course->open) {
        return true;
    }
    if (!check_doubles(s, course_fields, sizeof course_fields / sizeof *course_fields, why)) {
        return false;
    }
    return (course->path.length > 0.0 && course->path.time <= s->v.time && s->v.time <= course->arrival.time) ||
           disbelieve("course", why);
}

static bool check_coupling(const State *s, Message *why)
{
#if N_COUPLINGS > 0
    const Coupling *c = &s->coupling;
    bool lengths = c->interval >= 0.0 && c->usual >= 0.0 && c->now.period >= 0.0;
    for (int i = 0; i < N_ACROSS; i++) {
        lengths = lengths && c->span[i] >= 0.0;
    }
    const bool order = !c->stepped || (c->change.time <= c->now.time && c->now.time <= s->v.time);
    return (lengths && order && c->doubts >= 0) || disbelieve("coupling", why);
#else
    (void)s;
    (void)why;
    return true;
#endif
}

bool state_check(const State *s, Message *why)
{
    return check_bools(s, why) && check_phase(s, why) &&
           check_doubles(s, double_fields, sizeof double_fields / sizeof *double_fields, why) &&
           valid_experiment(&s->tolerance, s->v.time, NULL, why) && (!isnan(s->stop) || disbelieve("stop", why)) &&
           check_variables(&s->v, why) && check_integrator(&s->integrator, &s->density, why) && check_course(s, why) &&
           check_coupling(s, why);
}
