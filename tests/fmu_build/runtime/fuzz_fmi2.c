/* Random legal and illegal calls of FMI 2.0: fuzz SEED CALLS */
#include <stdarg.h>

#include "fmi2Functions.h"
#include "fuzz.h"

typedef struct {
    fmi2Component c;
    bool exchange;
    int phase;
    fmi2FMUstate snapshots[N_SNAPSHOTS];
    int phases[N_SNAPSHOTS];
    double times[N_SNAPSHOTS];
    double time;
} Unit;

static void log_message(fmi2ComponentEnvironment e, fmi2String name, fmi2Status status, fmi2String category,
                        fmi2String format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const char *text = va_arg(arguments, const char *);
    va_end(arguments);
    (void)e;
    (void)status;
    if (name == NULL || category == NULL || strcmp(format, "%s") != 0 || text == NULL || text[0] == '\0') {
        fail("a message without a text, a name or a category");
    }
    fuzz_messages++;
}

static const fmi2CallbackFunctions callbacks = {log_message, calloc, free, NULL, NULL};

static bool done(const Unit *u, const char *name, fmi2Status status, int legal_in, bool interface,
                 const double values[], size_t n)
{
    check(name, status == fmi2OK, status == fmi2Error, (u->phase & legal_in) != 0 && interface, values, n);
    return status == fmi2OK;
}

#define CALL(name, legal_in, interface, values, n, ...)                                                                \
    done(u, #name, name(u->c, ##__VA_ARGS__), legal_in, interface, values, n)

static void life(Unit *u)
{
    switch (draw(6)) {
    case 0:
        (void)CALL(fmi2SetupExperiment, INSTANTIATED_, true, NULL, 0, rarely(), number(1e-6), number(0.0), rarely(),
                   number(10.0));
        break;
    case 1:
        if (CALL(fmi2EnterInitializationMode, INSTANTIATED_, true, NULL, 0)) u->phase = INITIALIZING_;
        break;
    case 2:
        if (CALL(fmi2ExitInitializationMode, INITIALIZING_, true, NULL, 0)) u->phase = u->exchange ? EVENT_ : STEPPING_;
        break;
    case 3:
        if (rarely() && CALL(fmi2Terminate, STEPPING_ | EVENT_ | CONTINUOUS_, true, NULL, 0)) u->phase = TERMINATED_;
        break;
    case 4:
        if ((u->phase >= TERMINATED_ || rarely()) && CALL(fmi2Reset, ALWAYS_, true, NULL, 0)) u->phase = INSTANTIATED_;
        break;
    default: {
        const char *names[2] = {rarely() ? NULL : "logEvents", "%s%n"};
        (void)CALL(fmi2SetDebugLogging, ALWAYS_, true, NULL, 0, (int)draw(2), draw(3), draw(9) ? names : NULL);
    }
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
    switch (draw(6)) {
    case 0:
    case 1:
        (void)CALL(fmi2GetReal, EVALUABLE_, !null, w, n, r, n, null ? NULL : w);
        break;
    case 2:
    case 3:
        (void)CALL(fmi2SetReal, SETTABLE_, !null, NULL, 0, null ? NULL : r, draw(4) ? n : n > 0, v);
        break;
    case 4:
        (void)CALL(fmi2GetDirectionalDerivative, EVALUABLE_, !null, v, n, null ? NULL : r, n, k, m, w, v);
        break;
    default:
        if (draw(2)) {
            r[0] = FIRST_INPUT;
            (void)CALL(fmi2SetRealInputDerivatives, SETTABLE_, !u->exchange, NULL, 0, r, draw(2), orders, v);
        } else {
            (void)CALL(fmi2GetRealOutputDerivatives, STEPPING_ | TERMINATED_ | FAILED_, !u->exchange, w, n, r, n,
                       orders, w);
        }
    }
}

static void step(Unit *u)
{
    double h = rarely() ? odd_number() : uniform(1e-6, 0.05);
    double t = rarely() ? odd_number() : u->time;
    if (h > 1.0 && isfinite(h)) h = 1.0; /* a longer one is no error, but takes its time */
    const bool ok = CALL(fmi2DoStep, STEPPING_, !u->exchange, NULL, 0, t, h, (int)draw(2));
    if (!ok && u->phase == STEPPING_ && fmi2SetReal(u->c, NULL, 0, NULL) != fmi2OK) u->phase = FAILED_;
    fuzz_steps += ok;
    (void)CALL(fmi2GetRealStatus, STEPPING_ | TERMINATED_ | FAILED_, !u->exchange, &u->time, 1, fmi2LastSuccessfulTime,
               &u->time);
    if (rarely() && fmi2CancelStep(u->c) != fmi2Error) fail("fmi2CancelStep is accepted");
}

static void exchange(Unit *u)
{
    double x[AT_LEAST_ONE(N_STATES) + 1], z[AT_LEAST_ONE(N_RELATIONS)];
    fmi2EventInfo info;
    fmi2Boolean flags[2];
    const size_t n = rarely() ? N_STATES + 1 : N_STATES;
    switch (draw(10)) {
    case 0:
        if (CALL(fmi2EnterEventMode, EVENT_ | CONTINUOUS_, u->exchange, NULL, 0)) u->phase = EVENT_;
        break;
    case 1:
        (void)CALL(fmi2NewDiscreteStates, EVENT_, u->exchange, NULL, 0, &info);
        break;
    case 2:
        if (CALL(fmi2EnterContinuousTimeMode, EVENT_, u->exchange, NULL, 0)) u->phase = CONTINUOUS_;
        break;
    case 3:
        (void)CALL(fmi2CompletedIntegratorStep, CONTINUOUS_, u->exchange, NULL, 0, 1, &flags[0],
                   rarely() ? NULL : &flags[1]);
        break;
    case 4:
        (void)CALL(fmi2SetTime, EVENT_ | CONTINUOUS_, u->exchange, NULL, 0, number(u->time));
        break;
    case 5:
        if (CALL(fmi2GetContinuousStates, EVALUABLE_, u->exchange && n == N_STATES, x, n, x, n)) {
            for (int i = 0; i < N_STATES; i++) x[i] = number(x[i]);
            (void)CALL(fmi2SetContinuousStates, CONTINUOUS_, u->exchange, NULL, 0, x, N_STATES);
        }
        break;
    case 6:
    case 7:
        (void)CALL(fmi2GetDerivatives, EVALUABLE_, u->exchange && n == N_STATES, x, n, x, n);
        break;
    case 8:
        (void)CALL(fmi2GetEventIndicators, EVALUABLE_, u->exchange, z, N_RELATIONS, z, N_RELATIONS);
        break;
    default:
        (void)CALL(fmi2GetNominalsOfContinuousStates, ALWAYS_, u->exchange && n == N_STATES, x, n, x, n);
    }
}

/* What a state that was made up does to an instance of its own. */
static void live_with(const Unit *u, const fmi2Byte bytes[], size_t size)
{
    fmi2FMUstate state = NULL;
    fmi2EventInfo info;
    if (fmi2DeSerializeFMUstate(u->c, bytes, size, &state) == fmi2OK) {
        fmi2Component c = fmi2Instantiate("made up", u->exchange ? fmi2ModelExchange : fmi2CoSimulation, MODEL_TOKEN, NULL,
                                          &callbacks, 0, 0);
        if (fmi2SetFMUstate(c, state) == fmi2OK) {
            for (int i = 0; i < 3; i++) {
                double t = 0.0, x[AT_LEAST_ONE(N_STATES)];
                if (!u->exchange && fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &t) == fmi2OK) {
                    (void)fmi2DoStep(c, t, 0.01, 1);
                }
                (void)fmi2GetDerivatives(c, x, N_STATES);
                for (unsigned r = 0; r < N_VARIABLES; r++) {
                    if (variable_info[r].type == REAL && fmi2GetReal(c, &r, 1, &t) == fmi2OK && !isfinite(t)) {
                        fail("a made up state is OK with a value that is not finite");
                    }
                }
                (void)fmi2EnterEventMode(c);
                (void)fmi2NewDiscreteStates(c, &info);
                (void)fmi2EnterContinuousTimeMode(c);
            }
        }
        (void)fmi2FreeFMUstate(c, &state);
        fmi2FreeInstance(c);
    } else if (fuzz_messages == fuzz_messages_before) {
        fail("a made up state is refused without a message");
    }
    fuzz_messages_before = fuzz_messages;
}

static void snapshot(Unit *u)
{
    static fmi2Byte bytes[65536];
    const unsigned i = draw(N_SNAPSHOTS);
    fmi2FMUstate *s = &u->snapshots[i];
    size_t size = 0;
    switch (draw(5)) {
    case 0:
        if (CALL(fmi2GetFMUstate, ALWAYS_, true, NULL, 0, s)) {
            u->phases[i] = u->phase;
            u->times[i] = u->time;
        }
        break;
    case 1:
    case 2:
        if (CALL(fmi2SetFMUstate, ALWAYS_, *s != NULL, NULL, 0, *s)) {
            u->phase = u->phases[i];
            u->time = u->times[i];
        }
        break;
    case 3:
        (void)CALL(fmi2FreeFMUstate, ALWAYS_, true, NULL, 0, rarely() ? NULL : s);
        break;
    default:
        if (CALL(fmi2SerializedFMUstateSize, ALWAYS_, *s != NULL, NULL, 0, *s, &size) &&
            CALL(fmi2SerializeFMUstate, ALWAYS_, true, NULL, 0, *s, bytes, size)) {
            const bool damaged = draw(2) == 0;
            if (damaged) bytes[draw((uint32_t)size)] ^= (fmi2Byte)(1u << draw(8));
            const size_t given = rarely() ? draw((uint32_t)size) : size;
            (void)CALL(fmi2DeSerializeFMUstate, ALWAYS_, !damaged && given == size, NULL, 0, bytes, given, s);
            if (!damaged) {
                make_up((unsigned char *)bytes, size);
                live_with(u, bytes, size);
            }
        }
    }
}

/* Whether all variables are of one of two types. */
static bool all_of(const unsigned references[], size_t n, ValueType one, ValueType other)
{
    for (size_t i = 0; i < n; i++) {
        if (references[i] >= N_VARIABLES) return false;
        const ValueType type = variable_info[references[i]].type;
        if (type != one && type != other) return false;
    }
    return true;
}

static void others(Unit *u)
{
    unsigned r[1] = {reference()};
    int i[1] = {0};
    const size_t n = draw(2);
    const bool get = draw(2);
    fmi2Status status;
    if (get) {
        (void)CALL(fmi2GetInteger, EVALUABLE_, all_of(r, n, INTEGER, ENUMERATION), NULL, 0, r, n, i);
        (void)CALL(fmi2GetBoolean, EVALUABLE_, all_of(r, n, BOOLEAN, BOOLEAN), NULL, 0, r, n, i);
    } else {
        (void)CALL(fmi2SetBoolean, SETTABLE_ & ~CONTINUOUS_, all_of(r, n, BOOLEAN, BOOLEAN), NULL, 0, r, n, i);
        (void)CALL(fmi2SetInteger, SETTABLE_ & ~CONTINUOUS_, all_of(r, n, INTEGER, ENUMERATION), NULL, 0, r, n, i);
    }
    (void)CALL(fmi2GetStatus, 0, false, NULL, 0, fmi2DoStepStatus, &status);
}

static void live(long until)
{
    Unit unit = {.exchange = draw(2), .phase = INSTANTIATED_};
    Unit *u = &unit;
    u->c = fmi2Instantiate("fuzz", u->exchange ? fmi2ModelExchange : fmi2CoSimulation, MODEL_TOKEN, NULL, &callbacks, 0,
                           (int)draw(2));
    while (fuzz_calls < until) {
        const uint32_t what = draw(20);
        if (what < (u->phase <= INITIALIZING_ || u->phase >= TERMINATED_ ? 10u : 2u))
            life(u);
        else if (what < 13)
            values(u);
        else if (what < 16)
            u->exchange &&draw(9) ? exchange(u) : step(u);
        else if (what < 17)
            exchange(u);
        else if (what < 19)
            snapshot(u);
        else
            others(u);
        if (draw(500) == 0) break;
    }
    for (int i = 0; i < N_SNAPSHOTS; i++) (void)fmi2FreeFMUstate(u->c, &u->snapshots[i]);
    fmi2FreeInstance(u->c);
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
