#include "snapshot.h"

#include <string.h>

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

void snapshot_take(const Instance *instance, Snapshot *snapshot)
{
    memset(snapshot, 0, sizeof *snapshot);
    memcpy(&snapshot->state, &instance->state, sizeof snapshot->state);
    snapshot->stamp.magic = MAGIC;
    snapshot->stamp.size = sizeof *snapshot;
    memcpy(snapshot->stamp.token, MODEL_TOKEN, sizeof MODEL_TOKEN);
}

/* NULL if a snapshot of `size` bytes is one of this model, otherwise why not. */
static const char *obstacle(const Snapshot *snapshot, size_t size)
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

Status snapshot_restore(Instance *instance, const Snapshot *snapshot)
{
    Message why;
    const char *text = obstacle(snapshot, sizeof *snapshot);
    if (text == NULL && snapshot->state.use != instance->state.use) {
        text =
            "this is the state of an instance that is used in another way (Co-Simulation with or without event mode, "
            "or Model Exchange)";
    }
    if (text != NULL) {
        message_write(&why, "%s", text);
        return instance_refuse(instance, &why);
    }
    memcpy(&instance->state, &snapshot->state, sizeof instance->state);
    return STATUS_OK;
}

void snapshot_write(const Snapshot *snapshot, void *bytes)
{
    Stamp stamp = snapshot->stamp;
    stamp.checksum = checksum(&snapshot->state);
    memcpy(bytes, snapshot, sizeof *snapshot);
    memcpy(bytes, &stamp, sizeof stamp);
}

Status snapshot_read(const Instance *instance, const void *bytes, size_t size, Snapshot *snapshot)
{
    Snapshot read;
    Message why;
    memset(&read, 0, sizeof read);
    memcpy(&read, bytes, size < sizeof read ? size : sizeof read);
    const char *text = obstacle(&read, size);
    if (text == NULL && read.stamp.checksum != checksum(&read.state)) {
        text = "the bytes of this state are damaged";
    }
    if (text != NULL) {
        message_write(&why, "%s", text);
        return instance_refuse(instance, &why);
    }
    memcpy(snapshot, &read, sizeof read);
    return STATUS_OK;
}
