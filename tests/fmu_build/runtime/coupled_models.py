"""A hand-written model with a coupling, and the same one without."""

from __future__ import annotations

from dataclasses import dataclass, fields

from fmu_build.ir.models import Across, Coupling, Through
from tests.fmu_build.runtime.hand_written import Model, Variable

COUPLING = Coupling(
    across=(Across("u", "a", None, 1.0),),
    through=(Through("force", "impulse", "mean", "hold"),),
    extrapolate="extrapolation",
    work="work",
    applied="applied",
    energy="energy",
)


@dataclass(frozen=True)
class CoupledModel(Model):
    coupling: Coupling = COUPLING

    def header(self) -> str:
        sizes = f"enum {{ N_ACROSS = {len(self.coupling.across)}, N_THROUGH = {len(self.coupling.through)} }};"
        return super().header().replace("N_COUPLINGS 0", f"N_COUPLINGS 1\n{sizes}")

    def source(self) -> str:
        return f"{super().source()}const CouplingInfo coupling_info = {self.initializer(self.coupling)};\n"

    def initializer(self, value: Coupling | Across | Through | tuple[Across | Through, ...] | str | float) -> str:
        """References of names, within braces as records and lists are; fields in their order, 0 for None."""
        if isinstance(value, str):
            return str(self.references()[value])
        if isinstance(value, float):
            return repr(value)
        parts = value if isinstance(value, tuple) else (getattr(value, f.name) for f in fields(value))
        return f"{{{', '.join('0' if part is None else self.initializer(part) for part in parts)}}}"


def _towed() -> CoupledModel:
    """A mass m behind a ball of the speed u: a damper, and a spring of stiffness k_push (x > 0) or k_pull."""
    stiffness = "(holds[0] ? v->k_push : v->k_pull)"
    force = f"({stiffness} * v->x + v->damping * (v->v - v->u))"
    return CoupledModel(
        "Towed",
        (
            Variable("x", 0.0, "m"),
            Variable("v", 0.0, "m/s", min=-20.0),
            Variable("impulse", 0.0, "N.s"),
            Variable("work", 0.0, "J"),
        ),
        f"""
    const double force = {force};
    v->der_x = v->v - v->u;
    v->der_v = -force / v->m;
    v->der_impulse = force;
    v->der_work = force * v->u;""",
        {
            (0, 1): "1.0",
            (1, 0): f"-{stiffness} / v->m",
            (1, 1): "-v->damping / v->m",
            (2, 0): stiffness,
            (2, 1): "v->damping",
            (3, 0): f"{stiffness} * v->u",
            (3, 1): "v->damping * v->u",
        },
        inputs=(Variable("u", 0.0, "m/s", -50.0, 50.0), Variable("a", 0.0, "m/s2")),
        parameters=(
            Variable("m", 0.5, "kg", 0.001),
            Variable("k_push", 20.0, "N/m", 0.0),
            Variable("k_pull", 20.0, "N/m", 0.0),
            Variable("damping", 0.1, "N.s/m", 0.0),
            Variable("extrapolation", 1.0, "1", 0.0, 1.0),
            Variable("applied", 3.0, "1", 1.0, 3.0),
        ),
        others=(*(Variable(n, unit="N") for n in ("force", "mean", "hold")), Variable("energy", unit="J")),
        outputs=f"v->force = v->mean = v->hold = {force}; v->energy = 0.0;",
        relations=(("x > 0", "v->x"),),
        tolerance=1e-11,
    )


TOWED = _towed()
# The same without its coupling: the input is held, and the outputs are what the equations make them.
_SHARED = {f.name: getattr(TOWED, f.name) for f in fields(Model) if f.name != "name"}
TOWED_PLAIN = Model(name="TowedPlain", **_SHARED)
