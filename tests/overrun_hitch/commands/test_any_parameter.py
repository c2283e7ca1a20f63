"""Every command with every parameter away from its default: a result that makes sense, or one clear line."""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping
from itertools import product
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from overrun_hitch import cli
from overrun_hitch.comparison.crosscheck import crosscheck
from overrun_hitch.comparison.distances import Allowed
from overrun_hitch.comparison.sources import Manoeuvre, UnitSource
from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.fmu.settings import Settings
from overrun_hitch.parameters import FIGURES, Parameters
from overrun_hitch.sweeps.layout import FINISHED
from tests.kept import kept_fmus
from tests.runs import step_brake
from tests.sampling import sampled

# A value that some vehicle or device has, or none of it, with what it needs beside.
AWAY: Mapping[str, str] = {
    "M_c": "1500", "M_t": "1200", "I_c": "3", "I_t": "1", "R_c": "0.3", "R_t": "0.25", "C_kc": "2e5", "C_kt": "1e5",
    "k": "0", "k_t": "0", "C": "0", "r": "0", "eps": "0.05", "F_pull_max": "0", "rebound": "3", "F_f": "50",
    "tau_b": "0.05", "F_0": "150", "x_2": "0.02,k_2=9e3", "k_2": "9e3,x_2=0.01", "x_3": "0.03,k_3=12e3",
    "k_3": "12e3,x_3=0.01", "travel": "0.03", "k_buffer": "2e5,travel=0.03", "mu": "0.8", "mu_slide": "0.6,mu=0.2",
    "sigma": "0.4", "CdA_c": "0.7", "CdA_t": "1.5", "C_rr": "0.012", "reverse_braking": "0", "V_0": "5",
    "compression_start": "-0.01",
}  # fmt: skip
COMMANDS: Mapping[str, tuple[str, ...]] = {
    "run": ("--brake-torque", "2000"),
    "stability": ("--V", "5,40", "--C", "0,100,2500"),
    "optimise": ("--range", "0:5000"),
    "couple": ("--H", "0.01"),
    "sensitivity": ("--samples", "16", "--step", "0.1", "--workers", "1"),
    "fit": ("--fit", "k,C,r"),
}
QUICK = {("couple", "F_0")}


def settings_of(name: str) -> list[str]:
    return [word for text in f"{name}={AWAY[name]}".split(",") for word in ("--set", text)]


@pytest.fixture
def fmus(car_trailer_fmu: Path, pair_fmus: dict[int, dict[str, Path]], monkeypatch: pytest.MonkeyPatch) -> None:
    """Those under test for our own."""
    ours = {"CarTrailer": car_trailer_fmu, **pair_fmus[2]}
    for command in ("couple", "fit"):
        monkeypatch.setattr(f"overrun_hitch.commands.{command}.our_fmu", lambda fmu: (
            ours[fmu.stem] if fmu.stem in ours else kept_fmus(f"Systems.{fmu.stem}", fmi=2)[fmu.stem]
        ))  # fmt: skip
    for command in ("run", "optimise", "sensitivity"):
        monkeypatch.setattr(f"overrun_hitch.commands.{command}.chosen_fmu", lambda _: car_trailer_fmu)


def test_there_is_a_value_of_each() -> None:
    assert AWAY.keys() == Parameters.model_fields.keys()


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("asked", sampled(product(COMMANDS, AWAY), QUICK), ids=str)
def test_a_result_or_one_clear_line(
    asked: tuple[str, str], car_trailer_fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    command, name = asked
    arguments = [command, *COMMANDS[command], *settings_of(name)]
    if command == "fit":
        step_brake(FIGURES["7"], fmu=car_trailer_fmu).drop_attrs().to_dataframe().to_csv(tmp_path / "trace.csv")
        arguments.insert(1, "trace.csv")
    status = cli.main(arguments)
    out, err = capsys.readouterr()
    print(status, err or out)
    hints = [line for line in err.splitlines() if line.startswith("hint: ")]
    said = [line for line in err.splitlines() if line not in hints]
    assert not re.search(r"\b(nan|inf)\b", out.lower())
    if status == 2:
        assert out == "" and len(said) == 1 and said[0].startswith("hitch: ")
        assert f"{name} = " in said[0] or "damping_ratio" in said[0] or "does not oscillate" in said[0]
    else:
        assert status in (0, 1) and said == [] and out != ""
    if command == "couple" and status == 0:
        lines = next(Path("build/couple").glob("*.csv")).read_text(encoding="utf-8").splitlines()
        errors = {row["scheme"]: row for row in csv.DictReader(lines)}
        assert abs(float(errors["trailer-mean"]["error of the growth rate [1/s]"])) < 2e-3
        assert float(errors["jacobi"]["frequency [Hz]"]) == pytest.approx(1.6, abs=1.2)


@pytest.mark.full
def test_a_sweep(car_trailer_fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A run for each, level, up and down hill."""
    runs = [dict(pair.split("=") for pair in f"{name}={AWAY[name]}".split(",")) for name in AWAY]
    names = sorted({name for run in runs for name in run})
    default = Parameters().model_dump()
    columns = {name: [float(run.get(name, default[name])) for run in runs] for name in names}
    spec = tmp_path / "spec.toml"
    text = "\n".join(f"{name} = {values}" for name, values in columns.items())
    spec.write_text(f'name = "all"\n[grid]\ngrade = [-0.1, 0.0, 0.1]\n[runs]\n{text}\n', encoding="utf-8")
    arguments = ["sweep", str(spec), "--fmu", str(car_trailer_fmu), "--output", str(tmp_path), "--workers", "1"]
    assert cli.main(arguments) == 0
    out, err = capsys.readouterr()
    assert all(line.startswith("hint: ") or line.startswith("Running") for line in err.splitlines() if line), err
    assert "Traceback" not in out
    with xr.open_zarr(tmp_path / "all.zarr", consolidated=False) as found:
        assert (found["status"].values == FINISHED).all()
        for metric in ("peak_compression", "peak_jerk", "time_out_of_compression"):
            assert np.isfinite(found[metric].values).all()
        growth, frequency = found["growth_rate"].values, found["frequency"].values
        told = np.isfinite(growth)
        assert told.sum() > len(told) // 4
        print(np.abs(growth[told]).max(), frequency[told].min(), frequency[told].max())
        assert np.abs(growth[told]).max() < 5.0 and 0.3 < frequency[told].min() < frequency[told].max() < 4.0


@pytest.mark.parametrize("name", sampled(AWAY, {"F_f"}))
def test_a_crosscheck(name: str, car_trailer_fmu: Path) -> None:
    """A unit with itself agrees, and no number is told that is none."""
    changes = dict(pair.split("=") for pair in f"{name}={AWAY[name]}".split(","))
    scenario = FIGURES["8"].changed(parameters=FIGURES["8"].parameters.changed(changes))
    with opened_unit(car_trailer_fmu) as one, opened_unit(car_trailer_fmu) as other:
        found = crosscheck(Manoeuvre(scenario, Settings()), [UnitSource(one), UnitSource(other)], Allowed())
    for comparison in found.comparisons:
        assert comparison.differing == 0 or comparison.differing == []
        assert all(row.not_judged for row in comparison.numbers if not np.isfinite(row.difference))
