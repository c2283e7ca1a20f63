/* FMI 2.0: saved states. */
#include <string.h>

#include "fmi2_component.h"
#include "snapshot.h"

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *FMUstate)
{
    Component *component = legal(c, GET_FMU_STATE);
    Message message;
    if (component == NULL) {
        return fmi2Error;
    }
    if (FMUstate == NULL) {
        return null_argument(component, GET_FMU_STATE);
    }
    if (*FMUstate == NULL) {
        *FMUstate = allocate(&component->callbacks, sizeof(Snapshot));
    }
    if (*FMUstate == NULL) {
        message_write(&message, "fmi2GetFMUstate: there is no memory for a state");
        return report(component, STATUS_ERROR, &message);
    }
    snapshot_take(&component->instance, *FMUstate);
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate)
{
    Component *component = legal(c, SET_FMU_STATE);
    if (component == NULL) {
        return fmi2Error;
    }
    if (FMUstate == NULL) {
        return null_argument(component, SET_FMU_STATE);
    }
    return to_fmi2(snapshot_restore(&component->instance, FMUstate));
}

/* Freeing nothing is fine, as with free. */
fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *FMUstate)
{
    Component *component = legal(c, FREE_FMU_STATE);
    if (component == NULL) {
        return fmi2Error;
    }
    if (FMUstate != NULL && *FMUstate != NULL) {
        release(&component->callbacks, *FMUstate);
        *FMUstate = NULL;
    }
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate, size_t *size)
{
    Component *component = legal(c, SERIALIZED_FMU_STATE_SIZE);
    if (component == NULL) {
        return fmi2Error;
    }
    if (FMUstate == NULL || size == NULL) {
        return null_argument(component, SERIALIZED_FMU_STATE_SIZE);
    }
    *size = sizeof(Snapshot);
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate, fmi2Byte serializedState[], size_t size)
{
    Component *component = legal(c, SERIALIZE_FMU_STATE);
    if (component == NULL) {
        return fmi2Error;
    }
    if (FMUstate == NULL || serializedState == NULL) {
        return null_argument(component, SERIALIZE_FMU_STATE);
    }
    if (size < sizeof(Snapshot)) {
        return wrong_length(component, SERIALIZE_FMU_STATE, size, (int)sizeof(Snapshot));
    }
    snapshot_write(FMUstate, serializedState);
    return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte serializedState[], size_t size,
                                   fmi2FMUstate *FMUstate)
{
    Component *component = legal(c, DESERIALIZE_FMU_STATE);
    Snapshot snapshot;
    if (component == NULL) {
        return fmi2Error;
    }
    if (serializedState == NULL || FMUstate == NULL) {
        return null_argument(component, DESERIALIZE_FMU_STATE);
    }
    const fmi2Status status = to_fmi2(snapshot_read(&component->instance, serializedState, size, &snapshot));
    if (status != fmi2OK) {
        return status;
    }
    const fmi2Status made = fmi2GetFMUstate(c, FMUstate); /* room for it */
    if (made == fmi2OK) {
        memcpy(*FMUstate, &snapshot, sizeof snapshot);
    }
    return made;
}
