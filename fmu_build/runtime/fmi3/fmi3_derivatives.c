/* FMI 3.0: partial derivatives, and what depends on what. All variables are scalars, so that each has one seed. */
#include "derivatives.h"
#include "fmi3_component.h"

typedef Status Chain(Instance *instance, References unknown, References known, const double seed[],
                     double sensitivity[]);

/* n_seed and n_sensitivity must be those of the lists that they belong to. */
static fmi3Status chain(fmi3Instance instance, Function function, References unknown, References known,
                        const fmi3Float64 seed[], size_t n_seed, fmi3Float64 sensitivity[], size_t n_sensitivity)
{
    const bool forward = function == GET_DIRECTIONAL_DERIVATIVE;
    const References from = forward ? known : unknown;
    const References to = forward ? unknown : known;
    Component *component = legal_array(instance, function, seed, n_seed, from.n);
    if (component == NULL) {
        return fmi3Error;
    }
    if (n_sensitivity != to.n) {
        return wrong_length(component, function, n_sensitivity, to.n);
    }
    if ((from.n > 0 && from.references == NULL) || (to.n > 0 && (to.references == NULL || sensitivity == NULL))) {
        return null_argument(component, function);
    }
    Chain *const calculate = forward ? instance_directional : instance_adjoint;
    return to_fmi3(calculate(&component->instance, unknown, known, seed, sensitivity));
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns,
                                        const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[],
                                        size_t nSeed, fmi3Float64 sensitivity[], size_t nSensitivity)
{
    return chain(instance, GET_DIRECTIONAL_DERIVATIVE, (References){unknowns, nUnknowns}, (References){knowns, nKnowns},
                 seed, nSeed, sensitivity, nSensitivity);
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns,
                                    const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[],
                                    size_t nSeed, fmi3Float64 sensitivity[], size_t nSensitivity)
{
    return chain(instance, GET_ADJOINT_DERIVATIVE, (References){unknowns, nUnknowns}, (References){knowns, nKnowns},
                 seed, nSeed, sensitivity, nSensitivity);
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference valueReference,
                                               size_t *nDependencies)
{
    Component *component = legal(instance, GET_NUMBER_OF_VARIABLE_DEPENDENCIES);
    if (component == NULL) {
        return fmi3Error;
    }
    if (nDependencies == NULL) {
        return null_argument(component, GET_NUMBER_OF_VARIABLE_DEPENDENCIES);
    }
    return to_fmi3(instance_dependencies(&component->instance, valueReference, NULL, 0, nDependencies));
}

/* Index 0 stands for all elements of a variable; each has one. */
fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent,
                                       size_t elementIndicesOfDependent[], fmi3ValueReference independents[],
                                       size_t elementIndicesOfIndependents[], fmi3DependencyKind dependencyKinds[],
                                       size_t nDependencies)
{
    Component *component = legal(instance, GET_VARIABLE_DEPENDENCIES);
    size_t count = 0;
    if (component == NULL) {
        return fmi3Error;
    }
    if (nDependencies > 0 && (elementIndicesOfDependent == NULL || independents == NULL ||
                              elementIndicesOfIndependents == NULL || dependencyKinds == NULL)) {
        return null_argument(component, GET_VARIABLE_DEPENDENCIES);
    }
    const Status status = instance_dependencies(&component->instance, dependent, independents, nDependencies, &count);
    if (status != STATUS_OK) {
        return to_fmi3(status);
    }
    if (count != nDependencies) {
        return wrong_length(component, GET_VARIABLE_DEPENDENCIES, nDependencies, count);
    }
    for (size_t i = 0; i < count; i++) {
        elementIndicesOfDependent[i] = 0;
        elementIndicesOfIndependents[i] = 0;
        dependencyKinds[i] = fmi3Dependent;
    }
    return fmi3OK;
}
