/* Values and calls that must be refused, and resets and releases in every state. Exit status 0 if all went so. */
#include <math.h>
#include <stdio.h>

#include "unit.h"

static int failures = 0;

static void expect(bool fine, const char *what)
{
    if (!fine) {
        (void)fprintf(stderr, "not so: %s\n", what);
        failures++;
    }
}

static void illegal_values(const Unit *unit, fmi2Component c)
{
    const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, -1.0, 1e308 * 10.0};
    const fmi2ValueReference unknown = 1000000;
    double value = 0.0;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        expect(unit->set_real(c, &unit->brake_torque, 1, &bad[i]) == (isfinite(bad[i]) ? fmi2OK : fmi2Error),
               "a torque that is not finite is refused, a negative one is none");
        expect(unit->do_step(c, 0.0, bad[i], fmi2True) != fmi2OK, "a bad step size is refused");
        expect(unit->do_step(c, bad[i], 0.01, fmi2True) != fmi2OK, "a bad communication point is refused");
    }
    expect(unit->do_step(c, 0.0, 0.0, fmi2True) != fmi2OK, "a step of no length is refused");
    expect(unit->set_real(c, &unknown, 1, &value) == fmi2Error, "an unknown variable cannot be set");
    expect(unit->get_real(c, &unknown, 1, &value) == fmi2Error, "an unknown variable cannot be read");
    expect(unit->set_real(c, unit->outputs, 1, &value) == fmi2Error, "an output cannot be set");
    expect(unit->get_real(c, NULL, 1, &value) == fmi2Error, "no list of variables");
    expect(unit->get_real(c, unit->outputs, 1, NULL) == fmi2Error, "no room for values");
    expect(unit->get_real(c, NULL, 0, NULL) == fmi2OK, "an empty list");
}

/* A fresh instance after each number of calls of the usual sequence, then reset, a run, and release. */
static void reset_in_every_state(const Unit *unit)
{
    static Rows rows;
    for (int calls = 0; calls <= 6; calls++) {
        fmi2Component c = unit_create(unit);
        expect(c != NULL, "an instance");
        if (calls >= 1) {
            expect(unit->setup(c, fmi2True, 1e-8, 5.0, fmi2True, 50.0) == fmi2OK, "setup");
        }
        if (calls >= 2) {
            expect(unit->enter_initialization(c) == fmi2OK, "enter initialization");
        }
        if (calls >= 3) {
            expect(unit->exit_initialization(c) == fmi2OK, "exit initialization");
        }
        if (calls >= 4) {
            expect(unit->do_step(c, 5.0, 1.0, fmi2True) == fmi2OK, "a long step");
        }
        if (calls >= 5) {
            expect(unit->terminate(c) == fmi2OK, "terminate");
        }
        if (calls >= 6) {
            expect(unit->do_step(c, 6.0, 1.0, fmi2True) == fmi2Error, "no step behind the end");
        }
        expect(unit->reset(c) == fmi2OK, "reset");
        expect(unit_start(unit, c) && unit_brake(unit, c, rows), "a run after a reset");
        unit->free_instance(c);
    }
}

int main(int argc, char **argv)
{
    Unit unit;
    if (!unit_load(&unit, argc, argv)) {
        return 2;
    }
    fmi2Component c = unit_create(&unit);
    expect(unit.do_step(c, 0.0, 0.01, fmi2True) == fmi2Error, "no step before initialization");
    expect(unit_start(&unit, c), "a start");
    illegal_values(&unit, c);
    expect(unit.do_step(c, 0.0, 0.01, fmi2True) == fmi2OK, "a step after refused ones");
    expect(unit.setup(c, fmi2False, 0.0, 0.0, fmi2False, 0.0) == fmi2Error, "no setup behind the start");
    unit.free_instance(c);
    unit.free_instance(NULL);
    expect(unit.do_step(NULL, 0.0, 0.01, fmi2True) == fmi2Error, "no step of nothing");
    reset_in_every_state(&unit);
    return failures == 0 ? 0 : 1;
}
