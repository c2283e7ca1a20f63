"""Partial derivatives against central differences, adjoints against transposes, dependencies against both."""

from __future__ import annotations

import ctypes as ct
from collections.abc import Callable

import numpy as np
import pytest

from tests.fmu_build.runtime.generated_models import NONLINEAR, GeneratedModel, generate
from tests.fmu_build.runtime.runtime_fmi3 import Unit3
from tests.fmu_build.runtime.runtime_unit import ERROR, OK, Unit

STATES = ["x", "y"]
RATES = ["der(x)", "der(y)"]
OUTPUTS = ["p", "q", "of_state"]
START = {"a": 0.7, "b": 1.3, "x_0": 0.4, "u": 0.3, "y": 0.2}


@pytest.fixture(scope="module")
def nonlinear(tmp_path_factory: pytest.TempPathFactory) -> GeneratedModel:
    path = tmp_path_factory.mktemp("modelica") / "Nonlinear.mo"
    path.write_text(NONLINEAR, encoding="utf-8")
    return generate(path, "Nonlinear")


def differences(value: Callable[[str, float], np.ndarray], known: list[str], at: dict[str, float]) -> np.ndarray:
    """Fourth order: one column for each known."""
    h = 1e-3
    columns = []
    for name in known:
        near = value(name, at[name] + h) - value(name, at[name] - h)
        far = value(name, at[name] + 2 * h) - value(name, at[name] - 2 * h)
        columns.append((8 * near - far) / (12 * h))
    return np.array(columns).T


def check(jacobian: np.ndarray, expected: np.ndarray) -> None:
    error = np.abs(jacobian - expected).max() / np.abs(expected).max()
    print(f"largest difference, relative: {error:.1e}")
    assert error < 1e-7


def test_initialization_mode(unit: Callable[..., Unit], nonlinear: GeneratedModel) -> None:
    u = unit(nonlinear)
    known = list(START)
    unknown = ["x", *RATES, "p", "q", "g"]
    assert u.set(**START) == OK
    assert u.setup(start=0.6) == OK
    assert u.call("fmi2EnterInitializationMode") == OK

    def value(name: str, moved: float) -> np.ndarray:
        assert u.set(**{name: moved}) == OK
        result = u.get(*unknown)
        assert u.set(**{name: START[name]}) == OK
        return result

    expected = differences(value, known, START)
    columns = [u.directional(unknown, known, seed) for seed in np.eye(len(known))]
    assert {status for status, _ in columns} == {OK}
    check(np.array([column for _, column in columns]).T, expected)
    status, _ = u.directional(["p"], ["x"], np.ones(1))
    assert status == ERROR
    assert u.messages()[-1] == "no derivative can be had with respect to x: it is not known during initialization"


@pytest.mark.parametrize("exchange", [False, True])
def test_after_initialization(unit: Callable[..., Unit], nonlinear: GeneratedModel, exchange: bool) -> None:
    u = unit(nonlinear, exchange=exchange)
    assert u.set(**START) == OK
    assert u.setup(start=0.6) == OK
    assert u.initialize() == OK
    if not exchange:
        u.time = 0.6
        assert u.step(0.5) == OK
    known, unknown = [*STATES, "u", "time"], [*RATES, *OUTPUTS]
    at = dict(zip(known, u.get(*known), strict=True))
    jacobian = np.array([u.directional(unknown, known, seed)[1] for seed in np.eye(len(known))]).T
    other = unit(nonlinear, exchange=True)
    assert other.set(**START) == OK
    assert other.initialize() == OK
    assert other.call("fmi2EnterContinuousTimeMode") == OK

    def value(name: str, moved: float) -> np.ndarray:
        new = {**at, name: moved}
        other.call("fmi2SetTime", ct.c_double(new.pop("time")))
        assert other.set(**new) == OK
        return other.get(*unknown)

    check(jacobian, differences(value, known, at))
    for bad in ("g", "x_0", "p"):
        status, _ = u.directional(["p"], [bad], np.ones(1))
        assert status == ERROR
        assert (
            u.messages()[-1] == f"no derivative can be had with respect to {bad}: it is not known after initialization"
        )
    assert u.directional(["a"], ["x"], np.ones(1))[0] == ERROR
    assert "of a: it is not calculated" in u.messages()[-1]
    assert u.directional(["p"], ["x"], np.array([np.nan]))[0] == ERROR


@pytest.mark.parametrize("phase", ["initialization", "event", "continuous", "step"])
def test_adjoint_is_the_transpose(unit3: Callable[..., Unit3], nonlinear: GeneratedModel, phase: str) -> None:
    u = unit3(nonlinear, exchange=phase in ("event", "continuous"))
    assert u.set(**START) == OK
    assert u.enter_initialization(start=0.6) == OK
    known = list(START)
    if phase != "initialization":
        known = [*STATES, "u", "a", "b", "time"]
        assert u.call("ExitInitializationMode") == OK
    if phase == "continuous":
        assert u.call("EnterContinuousTimeMode") == OK
    if phase == "step":
        assert u.step(0.5).status == OK
    unknown = [*RATES, *OUTPUTS, "g"]
    forward = [u.partial("Directional", unknown, known, seed) for seed in np.eye(len(known))]
    reverse = [u.partial("Adjoint", unknown, known, seed) for seed in np.eye(len(unknown))]
    assert {status for status, _ in [*forward, *reverse]} == {OK}
    by_columns, by_rows = (np.array([values for _, values in way]) for way in (forward, reverse))
    np.testing.assert_allclose(by_rows, by_columns.T, rtol=1e-13, atol=1e-15)
    assert u.partial("Adjoint", unknown, known, np.ones(len(unknown) + 1))[0] == ERROR


def test_dependencies(unit3: Callable[..., Unit3], nonlinear: GeneratedModel) -> None:
    u = unit3(nonlinear)
    assert u.dependencies("x") == {"x_0", "b"}
    assert u.dependencies("p") == {"x_0", "b", "y", "a", "u", "time"}
    assert u.initialize() == OK
    assert u.dependencies("p") == {"x", "y", "u", "time"}
    assert u.dependencies("q") == {"x", "y"}
    assert u.dependencies("der(y)") == {"x", "y", "u"}
    assert u.dependencies("of_state") == {"y"}
    assert u.dependencies("g") == set()


def test_derivatives_of_outputs(unit: Callable[..., Unit], nonlinear: GeneratedModel) -> None:
    """Along the trajectory, with an input that moves, against differences of the outputs at two more points."""
    rows = []
    for size in (0.5 - 1e-3, 0.5, 0.5 + 1e-3):
        u = unit(nonlinear)
        assert u.set(**START) == OK
        assert u.setup(1e-12) == OK
        assert u.slopes(u=0.4) == OK
        assert u.initialize() == OK
        assert u.step(size) == OK
        rows.append((u.get("p", "q", "u"), u.output_slopes("p", "q", "u")))
    (before, _), (_, (status, slopes)), (behind, _) = rows
    assert status == OK
    np.testing.assert_allclose(slopes, (behind - before) / 2e-3, rtol=1e-5)
    assert slopes[2] == 0.4
    assert u.output_slopes("p", order=2)[0] == ERROR
    assert "order 2 of p" in u.messages()[-1]
    assert u.step(0.1) == OK
    assert u.output_slopes("u")[1] == 0.0
