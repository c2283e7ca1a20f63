"""The FMU against other tools that solve the same equations, each to the accuracy that it has.

rumoca simulates the library's own examples: same Modelica, another compiler back end, another integrator.
OpenModelica's trajectories are recorded in oracles/openmodelica, with their distance from a converged solution; those
of the package `modelica`, a third front end and solver for the same files, in oracles/modelica_python.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import rumoca

from overrun_hitch.parameters import FIGURES, Parameters
from overrun_hitch.results import VARIABLES
from tests.runs import step_brake
from tests.sampling import sampled

OPENMODELICA = Path(__file__).parent / "oracles" / "openmodelica"
# Distance from SciPy's Radau at rtol 1e-11, from the README beside the files: car, trailer (m/s), compression (m).
ACCURACY = {"6a": (3e-5, 4.4e-5, 2.3e-6), "6b": (9e-7, 7.2e-6, 1e-6), "10": (1.4e-8, 2e-7, 2.1e-8)}


@pytest.mark.parametrize("figure", ACCURACY)
def test_openmodelica(figure: str, car_trailer_fmu: Path) -> None:
    ours = step_brake(FIGURES[figure], fmu=car_trailer_fmu, relative_tolerance=1e-10)
    theirs = np.genfromtxt(OPENMODELICA / f"fig{figure}.csv", delimiter=",", names=True)
    np.testing.assert_allclose(ours.time, theirs["time"], atol=1e-12)
    distances = (
        np.abs(ours.v_car - theirs["v_c"]).max(),
        np.abs(ours.v_trailer - theirs["v_t"]).max(),
        np.abs(ours.compression - (theirs["x_t"] - theirs["x_c"])).max(),
    )
    print(f"figure {figure}: " + ", ".join(f"{float(d):.1e}" for d in distances))
    for distance, accuracy in zip(distances, ACCURACY[figure], strict=True):
        assert distance < 1.1 * accuracy  # their figures are rounded to two digits


def simulated_by_rumoca(library: Path, figure: str, rtol: float, times: np.ndarray) -> dict[str, np.ndarray]:
    model = rumoca.Session().load(str(library / "package.mo"), model=f"OverrunHitch.Examples.Figure{figure}")
    config = rumoca.SimConfig(solver="rk-like", rtol=rtol, atol=rtol, max_wall_seconds=60)
    result = model.simulate(t=(0, 6), dt=0.01, config=config)
    rows = [int(np.abs(np.asarray(result.time) - t).argmin()) for t in times]  # it adds rows at its events
    return {name: np.asarray(result[f"combination.{name}"])[rows] for name in VARIABLES}


MODELICA_PYTHON = Path(__file__).parent / "oracles" / "modelica_python" / "figure-8.csv"


def test_the_package_modelica(car_trailer_fmu: Path) -> None:
    theirs = np.genfromtxt(MODELICA_PYTHON, delimiter=",", names=True)
    scenario = FIGURES["8"].changed(parameters=FIGURES["8"].parameters.changed({"compression_start": 0.01}))
    ours = step_brake(scenario, fmu=car_trailer_fmu, relative_tolerance=1e-10, communication_step=0.05)
    np.testing.assert_allclose(ours.time, theirs["time"], atol=1e-12)
    for name in theirs.dtype.names[1:]:
        distance = np.abs(ours[name].values - theirs[name]).max()
        print(f"figure 8 from 0.01 m, {name}: {distance:.1e}")
        assert distance < 2e-8 * np.ptp(theirs[name])


def test_the_record_can_be_repeated() -> None:
    """Where the package is installed, which needs Python 3.12."""
    pytest.importorskip("modelica.sim")
    from tests.oracles.modelica_python.record import figure_8

    theirs = np.genfromtxt(MODELICA_PYTHON, delimiter=",", names=True)
    found = np.array(figure_8()).T
    for name, column in zip(theirs.dtype.names, found, strict=True):
        np.testing.assert_allclose(column, theirs[name], rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("figure", sampled(["6a", "6b", "8", "10"], ["8", "10"]))
def test_rumoca(figure: str, car_trailer_fmu: Path, modelica_library: Path) -> None:
    """rumoca's own accuracy is how far its result at rtol 1e-9 is from that at 1e-11."""
    ours = step_brake(FIGURES[figure], fmu=car_trailer_fmu, relative_tolerance=1e-10)
    coarse = simulated_by_rumoca(modelica_library, figure, 1e-9, ours.time.values)
    fine = simulated_by_rumoca(modelica_library, figure, 1e-11, ours.time.values)
    for name in VARIABLES:
        accuracy = np.abs(coarse[name] - fine[name]).max()
        distance = np.abs(ours[name].values - fine[name]).max()
        print(f"figure {figure}, {name}: {distance:.1e}, rumoca's accuracy {accuracy:.1e}")
        assert distance < accuracy + 1e-9 * np.abs(fine[name]).max()


def test_the_examples_have_the_parameters_of_the_figures(modelica_library: Path) -> None:
    session = rumoca.Session()
    for figure, scenario in FIGURES.items():
        model = session.load(str(modelica_library / "package.mo"), model=f"OverrunHitch.Examples.Figure{figure}")
        values = {name: model.parameters[f"combination.{name}"].value for name in Parameters.model_fields}
        assert values == pytest.approx(scenario.parameters.model_dump(), rel=1e-15)
        assert model.parameters["tau_c"].value == scenario.brake_torque
