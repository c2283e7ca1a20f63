"""Car.fmu and Trailer.fmu coupled, against CarTrailer.fmu, the same model in one piece."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import find_peaks

from overrun_hitch import cli
from overrun_hitch.coupling.pair import (
    CAR_PARAMETERS,
    SCHEMES,
    TRAILER_PARAMETERS,
    Coupled,
    Pair,
    opened_pair,
)
from overrun_hitch.coupling.study import CouplingStudy, gentle_braking, longest_stable_step, study_coupling
from overrun_hitch.coupling.trio import HITCH_PARAMETERS, Trio, opened_trio
from overrun_hitch.experiments.step_brake import brake
from overrun_hitch.fmu.description import described
from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.fmu.settings import Settings
from overrun_hitch.fmu.unit import HitchUnit
from overrun_hitch.parameters import CASES, FIGURES, HitchError
from overrun_hitch.results import values
from overrun_hitch.theory.linear import shunting_mode
from tests.sampling import sampled

BY_NAME = {scheme.name: scheme for scheme in SCHEMES}
V = 40.0


@pytest.fixture(scope="module")
def pair(pair_fmus: dict[int, dict[str, Path]]) -> Iterator[Pair]:
    with opened_pair(pair_fmus[2]["Car"], pair_fmus[2]["Trailer"]) as pair:
        yield pair


@pytest.fixture(scope="module")
def trio(pair_fmus: dict[int, dict[str, Path]], hitch_fmu: Path) -> Iterator[Trio]:
    with opened_trio(pair_fmus[2]["Car"], hitch_fmu) as trio:
        yield trio


@pytest.fixture(scope="module")
def whole(car_trailer_fmu: Path) -> Iterator[HitchUnit]:
    with opened_unit(car_trailer_fmu) as unit:
        yield unit


@pytest.fixture(scope="module")
def studies(pair: Pair, trio: Trio, whole: HitchUnit) -> dict[float, CouplingStudy]:
    """By C, over three steps, of the pair's schemes; test_hitch.py has the hitch alone."""
    steps = (0.005, 0.01, 0.02)
    cases = {C: CASES["ii"].changed({"C": C}) for C in (100.0, 500.0)}
    schemes = [scheme for scheme in SCHEMES if not scheme.alone]
    return {C: study_coupling(pair, trio, whole, case, V, steps, schemes=schemes) for C, case in cases.items()}


def test_each_unit_has_the_parameters_that_are_declared_to_be_its(
    pair_fmus: dict[int, dict[str, Path]], hitch_fmu: Path
) -> None:
    own = {"extrapolation", "applied_force", "M_front", "M_rear", "T_gap"}
    fmus = {**pair_fmus[2], "Hitch": hitch_fmu}
    declared = {"Car": CAR_PARAMETERS, "Trailer": TRAILER_PARAMETERS, "Hitch": HITCH_PARAMETERS}
    for unit, names in declared.items():
        assert described(fmus[unit]).parameters.keys() - own == set(names), unit


def errors(study: CouplingStudy, name: str) -> list[float]:
    return [point.growth_rate - study.whole.growth_rate for point in study.of(BY_NAME[name])]


@pytest.mark.parametrize("C", sampled([100.0, 500.0], [100.0]))
def test_jacobi_with_the_force_to_hold(studies: dict[float, CouplingStudy], C: float) -> None:
    """Asked for: 0.002 1/s at 10 ms."""
    found = errors(studies[C], "jacobi-hold")
    print(f"C = {C:g}, 5, 10, 20 ms: " + ", ".join(f"{error:+.5f}" for error in found))
    assert abs(found[0]) < 2e-5 and abs(found[1]) < 1e-4 and abs(found[2]) < 5e-4


def test_gauss_seidel_with_the_mean_force(studies: dict[float, CouplingStudy]) -> None:
    """Asked for: 1 % of the damping up to 10 ms."""
    found = errors(studies[500.0], "trailer-mean")
    print("5, 10, 20 ms: " + ", ".join(f"{error:+.6f}" for error in found))
    assert max(abs(error) for error in found[:2]) < 1e-4 * abs(studies[500.0].whole.growth_rate)


@pytest.mark.parametrize("name", ["jacobi", "jacobi-speed", "car-first"])
def test_what_is_late_feeds_the_oscillation_by_the_closed_form(studies: dict[float, CouplingStudy], name: str) -> None:
    for C, allowed in ((100.0, 0.02), (500.0, 0.12)):  # for light damping
        for point, error in zip(studies[C].of(BY_NAME[name]), errors(studies[C], name), strict=True):
            print(f"{name}, C = {C:g}, {1000 * point.H:g} ms: {error:.5f}, closed form {point.expected:.5f}")
            assert error == pytest.approx(point.expected, rel=allowed)


@pytest.mark.parametrize("name", ["jacobi-hold", "trailer-first", "trailer-mean", "iterated"])
def test_what_is_not_late_errs_by_a_twentieth_of_that(studies: dict[float, CouplingStudy], name: str) -> None:
    for study in studies.values():
        for late, error in zip(errors(study, "jacobi"), errors(study, name), strict=True):
            assert abs(error) < 0.05 * late


def test_a_coarse_step_makes_a_stable_combination_shunt(pair: Pair, trio: Trio, whole: HitchUnit) -> None:
    """Plain Jacobi at twice the step of the closed form; the force to hold does not at the same step."""
    p = CASES["ii"].changed({"C": 200.0})
    step = longest_stable_step(BY_NAME["jacobi"], p, float(shunting_mode(p, V).growth_rate))
    assert 0.03 < step < 0.06
    schemes = [BY_NAME["jacobi"], BY_NAME["jacobi-hold"]]
    jacobi, hold = study_coupling(pair, trio, whole, p, V, [0.05], schemes=schemes).points
    assert float(shunting_mode(p, V).growth_rate) < -0.1
    assert jacobi.growth_rate > 0.0 > hold.growth_rate


def test_a_scheme_that_fails_does_not_stop_the_others(
    pair: Pair, trio: Trio, whole: HitchUnit, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Repeating steps comes to no end where it is allowed two iterations."""
    monkeypatch.setattr("overrun_hitch.coupling.pair.ITERATIONS", 2)
    schemes = [BY_NAME[name] for name in ("iterated", "trailer-mean")]
    failed, other = study_coupling(pair, trio, whole, CASES["ii"], V, [0.1], schemes=schemes).points
    assert np.isnan(failed.created) and np.isfinite(other.created)


def run(pair: Pair, name: str, H: float, C: float = 500.0, duration: float = 6.0) -> Coupled:
    braking = gentle_braking(CASES["ii"].changed({"C": C}), V)
    return pair.run(BY_NAME[name], braking.parameters, braking.brake_torque, duration, H, 1e-9)


def test_the_mean_force_conserves_momentum(pair: Pair) -> None:
    """What the car has got is what the trailer gave, to rounding."""
    for name in ("trailer-mean", "iterated"):
        done = run(pair, name, 0.01)
        assert np.abs(done.given - done.values["ball.impulse"]).max() < 1e-11 * np.abs(done.given).max()


def test_the_force_to_hold_owes_at_most_a_step(pair: Pair) -> None:
    done = run(pair, "jacobi-hold", 0.01, duration=60.0)
    owed = np.abs(done.given - done.values["ball.impulse"])
    a_step = 0.01 * np.abs(done.values["F_hitch"]).max()
    print(f"owed after 60 s {owed[-1]:.1e} N.s, at most {owed.max():.1e} N.s; a step transmits {a_step:.2f} N.s")
    assert owed.max() < a_step and owed[-1] < 1e-3 * a_step


@pytest.mark.parametrize("name", [name for name in BY_NAME if not name.startswith(("trailer-first", "alone"))])
def test_the_unit_tells_the_energy_that_is_created(pair: Pair, name: str) -> None:
    """One step late, from the speeds at the communication points alone: the car's true place is not known to it.

    What the trapezoidal rule leaves of that is below 5e-5 J, of 1.2 MJ that move. Not with the force at the end of a
    step applied over the same step: the unit takes it to be held over the next.
    """
    for C in (100.0, 500.0):
        done = run(pair, name, 0.005, C)
        settled = slice(20, None)  # the wheels take up the brake torque within a step
        told = done.values["coupling_energy"][1:][settled]
        created = done.created[:-1][settled]
        print(f"{name}, C = {C:g}: created {created[-1]:.3e} J, told {told[-1]:.3e} J")
        assert np.abs(told - created).max() < 0.01 * np.ptp(created) + 5e-5


@pytest.mark.parametrize(("name", "order"), [("jacobi", 0.9), ("jacobi-speed", 0.9), ("jacobi-hold", 2.5)])
def test_the_created_energy_goes_to_zero_with_the_step(pair: Pair, name: str, order: float) -> None:
    coarse, fine = (float(np.abs(run(pair, name, H).created[round(1.0 / H) :]).max()) for H in (0.02, 0.01))
    print(f"{name}: {coarse:.2e} J at 20 ms, {fine:.2e} J at 10 ms")
    assert np.log2(coarse / fine) > order


def test_clearance_at_ten_milliseconds(pair: Pair, whole: HitchUnit) -> None:
    """Figure 10 under Jacobi with the force to hold: peaks of the compression within 1 %."""
    scenario = FIGURES["10"]
    done = pair.run(BY_NAME["jacobi-hold"], scenario.parameters, scenario.brake_torque, 6.0, 0.01, 1e-9)
    exact = values(brake(whole, scenario, Settings(relative_tolerance=1e-9)), "compression")
    peaks, _ = find_peaks(exact, prominence=1e-3)
    found, _ = find_peaks(done.values["compression"], prominence=1e-3)
    assert len(found) == len(peaks) >= 8
    ratios = done.values["compression"][found] / exact[peaks]
    print("peaks over those of the model in one piece: " + ", ".join(f"{ratio:.5f}" for ratio in ratios))
    np.testing.assert_allclose(ratios, 1.0, atol=0.01)


def test_the_stiff_tension_stop(pair: Pair, whole: HitchUnit) -> None:
    """Figure 6a, whose drawbar strikes a stop of 548 000 N/m eleven times: the largest compression."""
    scenario = FIGURES["6a"]
    fine = Settings(relative_tolerance=1e-9, communication_step=0.001)
    exact = values(brake(whole, scenario, fine), "compression").max()
    errors = {}
    for name in ("jacobi", "jacobi-speed", "jacobi-hold", "trailer-mean"):
        for H in (0.001, 0.005, 0.01):
            done = pair.run(BY_NAME[name], scenario.parameters, scenario.brake_torque, 6.0, H, 1e-9)
            errors[name, H] = float(done.values["compression"].max() / exact - 1.0)
            print(f"{name}, {1000 * H:g} ms: {100 * errors[name, H]:+.2f} %")
    assert abs(errors["jacobi-hold", 0.005]) < 1e-3 and abs(errors["jacobi-hold", 0.01]) < 0.01
    assert abs(errors["trailer-mean", 0.01]) < 2e-3
    assert errors["jacobi", 0.005] > 0.3 and errors["jacobi-speed", 0.005] > 0.1


def test_push_and_pull(pair: Pair) -> None:
    """A trailer that is pushed in pushes the car forward; one that hangs back pulls it."""
    for start, sign in ((0.02, 1.0), (-0.001, -1.0)):
        parameters = CASES["ii"].changed({"C": 500.0, "compression_start": start, "V_0": 20.0})
        done = pair.run(BY_NAME["jacobi-hold"], parameters, 0.0, 0.02, 0.01, 1e-9)
        assert sign * done.values["F_hitch"][0] > 0.0
        assert sign * done.given[-1] > 0.0 and sign * (done.values["v_car"][-1] - 20.0) > 0.0
        assert sign * (done.values["v_trailer"][-1] - 20.0) < 0.0


def test_other_fmus_are_refused(pair_fmus: dict[int, dict[str, Path]], car_trailer_fmu: Path) -> None:
    with (
        pytest.raises(HitchError, match="is not a trailer: it has no variable"),
        opened_pair(pair_fmus[2]["Car"], car_trailer_fmu),
    ):
        pass


@pytest.fixture
def command(pair_fmus: dict[int, dict[str, Path]], hitch_fmu: Path, car_trailer_fmu: Path, tmp_path: Path) -> list[str]:
    """`hitch couple` with the FMUs under test."""
    files = {"car": pair_fmus[2]["Car"], "trailer": pair_fmus[2]["Trailer"], "hitch": hitch_fmu}
    options = [("--whole", str(car_trailer_fmu)), ("--output", str(tmp_path / "out"))]
    options += [(f"--{name}", str(file)) for name, file in files.items()]
    return ["couple", *(word for option in options for word in option)]


def test_the_command(command: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main([*command, "--H", "0.02,0.05", "--set", "C=300"]) == 0
    out = capsys.readouterr().out
    for scheme in SCHEMES:
        assert f"{scheme.name}: {scheme.what}" in " ".join(out.split())
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        f"case-ii-C=300.{kind}" for kind in ("csv", "png", "svg")
    ]
    with (tmp_path / "out" / "case-ii-C=300.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 2 * len(SCHEMES)
    assert {float(row["H [s]"]) for row in rows} == {0.02, 0.05}


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (("--H", "0"), "H = 0 s is not allowed"),
        (("--H", "0.2"), "at most 0.1 s"),
        (("--H", "soon"), "is no number"),
        (("--V", "0"), "V_0"),
        (("--case", "x"), "no case 'x'"),
        (("--set", "C=-1"), "C = -1"),
    ],
)
def test_bad_input(
    command: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str], more: tuple[str, str], message: str
) -> None:
    assert cli.main([*command, *more]) == 2
    captured = capsys.readouterr()
    assert captured.out == "" and message in captured.err and captured.err.count("\n") == 1
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("mu", [1.0, 0.3])
@pytest.mark.parametrize("eps", [0.0, 0.1])
@pytest.mark.parametrize("C", [20.0, 500.0, 3200.0])
def test_the_pair_comes_to_rest(pair: Pair, whole: HitchUnit, C: float, eps: float, mu: float) -> None:
    """From 30 m/s and 10 s beyond, force to hold, 10 ms: it stops where the whole does, and stands."""
    p = CASES["ii"].changed({"C": C, "eps": eps, "mu": mu, "V_0": 30.0, "CdA_c": 0.7, "CdA_t": 1.2, "C_rr": 0.01})
    torque, duration = (2000.0, 16.0) if mu == 1.0 else (900.0, 24.0)
    coupled = pair.run(BY_NAME["jacobi-hold"], p, torque, duration, 0.01, 1e-6)
    whole.start(p, {"brake_torque": torque}, 1e-6)
    for n in range(round(duration * 100)):
        whole.step(n * 0.01, 0.01)
    way = whole.get(["car.body.x"])[0]
    assert all(np.isfinite(samples).all() for samples in coupled.values.values())
    speeds = np.abs([coupled.values["v_car"], coupled.values["v_trailer"]]).max(axis=0)
    standstill, found = np.flatnonzero(speeds > 0.1)[-1] * 0.01, coupled.values["car.body.x"][-1]
    last = coupled.values["v_car"][-1], coupled.values["v_trailer"][-1]
    print(f"C = {C:g}, eps = {eps:g}, mu = {mu:g}: {standstill:.2f} s, {found:.3f} m ({way:.3f} m), then {last} m/s")
    assert standstill < duration - 5.0
    assert found == pytest.approx(way, rel=1e-3)
    # A trailer that has stopped in the clearance has little but the damper to settle it: it moves as the whole does.
    assert speeds[-1] < max(1e-6, 2.0 * np.abs(whole.get(["v_car", "v_trailer"])).max())
