"""What scripts call: examples in the docstrings, types that an editor sees, files as text, and nothing loaded early."""

from __future__ import annotations

import doctest
import subprocess
import sys
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
import xarray as xr
from fmpy.fmi2 import FMU2Slave
from hypothesis import given
from hypothesis import strategies as st

import overrun_hitch as hitch
from overrun_hitch import api
from overrun_hitch.fmu.files import NAMES
from overrun_hitch.scenarios import asked_scenario
from tests.sampling import sampled

C, EPS = [100.0, 350.0, 2500.0], [0.0, 0.03]


FUNCTIONS = [
    name for name, thing in vars(api).items() if getattr(thing, "__module__", "") == api.__name__ and name[0] != "_"
]
LONG = ("crosscheck", "fit", "sweep")


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.full] if name in LONG else []) for name in FUNCTIONS]
)
def test_examples_of_the_docstrings(name: str) -> None:
    """That of `fit` needs another FMU."""
    runner = doctest.DocTestRunner()
    for example in doctest.DocTestFinder().find(vars(api)[name], name, globs=vars(api)):
        runner.run(example)
    assert (runner.tries > 0, runner.failures) == (name != "sweep", 0)


def test_all_names_are_there_and_said() -> None:
    assert {name for name in hitch.__all__ if getattr(hitch, name) is None} == set()
    assert set(hitch.__all__) <= set(dir(hitch))
    assert all(f"hitch.{name}(" in str(hitch.__doc__) for name in ("run", "run_many", "compare", "plot", "stability"))
    with pytest.raises(AttributeError, match="no attribute 'simulate'"):
        _ = hitch.simulate  # type: ignore[attr-defined]


def test_nothing_is_loaded_before_it_is_used() -> None:
    code = "import sys; before = set(sys.modules); import overrun_hitch; print(*(set(sys.modules) - before))"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    third = {name.partition(".")[0] for name in loaded} - set(sys.stdlib_module_names)
    assert third == {"overrun_hitch"}


@pytest.mark.full
def test_types_reach_a_script(tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    script.write_text("""
import fmu_build
import overrun_hitch as hitch
result = hitch.run("8", C=200.0)
reveal_type(result)
reveal_type(hitch.run_many({"C": [1.0]}))
reveal_type(hitch.compare(result))
reveal_type(hitch.crosscheck(["ours", "theirs.fmu"]))
reveal_type(hitch.stability("ii", V=[10, 20]))
reveal_type(hitch.sweep("spec.toml", "store.zarr"))
reveal_type(hitch.fit("bench.csv", ["k"]).estimates[0].value)
reveal_type(hitch.plot(result))
reveal_type(hitch.CASES["ii"])
reveal_type(hitch.FIGURES["8"])
reveal_type(fmu_build.build("model M end M;"))
reveal_type(hitch.fmu_path("Car", fmi=3))
reveal_type(hitch.Parameters().C)
reveal_type(hitch.__version__)
""")
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path), str(script)]
    said = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path).stdout
    revealed = [line.split('"')[1].rpartition(".")[2] for line in said.splitlines() if "Revealed type" in line]
    assert "Success: no issues found" in said, said
    assert revealed == [
        "Dataset", "Dataset", "DataFrame", "dict[str, Any]", "Dataset", "Dataset", "float", "Figure", "Parameters",
        "Scenario", "Path", "Path", "float", "str",
    ], said  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("fmi", [2, 3])
def test_where_our_fmus_are(name: str, fmi: int) -> None:
    from overrun_hitch.fmu.files import place  # what fmu_path builds, if it is missing, `make fmu` does as well

    assert place(name, fmi).parts[-2:] == (f"fmi{fmi}", f"{name}.fmu")


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: hitch.fmu_path("Trialer"), "no FMU of ours 'Trialer'; did you mean Trailer or CarTrailer?"),
        (lambda: hitch.fmu_path("Car", fmi=1), "fmi = 1 is not allowed; allowed: 2 or 3"),
        (lambda: hitch.run("8", c=200), "no parameter 'c'; did you mean C?"),
        (lambda: hitch.run("8", "ii"), "figure and case exclude each other"),
        (lambda: hitch.run("8", C=-1), "C = -1 N.s/m is not allowed"),
        (lambda: hitch.run(fmu="nowhere.fmu"), "nowhere.fmu"),
        (lambda: hitch.run(grade=2), "grade = 2 is not allowed: rise of the road over its run must be"),
        (lambda: hitch.run(profile={"time": [0, 1]}), "the profile has no brake_torque"),
        (lambda: hitch.run(profile={"time": [1, 0], "brake_torque": [0, 0]}), "time must not decrease"),
        (lambda: hitch.run(profile="nowhere.csv"), "nowhere.csv"),
        (lambda: hitch.crosscheck(["ours"]), "two files at least"),
        (lambda: hitch.run_many({"Cc": [1]}), "no parameter or input 'Cc'"),
        (lambda: hitch.run_many({"C": []}), "C"),
        (lambda: hitch.run_many({"C": [1]}, outputs=["speed"]), "no variable 'speed'"),
        (lambda: hitch.run_many({"C": [1]}, C=2), "C is varied and given"),
        (lambda: hitch.run_many({"C": ["soft"]}), "C = ['soft'] is not allowed: a number is, or several"),
        (lambda: hitch.run_many({"C": 1.0}, workers=-1), "workers = -1 is not allowed; allowed: 0 to 1000"),
        (lambda: hitch.run(duration="long"), "duration = 'long' is not allowed"),
        (lambda: hitch.run(grade="steep"), "grade = 'steep' is not allowed: rise of the road over its run must be"),
        (lambda: hitch.run(profile={"time": ["a"], "brake_torque": [1]}), "time = ['a'] is not allowed"),
        (lambda: hitch.run(profile={"time": [0, 1], "brake_torque": [1]}), "time has shape (2,), brake_torque (1,)"),
        (lambda: hitch.run(profile={"time": [0, np.nan], "brake_torque": [1, 2]}), "not finite"),
        (lambda: hitch.run(12), "no figure '12'"),
        (lambda: hitch.compare(xr.Dataset()), "does not say what was run"),
        (lambda: hitch.plot(xr.Dataset()), "does not say what was run"),
        (lambda: hitch.fit({"time": [1, 2]}), "the trace has no compression"),
        (lambda: hitch.fit("nowhere.csv"), "nowhere.csv"),
        (lambda: hitch.stability(V="fast"), "V = 'fast' is not allowed"),
        (lambda: hitch.stability(2), "no case"),
        (lambda: hitch.stability("x"), "no case 'x'"),
        (lambda: hitch.stability(CdA_c=1.0), "CdA_c"),
        (lambda: hitch.sweep("nowhere.toml", "store"), "nowhere.toml"),
        (lambda: hitch.run(profile={"time": [0], "brake_torque": [0]}, brake_torque=5), "exclude each other"),
        (lambda: hitch.crosscheck(["ours", "theory"], profile="a.csv", brake_torque=5), "exclude each other"),
        (lambda: hitch.run(profile={"time": [], "brake_torque": []}), "the profile has no knot"),
        (lambda: hitch.run_many({"C": [1]}, workers=1.5), "workers = 1.5 is not allowed; allowed: 0 to 1000"),
        (lambda: hitch.crosscheck("ours"), "files = 'ours' is not allowed"),
        (lambda: hitch.crosscheck(["ours", "theory"], []), "no figure is to be compared; allowed: 6a"),
        (lambda: hitch.crosscheck(["ours", "theory"], maps={"a.fmu": "a.toml"}), "maps: 'a.fmu' is none of the files"),
        (lambda: hitch.plot(hitch.run(duration=0.1)[["compression"]]), "the result has no v_car"),
    ],
)
def test_what_a_caller_can_mend(call, message: str) -> None:
    with pytest.raises(hitch.HitchError) as caught:
        call()
    assert message in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


@pytest.mark.parametrize(
    "value", [True, np.True_, np.timedelta64(1000, "ms"), 1j, None, "", "x", object(), [[1], [2, 3]]]
)
def test_only_numbers_are_numbers(value: Any) -> None:
    """Where one is asked for, and where several are. NumPy would make 1 of True, and 1000 of a second."""
    calls = (
        lambda: hitch.Parameters(C=value),
        lambda: hitch.run_many({"C": value}),
        lambda: hitch.stability(C=value),
        lambda: hitch.stability(deceleration=value),
        lambda: hitch.run(profile={"time": [0], "brake_torque": value}),
    )
    for call in calls:
        with pytest.raises(hitch.HitchError):
            call()


def test_what_is_masked_is_no_number() -> None:
    with pytest.raises(hitch.HitchError, match="C = masked_array"):
        hitch.run_many({"C": np.ma.array([1.0, 2.0], mask=[False, True])})


@pytest.mark.parametrize("value", [None, 5, 1.5, object()])
def test_what_is_of_another_kind_is_told(value: Any) -> None:
    """Of every argument that is no number; None where it stands for nothing else."""
    calls = [
        lambda: hitch.run_many(value),
        lambda: hitch.run_many({"C": [1]}, outputs=value),
        lambda: hitch.compare(value),
        lambda: hitch.plot(value),
        lambda: hitch.fit(value),
        lambda: hitch.sweep(value, "store"),
        lambda: hitch.crosscheck(value),
        lambda: hitch.crosscheck(["ours", value]),
        *([] if value is None else [lambda: hitch.run(profile=value)]),
    ]
    for call in calls:
        with pytest.raises(hitch.HitchError, match=r"is not allowed|no variable"):
            call()


@given(st.floats(0.01, 1e3))
def test_a_number_may_be_text(value: float) -> None:
    """As a table's cell is; the scenario is that of the number, its name too."""
    one, other = ({"brake_torque": each, "duration": each} for each in (value, repr(value)))
    assert asked_scenario("8", None, {"C": repr(value)}, **other) == asked_scenario("8", None, {"C": value}, **one)


def test_files_may_be_text(tmp_path: Path) -> None:
    runs = hitch.sweep({"grid": {"C": [100.0, 500.0]}, "metrics": ["peak_compression"]}, str(tmp_path / "runs.zarr"))
    alone = hitch.run(fmu=str(hitch.fmu_path()), C=500)
    assert float(runs["peak_compression"][1]) == pytest.approx(float(alone["compression"].max()), rel=1e-4)


def test_many_runs_are_those_of_fmpy_bit_by_bit() -> None:
    many = hitch.run_many({"C": C, "eps": EPS}, outputs=["compression", "F_hitch"])
    fmu = str(hitch.fmu_path())
    description, folder = fmpy.read_model_description(fmu), fmpy.extract(fmu)
    unit = FMU2Slave(guid=description.guid, unzipDirectory=folder, modelIdentifier="CarTrailer", instanceName="unit")
    unit.instantiate()
    for damper in C:
        for clearance in EPS:
            unit.reset()
            result = fmpy.simulate_fmu(
                folder, validate=False, stop_time=6, output_interval=0.06, relative_tolerance=1e-6,
                start_values={"C": damper, "eps": clearance, "brake_torque": 1000.0}, output=["compression", "F_hitch"],
                model_description=description, fmu_instance=unit, record_events=False,
            )  # fmt: skip
            for name in ("compression", "F_hitch"):
                assert many[name].sel(C=damper, eps=clearance).values.tolist() == result[name].tolist()
    unit.freeInstance()


def test_a_profile_and_a_grade() -> None:
    """A profile of one knot is the step; downhill by its own weight alone a combination gains g sin(arctan(grade))."""
    step, same = hitch.run(), hitch.run(profile={"time": [0], "brake_torque": [1000]})
    assert all(step[name].values.tolist() == same[name].values.tolist() for name in step.data_vars)
    rolling = hitch.run(brake_torque=0, grade=-0.1, duration=1)
    wheels = 1 + 5 / 0.35**2 / 1000  # of both vehicles, over the mass
    assert float(rolling["a_car"][-1]) == pytest.approx(9.80665 * np.sin(np.arctan(0.1)) / wheels, rel=1e-3)
    table = hitch.compare(rolling)
    assert set(table["verdict"]) == {"not judged"}
    assert set(table["not_judged"]) == {"grade = -0.1: the road is not level"}


def test_what_is_asked_for_beside_makes_no_difference() -> None:
    """A run is read for the outputs asked for alone."""
    whole = hitch.run_many({"C": C}, outputs=["compression", "F_hitch", "v_car"], metrics=["peak_jerk"])
    for name in ("compression", "F_hitch", "v_car"):
        assert whole[name].identical(hitch.run_many({"C": C}, outputs=[name])[name])
    assert whole["peak_jerk"].identical(hitch.run_many({"C": C}, outputs=[], metrics=["peak_jerk"])["peak_jerk"])


def test_one_may_stand_for_several() -> None:
    """A name for a list of names, a number for a list of numbers, an array for either, 8 for "8"."""
    many = hitch.run_many({"C": 100.0, "eps": np.array([0.0, 0.1])}, 8, outputs="a_car", metrics="peak_jerk")
    assert many.identical(hitch.run_many({"C": [100.0], "eps": [0.0, 0.1]}, outputs=["a_car"], metrics=["peak_jerk"]))


@pytest.mark.parametrize("workers", sampled([1, 2], [2]))
def test_where_it_runs_makes_no_difference(workers: int) -> None:
    here = hitch.run_many({"C": C, "eps": EPS}, metrics=["growth_rate"])
    assert here.identical(hitch.run_many({"C": C, "eps": EPS}, metrics=["growth_rate"], workers=workers))
    assert here.identical(hitch.run_many({"C": C, "eps": EPS}, metrics=["growth_rate"], fmu=str(hitch.fmu_path())))


def test_a_run_that_fails_is_told_where_it_is(tmp_path: Path) -> None:
    told: list[tuple[int, int, int]] = []
    many = hitch.run_many({"brake_torque": [1000.0, 1e300]}, progress=lambda *state: told.append(state))
    assert [bool(text) for text in many["message"].values] == [False, True]
    assert np.isnan(many["compression"].sel(brake_torque=1e300)).all()
    assert np.isfinite(many["compression"].sel(brake_torque=1000)).all()
    assert told[0] == (0, 0, 2)
    assert told[-1] == (2, 1, 2)
