"""`hitch stability`: the numbers, the table, JSON, CSV, parameters from files, and bad input."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import pytest

from overrun_hitch import cli
from overrun_hitch.commands.numbers import evenly, numbers
from overrun_hitch.commands.options import file_stem, parameters_of
from overrun_hitch.commands.stability import doubling
from overrun_hitch.modes.study import stability
from overrun_hitch.parameters import CASES, DATUM, FIGURES, HitchError, Parameters
from overrun_hitch.scenarios import asked_scenario
from overrun_hitch.theory.linear import shunting_mode
from overrun_hitch.theory.steady import steady
from tests.sampling import sampled


def run(*arguments: str, output: Path) -> int:
    return cli.main(["stability", *arguments, "--output", str(output)])


def json_of(capsys: pytest.CaptureFixture[str], *arguments: str, output: Path) -> dict[str, Any]:
    assert run(*arguments, "--json", output=output) == 0
    out, err = capsys.readouterr()
    assert err == ""
    found: dict[str, Any] = json.loads(out)
    return found


def test_rows_are_the_shunting_mode_speed_by_speed() -> None:
    result = stability("", CASES["i"], [0.0, 100.0], [20.0, 40.0])
    assert [(row.V, row.C) for row in result.rows] == [(20.0, 0.0), (20.0, 100.0), (40.0, 0.0), (40.0, 100.0)]
    mode = shunting_mode(CASES["i"].changed({"C": 100.0}), 40.0)
    last = result.rows[-1]
    assert (last.growth_rate, last.frequency, last.phase) == (mode.growth_rate, mode.frequency, mode.phase)
    assert [row.self_excited for row in result.rows] == [True, False, True, True]
    for boundary, (low, high) in zip(result.boundaries, ((51.0, 52.0), (103.0, 104.0)), strict=True):
        assert low < boundary.C_crit < high


@pytest.mark.parametrize(("case", "ratio"), [("i", 0.90), ("ii", 0.95), ("iii", 0.98)])
def test_claims_1_and_2_steady_state(case: str, ratio: float) -> None:
    result = stability("", CASES[case], [0.0], [20.0])
    assert round(result.A_over_A_c, 2) == ratio
    deflection = result.D
    assert deflection == pytest.approx(0.05, rel=0.005)  # 1 cm per 1 m/s2


def test_deflection_includes_the_clearance() -> None:
    parameters = DATUM.changed({"eps": 0.1})
    found = stability("", parameters, [0.0], [20.0]).D
    assert found == pytest.approx(stability("", DATUM, [0.0], [20.0]).D + 0.1)
    torque = 5.0 / abs(steady(parameters, 1.0).A)
    assert found == pytest.approx(steady(parameters, torque).D)


def test_json_is_one_document_with_units(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found = json_of(capsys, "--case", "iii", "--set", "M_t=700", "--C", "60,70", "--V", "20,40", output=tmp_path)
    assert found["name"] == "case iii, M_t=700"
    assert found["parameters"]["M_t"] == {"value": 700.0, "unit": "kg"}
    assert [row["C"] for row in found["shunting_mode"]] == [60.0, 70.0, 60.0, 70.0]
    assert [row["V"] for row in found["critical_damping"]] == [20.0, 40.0]
    every = {*found["shunting_mode"][0], *found["critical_damping"][0], *found["steady"]}
    every |= {*found["working_point"]} - {"stiffness"}
    assert every == set(found["units"])
    assert [Path(name).suffix for name in found["files"]] == [".csv", ".png", ".svg"]
    assert all(Path(name).is_file() for name in found["files"])


def test_csv_holds_every_digit(tmp_path: Path) -> None:
    assert run("--C", "0:400", "--V", "20", output=tmp_path) == 0
    with (tmp_path / "datum.csv").open(encoding="utf-8", newline="") as file:
        header, *rows = list(csv.reader(file))
    assert header[:3] == ["V [m/s]", "C [N.s/m]", "growth_rate [1/s]"]
    assert header[-1] == "self_excited [1]"
    expected = [0.0, 50.0, 100.0, 200.0, 400.0]
    assert [float(row[1]) for row in rows] == expected
    growth = [float(shunting_mode(DATUM.changed({"C": C}), 20.0).growth_rate) for C in expected]
    assert [float(row[2]) for row in rows] == growth
    assert [row[-1] for row in rows] == ["1", "1", "0", "0", "0"]


@pytest.mark.parametrize("width", ["40", "80"])
def test_piped_and_narrow_tables_stay_readable(
    width: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("COLUMNS", width)
    assert run("--case", "ii", "--C", "0,3200", output=tmp_path) == 0
    out = capsys.readouterr().out
    assert "\x1b" not in out
    assert max(map(len, out.splitlines()[:-3])) <= int(width)
    words = " ".join(out.split())
    for expected in ("self-excited", "stable", "0.08705", "-4.51979", "109.97", "C_crit = 60.4249 N.s/m",
                     "A/A_c = 0.95000", "D = 0.04998 m at 5 m/s2", f"wrote {tmp_path / 'case-ii.png'}"):  # fmt: skip
        assert expected in words


def test_defaults_are_the_papers(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = json_of(capsys, output=tmp_path)["shunting_mode"]
    assert [row["C"] for row in rows] == [0.0, 50.0, 100.0, 200.0, 400.0, 800.0, 1600.0, 3200.0]
    assert {row["V"] for row in rows} == {20.0}


def test_own_damper_and_speed_are_not_ignored(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found = json_of(capsys, "--set", "C=60", "--set", "V_0=30", output=tmp_path)
    assert [row["C"] for row in found["shunting_mode"]][:4] == [0.0, 50.0, 60.0, 100.0]
    assert {row["V"] for row in found["shunting_mode"]} == {30.0}
    assert found["name"] == "datum"
    found = json_of(capsys, "--set", "C=60", "--set", "V_0=30", "--C", "7", "--V", "8", output=tmp_path)
    assert [(row["C"], row["V"]) for row in found["shunting_mode"]] == [(7.0, 8.0)]


RANGES = [
    ["--set", "r=0"], ["--C", "500"], ["--C", "1:1.000000000001"], ["--V", "1:60:20"], ["--set", "k=0"],
    ["--C", "500:600"], ["--C", "0:1e6"], ["--C", "0:10"], ["--V", "20,20.0000000001"],
]  # fmt: skip


@pytest.mark.parametrize("arguments", sampled(RANGES, RANGES[:3]))
def test_any_range_can_be_drawn(arguments: list[str], tmp_path: Path) -> None:
    assert run(*arguments, output=tmp_path) == 0
    assert len(list(tmp_path.iterdir())) == 3


BAD = [
    (["--C", "-5"], "C = -5 N.s/m is not allowed: drawbar damper coefficient must be a finite number, at least 0"),
    (["--V", "0"], "V = 0 m/s is not allowed: speed must be a finite number, at least 0.1 m/s"),
    (["--C", "nan"], "--C 'nan': nan is not a finite number"),
    (["--V", "1:inf"], "--V '1:inf': inf is not a finite number"),
    (["--C", "0:3200:10000000"], "at least 2, at most 10000"),
    (["--C", ",".join(map(str, range(10001)))], "--C asks for 10001 values; allowed: at most 10000"),
    (["--C", "0:3200:200", "--V", "10:40:200"], "C and V make 40000 combinations; allowed: at most 10000"),
    (["--C", "0:3200:1"], "N of A:B:N must be a whole number, at least 2"),
    (["--C", "0:3200:2.5"], "N of A:B:N must be a whole number"),
    (["--C", "0:1:2:3"], "N of A:B:N"),
    (["--C", "5:5"], "--C '5:5' is an empty range: A of A:B must be less than B"),
    (["--C", "100:50"], "is an empty range"),
    (["--C", ""], "'' is no number; allowed: 200 or 50,100,200 or 0:3200 or 0:3200:9"),
    (["--C", "50,"], "'' is no number"),
    (["--V", ":"], "'' is no number"),
    (["--V", "fast"], "'fast' is no number"),
    (["--case", "x"], "there is no case 'x'; did you mean ix? allowed: i, "),
    (["--set", "k=0", "--set", "r=0"], "one of them must be greater than 0"),
    (["--set", "k=1e300"], "k = 1e+300 N/m is not allowed"),
    (["--set", "I_c=1e308"], "I_c = 1e+308 kg.m2 is not allowed"),
    (["--set", "M_c=1e200"], "at most 1e+09 kg"),
    (["--set", "k=1e-12", "--set", "r=1e-12"], "orders of magnitude"),
    (["--V", "1e200"], "V = 1e+200 m/s is not allowed"),
    (["--C", "1e308"], "C = 1e+308 N.s/m is not allowed"),
    (["--parameters", "none.toml"], "cannot read none.toml: No such file or directory"),
]  # fmt: skip


@pytest.mark.parametrize(("arguments", "message"), BAD)
def test_bad_input_is_one_line_and_status_2(
    arguments: list[str], message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(*arguments, "--json", output=tmp_path / "out") == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert message in err
    assert not (tmp_path / "out").exists()


def test_interrupted(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("overrun_hitch.modes.study.stability", interrupt)
    assert run(output=tmp_path / "out") == 130
    assert not (tmp_path / "out").exists()


def test_numbers() -> None:
    assert numbers("--C", " 200 ", doubling) == [200.0]
    assert numbers("--C", "200,50,50,1e2", doubling) == [50.0, 100.0, 200.0]
    assert numbers("--C", "30:450", doubling) == [30.0, 50.0, 100.0, 200.0, 400.0, 450.0]
    assert numbers("--C", "0:5000", doubling)[-2:] == [3200.0, 5000.0]
    assert numbers("--V", "10:40:3", doubling) == [10.0, 25.0, 40.0]
    assert evenly(0.1, 0.7, 7)[-1] == 0.7


FILE = Path("mine.toml")
BAD_FILES = [
    (b"Q = 1", "mine.toml: there is no parameter 'Q'; allowed: "),
    (b"k = -1", "mine.toml: k = -1 N/m is not allowed: drawbar stiffness in compression must be a finite number, at"),
    (b"k = true", "mine.toml: k = True is not allowed: drawbar stiffness in compression must be a finite number, at"),
    (b'k = "5480"', "mine.toml: k = '5480' is not allowed"),
    (b"k = [1]", "mine.toml: k = [1] is not allowed"),
    (b"k = 1979-05-27", "mine.toml: k = datetime.date(1979, 5, 27) is not allowed"),
    (b"k = nan", "mine.toml: k = nan N/m is not allowed"),
    (b"k = " + b"9" * 400, "mine.toml: k = "),
    (b"k = 1\nk = 2", "mine.toml is not TOML, such as k = 5480.0: "),
    (b"k 5480", "mine.toml is not TOML"),
    (b"k = 1\xff", "mine.toml is not TOML"),
    (b"k = " + b"[" * 100_000, "mine.toml is not TOML"),
    (b"#" * 1_000_001, "mine.toml is longer than 1000000 bytes"),
    (b"k = 1\n[parameters]\nr = 2", "mine.toml: 'k' stands outside [parameters]"),
    (b"parameters = 3", "mine.toml: parameters = 3 is not allowed; a table [parameters] is"),
    (b"[drawbar]\nk = 1", "mine.toml: there is no parameter 'drawbar'; allowed: "),
]  # fmt: skip


@pytest.mark.parametrize("command", ["run", "stability"])
@pytest.mark.parametrize(("content", "message"), BAD_FILES)
def test_bad_files_are_one_line_and_status_2(
    command: str,
    content: bytes,
    message: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    FILE.write_bytes(content)
    assert cli.main([command, "--parameters", "mine.toml"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert message in err
    assert len(err) < 400
    assert [path.name for path in tmp_path.iterdir()] == ["mine.toml"]


def test_a_folder_is_no_file(tmp_path: Path) -> None:
    with pytest.raises(HitchError, match=r"cannot read .*: Is a directory"):
        parameters_of(tmp_path)


@pytest.mark.parametrize("head", ["", "[parameters]\n"])
def test_case_before_file_before_set(head: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(f"{head}M_t = 700  # kg\nk = 5_000.0\nR_t = 0.35\n")
    assert parameters_of(file) == {"M_t": 700.0, "k": 5000.0, "R_t": 0.35}
    arguments = ("--case", "iii", "--parameters", str(file), "--set", "k=6000")
    found = json_of(capsys, *arguments, "--C", "0", output=tmp_path)
    values = {name: quantity["value"] for name, quantity in found["parameters"].items()}
    assert (values["M_t"], values["k"], values["r"]) == (700.0, 6000.0, CASES["iii"].r)
    assert found["name"] == "case iii, M_t=700, k=6000"


def test_empty_file_changes_nothing(tmp_path: Path) -> None:
    (tmp_path / "empty.toml").touch()
    assert parameters_of(tmp_path / "empty.toml") == {}


def test_a_run_is_named_after_what_the_file_changes(tmp_path: Path) -> None:
    file = tmp_path / "all.toml"
    file.write_text("\n".join(f"{name} = {value!r}" for name, value in FIGURES["6a"].parameters.model_dump().items()))
    assert asked_scenario("8", None, parameters_of(file)).name == "figure 8, C=20"
    assert asked_scenario("6a", None, parameters_of(file)).name == "figure 6a"


def test_long_names_make_files_with_short_names() -> None:
    long = ", ".join(["figure 8", *(f"{name}=1.23456e-05" for name in Parameters.model_fields)])
    assert file_stem("figure 8, C=20") == "figure-8-C=20"
    assert len(file_stem(long)) == 120
    assert file_stem(long) != file_stem(long + "7")


def test_a_stronger_rebound_decays_and_is_marked(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ("--set", "rebound=3", "--V", "40", "--C", "80")
    found = json_of(capsys, *arguments, output=tmp_path)
    assert found["approximate"] == ["rebound"]
    assert [row["self_excited"] for row in found["shunting_mode"]] == [False]
    assert found["critical_damping"][0]["C_crit"] == pytest.approx(60.35, abs=0.01)
    assert run(*arguments, output=tmp_path) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "approximate for rebound = 3: a damper of (1 + rebound)/2 C" in told
    assert "off by 0.0003 of itself or less" in told
    assert run("--set", "rebound=3", "--C", "80,3200", output=tmp_path) == 0
    assert "off by more than 0.1 of itself" in " ".join(capsys.readouterr().out.split())


@pytest.mark.parametrize("name", Parameters.having("theory", "neutral"))
def test_what_theory_does_not_know_is_refused(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("--set", f"{name}=0.5", output=tmp_path) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.startswith(f"hitch: linear theory does not know {name} = 0.5")
    assert list(tmp_path.iterdir()) == []


def test_the_working_point_and_its_reach_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    device = ("--set", "x_2=0.02", "--set", "k_2=16e3", "--set", "travel=0.08", "--C", "100")
    gentle = json_of(capsys, *device, output=tmp_path)["working_point"]
    assert gentle == {"deceleration": 0.0, "D": 0.0, "stiffness": "k", "from": 0.0, "until": 0.02}
    found = json_of(capsys, *device, "--deceleration", "5", output=tmp_path)
    assert (found["working_point"]["stiffness"], found["working_point"]["until"]) == ("k_2", 0.08)
    assert found["working_point"]["D"] == found["steady"]["D"] == pytest.approx(0.04494, abs=1e-5)
    growth = float(shunting_mode(DATUM.changed({"C": 100.0, "k": 16e3}), 20.0).growth_rate)
    assert found["shunting_mode"][0]["growth_rate"] == growth
    assert "deceleration=5" in found["name"]
    assert run(*device, output=tmp_path) == 0
    assert "k = 5480 N/m, which holds from 0 m of compression to 0.02 m" in capsys.readouterr().out
    assert run("--C", "100", output=tmp_path) == 0
    assert "small motions" not in capsys.readouterr().out
