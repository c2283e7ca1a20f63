/* Random legal and illegal calls of FMI 3.0: fuzz SEED CALLS */
#include "fmi3Functions.h"
#include "fuzz.h"

typedef struct {
    fmi3Instance c;
    bool exchange;
    bool events;
    bool early;
    bool updating;
    int phase;
    fmi3FMUState snapshots[N_SNAPSHOTS];
    int phases[N_SNAPSHOTS];
    double times[N_SNAPSHOTS];
    double time;
} Unit;

static void log_message(fmi3InstanceEnvironment e, fmi3Status status, fmi3String category, fmi3String text)
{
    (void)e;
    (void)status;
    if (category == NULL || text == NULL || text[0] == '\0') {
        fail("a message without a text or a category");
    }
    fuzz_messages++;
}

static bool done(const Unit *u, const char *name, fmi3Status status, int legal_in, bool interface,
                 const double values[], size_t n)
{
    check(name, status == fmi3OK, status == fmi3Error, !u->updating && (u->phase & legal_in) != 0 && interface, values,
          n);
    return status == fmi3OK;
}

#define CALL(name, legal_in, interface, values, n, ...)                                                                \
    done(u, #name, name(u->c, ##__VA_ARGS__), legal_in, interface, values, n)

static void life(Unit *u)
{
    switch (draw(5)) {
    case 0:
        if (CALL(fmi3EnterInitializationMode, INSTANTIATED_, true, NULL, 0, rarely(), number(1e-6), number(0.0),
                 rarely(), number(10.0))) {
            u->phase = INITIALIZING_;
        }
        break;
    case 1:
        if (CALL(fmi3ExitInitializationMode, INITIALIZING_, true, NULL, 0)) {
            u->phase = u->exchange || u->events ? EVENT_ : STEPPING_;
        }
        break;
    case 2:
        if (rarely() && CALL(fmi3Terminate, STEPPING_ | EVENT_ | CONTINUOUS_, true, NULL, 0)) u->phase = TERMINATED_;
        break;
    case 3:
        if ((u->phase >= TERMINATED_ || rarely()) && CALL(fmi3Reset, ALWAYS_, true, NULL, 0)) u->phase = INSTANTIATED_;
        break;
    default: { /* errors go on being logged, for the check that they have a reason */
        const char *names[2] = {rarely() ? NULL : "logEvents", "%s%n"};
        (void)CALL(fmi3SetDebugLogging, ALWAYS_, true, NULL, 0, draw(2), 1 + draw(2), draw(9) ? names : NULL);
    }
    }
}

static void derivatives(Unit *u, const unsigned r[], size_t n, const unsigned k[], size_t m)
{
    double v[MAX_LIST], w[MAX_LIST];
    unsigned ignored[MAX_LIST];
    list(ignored, v);
    const size_t seeds = rarely() ? m + 1 : m;
    if (draw(2)) {
        (void)CALL(fmi3GetDirectionalDerivative, EVALUABLE_, seeds == m, w, n, r, n, k, m, v, seeds, w, n);
    } else {
        (void)CALL(fmi3GetAdjointDerivative, EVALUABLE_, seeds == m, w, n, k, m, r, n, v, seeds, w, n);
    }
}

static void dependencies(Unit *u, unsigned r)
{
    size_t n = 0, of[N_VARIABLES], on[N_VARIABLES];
    unsigned independents[N_VARIABLES];
    fmi3DependencyKind kinds[N_VARIABLES];
    if (CALL(fmi3GetNumberOfVariableDependencies, ALWAYS_, r < N_VARIABLES, NULL, 0, r, &n)) {
        const size_t given = rarely() ? draw(N_VARIABLES) : n;
        (void)CALL(fmi3GetVariableDependencies, ALWAYS_, given == n, NULL, 0, r, of, independents, on, kinds, given);
    }
}

static void values(Unit *u)
{
    unsigned r[MAX_LIST], k[MAX_LIST];
    double v[MAX_LIST], w[MAX_LIST];
    int orders[MAX_LIST];
    const size_t n = length(), m = length();
    const bool null = rarely() && n > 0;
    list(r, v);
    list(k, w);
    for (int i = 0; i < MAX_LIST; i++) orders[i] = rarely() ? (int)draw(4) : 1;
    switch (draw(7)) {
    case 0:
    case 1: {
        const bool updating = u->updating;
        u->updating = false; /* legal then, too */
        (void)CALL(fmi3GetFloat64, ALWAYS_, !null, w, n, r, n, null ? NULL : w, n);
        u->updating = updating;
        break;
    }
    case 2:
    case 3:
        (void)CALL(fmi3SetFloat64, SETTABLE_, !null, NULL, 0, null ? NULL : r, draw(4) ? n : n > 0, v, n);
        break;
    case 4:
        derivatives(u, r, n, k, m);
        break;
    case 5:
        dependencies(u, r[0]);
        break;
    default:
        if (!u->updating) {
            (void)CALL(fmi3GetOutputDerivatives, STEPPING_ | TERMINATED_ | FAILED_, !u->exchange, w, n, r, n, orders, w,
                       n);
        }
    }
}

static void others(Unit *u)
{
    unsigned r[1] = {reference()};
    int8_t i[1] = {0};
    bool clock[1] = {false};
    const size_t n = draw(2);
    switch (draw(5)) {
    case 0:
        (void)CALL(fmi3SetInt8, SETTABLE_ & ~CONTINUOUS_, n == 0, NULL, 0, r, n, i, n);
        break;
    case 1:
        (void)CALL(fmi3GetClock, INITIALIZING_ | EVENT_, n == 0, NULL, 0, r, n, clock);
        break;
    case 2:
        (void)CALL(fmi3EnterConfigurationMode, 0, false, NULL, 0);
        break;
    case 3:
        (void)CALL(fmi3ActivateModelPartition, 0, false, NULL, 0, r[0], 0.0);
        break;
    default:
        (void)CALL(fmi3SetIntervalDecimal, INITIALIZING_ | EVENT_, n == 0, NULL, 0, r, n, &u->time);
    }
}

static void any_call(Unit *u);

static void on_intermediate(fmi3InstanceEnvironment e, fmi3Float64 time, fmi3Boolean set, fmi3Boolean get,
                            fmi3Boolean finished, fmi3Boolean early, fmi3Boolean *requested, fmi3Float64 *end)
{
    Unit *u = e;
    if (set || !get || !finished || early != u->early || !isfinite(time)) fail("wrong arguments of the callback");
    if (draw(4) == 0) {
        u->updating = true;
        any_call(u);
        u->updating = false;
    }
    *requested = draw(3) == 0;
    *end = number(time);
}

static void step(Unit *u)
{
    bool event = false, terminate = false, early = false;
    double h = rarely() ? odd_number() : uniform(1e-6, 0.05);
    double t = rarely() ? odd_number() : u->time;
    if (h > 1.0 && isfinite(h)) h = 1.0; /* a longer one is no error, but takes its time */
    const bool ok = CALL(fmi3DoStep, STEPPING_, !u->exchange, &u->time, 1, t, h, draw(2), &event, &terminate, &early,
                         rarely() ? NULL : &u->time);
    fuzz_steps += ok;
    if ((early && !u->early) || (event && !u->events) || terminate) fail("an early return or an event not asked for");
    if (!ok && u->phase == STEPPING_ && !u->updating && fmi3SetFloat64(u->c, NULL, 0, NULL, 0) != fmi3OK) {
        u->phase = FAILED_;
    }
    if (event && fmi3DoStep(u->c, u->time, 0.01, true, &event, &terminate, &early, &u->time) != fmi3Error) {
        fail("a step is made over an event that waits");
    }
}

static void events(Unit *u)
{
    bool b[5];
    double time;
    switch (draw(4)) {
    case 0:
        if (CALL(fmi3EnterEventMode, STEPPING_ | CONTINUOUS_, u->exchange || u->events, NULL, 0)) u->phase = EVENT_;
        break;
    case 1:
        (void)CALL(fmi3UpdateDiscreteStates, EVENT_, true, NULL, 0, &b[0], &b[1], &b[2], &b[3], &b[4],
                   rarely() ? NULL : &time);
        break;
    case 2:
        (void)CALL(fmi3EvaluateDiscreteStates, EVENT_, true, NULL, 0);
        break;
    default:
        if (draw(2)) {
            if (CALL(fmi3EnterStepMode, EVENT_, !u->exchange, NULL, 0)) u->phase = STEPPING_;
        } else if (CALL(fmi3EnterContinuousTimeMode, EVENT_, u->exchange, NULL, 0)) {
            u->phase = CONTINUOUS_;
        }
    }
}

static void exchange(Unit *u)
{
    double x[AT_LEAST_ONE(N_STATES) + 1], z[AT_LEAST_ONE(N_RELATIONS)];
    bool flags[2];
    size_t count;
    const size_t n = rarely() ? N_STATES + 1 : N_STATES;
    switch (draw(7)) {
    case 0:
        (void)CALL(fmi3CompletedIntegratorStep, CONTINUOUS_, u->exchange, NULL, 0, true, &flags[0],
                   rarely() ? NULL : &flags[1]);
        break;
    case 1:
        (void)CALL(fmi3SetTime, CONTINUOUS_, u->exchange, NULL, 0, number(u->time));
        break;
    case 2:
        if (CALL(fmi3GetContinuousStates, EVALUABLE_, u->exchange && n == N_STATES, x, n, x, n)) {
            for (int i = 0; i < N_STATES; i++) x[i] = number(x[i]);
            (void)CALL(fmi3SetContinuousStates, CONTINUOUS_, u->exchange, NULL, 0, x, N_STATES);
        }
        break;
    case 3:
        (void)CALL(fmi3GetContinuousStateDerivatives, EVALUABLE_, u->exchange && n == N_STATES, x, n, x, n);
        break;
    case 4:
        (void)CALL(fmi3GetEventIndicators, EVALUABLE_, u->exchange, z, N_RELATIONS, z, N_RELATIONS);
        break;
    case 5:
        (void)CALL(fmi3GetNumberOfEventIndicators, ALWAYS_, u->exchange, NULL, 0, &count);
        break;
    default:
        (void)CALL(fmi3GetNominalsOfContinuousStates, EVALUABLE_, u->exchange && n == N_STATES, x, n, x, n);
    }
}

/* What a state that was made up does to an instance of its own. */
static void live_with(const Unit *u, const fmi3Byte bytes[], size_t size)
{
    fmi3FMUState state = NULL;
    if (fmi3DeserializeFMUState(u->c, bytes, size, &state) == fmi3OK) {
        fmi3Instance c =
            u->exchange ? fmi3InstantiateModelExchange("made up", MODEL_TOKEN, NULL, false, true, NULL, log_message)
                        : fmi3InstantiateCoSimulation("made up", MODEL_TOKEN, NULL, false, true, u->events, true, NULL, 0,
                                                      NULL, log_message, NULL);
        if (fmi3SetFMUState(c, state) == fmi3OK) {
            for (int i = 0; i < 3; i++) {
                bool b[5];
                double t = 0.0, x[AT_LEAST_ONE(N_STATES)];
                const unsigned time = 0;
                if (fmi3GetFloat64(c, &time, 1, &t, 1) == fmi3OK && !u->exchange) {
                    (void)fmi3DoStep(c, t, 0.01, true, &b[0], &b[1], &b[2], &t);
                }
                (void)fmi3GetContinuousStateDerivatives(c, x, N_STATES);
                for (unsigned r = 0; r < N_VARIABLES; r++) {
                    if (variable_info[r].type == REAL && fmi3GetFloat64(c, &r, 1, &t, 1) == fmi3OK && !isfinite(t)) {
                        fail("a made up state is OK with a value that is not finite");
                    }
                }
                (void)fmi3EnterEventMode(c);
                (void)fmi3UpdateDiscreteStates(c, &b[0], &b[1], &b[2], &b[3], &b[4], &t);
                (void)(u->exchange ? fmi3EnterContinuousTimeMode : fmi3EnterStepMode)(c);
            }
        }
        (void)fmi3FreeFMUState(c, &state);
        fmi3FreeInstance(c);
    } else if (fuzz_messages == fuzz_messages_before) {
        fail("a made up state is refused without a message");
    }
    fuzz_messages_before = fuzz_messages;
}

static void snapshot(Unit *u)
{
    static fmi3Byte bytes[65536];
    const unsigned i = draw(N_SNAPSHOTS);
    fmi3FMUState *s = &u->snapshots[i];
    size_t size = 0;
    switch (draw(5)) {
    case 0:
        if (CALL(fmi3GetFMUState, ALWAYS_, true, NULL, 0, s)) {
            u->phases[i] = u->phase;
            u->times[i] = u->time;
        }
        break;
    case 1:
    case 2:
        if (CALL(fmi3SetFMUState, ALWAYS_, *s != NULL, NULL, 0, *s)) {
            u->phase = u->phases[i];
            u->time = u->times[i];
        }
        break;
    case 3:
        (void)CALL(fmi3FreeFMUState, ALWAYS_, true, NULL, 0, rarely() ? NULL : s);
        break;
    default:
        if (CALL(fmi3SerializedFMUStateSize, ALWAYS_, *s != NULL, NULL, 0, *s, &size) &&
            CALL(fmi3SerializeFMUState, ALWAYS_, true, NULL, 0, *s, bytes, size)) {
            const bool damaged = draw(2) == 0;
            if (damaged) bytes[draw((uint32_t)size)] ^= (fmi3Byte)(1u << draw(8));
            const size_t given = rarely() ? draw((uint32_t)size) : size;
            (void)CALL(fmi3DeserializeFMUState, ALWAYS_, !damaged && given == size, NULL, 0, bytes, given, s);
            if (!damaged) {
                make_up((unsigned char *)bytes, size);
                live_with(u, bytes, size);
            }
        }
    }
}

static void any_call(Unit *u)
{
    const uint32_t what = draw(20);
    if (what < (u->phase <= INITIALIZING_ || u->phase >= TERMINATED_ ? 10u : 2u))
        life(u);
    else if (what < 11)
        values(u);
    else if (what < 13)
        events(u);
    else if (what < 16)
        u->exchange &&draw(9) ? exchange(u) : step(u);
    else if (what < 17)
        exchange(u);
    else if (what < 19)
        snapshot(u);
    else
        others(u);
}

static void live(long until)
{
    Unit unit = {.exchange = draw(2), .events = draw(2), .early = draw(2), .phase = INSTANTIATED_};
    Unit *u = &unit;
    u->c = u->exchange ? fmi3InstantiateModelExchange("fuzz", MODEL_TOKEN, NULL, false, true, u, log_message)
                       : fmi3InstantiateCoSimulation("fuzz", MODEL_TOKEN, NULL, false, true, u->events, u->early, NULL,
                                                     0, u, log_message, draw(2) ? on_intermediate : NULL);
    do {
        any_call(u);
    } while (fuzz_calls < until && draw(500) != 0);
    for (int i = 0; i < N_SNAPSHOTS; i++) (void)fmi3FreeFMUState(u->c, &u->snapshots[i]);
    fmi3FreeInstance(u->c);
}

int main(int argc, char *argv[])
{
    if (argc != 3) return 2;
    fuzz_random = strtoull(argv[1], NULL, 10) * 2 + 1;
    const long calls = strtol(argv[2], NULL, 10);
    while (fuzz_calls < calls) live(calls);
    printf("%ld calls, %ld accepted, %ld of them steps\n", fuzz_calls, fuzz_accepted, fuzz_steps);
    return 0;
}
