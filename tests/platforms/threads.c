/* Eight instances in eight threads, bit by bit the run of one alone; exit status 0 if so. */
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "unit.h"

enum { THREADS = 8 };

typedef struct {
    const Unit *unit;
    bool fine;
    Rows rows;
} Run;

static void *run(void *argument)
{
    Run *r = argument;
    fmi2Component component = unit_create(r->unit);
    r->fine = component != NULL && unit_start(r->unit, component) && unit_brake(r->unit, component, r->rows);
    r->unit->free_instance(component);
    return NULL;
}

int main(int argc, char **argv)
{
    static Run alone;
    static Run runs[THREADS];
    pthread_t threads[THREADS];
    Unit unit;
    if (!unit_load(&unit, argc, argv)) {
        return 2;
    }
    alone.unit = &unit;
    (void)run(&alone);
    for (int i = 0; i < THREADS; i++) {
        runs[i].unit = &unit;
        if (pthread_create(&threads[i], NULL, run, &runs[i]) != 0) {
            (void)fprintf(stderr, "thread %d does not start\n", i);
            return 2;
        }
    }
    int different = alone.fine ? 0 : 1;
    for (int i = 0; i < THREADS; i++) {
        (void)pthread_join(threads[i], NULL);
        different += !runs[i].fine || memcmp(runs[i].rows, alone.rows, sizeof alone.rows) != 0;
    }
    (void)printf("%d runs failed or differ\n", different);
    return different == 0 ? 0 : 1;
}
