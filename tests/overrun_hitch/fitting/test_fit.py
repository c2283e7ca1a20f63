"""`hitch fit` on traces whose truth is known: made by the bench itself, with noise added, and by car and trailer."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter1d

from overrun_hitch import cli
from overrun_hitch.commands.options import parameters_of
from overrun_hitch.experiments.step_brake import step_brake
from overrun_hitch.fitting.bench import opened_bench
from overrun_hitch.fitting.estimates import Estimate
from overrun_hitch.fitting.fit import fit
from overrun_hitch.fitting.motion import Motion, motion
from overrun_hitch.fitting.table import COHERENT, remarks
from overrun_hitch.fitting.trace import Trace
from overrun_hitch.measure.noise import noise
from overrun_hitch.parameters import DATUM, FIGURES, HitchError
from overrun_hitch.results import values
from tests.kept import kept_fmus

TRUTH = DATUM.changed(
    {"k": 6000.0, "C": 450.0, "rebound": 2.5, "F_f": 70.0, "F_0": 150.0, "eps": 0.002, "tau_b": 0.025, "r": 15000.0}
)
FITTED = ("k", "F_0", "C", "rebound", "F_f", "eps", "r", "tau_b")
NOISE = {"compression": 1e-4, "F_hitch": 5.0, "v_rel": 5e-3, "trailer_brake_torque": 5.0}  # SI, standard deviations
FINER = 10  # steps of the truth in one between samples


@pytest.fixture(scope="session")
def bench_fmu() -> Path:
    return kept_fmus("Systems.Bench", fmi=2)["Bench"]


def truth(fmu: Path, parameters: Mapping[str, float], slow: float = 1.0, middle: float = 0.0315) -> Trace:
    """Three sines through clearance, threshold and spring, sampled each 10 ms, or the same `slow` times as slow."""
    time = 0.01 * slow / FINER * np.arange(600 * FINER + 1)
    waves = ((0.02, 1.0, -1.2), (0.009, 0.37, 0.0), (0.004, 2.3, 0.0))  # m, Hz, rad
    phases = [2.0 * np.pi * f / slow * time + phase for _, f, phase in waves]
    x = middle + sum(a * np.sin(phase) for (a, _, _), phase in zip(waves, phases, strict=True))
    v = sum(a * 2.0 * np.pi * f / slow * np.cos(p) for (a, f, _), p in zip(waves, phases, strict=True))
    with opened_bench(fmu, Motion(time, x, v, error=0.0, memory=1, still=time < 0.0)) as bench:
        force, torque = bench.run(parameters)
    every = slice(None, None, FINER)
    return Trace(time[every], x[every], force[every], v[every], torque[every])


def noisy(trace: Trace, seed: int, share: Mapping[str, float] = NOISE) -> Trace:
    random = np.random.default_rng(seed)
    channels = trace.channels()
    return Trace(**{
        name: channel + share.get(name, 0.0) * random.normal(size=len(channel)) for name, channel in channels.items()
    })  # fmt: skip


def by_name(estimates: tuple[Estimate, ...]) -> dict[str, Estimate]:
    return {estimate.name: estimate for estimate in estimates}


def inside(estimate: Estimate) -> bool:
    low, high = estimate.interval
    return bool(low <= getattr(TRUTH, estimate.name) <= high)


@pytest.fixture(scope="module")
def exact(bench_fmu: Path) -> Trace:
    return truth(bench_fmu, TRUTH.model_dump())


@pytest.mark.full
def test_without_noise_it_finds_the_truth(bench_fmu: Path, exact: Trace) -> None:
    found = fit(exact, fmu=bench_fmu)
    assert [estimate.name for estimate in found.estimates] == list(FITTED)
    for estimate in found.estimates:
        assert estimate.value == pytest.approx(getattr(TRUTH, estimate.name), rel=0.01), estimate.name
        assert estimate.told


def test_a_trace_with_noise(bench_fmu: Path, exact: Trace) -> None:
    """The bound of the 100 seeds below, on one: no value is off by more than four standard errors."""
    found = fit(noisy(exact, 0), fmu=bench_fmu)
    for estimate in found.estimates:
        off = abs(estimate.value - getattr(TRUTH, estimate.name))
        assert estimate.told and off < 4.0 * estimate.standard_error, estimate.name
    assert all(0.8 < excess < 1.2 for excess in found.excess.values())
    assert all(abs(coherence) < COHERENT for coherence in found.coherence.values())
    assert not remarks(found)


@pytest.mark.full
def test_each_true_value_is_in_its_interval_in_90_of_100(bench_fmu: Path, exact: Trace) -> None:
    hits = dict.fromkeys(FITTED, 0)
    for seed in range(100):
        for estimate in fit(noisy(exact, seed), fmu=bench_fmu).estimates:
            hits[estimate.name] += inside(estimate)
    print(hits)
    assert min(hits.values()) >= 90, hits


def test_slow_motion_does_not_tell_what_follows_the_rate(bench_fmu: Path) -> None:
    """2 mm/s at most: the damper makes 2 N and the lag 1 N.m, beside a noise of 5."""
    slow = truth(bench_fmu, TRUTH.model_dump(), slow=100.0)
    estimates = by_name(fit(noisy(slow, 0, {**NOISE, "v_rel": 5e-5}), fmu=bench_fmu).estimates)
    told = {name for name, estimate in estimates.items() if estimate.told}
    assert told == set(FITTED) - {"C", "rebound", "tau_b"}


@pytest.mark.full
def test_a_trace_beyond_the_threshold_does_not_tell_it_from_the_clearance(bench_fmu: Path) -> None:
    """Only their sum is in the force; the brakes, which begin where the spring does, tell them apart."""
    pushed = noisy(truth(bench_fmu, TRUTH.model_dump(), middle=0.05), 0)
    assert all(estimate.told for estimate in fit(pushed, fmu=bench_fmu).estimates)
    without = Trace(pushed.time, pushed.compression, pushed.F_hitch, pushed.v_rel)
    estimates = by_name(fit(without, fmu=bench_fmu).estimates)
    assert not estimates["F_0"].told and not estimates["eps"].told
    assert estimates["k"].told and estimates["F_f"].told


@pytest.mark.full
def test_further_stiffnesses_and_where_they_begin(bench_fmu: Path) -> None:
    stiffer = TRUTH.changed({"x_2": 0.03, "k_2": 9000.0})
    trace = noisy(truth(bench_fmu, stiffer.model_dump()), 0)
    found = fit(trace, stiffer.changed({"k_2": 1.0}), ["k", "x_2", "k_2", "C", "rebound", "F_f"], bench_fmu)
    for estimate in found.estimates:
        off = abs(estimate.value - getattr(stiffer, estimate.name))
        assert estimate.told and off < 4.0 * estimate.standard_error, estimate.name


@pytest.mark.full
def test_a_step_brake_of_car_and_trailer_gives_its_own_parameters(bench_fmu: Path, car_trailer_fmu: Path) -> None:
    """Another unit made the trace, and nobody measured the rate."""
    run = step_brake(FIGURES["7"], fmu=car_trailer_fmu)
    names = ("time", "compression", "F_hitch", "trailer_brake_torque")
    trace = Trace(**{name: values(run, name) for name in names})
    parameters = FIGURES["7"].parameters
    found = fit(trace, parameters, ["k", "C", "r"], bench_fmu).parameters
    assert [found.k, found.C, found.r] == pytest.approx([parameters.k, parameters.C, parameters.r], rel=0.01)


def test_the_motion_is_that_behind_the_noise(exact: Trace) -> None:
    """With a speed or without, and whatever its offset; the error is about what is told."""
    assert exact.v_rel is not None
    measured = noisy(exact, 1)
    assert noise(measured.compression) == pytest.approx(NOISE["compression"], rel=0.15)
    for speed in (None, measured.v_rel, exact.v_rel + 0.05):
        moved = motion(Trace(measured.time, measured.compression, measured.F_hitch, speed))
        off = float(np.std(moved.compression - exact.compression))
        assert off < moved.error < 3.0 * off < 2.0 * NOISE["compression"]


def moved_and_held(fmu: Path, rounding: int) -> Trace:
    """In and out by 40 mm at 100 mm/s, half of the time at rest, stopped within some `rounding` ms."""
    time = 1e-3 * np.arange(10001)
    x = gaussian_filter1d(0.03 + 0.02 * np.clip(1.6 * np.sin(np.pi * time), -1.0, 1.0), rounding)
    rate, still = np.gradient(x, time), np.zeros(len(time), dtype=bool)
    with opened_bench(fmu, Motion(time, x, rate, error=0.0, memory=1, still=still)) as bench:
        force, _ = bench.run(TRUTH.model_dump())
    return Trace(time[::10], x[::10], force[::10], rate[::10])


@pytest.mark.full
@pytest.mark.parametrize("rounding", [20, 60])
@pytest.mark.parametrize("rate", [False, True])
def test_values_that_are_far_off_are_told(bench_fmu: Path, rounding: int, rate: bool) -> None:
    """With 0.3 mm and stops the motion found is smoother than the true one; what it puts off by 3 errors says so."""
    exact = moved_and_held(bench_fmu, rounding)
    for seed in range(4):
        trace = noisy(exact, seed, {**NOISE, "compression": 3e-4})
        seen = trace if rate else Trace(trace.time, trace.compression, trace.F_hitch)
        found = fit(seen, TRUTH, ["k", "C", "F_f"], bench_fmu)
        off = [(e.value - getattr(TRUTH, e.name)) / e.standard_error for e in found.estimates]
        said = " ".join(remarks(found))
        print(f"{rounding} ms, coherence {found.coherence['F_hitch']:.2f}, excess {found.excess['F_hitch']:.2f}: {off}")
        assert max(map(abs, off)) < 3.0 or "hangs together" in said or "times its noise" in said


@pytest.mark.full
def test_a_guide_that_is_held_keeps_its_friction(bench_fmu: Path) -> None:
    """Half of the time it rests, while the travel's noise is as large as the travel over which friction reverses."""
    moved = moved_and_held(bench_fmu, 20)
    trace = noisy(Trace(moved.time, moved.compression, moved.F_hitch), 0)
    found = fit(trace, TRUTH, ["k", "C", "F_f"], bench_fmu)
    assert found.parameters.F_f == pytest.approx(TRUTH.F_f, rel=0.1)
    assert 0.2 < np.mean(found.motion.still) < 0.8


def test_a_drawbar_that_does_not_move(exact: Trace) -> None:
    trembling = 1e-4 * np.random.default_rng(0).normal(size=len(exact.time))
    with pytest.raises(HitchError, match="compression moves no further than its noise"):
        fit(Trace(exact.time, trembling, 6e3 * trembling), fmu=Path("none.fmu"))
    with pytest.raises(HitchError, match="the drawbar is never pushed in"):
        fit(Trace(exact.time, exact.compression - 1.0, exact.F_hitch), fmu=Path("none.fmu"))


def test_names_that_cannot_be_fitted(exact: Trace) -> None:
    without = Trace(exact.time, exact.compression, exact.F_hitch)
    for names, message in (
        (["M_c"], "no parameter to fit 'M_c'"),
        (["tau_b"], "no trailer_brake_torque"),
        ([], "nothing"),
    ):
        with pytest.raises(HitchError, match=message):
            fit(without, names=names, fmu=Path("none.fmu"))


def test_the_command(
    bench_fmu: Path, exact: Trace, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Columns by name, units by header and by option; JSON; the files; a file of parameters for other commands."""
    monkeypatch.setattr("overrun_hitch.commands.fit.our_fmu", lambda _: bench_fmu)
    table = np.column_stack([exact.time, 1e3 * exact.compression, exact.F_hitch / 1e3, exact.trailer_brake_torque])
    trace = tmp_path / "bench run.csv"
    np.savetxt(trace, table, delimiter=",", header="t,travel [mm],push,torque (Nm)", comments="", fmt="%.9g")
    arguments = ["fit", str(trace), "--time", "t", "--compression", "travel", "--force", "push", "--unit", "force=kN"]
    options = ["--torque", "torque", "--output", str(tmp_path / "out"), "--json"]
    assert cli.main([*arguments, *options]) == 0
    out, err = capsys.readouterr()
    said = json.loads(out)
    assert err == "" and said["remarks"][0] == "t: no unit given, taken as s"
    assert said["parameters"]["k"]["value"] == pytest.approx(TRUTH.k, rel=0.01)
    assert sorted(path.suffix for path in (tmp_path / "out").iterdir()) == [".csv", ".png", ".svg", ".toml"]
    assert parameters_of(Path(said["files"][1]))["k"] == said["parameters"]["k"]["value"]
