/* Prints the growth of the process in bytes over 10000 life cycles, after a tenth of them to warm up. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "unit.h"

enum { CYCLES = 10000 };

/* What was allocated, from the page tables: the kernel's running counts (statm) lag behind by some pages for each
   processor, and pages of files come and go with what else the machine does. */
static long allocated_bytes(void)
{
    char line[128];
    long kilobytes = -1;
    FILE *file = fopen("/proc/self/smaps_rollup", "r");
    while (file != NULL && kilobytes < 0 && fgets(line, sizeof line, file) != NULL) {
        if (strncmp(line, "Anonymous:", 10) == 0) {
            kilobytes = strtol(line + 10, NULL, 10);
        }
    }
    if (file != NULL) {
        (void)fclose(file);
    }
    return 1024 * kilobytes;
}

/* Every third instance is left without being terminated, every seventh is run a second time. */
static bool live(const Unit *unit, int cycle)
{
    double values[MAX_OUTPUTS];
    fmi2Component component = unit_create(unit);
    bool fine = component != NULL && unit_start(unit, component);
    if (fine && cycle % 7 == 0) {
        fine = unit->do_step(component, 0.0, 0.1, fmi2True) == fmi2OK && unit->reset(component) == fmi2OK &&
               unit_start(unit, component);
    }
    fine = fine && unit->do_step(component, 0.0, 0.1, fmi2True) == fmi2OK &&
           unit->get_real(component, unit->outputs, unit->n_outputs, values) == fmi2OK &&
           (cycle % 3 == 0 || unit->terminate(component) == fmi2OK);
    unit->free_instance(component);
    return fine;
}

int main(int argc, char **argv)
{
    Unit unit;
    long before = 0;
    if (!unit_load(&unit, argc, argv)) {
        return 2;
    }
    for (int cycle = 0; cycle < CYCLES; cycle++) {
        if (cycle == CYCLES / 10) {
            before = allocated_bytes();
        }
        if (!live(&unit, cycle)) {
            (void)fprintf(stderr, "life cycle %d failed\n", cycle);
            return 1;
        }
    }
    const long after = allocated_bytes();
    if (before < 0 || after < 0) {
        (void)fprintf(stderr, "the size of the process is not known\n");
        return 2;
    }
    (void)printf("%ld\n", after - before);
    return 0;
}
