/* FMI 2.0: saved states. */
#include "fmi2_component.h"
#include "snapshot.h"

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) { return to_fmi2(snapshot_get(c, FMUstate)); }

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate) { return to_fmi2(snapshot_set(c, FMUstate)); }

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) { return to_fmi2(snapshot_free(c, FMUstate)); }

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate, size_t *size)
{
    return to_fmi2(snapshot_size(c, FMUstate, size));
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate, fmi2Byte serializedState[], size_t size)
{
    return to_fmi2(snapshot_write(c, FMUstate, serializedState, size));
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte serializedState[], size_t size,
                                   fmi2FMUstate *FMUstate)
{
    return to_fmi2(snapshot_read(c, serializedState, size, FMUstate));
}
