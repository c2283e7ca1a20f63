/* Prints the outputs of figure 8's step brake, a line for each communication point, with all their digits. */
#include <stdio.h>

#include "unit.h"

int main(int argc, char **argv)
{
    static Rows rows;
    Unit unit;
    if (!unit_load(&unit, argc, argv)) {
        return 2;
    }
    fmi2Component component = unit_create(&unit);
    if (component == NULL || !unit_start(&unit, component) || !unit_brake(&unit, component, rows)) {
        (void)fprintf(stderr, "the run failed\n");
        return 1;
    }
    unit.free_instance(component);
    for (int i = 0; i <= STEPS; i++) {
        for (size_t j = 0; j < unit.n_outputs; j++) {
            (void)printf("%.17g ", rows[i][j]);
        }
        (void)printf("\n");
    }
    return 0;
}
