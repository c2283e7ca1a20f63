"""The Modelica example of figure 8, compiled and simulated by rumoca alone: no FMU, no code of ours.

Compiling comes before; each call of `simulate` prepares the equations anew. rumoca tells neither steps nor evaluations.
"""

from __future__ import annotations

from pathlib import Path
from time import process_time

import numpy as np
import rumoca

from benchmarks.contender import DURATION, STEP, TIME, Contender, Run

LIBRARY = Path(__file__).parents[1] / "modelica" / "OverrunHitch" / "package.mo"


class Rumoca:
    """Figure 8's model, compiled."""

    def __init__(self) -> None:
        self._model = rumoca.Session().load(str(LIBRARY), model="OverrunHitch.Examples.Figure8")

    def contenders(self) -> list[Contender]:
        """Its explicit and its implicit solver."""
        return [
            Contender(f"rumoca, {solver}", lambda tolerance, _, solver=solver: self._run(solver, tolerance))
            for solver in ("rk-like", "bdf")
        ]

    def preparation(self, tolerance: float) -> float:
        """CPU time in s of a run to the first point alone, which is as good as all preparation."""
        return self._simulated("rk-like", tolerance, STEP)[0]

    def _run(self, solver: str, tolerance: float) -> Run:
        cpu_time, result = self._simulated(solver, tolerance, DURATION)
        time = np.asarray(result.time)
        rows = np.abs(time - TIME[:, np.newaxis]).argmin(axis=1)  # it adds rows at its events
        return Run(cpu_time, np.asarray(result["combination.compression"])[rows])

    def _simulated(self, solver: str, tolerance: float, end: float) -> tuple[float, rumoca.Result]:
        config = rumoca.SimConfig(solver=solver, rtol=tolerance, atol=tolerance, max_wall_seconds=60.0)
        begin = process_time()
        result = self._model.simulate(t=(0.0, end), dt=STEP, config=config)
        return process_time() - begin, result
