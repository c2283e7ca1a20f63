"""The integration method by itself: its coefficients, its order, its behaviour on stiff problems."""

from __future__ import annotations

import ctypes as ct
from collections.abc import Callable
from math import factorial
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from tests.fmu_build.runtime.hand_written import Model
from tests.fmu_build.runtime.numerics.rosenbrock import Method, all_trees, density, strictly_lower, trees
from tests.fmu_build.runtime.runtime_models import (
    GROWING,
    PROTHERO_ROBINSON,
    SMOOTH,
    STIFFLY_TIED,
    TIED_RATES,
    VAN_DER_POL,
)
from tests.fmu_build.runtime.runtime_unit import OK, Library, Unit


class Coefficients(Method):
    """Those of Rodas5P."""

    def __init__(self, library: Library) -> None:
        gamma = ct.c_double()
        sizes = (56, 56, 8, 8, 24)
        buffers = [(ct.c_double * n)() for n in sizes]
        library.dll.probe_coefficients(ct.byref(gamma), *buffers)
        a, c, self.node, self.d, h = (np.array(b) for b in buffers)
        a, c = (strictly_lower(table.reshape(8, 7), 8) for table in (a, c))
        super().__init__(gamma.value, a, c)
        self.weights = a[7] + np.eye(8)[7]
        self.embedded = a[7] @ self.gamma
        self.bend = h.reshape(3, 8)

    def b(self, s: float = 1.0) -> np.ndarray:
        bend = self.bend[0] + s * (self.bend[1] + s * self.bend[2])
        return np.asarray(s * (self.weights + (1 - s) * bend) @ self.gamma)


@pytest.fixture(scope="module")
def coefficients(library: Callable[[Model], Library]) -> Coefficients:
    return Coefficients(library(SMOOTH))


def test_number_of_trees() -> None:
    assert [len(trees(n)) for n in range(1, 7)] == [1, 1, 2, 4, 9, 20]
    assert sum(factorial(4) // density(t) for t in trees(4) if len(t) == 3) == 6


def test_order_five(coefficients: Coefficients) -> None:
    assert max(abs(coefficients.residual(coefficients.b(), t)) for t in all_trees(5)) < 2e-14
    assert max(abs(coefficients.residual(coefficients.b(), t)) for t in trees(6)) > 1e-6


def test_embedded_order_four(coefficients: Coefficients) -> None:
    assert max(abs(coefficients.residual(coefficients.embedded, t)) for t in all_trees(4)) < 2e-14
    assert max(abs(coefficients.residual(coefficients.embedded, t)) for t in trees(5)) > 1e-6


@pytest.mark.parametrize("s", [0.1, 0.35, 0.7, 0.99])
def test_dense_order_four(coefficients: Coefficients, s: float) -> None:
    assert max(abs(coefficients.residual(coefficients.b(s), t, s)) for t in all_trees(4)) < 5e-14


def test_sums_of_rows(coefficients: Coefficients) -> None:
    """They enter where the equations depend on time."""
    np.testing.assert_allclose(coefficients.alpha.sum(axis=1), coefficients.node, atol=2e-14)
    np.testing.assert_allclose(coefficients.gamma.sum(axis=1), coefficients.d, atol=2e-14)


def test_stiffly_accurate_and_l_stable(coefficients: Coefficients) -> None:
    b = coefficients.b()
    np.testing.assert_allclose(b, coefficients.beta[7], atol=1e-14)
    assert abs(coefficients.amplification(b, -1e9)) < 1e-7
    assert max(abs(coefficients.amplification(b, 1j * w)) for w in np.logspace(-3, 4, 300)) < 1 + 1e-9


def fixed_steps(library: Library, steps: int, fraction: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    x, dense, embedded = ((ct.c_double * 2)() for _ in range(3))
    library.dll.probe_fixed_steps(
        ct.c_double(0.0), ct.c_double(1.5), ct.c_int(steps), x, ct.c_double(fraction), dense, embedded
    )
    return np.array(x), np.array(dense), np.array(embedded)


def smooth(t: float) -> np.ndarray:
    return np.array([np.sin(t) + 0.5, np.exp(-t)])


def test_observed_order(library: Callable[[Model], Library]) -> None:
    compiled = library(SMOOTH)
    steps = np.array([8, 16, 32, 64])
    end = [np.abs(fixed_steps(compiled, n, 0.6)[0] - smooth(1.5)).max() for n in steps]
    inside = [np.abs(fixed_steps(compiled, n, 0.6)[1] - smooth(1.5 - 0.4 * 1.5 / n)).max() for n in steps]
    orders = np.log2(np.array(end[:-1]) / end[1:])
    dense_orders = np.log2(np.array(inside[:-1]) / inside[1:])
    print("orders:", orders, "dense:", dense_orders)
    assert 4.7 < orders[-1] < 5.5
    assert dense_orders[-1] > 4.5  # one step's local error, of order 5, over a solution of order 5


@pytest.mark.parametrize("rate", [1e2, 1e4, 1e7])
def test_prothero_robinson(unit: Callable[..., Unit], rate: float) -> None:
    u = unit(PROTHERO_ROBINSON)
    assert u.set(rate=rate) == OK
    assert u.setup(1e-8) == OK
    assert u.initialize() == OK
    assert u.step(10.0) == OK
    assert abs(u.get("x")[0] - np.cos(10.0)) < 1e-6
    print(u.counters())
    assert u.counters().steps < 500


@pytest.mark.full
def test_van_der_pol(unit: Callable[..., Unit]) -> None:
    def radau(tolerance: float) -> Any:
        return solve_ivp(
            lambda t, x: [x[1], ((1 - x[0] ** 2) * x[1] - x[0]) / 1e-5],
            (0, 2),
            [2, 0],
            "Radau",
            rtol=tolerance,
            atol=tolerance,
        )

    reference = radau(1e-11).y[:, -1]
    u = unit(VAN_DER_POL)
    u.setup(1e-8)
    assert u.initialize() == OK
    assert u.step(2.0) == OK
    x = u.get("x", "y")
    print(u.counters(), x - reference)
    np.testing.assert_allclose(x, reference, rtol=2e-6)
    assert u.counters().steps < len(radau(1e-8).t)
    assert u.counters().rejected < u.counters().steps / 5


def test_error_goes_with_tolerance(unit: Callable[..., Unit]) -> None:
    tolerances = np.array([1e-4, 1e-6, 1e-8, 1e-10])
    errors = []
    for tolerance in tolerances:
        u = unit(SMOOTH)
        u.setup(tolerance)
        assert u.initialize() == OK
        assert u.step(3.0) == OK
        errors.append(np.abs(u.get("x", "y") - smooth(3.0)).max())
    print("errors:", errors)
    assert np.all(np.array(errors) < 3 * tolerances)
    slope = np.polyfit(np.log(tolerances), np.log(errors), 1)[0]
    assert 0.7 < slope < 1.3


@pytest.mark.parametrize("w", [1e7, 1e9, 1e10])
def test_digits_that_elimination_without_exchanges_loses(unit: Callable[..., Unit], w: float) -> None:
    """The solution with a + b = 0, to which all others decay. At w = 1e10 s^-1 the error is 9e-6 if steps are chosen by
    the embedded solution alone."""
    free = np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    start = np.array([1.0, 0.5, -0.5])
    rates = np.array(TIED_RATES)
    expected = free @ expm(5.0 * np.linalg.pinv(free) @ rates @ free) @ start
    u = unit(STIFFLY_TIED)
    p = -float((rates @ free @ start)[:2].sum()) / (2.0 * w)
    assert u.set(w=w, p=p, **dict(zip("abcd", map(float, free @ start), strict=True))) == OK
    u.setup(1e-6)
    assert u.initialize() == OK
    assert u.step(5.0) == OK
    error = np.abs(u.get(*"abcd") - expected).max()
    print(w, error, u.counters())
    assert error < 5e-7


@pytest.mark.parametrize("off", [0.0, 1e-15, 1e-12, 1e-6])
def test_matrix_singular_at_the_first_length(unit: Callable[..., Unit], coefficients: Coefficients, off: float) -> None:
    """An unstable mode whose rate is 1/(gamma h), or nearly so: a shorter step, not a wrong answer."""
    length = 0.01
    rate = (1.0 + off) / (coefficients.gamma[0, 0] * length)
    u = unit(GROWING)
    assert u.set(rate=rate) == OK
    u.setup(1e-2)  # so that the whole length is tried
    assert u.initialize() == OK
    assert u.step(length) == OK
    assert u.counters().rejected > 0
    assert u.get("x")[0] == pytest.approx(np.exp(rate * length), rel=1e-2)
