"""Small hand-written models that satisfy the contract of fmu_build/runtime/model.h, as C text."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from fmu_build.c_elimination import print_elimination
from fmu_build.elimination import eliminate

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
        return {"variables.h": self.header(), "model.c": self.source(), **algebra.files}

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
static bool is_known(int i, bool at_start) {
    const VariableKind kind = variable_info[i].kind;
    return kind == TIME || kind == STATE || kind == INPUT || kind == PARAMETER || kind == FIXED_PARAMETER
        || (kind == STATE_CALCULATED && !at_start);
}
static Variables moved(const Variables *v, const bool holds[], bool at_start, const Variables *d, double way) {
    Variables w = *v;
    for (int i = 0; i < N_VARIABLES; i++) {
        if (is_known(i, at_start)) w.at[i] += way * d->at[i];
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
        if (!is_known(i, at_start)) d->at[i] = (up.at[i] - down.at[i]) / (2.0 * way);
    }
}
void model_adjoint(const Variables *v, const bool holds[], bool at_start, Variables *d) {
    for (int i = 0; i < N_VARIABLES; i++) {
        Variables e = {.at = {0.0}};
        e.at[i] = 1.0;
        if (!is_known(i, at_start)) continue;
        model_tangent(v, holds, at_start, &e);
        for (int j = 0; j < N_VARIABLES; j++) {
            if (!is_known(j, at_start)) d->at[i] += e.at[j] * d->at[j];
        }
    }
}
"""


def c(value: float) -> str:
    return "(double)INFINITY" if value == inf else "-(double)INFINITY" if value == -inf else repr(float(value))


def _car_trailer() -> Model:
    """Sharp (1982), equations 1 to 8 with the drawbar of section 6; figure 8 by default."""
    k = 5480.0
    parameters = (
        Variable("M_c", 1000.0, "kg", 0.001),
        Variable("M_t", 500.0, "kg", 0.001),
        Variable("I_c", 5.0, "kg.m2", 0.001),
        Variable("I_t", 2.5, "kg.m2", 0.001),
        Variable("R_c", 0.35, "m", 0.001),
        Variable("R_t", 0.35, "m", 0.001),
        Variable("C_kc", 400000.0, "N", 0.0),
        Variable("C_kt", 200000.0, "N", 0.0),
        Variable("k", k, "N/m", 0.0),
        Variable("k_t", 100 * k, "N/m", 0.0),
        Variable("C", 500.0, "N.s/m", 0.0),
        Variable("r", 2.975 * k, "N.m/m", 0.0),
        Variable("eps", 0.0, "m", 0.0),
        Variable("V_0", 40.0, "m/s", 0.1),
        Variable("compression_start", 0.0, "m"),
        Variable("x_start", 0.0, "m"),
    )
    derivatives = """
    const double deep = v->x_t - v->x_c - v->eps;
    const double push = holds[0] ? v->k * deep : holds[1] ? v->k_t * (v->x_t - v->x_c) : 0.0;
    const double hitch = v->C * (v->v_c - v->v_t) - push;
    const double brake = holds[0] ? v->r * deep : 0.0;
    const double tyre_c = v->C_kc * (v->v_c - v->R_c * v->w_c) / v->v_c;
    const double tyre_t = v->C_kt * (v->v_t - v->R_t * v->w_t) / v->v_t;
    v->der_x_c = v->v_c;
    v->der_x_t = v->v_t;
    v->der_v_c = (-hitch - tyre_c) / v->M_c;
    v->der_v_t = (hitch - tyre_t) / v->M_t;
    v->der_w_c = (tyre_c * v->R_c - v->brake_torque) / v->I_c;
    v->der_w_t = (tyre_t * v->R_t - brake) / v->I_t;
    """
    slope = "(holds[0] ? v->k : holds[1] ? v->k_t : 0.0)"  # of the push over the compression
    grip_c = "(v->C_kc * v->R_c / v->v_c)"
    grip_t = "(v->C_kt * v->R_t / v->v_t)"
    jacobian = {
        (0, 2): "1.0",
        (1, 3): "1.0",
        (2, 0): f"-{slope} / v->M_c",
        (2, 1): f"{slope} / v->M_c",
        (2, 2): f"(-v->C - {grip_c} * v->w_c / v->v_c) / v->M_c",
        (2, 3): "v->C / v->M_c",
        (2, 4): f"{grip_c} / v->M_c",
        (3, 0): f"{slope} / v->M_t",
        (3, 1): f"-{slope} / v->M_t",
        (3, 2): "v->C / v->M_t",
        (3, 3): f"(-v->C - {grip_t} * v->w_t / v->v_t) / v->M_t",
        (3, 5): f"{grip_t} / v->M_t",
        (4, 2): f"v->R_c * {grip_c} * v->w_c / v->v_c / v->I_c",
        (4, 4): f"-v->R_c * {grip_c} / v->I_c",
        (5, 0): "(holds[0] ? v->r : 0.0) / v->I_t",
        (5, 1): "-(holds[0] ? v->r : 0.0) / v->I_t",
        (5, 3): f"v->R_t * {grip_t} * v->w_t / v->v_t / v->I_t",
        (5, 5): f"-v->R_t * {grip_t} / v->I_t",
    }
    return Model(
        "CarTrailer",
        (
            Variable("x_c", 0.0, "m", kind="STATE_CALCULATED"),
            Variable("x_t", 0.0, "m", kind="STATE_CALCULATED"),
            Variable("v_c", 40.0, "m/s", 0.1, kind="STATE_CALCULATED"),
            Variable("v_t", 40.0, "m/s", 0.1, kind="STATE_CALCULATED"),
            Variable("w_c", 114.0, "rad/s", kind="STATE_CALCULATED", nominal=3.0),
            Variable("w_t", 114.0, "rad/s", kind="STATE_CALCULATED", nominal=3.0),
        ),
        derivatives,
        jacobian,
        inputs=(Variable("brake_torque", 0.0, "N.m", 0.0),),
        parameters=parameters,
        others=(Variable("compression", unit="m"),),
        start_equations="""
    v->x_c = v->x_start;
    v->x_t = v->x_start + v->compression_start;
    v->v_c = v->V_0;
    v->v_t = v->V_0;
    v->w_c = v->V_0 / v->R_c;
    v->w_t = v->V_0 / v->R_t;""",
        outputs="v->compression = v->x_t - v->x_c;",
        relations=(("compression > eps", "v->x_t - v->x_c - v->eps"), ("compression < 0", "-(v->x_t - v->x_c)")),
    )


CAR_TRAILER = _car_trailer()


# Nonlinear, not autonomous: x = sin(t) + 1/2, y = exp(-t) in closed form.
SMOOTH = Model(
    "Smooth",
    (Variable("x", 0.5), Variable("y", 1.0)),
    """
    const double s = sin(v->time) + 0.5;
    v->der_x = cos(v->time) + v->y * (s * s - v->x * v->x);
    v->der_y = -v->y * v->y * exp(v->time) + (v->x - s) * v->y;""",
    {
        (0, 0): "-2.0 * v->x * v->y",
        (0, 1): "(sin(v->time) + 0.5) * (sin(v->time) + 0.5) - v->x * v->x",
        (1, 0): "v->y",
        (1, 1): "-2.0 * v->y * exp(v->time) + v->x - sin(v->time) - 0.5",
        (0, -1): "-sin(v->time) + 2.0 * v->y * (sin(v->time) + 0.5) * cos(v->time)",
        (1, -1): "-v->y * v->y * exp(v->time) - cos(v->time) * v->y",
    },
    others=(Variable("energy", unit="J"),),
    outputs="v->energy = v->x * v->x;",
)

VAN_DER_POL = Model(
    "VanDerPol",
    (Variable("x", 2.0), Variable("y", 0.0)),
    """
    v->der_x = v->y;
    v->der_y = ((1.0 - v->x * v->x) * v->y - v->x) / v->stiffness;""",
    {
        (0, 1): "1.0",
        (1, 0): "(-2.0 * v->x * v->y - 1.0) / v->stiffness",
        (1, 1): "(1.0 - v->x * v->x) / v->stiffness",
    },
    parameters=(Variable("stiffness", 1e-5, min=1e-9),),
)

# Prothero and Robinson: x = cos(t) for every lambda.
PROTHERO_ROBINSON = Model(
    "ProtheroRobinson",
    (Variable("x", 1.0),),
    "v->der_x = -v->rate * (v->x - cos(v->time)) - sin(v->time);",
    {(0, 0): "-v->rate", (0, -1): "-v->rate * sin(v->time) - cos(v->time)"},
    parameters=(Variable("rate", 1e6),),
)

GROWING = Model(
    "Growing",
    (Variable("x", 1.0),),
    "v->der_x = v->rate * v->x;",
    {(0, 0): "v->rate"},
    parameters=(Variable("rate", 1.0),),
)


def _stiffly_tied() -> Model:
    """a + b is tied to zero by an oscillation of the angular frequency w sqrt(2) with p, the first to be eliminated.

    Its small pivot makes factors so large that the other rates drown in their rounding.
    """
    names = ("p", "a", "b", "c", "d")
    rows = ["v->w*(-v->a - v->b)"]
    entries = {(0, 1): "-v->w", (0, 2): "-v->w", (1, 0): "v->w", (2, 0): "v->w"}
    for i, rates in enumerate(TIED_RATES, start=1):
        entries |= {(i, j): repr(rate) for j, rate in enumerate(rates, start=1)}
        tie = "v->w*v->p" if i < 3 else "0.0"
        rows.append(" + ".join([tie, *(f"{rate} * v->{name}" for rate, name in zip(rates, names[1:], strict=True))]))
    return Model(
        "StifflyTied",
        tuple(Variable(name) for name in names),
        "\n".join(f"v->der_{name} = {row};" for name, row in zip(names, rows, strict=True)),
        entries,
        parameters=(Variable("w", 1e8),),
    )


TIED_RATES = ((-1.0, 0.5, 0.3, -0.7), (-0.4, -1.2, 0.6, 0.2), (0.8, -0.3, -0.9, 0.4), (0.1, 0.7, -0.6, -1.1))
STIFFLY_TIED = _stiffly_tied()

# A mass between two springs with a gap: m = 1, stiffness p above the gap, q below zero.
OSCILLATOR = Model(
    "Oscillator",
    (Variable("x", 0.0, "m"), Variable("v", 1.0, "m/s")),
    """
    v->der_x = v->v;
    v->der_v = holds[0] ? -v->p * (v->x - v->gap) : holds[1] ? -v->q * v->x : 0.0;""",
    {(0, 1): "1.0", (1, 0): "holds[0] ? -v->p : holds[1] ? -v->q : 0.0"},
    parameters=(Variable("p", 4.0), Variable("q", 900.0), Variable("gap", 0.0, "m", 0.0)),
    relations=(("x > gap", "v->x - v->gap"), ("x < 0", "-v->x")),
)

# x = t exactly; the relation is true for a moment only.
PULSE = Model(
    "Pulse",
    (Variable("x", 0.0, "m"), Variable("y", 0.0)),
    "v->der_x = 1.0; v->der_y = holds[0] ? 1.0 : 0.0;",
    {},
    parameters=(Variable("centre", 0.5, "m"), Variable("half", 0.05, "m")),
    relations=(("abs(x - centre) < half", "v->half * v->half - (v->x - v->centre) * (v->x - v->centre)"),),
)

# Slides along x = 0: each side pushes to the other.
SLIDING = Model(
    "Sliding",
    (Variable("x", 1.0, "m"),),
    "v->der_x = holds[0] ? -1.0 : 1.0;",
    {},
    relations=(("x > 0", "v->x"),),
)

# x = 1 / (1 - t)
SINGULAR = Model("Singular", (Variable("x", 1.0),), "v->der_x = v->x * v->x;", {(0, 0): "2.0 * v->x"})

# x falls below zero at t = 1; its root, an output, is no number there.
ROOT_OF_NEGATIVE = Model(
    "RootOfNegative",
    (Variable("x", 1.0, "m"),),
    "v->der_x = -1.0;",
    {},
    others=(Variable("root"),),
    outputs="v->root = sqrt(v->x);",
)

# The derivative itself ends at t = 1.
DERIVATIVE_ENDS = Model(
    "DerivativeEnds",
    (Variable("x", 0.0, "m"), Variable("y", 0.0)),
    "v->der_x = 1.0; v->der_y = sqrt(1.0 - v->x);",
    {(1, 0): "-0.5 / sqrt(1.0 - v->x)"},
)

# A truth that contradicts itself.
PARADOX = Model("Paradox", (Variable("x"),), "v->der_x = 0.0;", {}, relations=(("lie", "holds[0] ? -1.0 : 1.0"),))

NO_STATES = Model(
    "NoStates",
    (),
    "",
    {},
    inputs=(Variable("u", 1.0, "N", -10.0, 10.0),),
    others=(Variable("y", unit="N"),),
    outputs="v->y = holds[0] ? 2.0 * v->u : v->u;",
    relations=(("time > 0.255", "v->time - 0.255"),),
)

LAG = Model(
    "Lag",
    (Variable("x"),),
    "v->der_x = v->u - v->x;",
    {(0, 0): "-1.0"},
    inputs=(Variable("u", 0.0, "N", -100.0, 100.0),),
)

# A relation of the input alone.
THRESHOLD = Model(
    "Threshold",
    (Variable("x"),),
    "v->der_x = holds[0] ? 1.0 : 0.0;",
    {},
    inputs=(Variable("u"),),
    parameters=(Variable("limit", 1.0),),
    relations=(("u < limit", "v->limit - v->u"),),
)
