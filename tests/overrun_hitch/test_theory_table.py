"""docs/theory.md against the code, and theory against the FMU at a value of every parameter that it takes."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import get_args

import numpy as np
import pytest

from overrun_hitch.experiments.free_vibration import DECELERATION, measured_vibration
from overrun_hitch.experiments.linearisation import at_steady_braking, at_zero_slip
from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.fmu.unit import HitchUnit
from overrun_hitch.parameters import DATUM, InTheory, Parameters
from overrun_hitch.theory.linear import shunting_mode
from overrun_hitch.theory.steady import braking_at
from overrun_hitch.theory.working_point import working_point

TABLE = (Path(__file__).parents[2] / "docs" / "theory.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| `(\w+)` \| (\w+) \| [^|]+ \| (?:`([^`]*)`)? ?\|$", TABLE, re.MULTILINE)
SHOWN = {name: dict(pair.split("=") for pair in values.split(", ")) for name, _, values in ROWS if values}
V = 20.0  # m/s
HARD = 5.0  # m/s2
ROLES: tuple[InTheory, ...] = get_args(InTheory)
UNDER_FRICTION = {"mu": 2e-3, "mu_slide": 2e-3}  # 1/s: theory neglects the slip beside 1
MOVED = {"eps", "F_0", "F_pull_max"}  # these move the point of rest or are not met: the mode stays


@pytest.fixture(scope="module")
def unit(car_trailer_fmu: Path) -> Iterator[HitchUnit]:
    with opened_unit(car_trailer_fmu) as opened:
        yield opened


def shunting(matrix: np.ndarray) -> complex:
    """The slowest oscillating eigenvalue of a combination whose wheels are stiff."""
    values = np.linalg.eigvals(matrix).astype(np.complex128)
    oscillating = values[values.imag > 1e-3]
    return complex(oscillating[np.abs(oscillating).argmin()])


def both(unit: HitchUnit, name: str, p: Parameters) -> tuple[complex, complex]:
    """The eigenvalue (1/s) of the FMU and of theory."""
    if name == "k_t":
        point = working_point(p, HARD)
        assert point.stiffness == "k_t"
        found = shunting(at_zero_slip(unit, p, V, point.compression).fmu)
    elif name in UNDER_FRICTION:
        point = working_point(p, HARD)
        linearisation = at_steady_braking(unit, p, V, braking_at(p, HARD)[2])
        return shunting(linearisation.fmu), complex(shunting_mode(point.linear, linearisation.V).eigenvalue)
    else:
        point = working_point(p, 0.0 if p.F_0 > 0.0 else DECELERATION)
        found = measured_vibration(unit, p, V).eigenvalue
    return found, complex(shunting_mode(point.linear, V).eigenvalue)


def test_the_table_has_every_parameter_as_it_is_declared() -> None:
    declared = [
        (name, role) for name in Parameters.model_fields for role in ROLES if name in Parameters.having("theory", role)
    ]
    assert [(name, role) for name, role, _ in ROWS] == declared
    assert [*SHOWN] == [*Parameters.having("theory", "exact", "small", "approximate")]
    assert all(name in values for name, values in SHOWN.items())


@pytest.mark.parametrize("name", SHOWN)
def test_the_fmu_grows_as_theory_says(unit: HitchUnit, name: str) -> None:
    base = DATUM.changed({"C": 100.0})
    p = base.changed(SHOWN[name])
    found, theory = both(unit, name, p)
    allowed = {**UNDER_FRICTION, "rebound": 0.005 * abs(theory.real)}.get(name, 2e-4)
    print(f"{name}: FMU {found:.5f}, theory {theory:.5f}, difference {abs(found.real - theory.real):.1e} 1/s")
    assert found.real == pytest.approx(theory.real, abs=allowed)
    assert found.imag == pytest.approx(theory.imag, rel=5e-4 if name in UNDER_FRICTION else 1e-4)
    without = complex(shunting_mode(base, V).eigenvalue)
    assert (abs(theory - without) > 3.0 * allowed) != (name in MOVED)


@pytest.mark.parametrize("name", Parameters.having("theory", "outside"))
def test_what_lies_outside_of_theory_does_not_change_it(name: str) -> None:
    changed = DATUM.changed({name: 0.5})
    assert working_point(changed).linear == changed
    assert shunting_mode(changed, V) == shunting_mode(DATUM, V)
