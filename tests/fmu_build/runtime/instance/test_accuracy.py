"""The car and trailer of Sharp (1982) against SciPy's Radau: figures 6a, 6b, 8 and 10."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.fmu_build.runtime.runtime_models import CAR_TRAILER
from tests.fmu_build.runtime.runtime_unit import OK, Unit
from tests.sampling import sampled

K = 5480.0
FIGURES = {
    "6a": {"C": 20.0, "k_t": 100 * K, "eps": 0.0},
    "6b": {"C": 20.0, "k_t": K, "eps": 0.0},
    "8": {"C": 500.0, "k_t": 100 * K, "eps": 0.0},
    "10": {"C": 500.0, "k_t": 100 * K, "eps": 0.1},
}
NAMES = ["compression", "v_c", "v_t"]


@cache
def reference(figure: str) -> tuple[np.ndarray, np.ndarray]:
    """Compression and speeds every 0.1 s. Equations written anew, from the paper; the kinks are met by small steps."""
    p = FIGURES[figure]

    def f(_t: float, x: np.ndarray) -> list[float]:
        delta, v_c, v_t, w_c, w_t = x
        if delta > p["eps"]:
            push, torque = K * (delta - p["eps"]), 2.975 * K * (delta - p["eps"])
        else:
            push, torque = p["k_t"] * min(delta, 0.0), 0.0
        hitch = p["C"] * (v_c - v_t) - push
        tyre_c = 400e3 * (v_c - 0.35 * w_c) / v_c
        tyre_t = 200e3 * (v_t - 0.35 * w_t) / v_t
        return [
            v_t - v_c,
            (-hitch - tyre_c) / 1000,
            (hitch - tyre_t) / 500,
            (tyre_c * 0.35 - 1000) / 5,
            (tyre_t * 0.35 - torque) / 2.5,
        ]

    times = np.linspace(0, 6, 61)
    start = [0.0, 40.0, 40.0, 40 / 0.35, 40 / 0.35]
    s = solve_ivp(f, (0, 6), start, "Radau", t_eval=times, rtol=1e-11, atol=1e-11, max_step=5e-3)
    assert s.success
    return times, s.y[:3].T


@pytest.fixture
def run(unit: Callable[..., Unit]) -> Callable[..., tuple[np.ndarray, Unit]]:
    """Compression and speeds at every 0.1 s with a communication step that divides it."""

    def simulate(figure: str, tolerance: float, size: float, start: float = 0.0, **values: float):
        u = unit(CAR_TRAILER)
        assert u.setup(tolerance, start) == OK
        assert u.set(brake_torque=1000.0, **FIGURES[figure], **values) == OK
        assert u.initialize() == OK
        rows = u.run(start + 6.0, size, NAMES)
        return rows[:: round(0.1 / size)], u

    return simulate


@pytest.mark.parametrize("figure", sampled(FIGURES, ["6b", "10"]))
@pytest.mark.parametrize(
    ("tolerance", "compression", "speed"),
    [pytest.param(1e-6, 1e-4, 1e-3, marks=pytest.mark.full), (1e-8, 2e-6, 2e-5)],
    ids=["1e-6", "1e-8"],
)
def test_against_radau(run: Callable, figure: str, tolerance: float, compression: float, speed: float) -> None:
    _, exact = reference(figure)
    for size in (0.001, 0.01, 0.05, 0.1):
        rows, u = run(figure, tolerance, size)
        error = np.abs(rows - exact).max(axis=0)
        c = u.counters()
        print(f"figure {figure} rtol {tolerance:g} H {size}: errors {error}, {c}")
        assert error[0] < compression
        assert error[1:].max() < speed
        assert c.rejected < 0.1 * (c.steps + c.rejected)
    assert c.events == {"6a": 23, "6b": 19, "8": 1, "10": 5}[figure]  # without clearance one is at the start


def test_random_communication_steps(unit: Callable[..., Unit]) -> None:
    _, exact = reference("6a")
    rng = np.random.default_rng(1)
    for _ in range(3):
        points = np.sort(np.concatenate([rng.uniform(0, 6, 200), [6.0]]))
        u = unit(CAR_TRAILER)
        u.setup(1e-8)
        u.set(brake_torque=1000.0, **FIGURES["6a"])
        assert u.initialize() == OK
        for point in points:
            assert u.step(point - u.time) == OK
        error = np.abs(u.get(*NAMES) - exact[-1])
        print(error, u.counters())
        assert error[0] < 2e-6
        assert error[1:].max() < 2e-5


def test_far_from_the_origin(run: Callable) -> None:
    """Positions grow without end, and a state's allowed error with its value; the compression must not suffer much."""
    _, exact = reference("6a")
    for start in (0.0, 1e3, 1e5):
        rows, u = run("6a", 1e-6, 0.01, x_start=start)
        error = np.abs(rows - exact).max(axis=0)
        print(f"x_start {start:g}: errors {error}, {u.counters()}")
        assert error[0] < 1e-4
        assert error[1:].max() < 1e-3


def test_start_time(run: Callable) -> None:
    at_zero, _ = run("10", 1e-6, 0.05)
    later, u = run("10", 1e-6, 0.05, start=100.0)
    np.testing.assert_allclose(later, at_zero, atol=1e-5)
    assert u.get("time")[0] == pytest.approx(106.0, abs=1e-12)


def test_input_held_constant_leaves_no_trace(unit: Callable[..., Unit]) -> None:
    units = [unit(CAR_TRAILER) for _ in range(2)]
    for u in units:
        u.set(brake_torque=1000.0)
        assert u.initialize() == OK
    for _ in range(50):
        units[0].set(brake_torque=1000.0)
        assert [u.step(0.01) for u in units] == [OK, OK]
    assert units[0].state() == units[1].state()


def test_stops_where_the_model_ends(unit: Callable[..., Unit]) -> None:
    u = unit(CAR_TRAILER)
    u.set(brake_torque=1000.0)
    assert u.initialize() == OK
    status = OK
    while status == OK and u.time < 60:
        status = u.step(0.1)
    print(u.messages())
    assert "fallen below its minimum of 0.1 m/s at t = " in u.messages("logStatusWarning")[-1]
    assert u.get("v_c", "v_t").min() > 0.0999
