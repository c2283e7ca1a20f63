"""Figure 8's six seconds by every contender at equal error, measured in turns: the table and its verdicts."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from rich.progress import track

from benchmarks.contender import Contender, Floats, Run, oracle_accuracy

ALLOWED = 2e-6  # m, error of the compression
ROUNDS = 31
FROM_C, FROM_FMPY, CVODE, RADAU = "FMU from C", "FMU from fmpy", "FMU, fmpy's CVode", "SciPy's Radau, numpy"
# How many times the CPU time of which other row it must be, at least.
AT_LEAST = {
    CVODE: (FROM_FMPY, 3.0),
    "rumoca, rk-like": (FROM_C, 20.0),
    "rumoca, bdf": (FROM_C, 20.0),
    RADAU: (FROM_C, 100.0),
}
TOLERANCES = [10.0 ** (-n / 8) for n in range(16, 97)]  # 1e-2 to 1e-12, relative
DEFAULT = 1e-6  # the FMU's own
# Whoever asked for fast steps had measured it elsewhere, with points every 1 ms; OpenModelica is not on our machines.
RECORDED = "| OpenModelica's FMU, recorded elsewhere | not told | 3e-06 | not told | not told | 35 to 45 |  |  |  |  |"


@dataclass(frozen=True)
class Row:
    """A contender at a tolerance: its run with counts, and the CPU times (rounds,) in s of others without."""

    name: str
    tolerance: float
    run: Run
    cpu_times: Floats

    @property
    def cpu_time(self) -> float:
        """The median, in s."""
        return float(np.median(self.cpu_times))


def loosest(contender: Contender, allowed: float) -> float:
    """The loosest of TOLERANCES whose error is at most as large as allowed (m)."""
    for tolerance in TOLERANCES:
        if contender.solve(tolerance, False).error <= allowed:
            return tolerance
    raise ValueError(f"{contender.name} does not reach {allowed:g} m")


def in_turns(solves: Sequence[Callable[[], float]], rounds: int, what: str) -> Floats:
    """CPU times (rounds, n) in s that n functions tell, each called once a round, so that all see the same machine."""
    return np.array([[solve() for solve in solves] for _ in track(range(rounds), what)])


def chosen(contenders: Sequence[Contender]) -> list[tuple[str, Contender, float]]:
    """Name of the row, contender, tolerance.

    The loosest tolerance that reaches ALLOWED; but from C the FMU's default, and from fmpy that of CVode, as compared
    there. Radau once more, to the error that the FMU has.
    """
    by_name = {contender.name: contender for contender in contenders}
    tolerances = {FROM_C: DEFAULT}
    for name in track([name for name in by_name if name not in (FROM_C, FROM_FMPY)], "tolerances"):
        tolerances[name] = loosest(by_name[name], ALLOWED)
    tolerances[FROM_FMPY] = tolerances[CVODE]
    to_our_error = loosest(by_name[RADAU], by_name[FROM_C].solve(DEFAULT, False).error)
    rows = [(name, contender, tolerances[name]) for name, contender in by_name.items()]
    return [*rows, (f"{RADAU}, to the FMU's error", by_name[RADAU], to_our_error)]


def compared(contenders: Sequence[Contender], preparation: Callable[[], float]) -> tuple[list[Row], Floats]:
    """The rows of the table, and the CPU times (rounds,) in s of rumoca's preparation, measured with them."""
    cases = chosen(contenders)
    counted = [contender.solve(tolerance, True) for _, contender, tolerance in cases]  # warms up as well
    solves = [lambda c=contender, t=tolerance: c.solve(t, False).cpu_time for _, contender, tolerance in cases]
    times = in_turns([*solves, preparation], ROUNDS, "at equal error")
    rows = [
        Row(name, tolerance, run, times[:, i])
        for i, ((name, _, tolerance), run) in enumerate(zip(cases, counted, strict=True))
    ]
    return rows, times[:, -1]


def table(rows: Sequence[Row]) -> tuple[list[str], bool]:
    """The rows with ratios and verdicts, and whether every requirement is met."""
    times = {row.name: row.cpu_time for row in rows}
    lines = [
        "| | tolerance | error, m | right-hand sides | steps | CPU, ms (quartiles) | over C | over fmpy | at least | |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    all_met = True
    for row in rows:
        low, high = 1e3 * np.percentile(row.cpu_times, [25, 75])
        ratios = {other: row.cpu_time / times[other] for other in (FROM_C, FROM_FMPY)}
        demand = verdict = ""
        if row.name in AT_LEAST:
            other, limit = AT_LEAST[row.name]
            met = ratios[other] >= limit and row.run.error <= ALLOWED
            demand, verdict = f"{limit:g} times {other.split()[-1]}", "met" if met else "NOT MET"
            all_met = all_met and met
        cells = [
            row.name,
            f"{row.tolerance:.1e}",
            f"{row.run.error:.1e}",
            _count(row.run.evaluations),
            _count(row.run.steps),
            f"{1e3 * row.cpu_time:.3g} ({low:.3g} to {high:.3g})",
            *(f"{ratio:.3g}" for ratio in ratios.values()),
            demand,
            verdict,
        ]
        lines.append(f"| {' | '.join(cells)} |")
    return lines, all_met


def _count(number: int | None) -> str:
    return "not told" if number is None else str(number)


def section(contenders: Sequence[Contender], preparation: Callable[[], float]) -> tuple[str, bool]:
    """The report's section, and whether every requirement is met; `preparation` tells rumoca's CPU time for it."""
    load = os.getloadavg()[0]
    rows, prepared = compared(contenders, preparation)
    lines, met = table(rows)
    by_name = {row.name: row for row in rows}
    ours = by_name[FROM_C].cpu_time
    steps = float(np.median(by_name["rumoca, rk-like"].cpu_times - prepared))
    radau, accurate = by_name[RADAU], rows[-1]
    text = f"""## Against other ways to the same 600 points

Everyone computes the compression every 10 ms from steady running on; error: the largest distance from SciPy's Radau at
rtol 1e-11, from which DOP853 at 1e-13 differs by {oracle_accuracy():.0e} m. Tolerance: the loosest, of eight a decade,
with an error of at most {ALLOWED:g} m; but from C it is the FMU's default, and from fmpy that of CVode, with which it
is compared. CPU time of the process, medians of {ROUNDS} rounds in which each had its turn, BLAS on one thread; the
load average was {load:.1f} at the start.

{chr(10).join([*lines, RECORDED])}

- OpenModelica's FMU: six seconds with points every 1 ms, as a contributor has recorded them on a machine of their own;
  to give the scale alone.
- FMU from C: `six_seconds.c`, from reset to the last point. From fmpy, and with its CVode (BDF, the FMU for model
  exchange): `fmpy.simulate_fmu` on an instance that is there already, both alike. Steps from fmpy are those from C at
  this tolerance; CVode's right-hand sides include those for its Jacobian.
- rumoca simulates the Modelica example that the FMU's model is in; compiling it is not counted. Each call of `simulate`
  prepares the equations anew, {1e3 * np.median(prepared):.3g} ms, which are counted. Without them the ratio of rk-like
  would be {steps / ours:.2g}: its steps take {1e3 * steps:.2g} ms (median of the differences).
- SciPy solves the paper's equations alone, five states where the FMU has ten (place, brakes that hold, standstill),
  with their exact Jacobian. `numpy` is Python's floats out of numpy's arrays, faster than arithmetic in arrays of five;
  `numba` is compiled. LSODA is that of `odeint`, a compiled loop.
- Radau takes {radau.run.steps} steps to {radau.run.error:.1e} m where the FMU takes {by_name[FROM_C].run.steps} to
  {by_name[FROM_C].run.error:.1e} m: communication points end no steps. Radau to that error (last row) takes
  {accurate.cpu_time / ours:.0f} times the FMU from C. The right-hand sides of
  the FMU from C are those of its steps and one at each point.
"""
    return text, met
