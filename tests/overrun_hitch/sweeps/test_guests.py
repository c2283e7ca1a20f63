"""FMUs that hang, crash or share: what a sweep makes of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import overrun_hitch
from overrun_hitch.parameters import DATUM
from overrun_hitch.sweeps.spec import SweepSpec
from overrun_hitch.sweeps.store import FAILED, FINISHED
from tests.overrun_hitch.fmu.strangers import ABORTS, FAULTS, HANGS, stranger
from tests.overrun_hitch.sweeps.test_sweep import alone, workers


@pytest.mark.full
def test_runs_that_hang_or_crash_are_recorded_and_stop_nothing(
    car_trailer_fmu: Path, tmp_path: Path, temporary: Path
) -> None:
    """Also those that only crash after another: they get a chance of their own."""
    code = f"if (C == 2.0) {{ {HANGS} }} if (C == 4.0) {{ {ABORTS} }} if (C == 5.0) {{ {FAULTS} }}"
    code += f"static int spoilt; if (spoilt && C == 7.0) {{ {FAULTS} }} spoilt |= C == 6.0;"
    fmu = stranger(car_trailer_fmu, tmp_path / "bad.fmu", do_step=code)
    spec = {"metrics": ["peak_jerk"], "grid": {"C": [float(C) for C in range(1, 9)]}, "communication_step": 0.1}
    found = overrun_hitch.sweep(spec, tmp_path / "bad.zarr", fmus=[fmu], workers=2, time_limit=1.0)
    assert [text for text in found["message"].values.tolist() if text] == [
        "bad.fmu: did not finish within 1 s (--time-limit)",
        "bad.fmu: crashed: aborted",
        "bad.fmu: crashed: segmentation fault",
    ]
    failed = np.isin(found["C"].values, [2.0, 4.0, 5.0])
    assert (found["status"].values == np.where(failed, FAILED, FINISHED)).all()
    good = alone(SweepSpec(**spec), car_trailer_fmu, tmp_path / "good.zarr")["peak_jerk"].values
    assert (found["peak_jerk"].values[~failed] == good[~failed]).all()
    assert np.isnan(found["peak_jerk"].values[failed]).all()
    assert not workers()
    assert list(temporary.iterdir()) == []


@pytest.mark.full
def test_the_time_limit_is_that_of_a_run(car_trailer_fmu: Path, tmp_path: Path) -> None:
    """Not of a batch: thirty runs of a tenth of a second, none longer than one."""
    fmu = stranger(car_trailer_fmu, tmp_path / "slow.fmu", do_step="if (time == 0.0) usleep(100000);")
    runs = [float(C) for C in range(30)]
    spec = {"metrics": [], "runs": {"C": runs}, "duration": 0.1, "communication_step": 0.1}
    found = overrun_hitch.sweep(spec, tmp_path / "slow.zarr", fmus=[fmu], workers=1, time_limit=1.0)
    assert (found["status"].values == FINISHED).all()


@pytest.mark.full
def test_the_fmus_of_a_sweep_do_not_meet(car_trailer_fmu: Path, tmp_path: Path) -> None:
    set_k = 'setenv("STRANGERS_FACTOR", "{}", 0); k *= atof(getenv("STRANGERS_FACTOR"));'
    fmus = [stranger(car_trailer_fmu, tmp_path / f"{x}.fmu", set_k=set_k.format(x)) for x in (1.0, 1.5)]
    spec = {"metrics": ["peak_compression"], "grid": {"C": [100.0]}, "communication_step": 0.1}
    found = overrun_hitch.sweep(spec, tmp_path / "two.zarr", fmus=fmus, workers=1)["peak_compression"].values
    stiffer = alone(
        SweepSpec(**spec, parameters={"k": 1.5 * DATUM.k}), car_trailer_fmu, tmp_path / "stiffer.zarr"
    )["peak_compression"].values  # fmt: skip
    assert found[1] == stiffer[0] < found[0]
