"""Car and Trailer linked in a container of fmu-manipulation-toolbox: not a bit changes, in FMI 2 and 3.

How a container exchanges values tells tests/test_container.py: linked inputs are set before any unit steps, so this is
Jacobi with held values. Or, told to be sequential, one unit after the other in the order in which they were named, each
with the newest values: Gauss-Seidel. The start value of the linked speed is what the car has before the first step.
"""

from __future__ import annotations

from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmu_manipulation_toolbox.container import FMUContainer  # type: ignore[import-untyped]

from overrun_hitch.parameters import FIGURES, Parameters
from tests.sampling import spread
from tests.test_container import Floats, brake_torque, instance, toolbox_runs_here

COUNT, H = 600, 0.01  # six seconds, in steps of H s
OUTPUTS = {"Trailer": ("v_trailer", "compression", "F_hitch", "coupling_energy"), "Car": ("v_car", "a_car", "slip_car")}
FORCES = {False: ("F_hitch_hold", 3.0), True: ("F_hitch_mean", 2.0)}  # sequential: output, applied_force


def own(case: Parameters, fmu: Path, sequential: bool) -> dict[str, float]:
    """The unit's parameters among those of a case and a scheme."""
    known = {**case.model_dump(), "extrapolation": 1.0, "applied_force": FORCES[sequential][1]}
    names = {v.name for v in fmpy.read_model_description(str(fmu)).modelVariables if v.causality == "parameter"}
    return {name: value for name, value in known.items() if name in names}


def container(
    fmus: dict[str, Path], output: Path, version: int, case: Parameters, sequential: bool, threads: bool
) -> Path:
    """A container of the pair that has the parameters, and exposes the brake and OUTPUTS."""
    builder = FMUContainer("Container", fmus["Car"].parent, fmi_version=version)
    for unit, names in OUTPUTS.items():
        builder.get_fmu(fmus[unit].name)
        for name, value in own(case, fmus[unit], sequential).items():
            builder.add_start_value(fmus[unit].name, name, repr(value))
        for name in names:
            builder.add_output(fmus[unit].name, name, name)
    builder.add_start_value("Trailer.fmu", "v_car", repr(case.V_0))
    builder.add_input("brake_torque", "Car.fmu", "brake_torque")
    builder.add_link("Car.fmu", "v_car", "Trailer.fmu", "v_car")
    builder.add_link("Trailer.fmu", FORCES[sequential][0], "Car.fmu", "F_hitch")
    builder.make_fmu(output, step_size=H, mt=threads, sequential=sequential)
    return output


def contained(fmu: Path, folder: Path, version: int) -> Floats:
    """OUTPUTS at all communication points of a container."""
    names = [name for unit in OUTPUTS.values() for name in unit]
    with instance(fmu, folder, version) as unit:
        unit.start(brake_torque=brake_torque(0.0))
        rows = [unit.get(*names)]
        for n in range(COUNT):
            unit.set(brake_torque=brake_torque(n * H))
            unit.slave.doStep(n * H, H)
            rows.append(unit.get(*names))
    return np.array(rows)


def coupled(
    fmus: dict[str, Path], folder: Path, case: Parameters, sequential: bool, H: float = H, count: int = COUNT
) -> Floats:
    """The same by hand, with units of FMI 2."""
    force = FORCES[sequential][0]
    with instance(fmus["Car"], folder / "car") as car, instance(fmus["Trailer"], folder / "trailer") as trailer:
        car.start(brake_torque=brake_torque(0.0), **own(case, fmus["Car"], sequential))
        trailer.start(v_car=case.V_0, **own(case, fmus["Trailer"], sequential))
        rows = [np.concatenate([trailer.get(*OUTPUTS["Trailer"]), car.get(*OUTPUTS["Car"])])]
        for n in range(count):
            before = trailer.get(force)[0]
            trailer.set(v_car=car.get("v_car")[0])
            trailer.slave.doStep(n * H, H)
            car.set(brake_torque=brake_torque(n * H), F_hitch=trailer.get(force)[0] if sequential else before)
            car.slave.doStep(n * H, H)
            rows.append(np.concatenate([trailer.get(*OUTPUTS["Trailer"]), car.get(*OUTPUTS["Car"])]))
    return np.array(rows)


@toolbox_runs_here
@pytest.mark.parametrize(
    ("version", "figure", "scheme"), spread([2, 3], ["7", "10"], ["parallel", "threads", "sequential"])
)
def test_the_pair_in_a_container(
    pair_fmus: dict[int, dict[str, Path]], tmp_path: Path, version: int, figure: str, scheme: str
) -> None:
    case, sequential = FIGURES[figure].parameters, scheme == "sequential"
    fmu = container(pair_fmus[version], tmp_path / "Container.fmu", version, case, sequential, scheme == "threads")
    inside = contained(fmu, tmp_path / "container", version)
    alone = coupled(pair_fmus[2], tmp_path, case, sequential)
    speed = inside[-1, len(OUTPUTS["Trailer"])]
    print(f"FMI {version}, {scheme}: largest difference {abs(inside - alone).max():.1e}, at the end {speed:.3f} m/s")
    assert speed < 30.0  # braked
    np.testing.assert_array_equal(inside, alone)
