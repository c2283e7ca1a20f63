"""Right sides whose derivative is infinite at one point, where a run begins, passes or stays for a while."""

from __future__ import annotations

from pathlib import Path

import fmpy
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import brentq

from tests.fmu_build.conftest import Build
from tests.sampling import sampled

Times = NDArray[np.float64]


def wrapped(equations: str, declarations: str = "Real x(start=0, fixed=true);") -> str:
    return f"model M\n  {declarations}\nequation\n  {equations}\nend M;"


def filled(times: Times) -> Times:
    """Of x' = 1 - sqrt(x) from zero: -2 s - 2 log(1 - s) = t with s^2 = x."""
    return np.array([brentq(lambda s, t: -2 * s - 2 * np.log1p(-s) - t, 0, 1 - 1e-12, (t,)) ** 2 for t in times])


CASES = {
    "by the time": (wrapped("der(x) = sqrt(time);"), lambda t: 2 / 3 * t**1.5),
    "by the time, on both sides": (wrapped("der(x) = noEvent(sqrt(abs(time)));"), lambda t: 2 / 3 * t**1.5),
    "by a state": (wrapped("der(x) = 1 - sqrt(x);"), filled),
    "by a power": (wrapped("der(x) = 1 - x^0.5;"), filled),
    "by another state": (
        wrapped("der(x) = sqrt(y);\n  der(y) = 1;", "Real x(start=0, fixed=true), y(start=0, fixed=true);"),
        lambda t: 2 / 3 * t**1.5,
    ),
}


def run(fmu: Path, stop: float, names: list[str]) -> tuple[Times, list[Times]]:
    result = fmpy.simulate_fmu(
        str(fmu),
        stop_time=stop,
        output_interval=stop / 20,
        relative_tolerance=1e-9,
        fmi_type="CoSimulation",
        output=names,
    )
    return result["time"], [result[name] for name in names]


@pytest.mark.parametrize("name", sampled(CASES, {"by the time", "by a state"}))
def test_a_run_that_begins_there(name: str, built: Build) -> None:
    text, exact = CASES[name]
    times, (x,) = run(built(text, 2), 2.0, ["x"])
    np.testing.assert_allclose(x, exact(times), rtol=0, atol=1e-7)


@pytest.mark.parametrize("damping", sampled([0.0, 0.1], {0.0}))
def test_a_contact_force_with_a_root(damping: float, built: Build) -> None:
    """In the air, where the derivative by the depth is 0 times infinity, and through the contact. Without damping the
    energy stays, m v^2/2 + m g h + 2/3 k d^(3/2) with m = 1; in the air it is constant in between."""
    contact = f"noEvent(if h < 0 then -h else 0);\n  f = max(0, 1e5*sqrt(d)*(1 - {damping}*v));"
    declarations = "Real h(start=1, fixed=true), v(start=0, fixed=true), d, f;"
    text = wrapped(f"der(h) = v;\n  der(v) = f - 10;\n  d = {contact}", declarations)
    times, (h, v) = run(built(text, 2), 3.0, ["h", "v"])
    energy = v**2 / 2 + 10 * h + 1e5 * 2 / 3 * np.maximum(-h, 0) ** 1.5
    falling = times < np.sqrt(0.2)
    np.testing.assert_allclose(h[falling], 1 - 5 * times[falling] ** 2, atol=1e-9)
    if damping == 0:
        np.testing.assert_allclose(energy, 10, rtol=1e-5)
    else:
        assert (np.diff(energy) < 1e-6).all() and 0 < energy[-1] < 5
