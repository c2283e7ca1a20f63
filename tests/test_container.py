"""Units inside a container of fmu-manipulation-toolbox: not a bit changes, in FMI 2 and 3, alone and linked.

The container makes the units' steps itself, from n * step on, however long the importer's own steps are. It passes
values straight through: an exposed input reaches its unit when it is set, an exposed output is fetched from its unit.
A linked input gets what the other unit put out at the end of the last step, because all inputs are set before any unit
steps. Units of FMI 3 are run with event mode, and may not return early: ours then handles its events itself.
(Read in container/container.c, fmu.c and fmi2.c of the toolbox's version 1.9.3. Of 2.0, which is used here, the sources
of the library were not to be had; that it does the same to the bit is what the tests show.)
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi3 import FMU3Slave
from fmu_manipulation_toolbox.container import FMUContainer  # type: ignore[import-untyped]
from numpy.typing import NDArray

from fmu_build.fmu.compile import host_platform
from overrun_hitch.parameters import FIGURES
from overrun_hitch.results import VARIABLES
from tests.sampling import spread
from tests.unit import Unit

VERSIONS = [2, 3]
STEP, COUNT = 0.01, 600  # s; six seconds
OUTPUTS = tuple(VARIABLES)

Floats = NDArray[np.float64]

toolbox_runs_here = pytest.mark.skipif(
    host_platform().name not in {"x86_64-linux", "x86_64-windows", "aarch64-darwin"},
    reason="the toolbox has no library for containers on this machine",
)


class Unit3(Unit):
    """The same calls to an instance of FMI 3."""

    slave_class = FMU3Slave

    def set(self, **values: float) -> None:
        self.slave.setFloat64([self.references[name] for name in values], list(values.values()))

    def get(self, *names: str) -> Floats:
        return np.array(self.slave.getFloat64([self.references[name] for name in names]))

    def start(self, time: float = 0.0, stop: float | None = None, **values: float) -> None:
        self.set(**values)
        self.slave.enterInitializationMode(startTime=time, stopTime=stop)
        self.slave.exitInitializationMode()


@contextmanager
def instance(fmu: Path, folder: Path, version: int = 2) -> Iterator[Unit]:
    unit = (Unit if version == 2 else Unit3)(fmu, folder)
    unit.slave.instantiate()
    try:
        yield unit
    finally:
        unit.slave.freeInstance()


def brake_torque(time: float) -> float:
    """Another value at every communication point, so that a delay would show."""
    return 1000.0 + 300.0 * math.sin(5.0 * time)


def driven(fmu: Path, folder: Path, version: int, stride: int, names: list[str], values: dict[str, float]) -> Floats:
    """The names' values at communication points `stride` of the container's steps apart."""
    with instance(fmu, folder, version) as unit:
        unit.start(brake_torque=brake_torque(0.0), **values)
        rows = [unit.get(*names)]
        for n in range(0, COUNT, stride):
            unit.set(brake_torque=brake_torque(n * STEP))
            unit.slave.doStep(n * STEP, stride * STEP)
            rows.append(unit.get(*names))
    return np.array(rows)


@pytest.mark.parametrize("version", VERSIONS)
def test_the_step_offered_is_a_whole_part_of_a_second(car_trailer_fmus: dict[int, Path], version: int) -> None:
    """The toolbox 1.9 finds a step for several units from int(1 / stepSize), 2.0 from the decimals as a fraction."""
    offered = fmpy.read_model_description(str(car_trailer_fmus[version])).defaultExperiment.stepSize
    assert Fraction(offered).numerator == 1
    assert int(1.0 / float(offered)) * Fraction(offered) == 1


@toolbox_runs_here
@pytest.mark.parametrize(("version", "figure", "stride"), spread(VERSIONS, ["6a", "10"], [1, 10]))
def test_one_unit(
    car_trailer_fmus: dict[int, Path],
    tmp_path: Path,
    caplog: pytest.LogCaptureFixture,
    version: int,
    figure: str,
    stride: int,
) -> None:
    """With its own step taken over, and its parameters, input and outputs exposed; against the FMI 2 unit alone."""
    builder = FMUContainer("Container", car_trailer_fmus[version].parent, fmi_version=version)
    builder.get_fmu("CarTrailer.fmu")
    builder.add_implicit_rule(auto_parameter=True)
    builder.make_fmu(tmp_path / "Container.fmu")
    assert [record.message for record in caplog.records if record.levelname in ("WARNING", "ERROR", "CRITICAL")] == []
    container = fmpy.read_model_description(str(tmp_path / "Container.fmu"))
    assert (container.fmiVersion, container.defaultExperiment.stepSize) == (f"{version}.0", str(STEP))

    values = FIGURES[figure].parameters.model_dump()
    exposed = {f"cartrailer.{name}": value for name, value in values.items()}
    inside = driven(tmp_path / "Container.fmu", tmp_path / "container", version, stride, [*OUTPUTS], exposed)

    with instance(car_trailer_fmus[2], tmp_path / "unit") as unit:
        unit.start(brake_torque=brake_torque(0.0), **values)
        alone = [unit.get(*OUTPUTS)]
        for n in range(COUNT):
            unit.set(brake_torque=brake_torque(n // stride * stride * STEP))
            unit.slave.doStep(n * STEP, STEP)
            alone.append(unit.get(*OUTPUTS))
    compression = inside[:, OUTPUTS.index("compression")]
    print(f"FMI {version}, figure {figure}: {len(inside)} points, compression {np.ptp(compression):.3f} m peak to peak")
    assert np.ptp(compression) > 0.01
    np.testing.assert_array_equal(inside, np.array(alone)[::stride])


@toolbox_runs_here
@pytest.mark.parametrize(("version", "threads"), spread(VERSIONS, [False, True]))
def test_two_units_linked(car_trailer_fmus: dict[int, Path], tmp_path: Path, version: int, threads: bool) -> None:
    """Figure 10's trailer brake is what brakes figure 6a's car, in a container that has the parameters."""
    fmu, figures = car_trailer_fmus[version], {"first": "10", "second": "6a"}
    builder = FMUContainer("Container", fmu.parent, fmi_version=version)
    for name, figure in figures.items():
        builder.get_fmu(fmu.name, f"{name}.fmu")
        for output in OUTPUTS:
            builder.add_output(f"{name}.fmu", output, f"{name}_{output}")
        for parameter, value in FIGURES[figure].parameters.model_dump().items():
            builder.add_start_value(f"{name}.fmu", parameter, repr(value))
    builder.add_input("brake_torque", "first.fmu", "brake_torque")
    builder.add_link("first.fmu", "trailer_brake_torque", "second.fmu", "brake_torque")
    builder.make_fmu(tmp_path / "Container.fmu", step_size=STEP, mt=threads)
    names = [f"{name}_{output}" for name in figures for output in OUTPUTS]
    inside = driven(tmp_path / "Container.fmu", tmp_path / "container", version, 1, names, {})

    two = tmp_path / "first", tmp_path / "second"
    with instance(car_trailer_fmus[2], two[0]) as first, instance(car_trailer_fmus[2], two[1]) as second:
        first.start(brake_torque=brake_torque(0.0), **FIGURES["10"].parameters.model_dump())
        second.start(**FIGURES["6a"].parameters.model_dump())
        alone = [np.concatenate([first.get(*OUTPUTS), second.get(*OUTPUTS)])]
        for n in range(COUNT):
            first.set(brake_torque=brake_torque(n * STEP))
            second.set(brake_torque=first.get("trailer_brake_torque")[0])
            for unit in (first, second):
                unit.slave.doStep(n * STEP, STEP)
            alone.append(np.concatenate([first.get(*OUTPUTS), second.get(*OUTPUTS)]))
    print(f"FMI {version}: speeds at the end {inside[-1, 0]:.3f} and {inside[-1, len(OUTPUTS)]:.3f} m/s")
    assert inside[-1, len(OUTPUTS)] < 39.0  # the second one's car has been braked
    np.testing.assert_array_equal(inside, np.array(alone))
