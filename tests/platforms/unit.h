/* An FMI 2.0 library loaded at run time, on Linux, macOS and Windows, and runs of it. */
#ifndef UNIT_H
#define UNIT_H

#include <stdbool.h>
#include <stddef.h>

#include "fmi2FunctionTypes.h"

enum { STEPS = 600, MAX_OUTPUTS = 16 };

typedef struct {
    fmi2InstantiateTYPE *instantiate;
    fmi2SetupExperimentTYPE *setup;
    fmi2EnterInitializationModeTYPE *enter_initialization;
    fmi2ExitInitializationModeTYPE *exit_initialization;
    fmi2SetRealTYPE *set_real;
    fmi2GetRealTYPE *get_real;
    fmi2DoStepTYPE *do_step;
    fmi2ResetTYPE *reset;
    fmi2TerminateTYPE *terminate;
    fmi2FreeInstanceTYPE *free_instance;
    const char *guid;
    fmi2ValueReference brake_torque;
    fmi2ValueReference outputs[MAX_OUTPUTS];
    size_t n_outputs;
} Unit;

/* Values of the outputs at the communication points. */
typedef double Rows[STEPS + 1][MAX_OUTPUTS];

/* From a program's arguments: PROGRAM LIBRARY GUID BRAKE_TORQUE OUTPUT..., the last ones value references.
 * What is missing is told on stderr. */
bool unit_load(Unit *unit, int argc, char **argv);

/* An instance that does not log; NULL if none can be made. */
fmi2Component unit_create(const Unit *unit);

/* From instantiation or reset to the first communication point, with the brake pulled. */
bool unit_start(const Unit *unit, fmi2Component component);

/* Figure 8: six seconds from the first communication point in steps of 10 ms. */
bool unit_brake(const Unit *unit, fmi2Component component, Rows rows);

#endif
