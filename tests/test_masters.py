"""Car and Trailer coupled by other people's masters, Ecos and libcosim: what the direct coupling gives.

Both step all units at once and hand values on when all have stepped, that is Jacobi, and both let start values settle
in initialization mode. Ecos sums up the time, libcosim counts it in ns: hence steps of 2^-7 s, exact in both.
"""

from __future__ import annotations

import ctypes
import sys
from pathlib import Path

import numpy as np
import pytest

from overrun_hitch.parameters import FIGURES
from tests.test_container import Floats, brake_torque
from tests.test_container_pair import OUTPUTS, coupled, own

H, COUNT = 1.0 / 128.0, 512  # s; four seconds
LINKS = (("Car", "v_car", "Trailer", "v_car"), ("Trailer", "F_hitch_hold", "Car", "F_hitch"))
CASE = FIGURES["10"].parameters
NAMES = [name for unit in OUTPUTS.values() for name in unit]
V_CAR = NAMES.index("v_car")


@pytest.fixture(scope="module")
def direct(pair_fmus: dict[int, dict[str, Path]], tmp_path_factory: pytest.TempPathFactory) -> Floats:
    return coupled(pair_fmus[2], tmp_path_factory.mktemp("direct"), CASE, sequential=False, H=H, count=COUNT)


def compare(name: str, rows: list[list[float]], direct: Floats, columns: list[int]) -> None:
    inside, alone = np.array(rows)[:, columns], direct[1:, columns]
    print(f"{name}: largest difference {abs(inside - alone).max():.1e}, v_car at the end {rows[-1][V_CAR]:.3f}")
    assert rows[-1][V_CAR] < 32.0  # braked
    np.testing.assert_allclose(inside, alone, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("version", [2, 3])
def test_ecos(pair_fmus: dict[int, dict[str, Path]], direct: Floats, version: int) -> None:
    for tbb in Path(sys.prefix, "lib").glob("libtbb.so.12"):  # ecospy brings none
        ctypes.CDLL(str(tbb), mode=ctypes.RTLD_GLOBAL)
    try:
        import ecospy  # type: ignore[import-untyped]
    except (ImportError, OSError) as error:
        pytest.skip(f"ecospy can't be used here: {error}")
    fmus = pair_fmus[version]
    with ecospy.EcosSimulationStructure() as structure:
        for unit, fmu in fmus.items():
            structure.add_model(unit, str(fmu))
        for start, output, end, target in LINKS:
            structure.make_real_connection(f"{start}::{output}", f"{end}::{target}")
        values = {f"{u}::{n}": v for u, fmu in fmus.items() for n, v in own(CASE, pair_fmus[2][u], False).items()}
        structure.add_parameter_set("case", values)
        with ecospy.EcosSimulation(structure=structure, step_size=H) as simulation:
            simulation.init(parameter_set="case")
            rows = []
            for n in range(COUNT):
                simulation.set_real("Car::brake_torque", brake_torque(n * H))
                simulation.step()
                rows.append([simulation.get_real(f"{u}::{name}") for u, names in OUTPUTS.items() for name in names])
            simulation.terminate()
    # Ecos hands on the new inputs before it fetches outputs for its user: those that feel inputs at once are ahead.
    at_once = {"F_hitch", "a_car"}
    compare(f"Ecos, FMI {version}", rows, direct, [i for i, name in enumerate(NAMES) if name not in at_once])


def test_libcosim(pair_fmus: dict[int, dict[str, Path]], direct: Floats) -> None:
    """FMI 2; libcosim knows no later one."""
    try:
        from libcosimpy.CosimExecution import CosimExecution  # type: ignore[import-untyped]
        from libcosimpy.CosimLogging import CosimLogLevel, log_output_level  # type: ignore[import-untyped]
        from libcosimpy.CosimManipulator import CosimManipulator  # type: ignore[import-untyped]
        from libcosimpy.CosimObserver import CosimObserver  # type: ignore[import-untyped]
        from libcosimpy.CosimSlave import CosimLocalSlave  # type: ignore[import-untyped]
    except (ImportError, OSError) as error:
        pytest.skip(f"libcosimpy can't be used here: {error}")

    log_output_level(CosimLogLevel.WARNING)
    fmus = pair_fmus[2]
    execution = CosimExecution.from_step_size(step_size=H * 1e9)
    slaves = {u: execution.add_local_slave(CosimLocalSlave(fmu_path=str(f), instance_name=u)) for u, f in fmus.items()}
    named = {u: {v.name.decode(): v.reference for v in execution.slave_variables(i)} for u, i in slaves.items()}
    for start, output, end, target in LINKS:
        execution.connect_real_variables(slaves[start], named[start][output], slaves[end], named[end][target])
    for unit, fmu in fmus.items():
        for name, value in own(CASE, fmu, sequential=False).items():
            execution.real_initial_value(slaves[unit], named[unit][name], value)
    observer, manipulator = CosimObserver.create_last_value(), CosimManipulator.create_override()
    execution.add_observer(observer)
    execution.add_manipulator(manipulator)
    rows = []
    for n in range(COUNT):
        manipulator.slave_real_values(slaves["Car"], [named["Car"]["brake_torque"]], [brake_torque(n * H)])
        execution.step()
        values = [observer.last_real_values(slaves[u], [named[u][n] for n in names]) for u, names in OUTPUTS.items()]
        rows.append([value for unit in values for value in unit])
    compare("libcosim", rows, direct, list(range(len(NAMES))))
