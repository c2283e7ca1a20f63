"""Two stiff textbook problems by an FMU of ours and by others: error against CPU time, as a picture.

    python -m benchmarks.stiff

The FMU's co-simulation, and fmpy's CVode on its model exchange, both by fmpy's simulate_fmu; SciPy's Radau with the
exact Jacobian. The solution is asked for at 100 points.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from ctypes import c_long, c_void_p
from dataclasses import dataclass
from pathlib import Path
from time import process_time
from typing import Any
from unittest.mock import patch

import fmpy
import matplotlib as mpl
import numpy as np
from fmpy.fmi2 import FMU2Model
from fmpy.sundials import CVodeSolver
from fmpy.sundials.libraries import sundials_cvode
from matplotlib.figure import Figure
from scipy.integrate import solve_ivp
from threadpoolctl import threadpool_limits

from benchmarks.comparison import in_turns
from benchmarks.contender import Floats
from benchmarks.work_precision import TOLERANCES, Curve, draw_curves
from fmu_build.pipeline import build
from overrun_hitch.show.traces import STYLE, rendered
from tests.unit import Unit

PICTURE = Path(__file__).with_name("stiff.svg")
ROUNDS = 5
POINTS = 100


@dataclass(frozen=True)
class Problem:
    """An initial value problem as Modelica (class M) and as functions; the error is that of `outputs` / `nominal`."""

    title: str
    modelica: str
    stop: float
    outputs: tuple[str, ...]
    start: tuple[float, ...]
    nominal: tuple[float, ...]
    rates: Callable[..., list[float]]
    jacobian: Callable[..., list[list[float]]]


PROBLEMS = (
    Problem(
        "Van der Pol, μ = 1000, to t = 2000 s",
        """
model M
  parameter Real mu = 1000;
  output Real x(start=2, fixed=true);
  output Real y(start=0, fixed=true, nominal=1e-3);
equation
  der(x) = y;
  der(y) = mu*(1 - x^2)*y - x;
end M;""",
        2000.0,
        ("x",),
        (2.0, 0.0),
        (1.0, 1e-3),
        lambda t, s: [s[1], 1000 * (1 - s[0] ** 2) * s[1] - s[0]],
        lambda t, s: [[0, 1], [-2000 * s[0] * s[1] - 1, 1000 * (1 - s[0] ** 2)]],
    ),
    Problem(
        "Roberts' kinetics, to t = 4000 s",
        """
model M
  output Real a(start=1, fixed=true);
  output Real b(start=0, fixed=true, nominal=1e-5);
  output Real c(start=0, fixed=true);
equation
  der(a) = -0.04*a + 1e4*b*c;
  der(b) = 0.04*a - 1e4*b*c - 3e7*b^2;
  der(c) = 3e7*b^2;
end M;""",
        4000.0,
        ("a", "b", "c"),
        (1.0, 0.0, 0.0),
        (1.0, 1e-5, 1.0),
        lambda t, s: [
            -0.04 * s[0] + 1e4 * s[1] * s[2],
            0.04 * s[0] - 1e4 * s[1] * s[2] - 3e7 * s[1] ** 2,
            3e7 * s[1] ** 2,
        ],
        lambda t, s: [
            [-0.04, 1e4 * s[2], 1e4 * s[1]],
            [0.04, -1e4 * s[2] - 6e7 * s[1], -1e4 * s[1]],
            [0, 6e7 * s[1], 0],
        ],
    ),
)


class Model(Unit):
    """An instance for model exchange."""

    slave_class = FMU2Model


class PatientCVode(CVodeSolver):
    """fmpy's, which by itself gives up after 500 steps between two points."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        sundials_cvode.CVodeSetMaxNumSteps(c_void_p(self.cvode_mem), c_long(100_000))


def radau(problem: Problem, tolerance: float) -> Floats:
    """SciPy's solution (outputs, points)."""
    times = np.linspace(0, problem.stop, POINTS + 1)[1:]
    solved = solve_ivp(
        problem.rates,
        (0, problem.stop),
        problem.start,
        "Radau",
        times,
        rtol=tolerance,
        atol=tolerance * np.array(problem.nominal),
        jac=problem.jacobian,
    )
    values: Floats = solved.y[: len(problem.outputs)]
    return values


def simulated(unit: Unit, problem: Problem, tolerance: float) -> Floats:
    """The FMU's outputs (outputs, points)."""
    unit.slave.reset()
    with patch("fmpy.sundials.CVodeSolver", PatientCVode):
        result = fmpy.simulate_fmu(
            unit.slave.unzipDirectory,
            validate=False,
            stop_time=problem.stop,
            output_interval=problem.stop / POINTS,
            relative_tolerance=tolerance,
            output=problem.outputs,
            record_events=False,
            model_description=unit.description,
            fmu_instance=unit.slave,
        )
    return np.array([result[name][1:] for name in problem.outputs])


def measured(problem: Problem, folder: Path) -> dict[str, Curve]:
    """The curve of each way."""
    (folder / "M.mo").write_text(problem.modelica, encoding="utf-8")
    build(folder / "M.mo", "M", folder / "M.fmu")
    slave, model = Unit(folder / "M.fmu", folder / "slave"), Model(folder / "M.fmu", folder / "model")
    for unit in (slave, model):
        unit.slave.instantiate()
    ways: dict[str, Callable[[float], Floats]] = {
        "FMU from fmpy": lambda tolerance: simulated(slave, problem, tolerance),
        "FMU, fmpy's CVode": lambda tolerance: simulated(model, problem, tolerance),
        "SciPy's Radau, numpy": lambda tolerance: radau(problem, tolerance),
    }
    exact = radau(problem, 1e-12)
    nominal = np.array(problem.nominal)[: len(problem.outputs), None]
    cases = [(solve, tolerance) for solve in ways.values() for tolerance in TOLERANCES]
    errors = np.array([np.abs((solve(tolerance) - exact) / nominal).max() for solve, tolerance in cases])
    times = np.median(in_turns([lambda c=c: cpu_time(*c) for c in cases], ROUNDS, problem.title), axis=0)
    for unit in (slave, model):
        unit.slave.freeInstance()
    shape = len(ways), len(TOLERANCES)
    return dict(zip(ways, zip(times.reshape(shape), errors.reshape(shape), strict=True), strict=True))


def cpu_time(solve: Callable[[float], Floats], tolerance: float) -> float:
    """CPU time of a run in s, behind another one that warms the processor's caches."""
    solve(TOLERANCES[0])
    begin = process_time()
    solve(tolerance)
    return process_time() - begin


def drawn(curves: list[dict[str, Curve]]) -> Figure:
    """A diagram for each problem."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(8.6, 4.2), layout="constrained")
        for axes, problem, ways in zip(figure.subplots(1, len(PROBLEMS)), PROBLEMS, curves, strict=True):
            draw_curves(axes, ways)
            axes.set_title(problem.title, fontsize="medium")
            axes.set_ylabel(f"Error of {', '.join(problem.outputs)} relative to nominal (1)")
        figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def main() -> None:
    """Measure, print and draw."""
    curves = []
    with tempfile.TemporaryDirectory(prefix="stiff-") as name, threadpool_limits(1):
        for number, problem in enumerate(PROBLEMS):
            folder = Path(name) / str(number)
            folder.mkdir()
            curves.append(measured(problem, folder))
            print(problem.title)
            for way, (times, errors) in curves[-1].items():
                for tolerance, time, error in list(zip(TOLERANCES, times, errors, strict=True))[::4]:
                    print(f"  {way:<22} {tolerance:7.0e} {1e3 * time:9.2f} ms  {error:8.1e}")
    PICTURE.write_bytes(rendered(drawn(curves), "svg"))


if __name__ == "__main__":
    main()
