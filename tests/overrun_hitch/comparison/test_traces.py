"""hitch crosscheck with traces from files: any form, any unit, at the file's own times, measured ones aligned."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy.io import savemat

from overrun_hitch import cli
from overrun_hitch.comparison.alignment import align
from overrun_hitch.comparison.traces import TraceFile, read_trace_file
from overrun_hitch.experiments.torque import Torque
from overrun_hitch.foreign.mapping import read_mapping
from overrun_hitch.parameters import FIGURES, HitchError
from overrun_hitch.results import VARIABLES
from tests.overrun_hitch.conftest import OracleRun

Columns = Mapping[str, np.ndarray]
ORACLE = Path(__file__).parents[2] / "oracles" / "openmodelica" / "fig10.csv"


def judged(capsys: pytest.CaptureFixture[str], folder: Path, *arguments: object) -> tuple[int, dict[str, object]]:
    status = cli.main(["crosscheck", *map(str, arguments), "--json", "--output", str(folder / "out")])
    (figure,) = json.loads(capsys.readouterr().out)["figures"]
    return status, figure["comparisons"][0]


def number(comparison: dict[str, object], quantity: str) -> dict[str, float]:
    (found,) = (row for row in comparison["numbers"] if row["quantity"] == quantity)
    return found


@pytest.fixture
def oracle(oracle_run: OracleRun) -> Columns:
    """Figure 8 by SciPy, time and all variables (601,)."""
    run = oracle_run(FIGURES["8"])
    return {"time": run["time"].values, **{name: run[name].values for name in VARIABLES}}


def test_a_file_as_a_german_spreadsheet_writes_it(
    oracle: Columns, car_trailer_fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    frame = pd.DataFrame(
        {"Zeit [ms]": 1e3 * oracle["time"], "Geschwindigkeit (km/h)": 3.6 * oracle["v_car"],
         "v_trailer [km/h]": 3.6 * oracle["v_trailer"], "Stoß [kN]": -1e-3 * oracle["F_hitch"],
         "compression [mm]": 1e3 * oracle["compression"], "slip_car [%]": 100.0 * oracle["slip_car"]}
    )  # fmt: skip
    trace, mapping = tmp_path / "Messung.csv", tmp_path / "names.toml"
    frame.to_csv(trace, sep=";", decimal=",", index=False, encoding="cp1252")
    mapping.write_text(
        '[time]\ntheirs = "Zeit"\n[v_car]\ntheirs = "Geschwindigkeit"\n[F_hitch]\ntheirs = "Stoß"\nsign = -1\n',
        encoding="utf-8",
    )
    asked = [car_trailer_fmu, trace, "--figure", "8"]
    status, comparison = judged(capsys, tmp_path, *asked, "--map", mapping)
    assert status == 0
    assert comparison["not_compared"] == ["a_car", "a_trailer", "slip_trailer", "trailer_brake_torque"]
    assert [row["verdict"] for row in comparison["numbers"]] == ["agrees"] * 3
    assert cli.main(["crosscheck", *map(str, asked), "--output", str(tmp_path)]) == 2
    assert "there is no column 'time'" in capsys.readouterr().err


def trajectory(columns: Columns, units: Mapping[str, str], form: str) -> dict[str, np.ndarray]:
    """As Dymola writes it, in whose first matrix are parameters and in whose second trajectories; one has a sign."""

    def rows(texts: list[str]) -> np.ndarray:
        length = max(map(len, texts))
        return np.array([list(text.ljust(length)) for text in texts])

    names = [*columns, "k", "backward"]
    info = [[0 if name == "time" else 2, place, 0, -1] for place, name in enumerate(columns, start=1)]
    info += [[1, 2, 0, 0], [2, -list(columns).index("v_car") - 1, 0, -1]]
    described = [f"something [{units[name]}]" if name in units else "[:#(type=Real)]" for name in names]
    matrices = {
        "name": rows(names), "description": rows(described), "dataInfo": np.array(info),
        "data_1": np.array([[0.0, 5480.0], [6.0, 5480.0]]), "data_2": np.array(list(columns.values())).T,
    }  # fmt: skip
    turned = (
        {name: np.ascontiguousarray(matrix.T) for name, matrix in matrices.items()} if form == "binTrans" else matrices
    )
    return {"Aclass": rows(["Atrajectory", "1.1", "", form]), **turned}


@pytest.mark.parametrize("form", ["binTrans", pytest.param("binNormal", marks=pytest.mark.full)])
def test_a_trajectory_of_the_recorded_oracle_as_a_mat_file(
    form: str, car_trailer_fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As OpenModelica and Dymola write it, with an event: two rows at one time, the earlier one as if before a jump."""
    recorded = pd.read_csv(ORACLE)
    columns = {
        "time": recorded["time"], "v_car": recorded["v_c"], "v_trailer": recorded["v_t"],
        "compression": recorded["x_t"] - recorded["x_c"],
    }  # fmt: skip
    before = {name: column[100] - (name == "v_car") for name, column in columns.items()}
    table = {name: np.insert(column.to_numpy(), 100, before[name]) for name, column in columns.items()}
    trace, mapping = tmp_path / "fig10.mat", tmp_path / "back.toml"
    savemat(trace, trajectory(table, {"v_car": "m/s", "backward": "m/s|km/h"}, form), format="4")
    asked = [car_trailer_fmu, trace, "--figure", "10"]
    status, comparison = judged(capsys, tmp_path, *asked)
    assert status == 0
    assert max(row["largest"] for row in comparison["variables"] if row["largest"]) < 1e-6
    assert {row["verdict"] for row in comparison["passages"]} == {"agrees"}
    mapping.write_text('[v_car]\ntheirs = "backward"\nsign = -1\n')
    backward = read_trace_file(trace, read_mapping(mapping)).columns["v_car"]
    np.testing.assert_array_equal(backward, read_trace_file(trace, {}).columns["v_car"])


def test_times_of_its_own(
    oracle_run: OracleRun, car_trailer_fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Uneven, from some moment on, with an empty place in the middle: our FMU is asked for these."""
    run = oracle_run(FIGURES["8"], milliseconds=1)
    chosen = np.unique((np.linspace(0.3, 1.0, 900) ** 2 * 6000).astype(int))
    frame = pd.DataFrame({"time": run["time"].values[chosen], "compression": run["compression"].values[chosen]})
    trace = tmp_path / "some.csv"
    frame.to_csv(trace, index=False)
    status, comparison = judged(capsys, tmp_path, car_trailer_fmu, trace, "--figure", "8")
    assert status == 0 and comparison["not_compared"] == [name for name in VARIABLES if name != "compression"]
    assert max(row["largest"] or 0.0 for row in comparison["variables"]) < 1e-6
    assert number(comparison, "shunting frequency")["verdict"] == "agrees"


@pytest.mark.parametrize("late", [0.13, pytest.param(-0.2, marks=pytest.mark.full)])
def test_a_noisy_trace_with_a_clock_of_its_own(
    late: float, oracle: Columns, car_trailer_fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    random = np.random.default_rng(7)
    wanted = ("v_car", "a_car", "compression", "F_hitch")
    noisy = {name: oracle[name] + 0.02 * np.ptp(oracle[name]) * random.normal(size=601) for name in wanted}
    trace = tmp_path / "noisy.csv"
    pd.DataFrame({"time": oracle["time"] + late, **noisy}).to_csv(trace, index=False)
    asked = [car_trailer_fmu, trace, "--figure", "8"]
    status, comparison = judged(capsys, tmp_path, *asked, "--measured")
    alignment, frequency = comparison["alignment"], number(comparison, "shunting frequency")
    assert status == 0
    assert abs(alignment["shift"] - late) < min(0.005, 3.0 * alignment["error"])
    assert abs(frequency["difference"]) < 0.005 * frequency["expected"]
    for name in wanted:
        assert alignment["noise"][name] == pytest.approx(0.02 * np.ptp(oracle[name]), rel=0.15)
    print(f"shift {alignment['shift']:.4f} +- {alignment['error']:.1e} s, frequency {frequency['difference']:+.1e} Hz")


@pytest.mark.full
def test_noise_hides_neither_a_shift_that_is_not_told_nor_another_spring(
    oracle: Columns, car_trailer_fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    trace, random = tmp_path / "noisy.csv", np.random.default_rng(7)
    noisy = oracle["compression"] + 0.02 * np.ptp(oracle["compression"]) * random.normal(size=601)
    pd.DataFrame({"time": oracle["time"] + 0.13, "compression": noisy}).to_csv(trace, index=False)
    asked = [car_trailer_fmu, trace, "--figure", "8"]
    assert judged(capsys, tmp_path, *asked)[0] == 1
    assert judged(capsys, tmp_path, *asked, "--measured")[0] == 0
    assert judged(capsys, tmp_path, *asked, "--measured", "--set", "k=6500")[0] == 1


@pytest.mark.full
def test_the_interval_of_the_shift_is_that_of_its_scatter(oracle: Columns, oracle_run: OracleRun) -> None:
    """What is said with 95 % confidence holds in 19 of 20 cases, as far as 40 can tell."""
    reference, random = oracle_run(FIGURES["8"]), np.random.default_rng(3)
    inside = 0
    for _ in range(40):
        noisy = oracle["compression"] + 0.02 * np.ptp(oracle["compression"]) * random.normal(size=601)
        found = align(reference, TraceFile(Path("a"), oracle["time"] + 0.13, {"compression": noisy}, ()))
        inside += abs(found.shift - 0.13) < found.error
    assert inside >= 33


def test_traces_against_theory_and_each_other(
    oracle: Columns, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    trace, other = tmp_path / "a.csv", tmp_path / "b.csv"
    columns = {name: oracle[name] for name in ("time", "v_car", "compression")}
    pd.DataFrame(columns).to_csv(trace, index=False)
    pd.DataFrame({name: np.append(column[1:-3:2], column[-3]) for name, column in columns.items()}).to_csv(other)
    status, comparison = judged(capsys, tmp_path, "theory", trace, "--figure", "8")
    assert status == 0
    verdicts = {row["quantity"]: row["verdict"] for row in comparison["numbers"]}
    assert verdicts.pop("A / A_c") == "not judged" and set(verdicts.values()) == {"agrees"}
    status, _ = judged(capsys, tmp_path, "theory", trace, "--figure", "8", "--set", "C=520")
    assert status == 1
    status, _ = judged(capsys, tmp_path, trace, other, "--figure", "8")
    assert status == 0


def test_ours_by_its_name_and_notes_on_what_was_guessed(
    oracle: Columns, car_trailer_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.setattr("overrun_hitch.commands.crosscheck.our_fmu", lambda _: car_trailer_fmu)
    trace = tmp_path / "a.csv"
    pd.DataFrame({"time": oracle["time"], "F_hitch": -oracle["F_hitch"]}).to_csv(trace, index=False)
    command = ["crosscheck", "ours", str(trace), "--figure", "8", "--output", str(tmp_path / "out")]
    assert cli.main(command) == 1
    out = capsys.readouterr().out
    assert f"A  {car_trailer_fmu}\n" in out
    assert f"B  {trace}\n   gives no unit, taken as ours: time, F_hitch\n" in out
    assert "B differs from A in figure 8: F_hitch; not compared: v_car, " in out
    assert "   F_hitch: opposite sign?\n" in out


def test_a_torque_is_followed_from_knot_to_knot() -> None:
    torque = Torque(np.array([0.5, 1.0, 1.0, 2.0]), np.array([100.0, 300.0, 50.0, 50.0]))
    points = np.array([0.0, 0.5, 0.75, 1.0, 1.5, 3.0])
    expected = [(100.0, 100.0), (100.0, 200.0), (200.0, 300.0), (50.0, 50.0), (50.0, 50.0)]
    np.testing.assert_allclose(torque.courses(points), expected)
    assert torque.knots(0.0, 2.0).tolist() == [0.5, 1.0]
    for time, values, words in (
        ([1.0, 0.0], [1.0, 1.0], "must not decrease"),
        ([0.0], [-1.0], "-1 N.m is not allowed"),
    ):
        with pytest.raises(HitchError, match=words):
            Torque(np.array(time), np.array(values))


@pytest.mark.full
def test_a_profile_instead_of_a_step(
    car_trailer_fmus: dict[int, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A ramp with a jump, followed by slopes of the input (co-simulation, FMI 2) and held in between (the others)."""
    profile = tmp_path / "$^$ [red].csv"  # a name that is neither a formula nor markup
    profile.write_text("time [ms];brake_torque [kN.m]\n0;0,2\n500,5;0,8\n1000;0,8\n1000;1,0\n")
    fmus = [car_trailer_fmus[2], car_trailer_fmus[3], car_trailer_fmus[2]]
    options = ["--type", "C=me", "--figure", "8", "--duration", "1.2", "--step", "0.0005", "--profile", profile]
    status, _ = judged(capsys, tmp_path, *fmus, *options)
    assert status == 0
    document = json.loads((tmp_path / "out" / "crosscheck.json").read_text(encoding="utf-8"))
    assert document["figures"][0]["brake_torque"]["time"] == pytest.approx([0.0, 0.5005, 1.0, 1.0])


BAD = [
    ("time,v_car\n0,1\n1,1\n", ["--figure", "8", "--figure", "7"], "a trace is of one scenario: say which with --fi"),
    ("time,v\n0,1\n1,1\n", ["--figure", "8"], "has none of v_car, v_trailer"),
    ("time,v_car\n0,1\n1,1\n0.5,1\n", ["--figure", "8"], "time must not decrease"),
    ("time,v_car\n0,1\n1,x\n", ["--figure", "8"], "column 'v_car', line 3: 'x' is not a finite number"),
    ("time,v_car [kg]\n0,1\n1,1\n", ["--figure", "8"], "'kg' is no unit of v_car; allowed: m/s and what can"),
    ("time,v_car\n0,1\n1,1\n", ["--figure", "8", "--set", "k=-1"], "k = -1 N/m is not allowed"),
    ("time,v_car\n0,1\n1,1\n", ["--figure", "8", "--map", "C=x.toml"], "cannot read x.toml"),
    ("time,v_car\n0,1\n1,1\n", ["--figure", "8", "--type", "C=me"], "--type C=me: there is no file C; allowed: A to B"),
    ("time,v_car\n0,1\n1,1\n", ["--figure", "8", "--type", "xx"], "--type 'xx' is not allowed; allowed: cs"),
    ("time,v_car\n0,1\n1,1\n", ["--figure", "8", "--profile", "no.csv"], "cannot read no.csv"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "arguments", "message"), BAD)
def test_bad_input_is_one_line_and_status_2(
    text: str, arguments: list[str], message: str, car_trailer_fmu: Path, tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    Path("trace.csv").write_text(text)
    assert cli.main(["crosscheck", str(car_trailer_fmu), "trace.csv", *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1 and message in err
    assert [path.name for path in tmp_path.iterdir()] == ["trace.csv"]


@pytest.mark.filterwarnings("ignore::DeprecationWarning")  # those of asammdf, when it is imported
@pytest.mark.parametrize("suffix", [".parquet", ".mf4"])
def test_forms_of_the_extra(suffix: str, oracle: Columns, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    csv, trace = tmp_path / "a.csv", tmp_path / f"a{suffix}"
    columns = {name: oracle[name] for name in ("v_car", "compression")}
    pd.DataFrame({"time": oracle["time"], **columns}).to_csv(csv, index=False)
    if suffix == ".parquet":
        pytest.importorskip("pyarrow", reason="of the extra `traces`")
        table = {"time": oracle["time"], "v_car [km/h]": 3.6 * columns["v_car"], "compression": columns["compression"]}
        pd.DataFrame(table).to_parquet(trace)
    else:
        asammdf = pytest.importorskip("asammdf", reason="of the extra `traces`")
        signals = [
            asammdf.Signal(3.6 * columns["v_car"], oracle["time"], unit="km/h", name="v_car"),
            asammdf.Signal(columns["compression"], oracle["time"], unit="m", name="compression"),
        ]
        with asammdf.MDF() as mdf:
            for signal in signals:
                mdf.append([signal])
            mdf.save(trace)
    assert judged(capsys, tmp_path, csv, trace, "--figure", "8")[0] == 0


def test_without_the_extra_its_name_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    trace = tmp_path / "a.mf4"
    trace.write_bytes(b"MDF")
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(__import__("sys").modules, "asammdf", None)
        assert cli.main(["crosscheck", str(trace), str(trace), "--figure", "8"]) == 2
    assert "needs the package asammdf: pip install 'overrun-hitch[traces]'" in capsys.readouterr().err
