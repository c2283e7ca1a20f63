/* Saved states: kept in the caller's memory, or as bytes that another process with the same model can read.
 *
 * Each function is one of the standard's, with what it has to refuse; a saved state is known to its caller by its
 * address alone. */
#ifndef SNAPSHOT_H
#define SNAPSHOT_H

#include "calls.h"

/* Into what *slot points to, or, if that is NULL, into new memory. */
Status snapshot_get(Instance *instance, void **slot);

/* Refused if it was taken of an instance that is used in another way. */
Status snapshot_set(Instance *instance, const void *saved);

/* Freeing nothing is fine, as with free. */
Status snapshot_free(Instance *instance, void **slot);

/* How many bytes snapshot_write needs. */
Status snapshot_size(Instance *instance, const void *saved, size_t *size);
Status snapshot_write(Instance *instance, const void *saved, void *bytes, size_t size);

/* Bytes to a saved state, in *slot as above; refused, with nothing written, if they are not one of this very model,
 * damaged, or made up: see state_check.h. */
Status snapshot_read(Instance *instance, const void *bytes, size_t size, void **slot);

#endif
