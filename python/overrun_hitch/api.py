"""What scripts call: `import overrun_hitch as hitch`, then hitch.run(...), hitch.run_many(...) and so on.

All values are in SI units; parameters have the paper's symbols (hitch.Parameters). Whatever the caller can mend is a
HitchError, whose message names the thing and says what is allowed.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from overrun_hitch.arguments import check_files, check_kind, check_one_torque, check_result, names_in, numbers
from overrun_hitch.extras import what_is_missing_told
from overrun_hitch.parameters import FIGURES, HitchError, Parameters, Scenario, named
from overrun_hitch.scenarios import asked_scenario, name_with

if TYPE_CHECKING:
    import numpy as np
    import pandas as pd
    import xarray as xr
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from overrun_hitch.experiments.torque import Torque
    from overrun_hitch.fitting.fit import Fit
    from overrun_hitch.fitting.trace import Trace
    from overrun_hitch.sweeps.job import Progress
    from overrun_hitch.sweeps.spec import SweepSpec

    Floats = NDArray[np.float64]
    Numbers = Sequence[float] | Floats
    Profile = Mapping[str, Numbers] | str | Path

TIME_LIMIT = 60.0  # s
MOST_WORKERS = 1000


def fmu_path(name: str = "CarTrailer", fmi: int = 2) -> Path:
    """The file of our FMU `name` (CarTrailer, Car, Trailer, Bench) of FMI `fmi` (2 or 3), built first if need be.

    An installed package brings the files; a clone of the repository builds them from Modelica with its C compiler.

    >>> fmu_path("Trailer", fmi=3).name
    'Trailer.fmu'
    """
    from overrun_hitch.fmu.files import build, is_current, place

    path = place(name, fmi)
    if not is_current(path):
        build(path)
    return path


def run(
    figure: str | int | None = None,
    case: str | None = None,
    *,
    fmu: str | Path | None = None,
    brake_torque: float | None = None,
    profile: Profile | None = None,
    grade: float = 0.0,
    duration: float | None = None,
    relative_tolerance: float = 1e-6,
    communication_step: float = 0.01,
    time_limit: float = TIME_LIMIT,
    **parameters: float,
) -> xr.Dataset:
    """A step brake of the paper's figure ("8" unless said otherwise) or of figure 8 with a case's parameters.

    `parameters` change single ones: C=200. brake_torque in N.m on the car's wheels (1000), duration in s (6). profile:
    the brake torque over time instead, {"time": [...], "brake_torque": [...]} or a file with these columns, straight
    lines between knots, two knots at one time for a jump. grade: rise of the road over its run, positive uphill.
    communication_step in s, from output point to output point. fmu: a file of somebody else's; it runs, like ours, in
    a process of its own for at most time_limit (s).

    The result has the FMU's outputs (time,) with units and long_name, and what was run as attributes.

    >>> result = run("8", C=200)
    >>> round(float(result["compression"].max()), 4), result["compression"].attrs["units"]
    (0.0512, 'm')
    >>> ramp = run(profile={"time": [0, 0.5, 2, 2], "brake_torque": [0, 1500, 1500, 0]}, grade=-0.05)
    >>> round(float(ramp["a_car"].min()), 2)
    -4.1
    """
    from overrun_hitch.experiments.step_brake import step_brake

    check_one_torque(profile, brake_torque)
    scenario = asked_scenario(figure, case, parameters, brake_torque=brake_torque, duration=duration)
    return step_brake(
        scenario,
        fmu=fmu_path() if fmu is None else Path(fmu),
        relative_tolerance=relative_tolerance,
        communication_step=communication_step,
        time_limit=time_limit,
        torque=_torque(profile),
        grade=grade,
    )


def _torque(profile: Profile | None) -> Torque | None:
    from overrun_hitch.comparison.sources import read_profile
    from overrun_hitch.experiments.torque import Torque

    if profile is None or isinstance(profile, str | Path):
        return None if profile is None else read_profile(Path(profile))
    check_kind("profile", profile, Mapping, "time and brake_torque are, or a file of them")
    missing = [name for name in ("time", "brake_torque") if name not in profile]
    if missing:
        raise HitchError(f"the profile has no {missing[0]}; needed: time (s) and brake_torque (N.m)")
    return Torque(*(numbers(name, profile[name]) for name in ("time", "brake_torque")))


def run_many(
    varied: Mapping[str, float | Numbers],
    figure: str | int | None = None,
    case: str | None = None,
    *,
    outputs: str | Sequence[str] = ("compression",),
    metrics: str | Sequence[str] = (),
    fmu: str | Path | None = None,
    workers: int | None = None,
    duration: float | None = None,
    relative_tolerance: float = 1e-6,
    communication_step: float = 0.06,
    time_limit: float = TIME_LIMIT,
    progress: Progress | None = None,
    **parameters: float,
) -> xr.Dataset:
    """Step brakes for every combination of the values in `varied`, parameters or brake_torque: {"C": [...], ...}.

    One instance runs them all, reset in between. workers: so many processes; 0: this one, which is the default for our
    own FMU (somebody else's gets a process for itself in any case). What else is as for `run`. progress is told runs
    done, failed ones among them, and runs in all; else a bar shows on a terminal. For more than fits into memory, for
    samples, profiles, clusters and interruptions: `sweep`.

    The result has dimensions as `varied`, and time: `outputs` over both, `metrics` (names in docs/sweep.md) and
    `message`, why a run failed or "", over the former.

    >>> many = run_many({"C": [100, 500], "eps": [0, 0.05, 0.1]}, metrics=["peak_compression"])
    >>> dict(many.sizes)
    {'C': 2, 'eps': 3, 'time': 101}
    >>> round(float(many["peak_compression"].sel(C=500, eps=0.1)), 4)
    0.1865
    """
    from overrun_hitch.show import terminal
    from overrun_hitch.sweeps.many import run_in_memory
    from overrun_hitch.sweeps.planner import planned
    from overrun_hitch.sweeps.spec import SweepSpec

    check_kind("varied", varied, Mapping, 'names and values are, {"C": [100, 500]}')
    base = _base(varied, asked_scenario(figure, case, parameters, duration=duration), parameters)
    grid = {name: numbers(name, values).tolist() for name, values in varied.items()}
    if workers is not None and not (isinstance(workers, int) and 0 <= workers <= MOST_WORKERS):
        raise HitchError(f"workers = {workers!r:.40} is not allowed; allowed: 0 to {MOST_WORKERS} processes")
    spec = SweepSpec(
        name="many runs", grid=grid, parameters=base, trajectories=names_in("outputs", outputs),
        metrics=names_in("metrics", metrics),
        **({} if duration is None else {"duration": duration}), communication_step=communication_step,
        relative_tolerance=relative_tolerance,
    )  # fmt: skip
    file = fmu_path() if fmu is None else Path(fmu)
    plan = planned(spec, [file])
    count = (0 if fmu is None else 1) if workers is None else max(workers, 0 if fmu is None else 1)
    if progress is not None:
        return run_in_memory(plan, file, time_limit, count, progress)
    with terminal.counting("runs", is_kept=False) as told:
        return run_in_memory(plan, file, time_limit, count, told)


def _base(varied: Mapping[str, float | Numbers], scenario: Scenario, given: Mapping[str, float]) -> dict[str, float]:
    """The parameters that stay the same. HitchError where one does not."""
    twice = [name for name in given if name in varied]
    if twice:
        raise HitchError(f"{twice[0]} is varied and given; allowed: one of them")
    return {name: value for name, value in scenario.parameters.model_dump().items() if name not in varied}


def compare(result: xr.Dataset, *, fmu: str | Path | None = None, time_limit: float = TIME_LIMIT) -> pd.DataFrame:
    """A result of `run` against linear theory: expected, found, difference, allowed, unit, verdict of each quantity.

    Growth rate and frequency of the shunting oscillation, the paper's A, A/A_c and D. The verdict is "agrees",
    "differs" or "not judged", with a reason. fmu: the file that was run, if it was not ours.

    >>> table = compare(run("8"))
    >>> set(table["verdict"])
    {'agrees'}
    """
    import pandas as pd

    from overrun_hitch.comparison.theory import compare as judged
    from overrun_hitch.experiments.step_brake import car_alone, step_brake
    from overrun_hitch.results import scenario_of

    check_result(result)
    scenario = scenario_of(result)
    profile = result.attrs["profile"]
    alone = step_brake(
        car_alone(scenario),
        fmu=fmu_path() if fmu is None else Path(fmu),
        relative_tolerance=float(result.attrs["relative_tolerance"]),
        communication_step=float(result.attrs["communication_step"]),
        time_limit=time_limit,
        torque=_torque(dict(zip(("time", "brake_torque"), json.loads(profile), strict=True)) if profile else None),
        grade=float(result.attrs["grade"]),
    )
    columns = ("unit", "expected", "found", "difference", "allowed", "verdict", "not_judged")
    rows = judged(result, alone)
    index = pd.Index([row.quantity for row in rows], name="quantity")
    table: pd.DataFrame = pd.DataFrame([[getattr(row, name) for name in columns] for row in rows], index, columns)
    return table


def crosscheck(
    files: Sequence[str | Path],
    figures: str | Sequence[str] = tuple(FIGURES),
    *,
    maps: Mapping[str, str | Path] | None = None,
    measured: bool = False,
    profile: Profile | None = None,
    duration: float | None = None,
    brake_torque: float | None = None,
    funnel: float = 1e-3,
    funnel_time: float = 1e-4,
    time_limit: float = TIME_LIMIT,
    **parameters: float,
) -> dict[str, Any]:
    """FMUs and traces of the paper's step brakes against the first of them, also "ours" (an FMU) or "theory".

    maps: a file of `files` to the TOML file with its names, signs and units. measured: traces have noise and a clock of
    their own. funnel: allowed distance, relative to a variable's range in the first; funnel_time: allowed shift in s.
    What else is as for `run`. Returns what `hitch crosscheck --json` prints (docs/crosscheck.md): "agrees", and under
    "figures" the "comparisons" of all but the first, with every number, tolerance and reason.

    >>> crosscheck(["ours", fmu_path(fmi=3)], ["8"])["agrees"]
    True
    """
    from overrun_hitch.comparison import record
    from overrun_hitch.comparison.crosscheck import crosscheck as checked
    from overrun_hitch.comparison.distances import Allowed
    from overrun_hitch.comparison.sources import OURS, Asked, Manoeuvre, opened_sources
    from overrun_hitch.fmu.settings import Settings
    from overrun_hitch.foreign.mapping import NO_NAMES, read_mapping

    check_one_torque(profile, brake_torque)
    check_files(files, maps or {}, names_in("figures", figures))
    names = {str(name): read_mapping(Path(file)) for name, file in (maps or {}).items()}
    asked = [
        Asked(fmu_path() if Path(file) == OURS else Path(file), names.get(str(file), NO_NAMES), None) for file in files
    ]
    scenarios = [
        asked_scenario(n, None, parameters, duration=duration, brake_torque=brake_torque)
        for n in names_in("figures", figures)
    ]
    manoeuvres = [Manoeuvre(scenario, Settings(), _torque(profile)) for scenario in scenarios]
    allowed = Allowed(funnel=funnel, funnel_time=funnel_time)
    with opened_sources(asked, time_limit) as sources:
        checks = [checked(one, sources, allowed, measured) for one in manoeuvres]
        return record.document(checks, record.compared(sources), manoeuvres, allowed, ())


def stability(
    case: str | None = None,
    *,
    C: float | Numbers = (0.0, 50.0, 100.0, 200.0, 400.0, 800.0, 1600.0, 3200.0),
    V: float | Numbers = 20.0,
    deceleration: float = 0.0,
    **parameters: float,
) -> xr.Dataset:
    """The shunting mode by linear theory for dampers C (N.s/m) and speeds V (m/s); no FMU is run.

    About gentle motion, or steady braking by `deceleration` (m/s2). HitchError for a parameter that theory lacks.

    The result has growth_rate (1/s), frequency (Hz), damping_ratio, amplitude_ratio, phase (deg) over V and C, and
    over V alone C_crit (N.s/m), the damper below which the combination shunts by itself.

    >>> found = stability("ii", V=[10, 20, 40])
    >>> [round(float(value), 1) for value in found["C_crit"]]
    [30.2, 60.4, 120.7]
    """
    import numpy as np
    import xarray as xr

    from overrun_hitch.modes.study import UNITS
    from overrun_hitch.modes.study import stability as analyse
    from overrun_hitch.parameters import CASES, DATUM

    start: Parameters = DATUM if case is None else named("case", case, CASES)
    speeds, dampers = numbers("V", V), numbers("C", C)
    check_kind("deceleration", deceleration, float | int | np.floating, "a number is, in m/s2")
    name = name_with("datum" if case is None else f"case {case}", start, start.changed(parameters))
    study = analyse(name, start.changed(parameters), dampers.tolist(), speeds.tolist(), deceleration)
    names = ("growth_rate", "frequency", "damping_ratio", "amplitude_ratio", "phase")
    shape = len(speeds), len(dampers)
    table = {key: np.array([getattr(row, key) for row in study.rows]).reshape(shape) for key in names}
    data: dict[str, Any] = {key: (("V", "C"), values, {"units": UNITS[key]}) for key, values in table.items()}
    data["C_crit"] = ("V", [each.C_crit for each in study.boundaries], {"units": UNITS["C_crit"]})
    axes: dict[str, Any] = {"V": ("V", speeds, {"units": "m/s"}), "C": ("C", dampers, {"units": "N.s/m"})}
    return xr.Dataset(data, axes, {"title": name, **study.parameters.model_dump()})


def fit(
    trace: Trace | Mapping[Any, Any] | pd.DataFrame | str | Path,
    names: str | Sequence[str] | None = None,
    *,
    columns: Mapping[str, str] | None = None,
    units: Mapping[str, str] | None = None,
    fmu: str | Path | None = None,
    **parameters: float,
) -> Fit:
    """A drawbar's parameters from a trace: what was measured, in SI units.

    A file (CSV, MAT, Parquet or MDF), a table or a result of `run`: time, compression, F_hitch and, where they were
    measured, v_rel and trailer_brake_torque, (n,) each. columns: of a file, what they are called there; units: theirs,
    else those in its header, else SI. names: the parameters to fit, else those that the trace tells; `parameters`: the
    others', where they are not figure 8's. fmu: a Bench.fmu of one's own.

    The result has `estimates` (name, value, standard_error, interval, told) and `parameters` (docs/fit.md).

    >>> found = fit(run("8", C=300), ["k", "C"])
    >>> {each.name: round(each.value / 10) * 10 for each in found.estimates}
    {'k': 5480, 'C': 300}
    """
    import pandas as pd

    from overrun_hitch.fitting.columns import read_trace
    from overrun_hitch.fitting.fit import fit as search
    from overrun_hitch.fitting.trace import UNITS, Trace
    from overrun_hitch.parameters import DATUM

    if isinstance(trace, str | Path):
        trace, _ = read_trace(Path(trace), columns or {}, units or {})
    elif not isinstance(trace, Trace):
        check_kind("trace", trace, Mapping | pd.DataFrame, "a file, a table or a result of hitch.run is")
        missing = [name for name in ("time", "compression", "F_hitch") if name not in trace]
        if missing:
            raise HitchError(f"the trace has no {missing[0]}; allowed: {', '.join(UNITS)}")
        trace = Trace(**{name: numbers(name, trace[name]) for name in UNITS if name in trace})
    wanted = None if names is None else names_in("names", names)
    return search(trace, DATUM.changed(parameters), wanted, fmu_path("Bench") if fmu is None else Path(fmu))


def plot(result: xr.Dataset) -> Figure:
    """The traces of a result of `run`, as the paper draws them; a notebook shows them, savefig writes them.

    >>> len(plot(run("8")).axes)
    3
    """
    from overrun_hitch.show.traces import draw

    check_result(result)
    return draw(result)


def sweep(
    spec: SweepSpec | Mapping[str, Any] | str | Path,
    store: str | Path,
    *,
    fmus: Sequence[str | Path] = (),
    scheduler: str | None = None,
    workers: int | None = None,
    repair: bool = False,
    time_limit: float = TIME_LIMIT,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Run what is missing of a sweep in the Zarr `store`, and return the whole; interrupted, it goes on from there.

    spec: a TOML file or its settings (docs/sweep.md). fmus: the files to run where the spec names none. scheduler: the
    address of a Dask scheduler; else `workers` processes on this machine. repair: run again what is damaged.
    """
    with what_is_missing_told():
        from overrun_hitch.show import terminal
        from overrun_hitch.sweeps.engine import sweep as run_sweep
        from overrun_hitch.sweeps.spec import SweepSpec

    check_kind("spec", spec, SweepSpec | Mapping | str | Path, "settings are, or a TOML file of them")
    asked = Path(spec) if isinstance(spec, str) else spec
    with terminal.counting("runs") as told:
        return run_sweep(
            asked,
            Path(store),
            fmus=[Path(file) for file in fmus],
            scheduler=scheduler,
            workers=workers,
            repair=repair,
            time_limit=time_limit,
            progress=progress or told,
        )
