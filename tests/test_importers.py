"""What importers do to a unit: a million steps, odd times and paths, silence, no set-up."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi2 import fmi2CoSimulation
from numpy.random import default_rng

from tests.unit import Unit

DATUM_OUTPUTS = ["v_car", "v_trailer", "compression"]


@pytest.fixture
def unit(car_trailer_fmu: Path, tmp_path: Path) -> Iterator[Unit]:
    unit = Unit(car_trailer_fmu, tmp_path / "a folder, ünïcode")
    unit.slave.instantiate()
    yield unit
    unit.slave.freeInstance()


@pytest.mark.full
def test_a_million_steps_of_a_sixtieth_second(unit: Unit) -> None:
    """Coasting: time summed up by the caller, the last step a little beyond the stop time, and nothing moves."""
    step, count = 1.0 / 60.0, 1_000_000
    unit.start(stop=count * step)
    time = 0.0
    for _ in range(count):
        unit.slave.doStep(time, step)
        time += step
    assert abs(time - count * step) > 1e-9  # the caller's sum has drifted off, and was accepted
    np.testing.assert_allclose(unit.get("v_car", "v_trailer", "compression"), [40.0, 40.0, 0.0], atol=1e-9)
    assert unit.get("car.body.x")[0] == pytest.approx(40.0 * time, rel=1e-9)


def test_coasting_with_any_parameters(unit: Unit) -> None:
    """Nothing loads the drawbar: its compression is zero but for rounding, on both switching surfaces all the time."""
    random = default_rng(1)
    for _ in range(80):
        radii = {name: random.uniform(0.2, 0.5) for name in ("R_c", "R_t")}
        masses = {"M_c": random.uniform(500.0, 2500.0), "M_t": random.uniform(200.0, 2000.0)}
        drawbar = {"C": random.choice([0.0, 20.0, 500.0, 2500.0]), "eps": random.choice([0.0, 0.0, 0.1])}
        unit.slave.reset()
        unit.start(
            V_0=random.uniform(5.0, 45.0), F_pull_max=random.choice([1e9, 1e9, 0.0]), **radii, **masses, **drawbar
        )
        for n in range(100):
            unit.slave.doStep(n * 0.1, 0.1)
        assert abs(unit.get("compression")[0]) < 1e-12


@pytest.mark.parametrize("start", [-5.0, 1e4])
def test_another_start_time(unit: Unit, start: float) -> None:
    unit.start(brake_torque=1000.0)
    reference = []
    for n in range(100):
        unit.slave.doStep(n * 0.01, 0.01)
        reference.append(unit.get(*DATUM_OUTPUTS))
    unit.slave.reset()
    unit.start(time=start, brake_torque=1000.0)
    for n in range(100):
        unit.slave.doStep(start + n * 0.01, 0.01)
        np.testing.assert_allclose(unit.get(*DATUM_OUTPUTS), reference[n], rtol=1e-7, atol=1e-9)


def test_outputs_before_the_first_step_and_without_set_up(unit: Unit) -> None:
    unit.set(V_0=30.0, compression_start=0.02)
    unit.slave.enterInitializationMode()  # no setupExperiment
    expected = [30.0, 30.0, 0.02, 5480.0 * 0.02, 0.0, 16303.0 * 0.02]
    names = ("v_car", "v_trailer", "compression", "F_hitch", "slip_car", "trailer_brake_torque")
    np.testing.assert_allclose(unit.get(*names), expected, rtol=1e-14, atol=1e-15)
    unit.slave.exitInitializationMode()
    np.testing.assert_allclose(unit.get(*names), expected, rtol=1e-14, atol=1e-15)


@pytest.mark.parametrize("resources", [None, b"", b"file:///no/such/folder", "file:///Größe/a b%20c".encode(), b"%s%n"])
def test_it_needs_no_resources(car_trailer_fmu: Path, tmp_path: Path, resources: bytes | None) -> None:
    unit = Unit(car_trailer_fmu, tmp_path)
    callbacks = fmpy.fmi2.defaultCallbacks
    unit.slave.component = unit.slave.fmi2Instantiate(
        b"%s%n", fmi2CoSimulation, unit.slave.guid.encode(), resources, fmpy.fmi2.byref(callbacks), 0, 0
    )
    unit.start()
    unit.slave.doStep(0.0, 0.01)
    unit.slave.freeInstance()


def test_nothing_is_printed(car_trailer_fmu: Path, tmp_path: Path) -> None:
    """Not by the library itself: logging off and no logger, good and bad calls, in a process of its own."""
    script = f"""
from pathlib import Path
from fmpy.fmi2 import fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from tests.unit import Unit
unit = Unit(Path({str(car_trailer_fmu)!r}), Path({str(tmp_path)!r}))
unit.slave.instantiate(callbacks=fmi2CallbackFunctions())
try:
    unit.set(M_c=-1.0)
except Exception:
    pass
unit.start(brake_torque=1000.0)
unit.slave.doStep(0.0, 1.0)
unit.slave.freeInstance()
"""
    result = subprocess.run([sys.executable, "-c", script], capture_output=True, check=True)
    assert (result.stdout, result.stderr) == (b"", b"")
