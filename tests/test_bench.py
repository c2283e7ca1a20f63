"""Bench.fmu: the drawbar moved as one likes. One turn of the guide's friction costs the area of its loop."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import fmpy
import numpy as np
import pytest

from overrun_hitch.parameters import DATUM, Parameters
from tests.kept import kept_fmus
from tests.unit import Unit

X_F = 1e-4  # m, over which friction reverses: Components.DrawbarFriction
STEPS = 2000  # a cycle


@pytest.fixture(scope="module")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Unit]:
    unit = Unit(kept_fmus("Systems.Bench", fmi=2)["Bench"], tmp_path_factory.mktemp("bench"))
    unit.slave.instantiate()
    yield unit
    unit.slave.freeInstance()


def moved(unit: Unit, a: float, omega: float, cycles: int, **parameters: float) -> tuple[np.ndarray, np.ndarray]:
    """Compression and hitch force (n,) while the drawbar is moved by a sine of amplitude a about a middle of 2 a."""
    h = 2.0 * np.pi / omega / STEPS
    time = h * np.arange(cycles * STEPS + 1)
    x = 2.0 * a + a * np.sin(omega * time)
    unit.slave.reset()
    unit.start(compression_start=x[0], v_rel=(x[1] - x[0]) / h, **parameters)
    rows = [unit.get("compression", "F_hitch")]
    for now, v in zip(time[:-1], np.diff(x) / h, strict=True):
        unit.set(v_rel=v)
        unit.slave.doStep(now, h)
        rows.append(unit.get("compression", "F_hitch"))
    compression, force = np.array(rows).T
    np.testing.assert_allclose(compression, x, rtol=0.0, atol=1e-9)
    return compression, force


@pytest.mark.parametrize("omega", [0.5, 10.0])
def test_a_cycle_costs_the_area_of_the_loop(bench: Unit, omega: float) -> None:
    """Friction 4 F_f (a - x_f) whatever the frequency, the damper pi C omega a^2, the spring nothing.

    What friction is beyond the first order of x_f/a (1/300 here) and the area of a polygon are less than a thousandth.
    """
    a, C, F_f = 0.03, 50.0, 80.0
    compression, force = moved(bench, a, omega, 2, C=C, F_f=F_f)
    area = np.trapezoid(force[-STEPS - 1 :], compression[-STEPS - 1 :])
    assert area == pytest.approx(4.0 * F_f * (a - X_F) + np.pi * C * omega * a**2, rel=1e-3)


@pytest.mark.parametrize("name", ["Bench", "Hitch"])
def test_it_has_the_drawbar_of_car_and_trailer(name: str) -> None:
    """The same names, defaults and ranges."""
    variables = fmpy.read_model_description(str(kept_fmus(f"Systems.{name}", fmi=2)[name])).modelVariables
    own = {v.name: v for v in variables if v.causality == "parameter" and "." not in v.name}
    ours = [name for name in own if name in Parameters.model_fields]
    assert {"k", "C", "F_f", "tau_b", "compression_start"} <= set(ours)
    for name in ours:
        assert float(own[name].start) == pytest.approx(getattr(DATUM, name), rel=1e-12), name
        assert float(own[name].min or -np.inf) == Parameters.limits(name)[0], name


def test_it_stands_beside_the_others() -> None:
    """Makefile and package.order list what is exported."""
    root = Path(__file__).parents[1]
    order = (root / "modelica" / "OverrunHitch" / "Systems" / "package.order").read_text().split()
    (units,) = [line for line in (root / "Makefile").read_text().splitlines() if line.startswith("UNITS := ")]
    assert sorted(order) == sorted(units.removeprefix("UNITS := ").split())
