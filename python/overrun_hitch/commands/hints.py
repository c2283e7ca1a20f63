"""Hints on stderr about input that is allowed and hardly meant. They change no exit status."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING

from overrun_hitch.parameters import DATUM, HitchError, Parameters
from overrun_hitch.theory.steady import steady
from overrun_hitch.theory.working_point import g_n

if TYPE_CHECKING:
    from overrun_hitch.sweeps.plan import Plan

FASTEST = 70.0  # m/s
LARGEST_WHEEL = 2.0  # m
LINEAR_SLIP = 0.1  # up to which the tyre force is in proportion to slip


def hint(parameters: Parameters, brake_torque: float = 0.0) -> None:
    """Print a line for each thing that looks like a slip of the pen; brake_torque in N.m, steady."""
    for line in hints(parameters, brake_torque):
        print(f"hint: {line}", file=sys.stderr)


def hint_sweep(plan: Plan) -> None:
    """The same, each line once, for the runs in which something that varies is least or greatest."""
    rows = {0, *(int(row) for column in plan.columns.values() for row in (column.argmin(), column.argmax()))}
    lines: dict[str, None] = {}
    for row in sorted(rows):
        values = {**plan.job.fixed, **{name: float(column[row]) for name, column in plan.columns.items()}}
        try:
            parameters = Parameters(**{name: values[name] for name in Parameters.model_fields})
        except HitchError:  # what does not go together: that run's own message says so
            continue
        lines |= dict.fromkeys(hints(parameters, values.get("brake_torque", 0.0)))  # of profiles nothing is said
    for line in lines:
        print(f"hint: {line}", file=sys.stderr)


def hints(parameters: Parameters, brake_torque: float = 0.0) -> Iterator[str]:
    """The lines."""
    p = parameters
    if abs(p.V_0) > FASTEST:
        yield f"V_0 = {p.V_0:g} m/s is {3.6 * p.V_0:g} km/h; speeds are in m/s"
    for name, radius in (("R_c", p.R_c), ("R_t", p.R_t)):
        if radius > LARGEST_WHEEL:
            yield f"{name} = {radius:g} m is a large wheel; radii are in m"
    yield from _braking_hints(p, brake_torque)


def _braking_hints(p: Parameters, brake_torque: float) -> Iterator[str]:
    try:
        A = -steady(p, brake_torque).A
    except HitchError:
        return
    if brake_torque > p.mu * p.M_c * g_n * p.R_c:
        yield f"{brake_torque:g} N.m is more than friction, mu = {p.mu:g}, can hold: the car's wheels lock"
    if g_n < A:
        yield f"{brake_torque:g} N.m would brake by {A:.3g} m/s2, more than 1 g"
    slip = (brake_torque / p.R_c - p.I_c / p.R_c**2 * A) / p.C_kc
    if p.mu == DATUM.mu and slip > LINEAR_SLIP:
        yield f"the car's slip would be {slip:.2g}; beyond {LINEAR_SLIP:g} a tyre needs its friction, mu"
