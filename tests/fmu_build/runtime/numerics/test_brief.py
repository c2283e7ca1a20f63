"""The method of brief steps by itself: its coefficients, its order, its stability."""

from __future__ import annotations

import ctypes as ct
from collections.abc import Callable

import numpy as np
import pytest

from tests.fmu_build.runtime.hand_written import Model, Variable
from tests.fmu_build.runtime.numerics.rosenbrock import Method, all_trees, strictly_lower, trees
from tests.fmu_build.runtime.numerics.test_rodas import smooth
from tests.fmu_build.runtime.runtime_models import SMOOTH
from tests.fmu_build.runtime.runtime_unit import OK, Library, Unit


class Coefficients(Method):
    """Those of GRK4T. Its last stage has the argument of the one before."""

    def __init__(self, library: Library) -> None:
        gamma = ct.c_double()
        buffers = [(ct.c_double * n)() for n in (6, 12, 4, 4, 3, 4)]
        library.dll.probe_brief_coefficients(ct.byref(gamma), *buffers)
        a, c, weight, error, self.node, self.d = (np.array(b) for b in buffers)
        a = a.reshape(3, 2)
        super().__init__(gamma.value, strictly_lower(a[[0, 1, 2, 2]], 4), strictly_lower(c.reshape(4, 3), 4))
        self.b = weight @ self.gamma
        self.embedded = (weight - error) @ self.gamma


@pytest.fixture(scope="module")
def coefficients(library: Callable[[Model], Library]) -> Coefficients:
    return Coefficients(library(SMOOTH))


def test_order_four(coefficients: Coefficients) -> None:
    assert max(abs(coefficients.residual(coefficients.b, t)) for t in all_trees(4)) < 2e-14
    assert max(abs(coefficients.residual(coefficients.b, t)) for t in trees(5)) > 1e-4


def test_embedded_order_three(coefficients: Coefficients) -> None:
    assert max(abs(coefficients.residual(coefficients.embedded, t)) for t in all_trees(3)) < 2e-14
    assert max(abs(coefficients.residual(coefficients.embedded, t)) for t in trees(4)) > 1e-4


def test_sums_of_rows(coefficients: Coefficients) -> None:
    """They enter where the equations depend on time."""
    np.testing.assert_allclose(coefficients.alpha.sum(axis=1), [*coefficients.node, coefficients.node[2]], atol=2e-14)
    np.testing.assert_allclose(coefficients.gamma.sum(axis=1), coefficients.d, atol=2e-14)


def test_stable_in_a_wedge(coefficients: Coefficients) -> None:
    """Of 89.3 degrees to either side of the negative axis; what is stiff is damped by more than one half."""
    wedge = -np.exp(1j * np.radians(89.3)) * np.logspace(-3, 6, 500)
    assert max(abs(coefficients.amplification(coefficients.b, z)) for z in wedge) < 1.0 + 1e-4
    assert abs(coefficients.amplification(coefficients.b, -1e9)) < 0.5


def observed(library: Library, with_one_matrix: int) -> tuple[np.ndarray, np.ndarray]:
    """The orders at the end and inside of the last step, the least of three of each."""
    steps = np.array([8, 16, 32, 64])
    end, inside = [], []
    for n in steps:
        x, dense = ((ct.c_double * 2)() for _ in range(2))
        library.dll.probe_brief_steps(
            ct.c_double(0.0), ct.c_double(1.5), ct.c_int(n), ct.c_int(with_one_matrix), x, ct.c_double(0.6), dense
        )
        end.append(np.abs(np.array(x) - smooth(1.5)).max())
        inside.append(np.abs(np.array(dense) - smooth(1.5 - 0.4 * 1.5 / n)).max())
    orders, dense_orders = (np.log2(np.array(errors[:-1]) / errors[1:]) for errors in (end, inside))
    print("orders:", orders, "dense:", dense_orders)
    return orders, dense_orders


def test_observed_order(library: Callable[[Model], Library]) -> None:
    orders, dense_orders = observed(library(SMOOTH), with_one_matrix=1)
    assert 3.7 < orders[-1] < 4.5
    assert dense_orders[-1] > 2.5  # one step's local error, of order 3, over a solution of order 4


def test_observed_order_with_one_matrix_for_four_steps(library: Callable[[Model], Library]) -> None:
    """Of second order is what the matrix is off by, itself of first order, times a small coefficient."""
    orders, _ = observed(library(SMOOTH), with_one_matrix=4)
    assert orders[-1] > 1.8


def test_estimate_sees_what_the_matrix_is_off_by(coefficients: Coefficients) -> None:
    """Twenty times over what is in the solution: the term of second order in the error of the matrix."""
    sums = coefficients.gamma.sum(axis=1)
    assert abs((coefficients.b - coefficients.embedded) @ sums) > 19.0 * abs(coefficients.b @ sums)


# At steps of 1/1024 s the matrix has a pivot that is zero: that of x, which stays zero.
ZERO_PIVOT = Model(
    name="ZeroPivot",
    states=(Variable("x"), Variable("y", start=1.0)),
    derivatives=f"v->der_x = {1.0 / (0.231 / 1024)!r} * v->x; v->der_y = v->u - v->y;",
    jacobian={(0, 0): repr(1.0 / (0.231 / 1024)), (1, 1): "-1.0"},
    inputs=(Variable("u"),),
)


def test_a_matrix_without_factors_is_no_obstacle(unit: Callable[..., Unit]) -> None:
    """Neither to the steps nor to what is saved behind them."""
    unit_ = unit(ZERO_PIVOT)
    assert unit_.setup() == OK and unit_.initialize() == OK
    y = 1.0
    for i in range(30):
        assert unit_.set(u=i % 2) == OK and unit_.step(1.0 / 1024, i / 1024) == OK
        y = i % 2 + (y - i % 2) * np.exp(-1.0 / 1024)
        saved = unit_.save()
        status, loaded = unit_.deserialize(unit_.serialize(saved))
        assert status == OK, unit_.log
        unit_.drop(saved)
        unit_.drop(loaded)
    assert unit_.get("x", "y") == pytest.approx([0.0, y], rel=1e-6)
