/* FMI 3.0: saved states. */
#include <stdlib.h>
#include <string.h>

#include "fmi3_component.h"
#include "snapshot.h"

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *FMUState)
{
    Component *component = legal(instance, GET_FMU_STATE);
    Message message;
    if (component == NULL) {
        return fmi3Error;
    }
    if (FMUState == NULL) {
        return null_argument(component, GET_FMU_STATE);
    }
    if (*FMUState == NULL) {
        *FMUState = calloc(1, sizeof(Snapshot));
    }
    if (*FMUState == NULL) {
        message_write(&message, "fmi3GetFMUState: there is no memory for a state");
        return report(component, STATUS_ERROR, &message);
    }
    snapshot_take(&component->instance, *FMUState);
    return fmi3OK;
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState FMUState)
{
    Component *component = legal(instance, SET_FMU_STATE);
    if (component == NULL) {
        return fmi3Error;
    }
    if (FMUState == NULL) {
        return null_argument(component, SET_FMU_STATE);
    }
    return to_fmi3(snapshot_restore(&component->instance, FMUState));
}

/* Freeing nothing is fine, as with free. */
fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *FMUState)
{
    Component *component = legal(instance, FREE_FMU_STATE);
    if (component == NULL) {
        return fmi3Error;
    }
    if (FMUState != NULL && *FMUState != NULL) {
        free(*FMUState);
        *FMUState = NULL;
    }
    return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState FMUState, size_t *size)
{
    Component *component = legal(instance, SERIALIZED_FMU_STATE_SIZE);
    if (component == NULL) {
        return fmi3Error;
    }
    if (FMUState == NULL || size == NULL) {
        return null_argument(component, SERIALIZED_FMU_STATE_SIZE);
    }
    *size = sizeof(Snapshot);
    return fmi3OK;
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState FMUState, fmi3Byte serializedState[], size_t size)
{
    Component *component = legal(instance, SERIALIZE_FMU_STATE);
    if (component == NULL) {
        return fmi3Error;
    }
    if (FMUState == NULL || serializedState == NULL) {
        return null_argument(component, SERIALIZE_FMU_STATE);
    }
    if (size < sizeof(Snapshot)) {
        return wrong_length(component, SERIALIZE_FMU_STATE, size, sizeof(Snapshot));
    }
    snapshot_write(FMUState, serializedState);
    return fmi3OK;
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte serializedState[], size_t size,
                                   fmi3FMUState *FMUState)
{
    Component *component = legal(instance, DESERIALIZE_FMU_STATE);
    Snapshot snapshot;
    if (component == NULL) {
        return fmi3Error;
    }
    if (serializedState == NULL || FMUState == NULL) {
        return null_argument(component, DESERIALIZE_FMU_STATE);
    }
    const fmi3Status status = to_fmi3(snapshot_read(&component->instance, serializedState, size, &snapshot));
    if (status != fmi3OK) {
        return status;
    }
    const fmi3Status made = fmi3GetFMUState(instance, FMUState); /* room for it */
    if (made == fmi3OK) {
        memcpy(*FMUState, &snapshot, sizeof snapshot);
    }
    return made;
}
