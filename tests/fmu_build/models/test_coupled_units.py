"""Trailer, Car and Hitch.fmu, which are to be coupled: the files, the trailer behind a given speed, the pair."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from collections.abc import Callable, Iterator
from math import cos, sin
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.validation import validate_fmu
from lxml import etree
from scipy.integrate import solve_ivp

from fmu_build.pipeline import build
from tests.kept import kept_fmus
from tests.sampling import sampled, spread
from tests.unit import Unit

NAMES = ("Trailer", "Car")
VERSIONS = (2, 3)
FORCES = ("F_hitch", "F_hitch_mean", "F_hitch_hold")
Fmus = dict[tuple[str, int], Path]


@pytest.fixture
def fmus(pair_fmus: dict[int, dict[str, Path]]) -> Fmus:
    return {(name, version): fmu for version, units in pair_fmus.items() for name, fmu in units.items()}


@pytest.fixture
def start(fmus: Fmus, car_trailer_fmu: Path, tmp_path: Path) -> Iterator[Callable[..., Unit]]:
    """Instances at their first communication point, freed at the end of the test."""
    units: list[Unit] = []

    def create(name: str, tolerance: float = 1e-9, **values: float) -> Unit:
        unit = Unit(car_trailer_fmu if name == "CarTrailer" else fmus[name, 2], tmp_path / f"{name}{len(units)}")
        unit.slave.instantiate()
        unit.set(**values)
        unit.slave.setupExperiment(tolerance=tolerance, startTime=0.0)
        unit.slave.enterInitializationMode()
        unit.slave.exitInitializationMode()
        units.append(unit)
        return unit

    yield create
    for unit in units:
        unit.slave.terminate()
        unit.slave.freeInstance()


@pytest.mark.parametrize(("name", "version"), spread(NAMES, VERSIONS))
def test_both_checkers_find_nothing(fmus: Fmus, name: str, version: int) -> None:
    checked_by_both(fmus[name, version], version)


@pytest.mark.full
@pytest.mark.parametrize("version", sampled(VERSIONS, [2]))
def test_nor_in_the_hitch_alone(version: int) -> None:
    checked_by_both(kept_fmus("Systems.Hitch", fmi=version)["Hitch"], version)


def checked_by_both(fmu: Path, version: int) -> None:
    assert validate_fmu(str(fmu)) == []
    command = [str(Path(sys.executable).with_name("fmutool")), "-input", str(fmu), "-check"]
    result = subprocess.run(command, capture_output=True, text=True, check=True)
    report = result.stdout + result.stderr
    assert f"compliant with FMI-{version}.0" in report and "No semantic error" in report
    assert "WARNING" not in report and "ERROR" not in report


@pytest.mark.full
@pytest.mark.parametrize("version", sampled(VERSIONS, [3]))
def test_the_same_source_gives_the_same_bytes(fmus: Fmus, modelica_library: Path, tmp_path: Path, version: int) -> None:
    build(modelica_library, "OverrunHitch.Systems.Trailer", tmp_path / "Trailer.fmu", version)
    assert (tmp_path / "Trailer.fmu").read_bytes() == fmus["Trailer", version].read_bytes()


def terminals(fmu: Path) -> dict[str, dict[str, tuple[str, str]]]:
    """Terminal to member to (variable, kind), from a file that follows its schema."""
    schema_file = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"
    with zipfile.ZipFile(fmu) as archive:
        root = etree.fromstring(archive.read("terminalsAndIcons/terminalsAndIcons.xml"))
    etree.XMLSchema(etree.parse(str(schema_file))).assertValid(root)
    assert {terminal.get("matchingRule") for terminal in root.iter("Terminal")} <= {"plug"}
    return {
        terminal.get("name"): {
            member.get("memberName"): (member.get("variableName"), member.get("variableKind"))
            for member in terminal.iter("TerminalMemberVariable")
        }
        for terminal in root.iter("Terminal")
    }


def test_the_two_hitches_fit(fmus: Fmus, car_trailer_fmus: dict[int, Path]) -> None:
    """Equal member names and units; an output on one side, an input on the other; what flows out here flows in."""
    assert terminals(car_trailer_fmus[3]) == {}
    hitches = {name: terminals(fmus[name, 3])["hitch"] for name in NAMES}
    assert {name: sorted(hitch) for name, hitch in hitches.items()} == {name: ["F", "v"] for name in NAMES}
    variables = {
        name: {v.name: v for v in fmpy.read_model_description(str(fmus[name, 3])).modelVariables} for name in NAMES
    }
    for member, kinds in (("F", {"inflow", "outflow"}), ("v", {"signal"})):
        ends = [(variables[name][hitches[name][member][0]], hitches[name][member][1]) for name in NAMES]
        assert {kind for _, kind in ends} == kinds
        assert {variable.causality for variable, _ in ends} == {"input", "output"}
        assert len({variable.unit for variable, _ in ends}) == 1


@pytest.mark.full
def test_the_hitch_alone_fits_both_bodies() -> None:
    """In front as Trailer does; behind it gives the brake torque too, and what flows in there flows out in front."""
    ports = terminals(kept_fmus("Systems.Hitch", fmi=3)["Hitch"])
    assert ports["hitch"] == {"v": ("v_car", "signal"), "F": ("F_hitch_hold", "outflow")}
    assert ports["trailer"] == {
        "v": ("v_trailer", "signal"),
        "brake_torque": ("trailer_brake_torque_hold", "signal"),
        "F": ("F_hitch_hold", "inflow"),
    }


def test_names_of_the_hitch(hitch_fmu: Path) -> None:
    variables = fmpy.read_model_description(str(hitch_fmu)).modelVariables
    by_causality = {kind: {v.name for v in variables if v.causality == kind} for kind in ("input", "output")}
    assert by_causality["input"] == {"v_car", "v_trailer", "a_car", "a_trailer", "compression_in"}
    assert by_causality["output"] == {
        *(f"{name}{kind}" for name in ("F_hitch", "trailer_brake_torque") for kind in ("", "_mean", "_hold")),
        "coupling_energy", "compression", "v_rel",
    }  # fmt: skip


def test_names_of_the_trailer(fmus: Fmus) -> None:
    description = fmpy.read_model_description(str(fmus["Trailer", 2]))
    by_causality = {
        kind: {v.name for v in description.modelVariables if v.causality == kind}
        for kind in ("input", "output", "parameter")
    }
    assert by_causality["input"] == {"v_car", "a_car", "grade"}
    assert by_causality["output"] == {
        *FORCES,
        *"coupling_energy compression v_rel v_trailer a_trailer slip_trailer trailer_brake_torque".split(),
    }
    assert {"extrapolation", "applied_force", "k", "k_t", "C", "r", "eps"} <= by_causality["parameter"]
    assert all(v.unit and v.description for v in description.modelVariables)
    starts = {v.name: float(v.start) for v in description.modelVariables if v.causality == "parameter"}
    assert (starts["extrapolation"], starts["applied_force"]) == (1.0, 3.0)


def test_coasting_leaves_the_drawbar_alone(start: Callable[..., Unit]) -> None:
    trailer = start("Trailer", 1e-6, V_0=25.0, v_car=25.0)
    largest = 0.0
    for step in range(10_000):
        trailer.set(v_car=25.0)
        trailer.slave.doStep(step * 0.1, 0.1)
        largest = max(largest, abs(trailer.get("compression")[0]))
    print(largest, trailer.get(*FORCES, "coupling_energy"))
    assert largest < 1e-9
    assert np.abs(trailer.get(*FORCES, "coupling_energy")).max() < 1e-5


def profile(t: float) -> float:
    return 30.0 - 2.0 * t + 0.02 * sin(4.0 * t)


def slope(t: float) -> float:
    return -2.0 + 0.08 * cos(4.0 * t)


def paper(t: float, state: np.ndarray) -> np.ndarray:
    """Compression, speed and wheel of the trailer behind the profile, by the paper's equations 2, 4 to 6 and 8."""
    compression, v, omega = state
    v_rel = v - profile(t)
    hitch = -500.0 * v_rel - 5480.0 * compression  # positive in tension
    tyre = 200_000.0 * (v - 0.35 * omega) / v
    return np.array([v_rel, (hitch - tyre) / 500.0, (0.35 * tyre - 16303.0 * compression) / 2.5])


@pytest.mark.parametrize(("known", "size", "bound"), [(False, 0.001, 1e-7), (True, 0.002, 1e-7), (False, 0.01, 1e-6)])
def test_behind_a_speed_in_closed_form(start: Callable[..., Unit], known: bool, size: float, bound: float) -> None:
    """The drawbar stays pushed in, so that the equations are smooth. If only values are given, nothing is known of the
    slope in the first step."""
    compression = 0.019
    trailer = start("Trailer", 1e-9, V_0=30.0, v_car=profile(0.0), compression_start=compression, C=500.0)
    steps = round(3.0 / size)
    times = size * np.arange(steps + 1)
    truth = solve_ivp(paper, (0.0, 3.0), [compression, 30.0, 30.0 / 0.35], "DOP853", times, rtol=1e-12, atol=1e-13).y
    assert truth[0].min() > 0.005
    errors = []
    for i in range(steps):
        trailer.set(v_car=profile(times[i]), a_car=slope(times[i]) if known else 0.0)
        trailer.slave.doStep(times[i], size)
        errors.append(trailer.get("compression")[0] - truth[0, i + 1])
    print(known, size, np.abs(errors).max(), np.abs(errors[1:]).max())
    assert np.abs(errors[0 if known else 1 :]).max() < bound


def test_signs_a_trailer_that_pushes_gives_positive_forces(start: Callable[..., Unit]) -> None:
    for compression in (0.05, -0.001):
        trailer = start("Trailer", V_0=25.0, v_car=25.0, compression_start=compression)
        trailer.slave.doStep(0.0, 0.001)
        forces = trailer.get(*FORCES)
        assert np.all(forces > 0.0) if compression > 0.0 else np.all(forces < 0.0)
        assert trailer.get("ball.impulse")[0] == pytest.approx(0.001 * forces[1], rel=1e-12)


def test_derivatives_of_the_replaced_outputs_are_those_of_the_force(start: Callable[..., Unit]) -> None:
    trailer = start("Trailer", V_0=25.0, v_car=25.0, compression_start=0.05)
    trailer.slave.doStep(0.0, 0.001)
    references = trailer.references
    unknown = [references[name] for name in (*FORCES, "coupling_energy")]
    derivatives = trailer.slave.getDirectionalDerivative(unknown, [references["v_car"]], [1.0])
    assert derivatives == pytest.approx([-500.0, -500.0, -500.0, 0.0])


def test_forces_depend_on_the_speed_now_until_the_first_step(start: Callable[..., Unit]) -> None:
    """Why `dependencies` lists v_car for all three, and no other output of Car than a_car depends on the force now."""
    trailer, car = start("Trailer"), start("Car")
    slopes = {}
    for stepped in (False, True):
        before = trailer.get(*FORCES)
        trailer.set(v_car=trailer.get("v_car")[0] + 0.5)
        slopes[stepped] = (trailer.get(*FORCES) - before) / 0.5
        trailer.slave.doStep(0.01 * stepped, 0.01)
    assert slopes[False] == pytest.approx([-500.0, -500.0, -500.0])  # the damper's
    assert slopes[True] == pytest.approx([-500.0, 0.0, 0.0])
    at_rest = car.outputs()
    car.set(F_hitch=100.0)
    outputs = [v.name for v in car.description.modelVariables if v.causality == "output"]
    assert {name for name, new, old in zip(outputs, car.outputs(), at_rest, strict=True) if new != old} == {"a_car"}


@pytest.mark.parametrize("version", VERSIONS)
def test_model_exchange_has_no_coupling(fmus: Fmus, version: int) -> None:
    result = fmpy.simulate_fmu(
        str(fmus["Trailer", version]),
        fmi_type="ModelExchange",
        stop_time=1.0,
        output_interval=0.1,
        start_values={"compression_start": 0.02},
        output=[*FORCES, "coupling_energy"],
    )
    assert np.ptp(result["F_hitch"]) > 10.0
    assert np.array_equal(result["F_hitch"], result["F_hitch_mean"])
    assert np.array_equal(result["F_hitch"], result["F_hitch_hold"])
    assert np.all(result["coupling_energy"] == 0.0)


@pytest.mark.parametrize("version", sampled(VERSIONS, [2]))
def test_the_hitch_alone_in_model_exchange(version: int) -> None:
    """A trailer that catches up with a car, both of constant speed: the closed form, and nothing of the coupling."""
    torques = tuple(force.replace("F_hitch", "trailer_brake_torque") for force in FORCES)
    result = fmpy.simulate_fmu(
        str(kept_fmus("Systems.Hitch", fmi=version)["Hitch"]),
        fmi_type="ModelExchange",
        stop_time=1.0,
        output_interval=0.1,
        start_values={"v_car": 20.0, "v_trailer": 20.1, "compression_start": -0.02, "M_front": 1000.0},
        output=["compression", *FORCES, *torques, "coupling_energy"],
    )
    compression = -0.02 + 0.1 * result["time"]
    np.testing.assert_allclose(result["compression"], compression, atol=1e-7)
    for force, torque in zip(FORCES, torques, strict=True):
        stiffness = np.where(compression < 0.0, 548e3, 5480.0)
        np.testing.assert_allclose(result[force], stiffness * compression + 500.0 * 0.1, atol=0.06)
        np.testing.assert_allclose(result[torque], np.maximum(16303.0 * compression, 0.0), atol=2e-3)
    assert np.all(result["coupling_energy"] == 0.0)


def test_the_pair_brakes_as_the_whole_does(start: Callable[..., Unit]) -> None:
    """Three seconds, both stepping at the same time: held force of the step's end, and what is offered instead."""
    size, steps = 0.01, 300
    whole = start("CarTrailer", brake_torque=1000.0)
    truth = []
    for i in range(steps):
        whole.slave.doStep(i * size, size)
        truth.append(whole.get("compression")[0])
    distance = {}
    for force, options in {
        "F_hitch_hold": {},
        "F_hitch": {"applied_force": 1.0, "extrapolation": 0.0},
    }.items():
        car, trailer = start("Car", brake_torque=1000.0), start("Trailer", **options)
        compression = []
        for i in range(steps):
            (v,), (f,) = car.get("v_car"), trailer.get(force)
            trailer.set(v_car=v)
            car.set(F_hitch=f)
            for unit in (car, trailer):
                unit.slave.doStep(i * size, size)
            compression.append(trailer.get("compression")[0])
        distance[force] = np.abs(np.array(compression) - truth).max() / np.max(truth)
    print(distance)
    assert distance["F_hitch_hold"] < 0.005
    assert distance["F_hitch"] > 5.0 * distance["F_hitch_hold"]
