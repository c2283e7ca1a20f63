"""A model written by hand, without the generator: its C as the runtime wants it, from a few lines for each part."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from fmu_build.codegen.elimination import print_elimination
from fmu_build.equations.elimination import eliminate

TOKEN = "{0c9d3f3e-hand-written}"


@dataclass(frozen=True)
class Variable:
    name: str
    start: float = 0.0
    unit: str = "1"
    min: float = -inf
    max: float = inf
    nominal: float = 1.0
    kind: str = ""


@dataclass(frozen=True)
class Model:
    """C statements read and write `v->name`; `holds`, `z`, `jacobian` and `time_derivative` as in model.h.

    A jacobian is given as the entries that are not zero: {(row, column): expression}; column -1 is the time.
    Tangents and adjoints are made of central differences: enough where they are not what is tested.
    """

    name: str
    states: tuple[Variable, ...]
    derivatives: str
    jacobian: dict[tuple[int, int], str]
    inputs: tuple[Variable, ...] = ()
    parameters: tuple[Variable, ...] = ()
    calculated: tuple[Variable, ...] = ()
    others: tuple[Variable, ...] = ()
    parameter_equations: str = ""
    start_equations: str = ""
    outputs: str = ""
    relations: tuple[tuple[str, str], ...] = ()  # (text, residual)
    tolerance: float = 1e-6

    def variables(self) -> list[Variable]:
        def kind(variables: tuple[Variable, ...], default: str) -> list[Variable]:
            return [Variable(v.name, v.start, v.unit, v.min, v.max, v.nominal, v.kind or default) for v in variables]

        return [
            Variable("time", unit="s", kind="TIME"),
            *kind(self.states, "STATE"),
            *[Variable(f"der_{v.name}", kind="DERIVATIVE") for v in self.states],
            *kind(self.inputs, "INPUT"),
            *kind(self.parameters, "PARAMETER"),
            *kind(self.calculated, "CALCULATED_PARAMETER"),
            *kind(self.others, "OTHER"),
            *[Variable(f"residual_{i}", kind="OTHER") for i in range(len(self.relations))],
        ]

    def references(self) -> dict[str, int]:
        return {v.name: i for i, v in enumerate(self.variables())}

    def files(self) -> dict[str, str]:
        """The generated files: what the runtime's sources are compiled with."""
        entries = [place for place in self.jacobian if place[1] >= 0]
        algebra = print_elimination(eliminate(entries, len(self.states)))
        return {"unit.h": "", "variables.h": self.header(), "model.c": self.source(), **algebra.files}

    def header(self) -> str:
        names = " ".join(f"double {v.name};" for v in self.variables())
        return f"""#ifndef VARIABLES_H
#define VARIABLES_H
#define MODEL_NAME "{self.name}"
#define MODEL_TOKEN "{TOKEN}"
#define DEFAULT_TOLERANCE {self.tolerance!r}
#define N_COUPLINGS 0
#define HAS_EVENTS 0
enum {{
    N_STATES = {len(self.states)},
    N_INPUTS = {len(self.inputs)},
    N_PARAMETERS = {len(self.parameters)},
    N_RELATIONS = {len(self.relations)},
    N_VARIABLES = {len(self.variables())}
}};
typedef union {{
    struct {{ {names} }};
    double at[N_VARIABLES];
}} Variables;
#endif
"""

    def source(self) -> str:
        rows = ",\n".join(
            f'    {{"{v.name}", "{v.unit}", REAL, {v.kind}, {c(v.start)}, {c(v.min)}, {c(v.max)}, {c(v.nominal)}}}'
            for v in self.variables()
        )
        texts = ", ".join(f'"{text}"' for text, _ in self.relations) or '""'
        slopes = [e for (_, j), e in self.jacobian.items() if j >= 0]
        entries = "\n".join(
            [f"    jacobian[{index}] = {e};" for index, e in enumerate(slopes)]
            + [f"    time_derivative[{i}] = {e};" for (i, j), e in self.jacobian.items() if j < 0]
        )
        residuals = "\n".join(f"    z[{i}] = v->residual_{i} = {e};" for i, (_, e) in enumerate(self.relations))
        references = ", ".join(str(self.references()[f"residual_{i}"]) for i in range(len(self.relations))) or "0"
        return f"""#include <math.h>
#include "model.h"
const VariableInfo variable_info[N_VARIABLES] = {{
{rows}
}};
const char *const relation_text[AT_LEAST_ONE(N_RELATIONS)] = {{{texts}}};
const unsigned relation_reference[AT_LEAST_ONE(N_RELATIONS)] = {{{references}}};
void model_parameters(Variables *v) {{
    (void)v;
    {self.parameter_equations}
}}
void model_steady(Variables *v) {{
    (void)v;
}}
const bool moves_steady[AT_LEAST_ONE(N_INPUTS)] = {{false}};
void model_start(Variables *v, const bool holds[]) {{
    (void)v;
    (void)holds;
    {self.start_equations}
}}
void model_derivatives(Variables *v, const bool holds[]) {{
    (void)v;
    (void)holds;
    {self.derivatives}
}}
const bool moves_truths[AT_LEAST_ONE(N_INPUTS)] = {{{", ".join(["true"] * len(self.inputs)) or "true"}}};
void model_derivatives_by(Variables *v, const bool holds[], int input) {{
    (void)input;
    model_derivatives(v, holds);
}}
void model_outputs(Variables *v, const bool holds[]) {{
    double z[AT_LEAST_ONE(N_RELATIONS)];
    model_derivatives(v, holds);
    model_relations(v, holds, z);
    {self.outputs}
}}
void model_jacobian(const Variables *v, const bool holds[], double jacobian[], double time_derivative[]) {{
    (void)v;
    (void)holds;
    (void)jacobian;
    for (int i = 0; i < N_STATES; i++) {{
        time_derivative[i] = 0.0;
    }}
{entries}
}}
void model_relations(Variables *v, const bool holds[], double z[]) {{
    (void)v;
    (void)holds;
    (void)z;
{residuals}
}}
{DIFFERENCES}"""


DIFFERENCES = """
static bool is_given(int i, bool at_start) {
    const VariableKind kind = variable_info[i].kind;
    return kind == TIME || kind == STATE || kind == INPUT || kind == PARAMETER || kind == FIXED_PARAMETER
        || (kind == STATE_CALCULATED && !at_start);
}
static Variables moved(const Variables *v, const bool holds[], bool at_start, const Variables *d, double way) {
    Variables w = *v;
    for (int i = 0; i < N_VARIABLES; i++) {
        if (is_given(i, at_start)) w.at[i] += way * d->at[i];
    }
    model_parameters(&w);
    if (at_start) model_start(&w, holds);
    model_outputs(&w, holds);
    return w;
}
void model_tangent(const Variables *v, const bool holds[], bool at_start, Variables *d) {
    const double way = 1e-6;
    const Variables up = moved(v, holds, at_start, d, way);
    const Variables down = moved(v, holds, at_start, d, -way);
    for (int i = 0; i < N_VARIABLES; i++) {
        if (!is_given(i, at_start)) d->at[i] = (up.at[i] - down.at[i]) / (2.0 * way);
    }
}
void model_input_tangent(const Variables *v, const bool holds[], Variables *d) {
    model_tangent(v, holds, false, d);
}
void model_adjoint(const Variables *v, const bool holds[], bool at_start, Variables *d) {
    for (int i = 0; i < N_VARIABLES; i++) {
        Variables e = {.at = {0.0}};
        e.at[i] = 1.0;
        if (!is_given(i, at_start)) continue;
        model_tangent(v, holds, at_start, &e);
        for (int j = 0; j < N_VARIABLES; j++) {
            if (!is_given(j, at_start)) d->at[i] += e.at[j] * d->at[j];
        }
    }
}
"""


def c(value: float) -> str:
    return "(double)INFINITY" if value == inf else "-(double)INFINITY" if value == -inf else repr(float(value))
