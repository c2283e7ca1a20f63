#include "snapshot.h"

#include <stdint.h>
#include <string.h>

#include "log.h"
#include "state_check.h"

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

static const uint64_t MAGIC = 0x464D555354415431u; /* FMUSTAT1 */

/* FNV-1a, see draft-eastlake-fnv: against damage, not against intent. */
static uint64_t checksum(const State *state)
{
    const unsigned char *bytes = (const unsigned char *)state;
    uint64_t sum = 0xcbf29ce484222325u;
    for (size_t i = 0; i < sizeof *state; i++) {
        sum = (sum ^ bytes[i]) * 0x100000001b3u;
    }
    return sum;
}

static void take(const Instance *instance, Snapshot *snapshot)
{
    memset(snapshot, 0, sizeof *snapshot);
    memcpy(&snapshot->state, &instance->state, sizeof snapshot->state);
    snapshot->stamp.magic = MAGIC;
    snapshot->stamp.size = sizeof *snapshot;
    memcpy(snapshot->stamp.token, MODEL_TOKEN, sizeof MODEL_TOKEN);
}

/* NULL if a snapshot of `size` bytes is one of this model, otherwise why not. */
static const char *foreign(const Snapshot *snapshot, size_t size)
{
    static const char token[sizeof snapshot->stamp.token] = MODEL_TOKEN;
    const Stamp *stamp = &snapshot->stamp;
    if (size < sizeof *stamp || stamp->magic != MAGIC) {
        return "these are not the bytes of a state, or those of another kind of machine";
    }
    if (memcmp(stamp->token, token, sizeof token) != 0) {
        return "this is the state of another model, or of another version of this model";
    }
    return size == stamp->size && size == sizeof *snapshot ? NULL : "the bytes of this state are not complete";
}

static Status refuse_snapshot(const Instance *instance, const char *text)
{
    Message why;
    message_write(&why, "%s", text);
    return log_error(instance, &why);
}

/* Room for a snapshot where there is none yet. */
static Status make_room(Instance *instance, void **slot)
{
    Message why;
    if (*slot == NULL) {
        *slot = instance->caller.allocate(1, sizeof(Snapshot));
    }
    if (*slot == NULL) {
        message_write(&why, "%s: there is no memory for a state", call_name(instance, GET_FMU_STATE));
        return log_error(instance, &why);
    }
    return STATUS_OK;
}

Status snapshot_get(Instance *instance, void **slot)
{
    if (!call_is_complete(instance, GET_FMU_STATE, slot != NULL) || make_room(instance, slot) != STATUS_OK) {
        return STATUS_ERROR;
    }
    take(instance, *slot);
    return STATUS_OK;
}

Status snapshot_set(Instance *instance, const void *saved)
{
    const Snapshot *snapshot = saved;
    if (!call_is_complete(instance, SET_FMU_STATE, saved != NULL)) {
        return STATUS_ERROR;
    }
    const char *text = foreign(snapshot, sizeof *snapshot);
    if (text == NULL && snapshot->state.use != instance->state.use) {
        text =
            "this is the state of an instance that is used in another way (Co-Simulation with or without event mode, "
            "or Model Exchange)";
    }
    if (text != NULL) {
        return refuse_snapshot(instance, text);
    }
    memcpy(&instance->state, &snapshot->state, sizeof instance->state);
    return STATUS_OK;
}

Status snapshot_free(Instance *instance, void **slot)
{
    if (!call_is_legal(instance, FREE_FMU_STATE)) {
        return STATUS_ERROR;
    }
    if (slot != NULL && *slot != NULL) {
        instance->caller.release(*slot);
        *slot = NULL;
    }
    return STATUS_OK;
}

Status snapshot_size(Instance *instance, const void *saved, size_t *size)
{
    if (!call_is_complete(instance, SERIALIZED_FMU_STATE_SIZE, saved != NULL && size != NULL)) {
        return STATUS_ERROR;
    }
    *size = sizeof(Snapshot);
    return STATUS_OK;
}

Status snapshot_write(Instance *instance, const void *saved, void *bytes, size_t size)
{
    const Snapshot *snapshot = saved;
    if (!call_is_complete(instance, SERIALIZE_FMU_STATE, saved != NULL && bytes != NULL) ||
        (size < sizeof *snapshot && !call_has_length(instance, SERIALIZE_FMU_STATE, size, sizeof *snapshot))) {
        return STATUS_ERROR;
    }
    Stamp stamp = snapshot->stamp;
    stamp.checksum = checksum(&snapshot->state);
    memcpy(bytes, snapshot, sizeof *snapshot);
    memcpy(bytes, &stamp, sizeof stamp);
    return STATUS_OK;
}

Status snapshot_read(Instance *instance, const void *bytes, size_t size, void **slot)
{
    Snapshot read;
    Message why;
    if (!call_is_complete(instance, DESERIALIZE_FMU_STATE, bytes != NULL && slot != NULL)) {
        return STATUS_ERROR;
    }
    memset(&read, 0, sizeof read);
    memcpy(&read, bytes, size < sizeof read ? size : sizeof read);
    const char *text = foreign(&read, size);
    if (text == NULL && read.stamp.checksum != checksum(&read.state)) {
        text = "the bytes of this state are damaged";
    }
    if (text != NULL) {
        return refuse_snapshot(instance, text);
    }
    if (!state_check(&read.state, &why)) {
        return log_error(instance, &why);
    }
    if (make_room(instance, slot) != STATUS_OK) {
        return STATUS_ERROR;
    }
    memcpy(*slot, &read, sizeof read);
    return STATUS_OK;
}
