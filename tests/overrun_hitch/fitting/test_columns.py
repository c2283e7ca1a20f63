"""Traces from CSV files: columns and units, and what is refused in one line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from overrun_hitch import cli
from overrun_hitch.fitting.columns import read_trace
from overrun_hitch.parameters import HitchError

N = 60
TIME = np.linspace(0.0, 1.0, N)
GOOD = {"time": TIME, "compression": 0.02 + 0.01 * np.sin(9.0 * TIME), "F_hitch": 100.0 + 50.0 * np.sin(9.0 * TIME)}


def written(folder: Path, **columns: object) -> Path:
    table = {**GOOD, **columns}
    rows = zip(*(np.broadcast_to(np.asarray(column), N) for column in table.values()), strict=True)
    path = folder / "trace.csv"
    path.write_text("\n".join([",".join(table), *(",".join(map(str, row)) for row in rows)]) + "\n", encoding="utf-8")
    return path


def changed(name: str, place: int, value: object) -> list[object]:
    column: list[object] = GOOD[name].tolist()
    column[place] = value
    return column


BAD = [
    ({"F_hitch": changed("F_hitch", 7, "")}, [], "column 'F_hitch', line 9: '' is not a finite number"),
    ({"compression": changed("compression", 0, "nan")}, [], "line 2: 'nan' is not a finite number"),
    ({"compression": changed("compression", 3, "inf")}, [], "line 5: 'inf' is not a finite number"),
    ({"time": changed("time", 5, 0.0)}, [], "time does not increase from sample 5 "),
    ({"compression": 0.02}, [], "compression is 0.02 m all the time"),
    ({"F_hitch": -GOOD["F_hitch"]}, [], "F_hitch falls as compression rises"),
    ({}, ["--force", "push"], "there is no column 'push'; allowed: "),
    ({}, ["--torque", "M"], "there is no column 'M'; allowed: "),
    ({}, ["--unit", "mass=kg"], "--unit 'mass' is no column; allowed: time, "),
    ({}, ["--unit", "force"], "--unit 'force' is not NAME=VALUE; for example --unit force=kN"),
    ({}, ["--unit", "force=mm"], "'mm' is no unit of F_hitch; allowed: N "),
    ({}, ["--unit", "force=*("], "'*(' is no unit of F_hitch"),
    ({}, ["--fit", "tau_b"], "tau_b cannot be fitted: the trace has no trailer_brake_torque"),
    ({}, ["--fit", "k,mass"], "there is no parameter to fit 'mass'; allowed: "),
    ({}, ["--set", "k=-1"], "k = -1 N/m is not allowed"),
]  # fmt: skip


@pytest.mark.parametrize(("columns", "arguments", "message"), BAD)
def test_bad_input_is_one_line_and_status_2(
    columns: dict[str, object],
    arguments: list[str],
    message: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("overrun_hitch.commands.fit.our_fmu", lambda fmu: fmu)  # what is wrong comes first
    trace = written(tmp_path, **columns)
    status = cli.main(["fit", str(trace), *arguments, "--output", str(tmp_path / "out")])
    out, err = capsys.readouterr()
    assert status == 2 and out == "" and not (tmp_path / "out").exists()
    assert err.startswith("hitch: ") and err.count("\n") == 1 and message in err


@pytest.mark.parametrize("text", ["", "time,compression,F_hitch\n", "\x00", "a,b\n1,2,3\n4\n"])
def test_what_is_no_table(text: str, tmp_path: Path) -> None:
    path = tmp_path / "trace.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(HitchError):
        read_trace(path, {}, {})
    with pytest.raises(HitchError, match="cannot read"):
        read_trace(tmp_path / "none.csv", {}, {})


def test_a_trace_is_the_same_in_any_unit(tmp_path: Path) -> None:
    plain, guesses = read_trace(written(tmp_path), {}, {})
    assert [guess.partition(":")[0] for guess in guesses] == ["time", "compression", "F_hitch"]
    other = tmp_path / "other"
    other.mkdir()
    path = written(other, **{"s [mm]": 1e3 * GOOD["compression"], "push (kN)": GOOD["F_hitch"] / 1e3})
    trace, guesses = read_trace(path, {"compression": "s", "F_hitch": "push (kN)"}, {"time": "s"})
    assert guesses == []
    np.testing.assert_allclose(trace.compression, plain.compression, rtol=1e-12)
    np.testing.assert_allclose(trace.F_hitch, plain.F_hitch, rtol=1e-12)
