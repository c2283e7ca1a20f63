/* FMI 3.0: partial derivatives, and what depends on what. All variables are scalars, so that each has one seed. */
#include "derivatives.h"
#include "fmi3_component.h"

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns,
                                        const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[],
                                        size_t nSeed, fmi3Float64 sensitivity[], size_t nSensitivity)
{
    return to_fmi3(derivatives_chain(instance, GET_DIRECTIONAL_DERIVATIVE, (References){unknowns, nUnknowns},
                                     (References){knowns, nKnowns}, seed, nSeed, sensitivity, nSensitivity));
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns,
                                    const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[],
                                    size_t nSeed, fmi3Float64 sensitivity[], size_t nSensitivity)
{
    return to_fmi3(derivatives_chain(instance, GET_ADJOINT_DERIVATIVE, (References){unknowns, nUnknowns},
                                     (References){knowns, nKnowns}, seed, nSeed, sensitivity, nSensitivity));
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference valueReference,
                                               size_t *nDependencies)
{
    if (!call_is_complete(instance, GET_NUMBER_OF_VARIABLE_DEPENDENCIES, nDependencies != NULL)) {
        return fmi3Error;
    }
    return to_fmi3(derivatives_dependencies(instance, valueReference, NULL, 0, nDependencies));
}

/* Index 0 stands for all elements of a variable; each has one. */
fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent,
                                       size_t elementIndicesOfDependent[], fmi3ValueReference independents[],
                                       size_t elementIndicesOfIndependents[], fmi3DependencyKind dependencyKinds[],
                                       size_t nDependencies)
{
    const bool given = elementIndicesOfDependent != NULL && independents != NULL &&
                       elementIndicesOfIndependents != NULL && dependencyKinds != NULL;
    size_t count = 0;
    if (!call_is_complete(instance, GET_VARIABLE_DEPENDENCIES, nDependencies == 0 || given)) {
        return fmi3Error;
    }
    const Status status = derivatives_dependencies(instance, dependent, independents, nDependencies, &count);
    if (status != STATUS_OK) {
        return to_fmi3(status);
    }
    if (!call_has_length(instance, GET_VARIABLE_DEPENDENCIES, nDependencies, count)) {
        return fmi3Error;
    }
    for (size_t i = 0; i < count; i++) {
        elementIndicesOfDependent[i] = 0;
        elementIndicesOfIndependents[i] = 0;
        dependencyKinds[i] = fmi3Dependent;
    }
    return fmi3OK;
}
