"""Small hand-written models that satisfy the contract of fmu_build/runtime/model.h, as C text."""

from __future__ import annotations

from tests.fmu_build.runtime.hand_written import Model, Variable


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
