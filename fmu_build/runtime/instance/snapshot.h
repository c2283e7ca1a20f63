/* Saved states: kept in memory, or as bytes that another process with the same model can read. */
#ifndef SNAPSHOT_H
#define SNAPSHOT_H

#include <stdint.h>

#include "instance.h"

typedef struct {
    uint64_t magic; /* kind and version of the layout; reads differently in another byte order */
    char token[(sizeof MODEL_TOKEN + 7) / 8 * 8]; /* so that there are no gaps */
    uint64_t size;                                /* of a Snapshot */
    uint64_t checksum;                            /* of the state; of use in bytes only */
} Stamp;

typedef struct {
    Stamp stamp;
    State state;
} Snapshot;

void snapshot_take(const Instance *instance, Snapshot *snapshot);

/* Refused if the snapshot was taken of an instance that is used in another way. */
Status snapshot_restore(Instance *instance, const Snapshot *snapshot);

/* bytes: sizeof(Snapshot) of them. */
void snapshot_write(const Snapshot *snapshot, void *bytes);

/* Bytes to a snapshot; refused, with nothing written, if they are not one of this very model, or damaged. */
Status snapshot_read(const Instance *instance, const void *bytes, size_t size, Snapshot *snapshot);

#endif
