#include "unit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif

/* Objects and functions have pointers of different types in C: copy the bits. */
static bool find(void *library, const char *name, void *function)
{
#ifdef _WIN32
    const FARPROC address = GetProcAddress((HMODULE)library, name);
#else
    void *const address = dlsym(library, name);
#endif
    if (address == NULL) {
        (void)fprintf(stderr, "%s is missing\n", name);
        return false;
    }
    memcpy(function, &address, sizeof address);
    return true;
}

static void *open_library(const char *path)
{
#ifdef _WIN32
    void *library = (void *)LoadLibraryA(path);
#else
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
#endif
    if (library == NULL) {
        (void)fprintf(stderr, "%s does not load\n", path);
    }
    return library;
}

bool unit_load(Unit *unit, int argc, char **argv)
{
    if (argc < 5 || argc > 4 + MAX_OUTPUTS) {
        (void)fprintf(stderr, "usage: %s LIBRARY GUID BRAKE_TORQUE OUTPUT...\n", argv[0]);
        return false;
    }
    unit->guid = argv[2];
    unit->brake_torque = (fmi2ValueReference)strtoul(argv[3], NULL, 10);
    unit->n_outputs = (size_t)argc - 4;
    for (size_t i = 0; i < unit->n_outputs; i++) {
        unit->outputs[i] = (fmi2ValueReference)strtoul(argv[4 + i], NULL, 10);
    }
    void *library = open_library(argv[1]);
    return library != NULL && find(library, "fmi2Instantiate", &unit->instantiate) &&
           find(library, "fmi2SetupExperiment", &unit->setup) &&
           find(library, "fmi2EnterInitializationMode", &unit->enter_initialization) &&
           find(library, "fmi2ExitInitializationMode", &unit->exit_initialization) &&
           find(library, "fmi2SetReal", &unit->set_real) && find(library, "fmi2GetReal", &unit->get_real) &&
           find(library, "fmi2DoStep", &unit->do_step) && find(library, "fmi2Reset", &unit->reset) &&
           find(library, "fmi2Terminate", &unit->terminate) && find(library, "fmi2FreeInstance", &unit->free_instance);
}

fmi2Component unit_create(const Unit *unit)
{
    static const fmi2CallbackFunctions silent = {0};
    return unit->instantiate("unit", fmi2CoSimulation, unit->guid, NULL, &silent, fmi2False, fmi2False);
}

bool unit_start(const Unit *unit, fmi2Component component)
{
    const double torque = 1000.0; /* N.m */
    return unit->setup(component, fmi2False, 0.0, 0.0, fmi2False, 0.0) == fmi2OK &&
           unit->enter_initialization(component) == fmi2OK &&
           unit->set_real(component, &unit->brake_torque, 1, &torque) == fmi2OK &&
           unit->exit_initialization(component) == fmi2OK;
}

bool unit_brake(const Unit *unit, fmi2Component component, Rows rows)
{
    const double size = 0.01; /* s */
    bool fine = unit->get_real(component, unit->outputs, unit->n_outputs, rows[0]) == fmi2OK;
    for (int i = 0; i < STEPS && fine; i++) {
        fine = unit->do_step(component, i * size, size, fmi2True) == fmi2OK &&
               unit->get_real(component, unit->outputs, unit->n_outputs, rows[i + 1]) == fmi2OK;
    }
    return fine;
}
