"""The contenders of the benchmark solve the same problem, each as well as its tolerance asks. No times are judged."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from benchmarks import fmu_contenders, rumoca_contenders, scipy_contenders
from benchmarks.comparison import ALLOWED, AT_LEAST, CVODE, FROM_C, FROM_FMPY
from benchmarks.contender import Contender
from benchmarks.work_precision import STYLES
from overrun_hitch.parameters import DATUM
from tests.oracles import radau

EPS = 0.1
STATES = {  # delta, v_c, v_t, omega_c, omega_t
    radau.TENSION: np.array([-0.02, 31.0, 31.5, 88.0, 89.5]),
    radau.CLEARANCE: np.array([0.04, 31.0, 30.5, 88.0, 86.5]),
    radau.COMPRESSION: np.array([0.13, 31.0, 31.2, 87.0, 88.5]),
}


@pytest.fixture(scope="module")
def contenders(car_trailer_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, Contender]]:
    with fmu_contenders.contenders(car_trailer_fmu, tmp_path_factory.mktemp("benchmark")) as ours:
        everyone = [*ours, *rumoca_contenders.Rumoca().contenders(), *scipy_contenders.contenders()]
        yield {contender.name: contender for contender in everyone}


@pytest.mark.full
@pytest.mark.parametrize("name", STYLES)
def test_each_comes_as_close_to_the_oracle_as_its_tolerance_asks(name: str, contenders: dict[str, Contender]) -> None:
    if name not in contenders:
        pytest.skip("numba is not installed")
    loose, tight = (contenders[name].solve(tolerance, False) for tolerance in (1e-3, 1e-9))
    print(f"{name}: {loose.error:.1e} m, {tight.error:.1e} m")
    assert tight.error < min(ALLOWED, loose.error)
    assert tight.cpu_time > 0.0
    counted = contenders[name].solve(1e-3, True)
    if name.startswith("rumoca"):
        assert counted.evaluations is counted.steps is None
    else:
        assert counted.evaluations > counted.steps > 0
        assert counted.compression == pytest.approx(loose.compression, abs=1e-12)


@pytest.mark.full
def test_all_contenders_are_known_by_name(contenders: dict[str, Contender]) -> None:
    assert set(contenders) <= set(STYLES)
    assert set(AT_LEAST) | {FROM_C, FROM_FMPY, CVODE} <= set(contenders)


@pytest.mark.full
def test_fmpy_takes_the_steps_of_the_c_program(contenders: dict[str, Contender]) -> None:
    """So the C program counts for both: they differ by rounding, far less than runs whose steps differ."""
    c, other_steps = (np.array(contenders[FROM_C].solve(tolerance, False).compression) for tolerance in (1e-6, 7e-7))
    fmpy = contenders[FROM_FMPY].solve(1e-6, False).compression
    assert np.abs(fmpy - c).max() < 0.2 * np.abs(other_steps - c).max()


@pytest.mark.parametrize("regime", STATES)
def test_equations_are_the_papers_in_every_regime(regime: int) -> None:
    parameters, state = DATUM.changed({"eps": EPS, "C": 300.0}), STATES[regime]
    rates, partials = scipy_contenders.equations(parameters, 1000.0)
    np.testing.assert_allclose(rates(*state), radau.derivatives(parameters, 1000.0, regime, state), rtol=1e-12)
    for column, change in enumerate(1e-6 * np.diag(state)):
        slopes = (np.array(rates(*(state + change))) - rates(*(state - change))) / (2.0 * change[column])
        np.testing.assert_allclose(np.array(partials(*state))[:, column], slopes, rtol=1e-6, atol=1e-6)


def test_compiled_equations_are_the_interpreted_ones() -> None:
    pytest.importorskip("numba")
    for slow, fast in zip(scipy_contenders.interpreted(), scipy_contenders.compiled(), strict=True):
        for state in STATES.values():
            np.testing.assert_allclose(fast(0.0, state), slow(0.0, state), rtol=1e-13)
