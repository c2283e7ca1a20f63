"""Figures of merit against motions whose figures are known."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from overrun_hitch.measure.metrics import METRICS, NEEDED, RESPONDED, Traces, measured
from overrun_hitch.measure.oscillation import FITS

Floats = NDArray[np.float64]

TIME = np.linspace(0.0, 6.0, 101)  # 100 steps of 60 ms


def traces(eps: float = 0.0, **values: Floats) -> Traces:
    given = {name: np.atleast_2d(values.get(name, np.zeros_like(TIME))) for name in NEEDED}
    return Traces(TIME, given, np.full(len(given["v_car"]), eps))


def vibration(growth: float, omega: float) -> Traces:
    """Compression 0.03 + 0.02 exp(growth t) cos(omega t + 1), and the speeds that go with it."""
    shape = 0.02 * np.exp(complex(growth, omega) * TIME + 1j)
    rate = (complex(growth, omega) * shape).real
    return traces(v_car=np.full_like(TIME, 30.0), v_trailer=30.0 + rate, compression=0.03 + shape.real)


def one(name: str, runs: Traces) -> float:
    return float(measured((name,), runs)[name][0])


@given(growth=st.floats(-2.0, 0.1), frequency=st.floats(0.8, 4.0))
@settings(max_examples=25, deadline=None)
def test_growth_frequency_and_damping(growth: float, frequency: float) -> None:
    omega = 2.0 * np.pi * frequency
    runs = vibration(growth, omega)
    assert one("growth_rate", runs) == pytest.approx(growth, abs=1e-4)
    assert one("frequency", runs) == pytest.approx(frequency, rel=1e-4)
    assert one("damping_ratio", runs) == pytest.approx(-growth / np.hypot(growth, omega), abs=1e-4)


@given(frequency=st.floats(0.8, 2.0))
@settings(max_examples=25, deadline=None)
def test_a_peak_between_two_points_is_found(frequency: float) -> None:
    fine = np.linspace(0.0, 6.0, 200_001)
    omega = 2.0 * np.pi * frequency
    true = 0.03 + 0.02 * np.cos(omega * fine + 1.0)
    runs = vibration(0.0, omega)
    assert one("peak_compression", runs) == pytest.approx(true.max(), abs=0.02 * 2e-3)
    assert runs.values["compression"].max() < true.max() + 1e-12


def test_time_out_of_compression_counts_from_the_first_compression_on() -> None:
    compression = np.interp(TIME, [0.0, 1.0, 3.0, 4.0, 6.0], [-0.1, 0.1, 0.1, -0.1, -0.1])
    rate = np.gradient(compression, TIME)
    assert one("time_out_of_compression", traces(compression=compression, v_trailer=rate)) == pytest.approx(
        2.5, abs=0.1
    )


def test_jerk_of_the_first_tenth_of_a_second_and_of_standstill_do_not_count() -> None:
    rolls = np.full_like(TIME, 20.0)
    stepped = np.where(TIME > 0.0, -3.0, 0.0)
    assert one("peak_jerk", traces(a_car=stepped, v_car=rolls)) == 0.0
    ramp = stepped - np.clip(TIME - 2.0, 0.0, 1.0) * 1.5
    assert one("peak_jerk", traces(a_car=ramp, v_car=rolls)) == pytest.approx(1.5)
    stops = np.where(TIME < 5.0, ramp, 0.0)
    assert one("peak_jerk", traces(a_car=stops, v_car=np.where(TIME < 4.99, 20.0, 0.0))) == pytest.approx(1.5)


@given(speed=st.floats(5.0, 14.0), deceleration=st.floats(2.5, 6.0))
@settings(max_examples=50, deadline=None)
def test_stopping_distance_is_that_of_steady_braking(speed: float, deceleration: float) -> None:
    v = np.maximum(speed - deceleration * TIME, 0.0)
    a = np.where(v > 0.0, -deceleration, 0.0)
    assert one("stopping_distance", traces(v_car=v, a_car=a)) == pytest.approx(0.5 * speed**2 / deceleration, rel=1e-4)


def test_without_standstill_there_is_no_stopping_distance() -> None:
    assert np.isnan(one("stopping_distance", traces(v_car=40.0 - 2.0 * TIME)))


@given(lag=st.floats(0.15, 1.0), dead=st.floats(0.0, 0.5))
@settings(max_examples=25, deadline=None)
def test_delay_of_a_first_order_lag(lag: float, dead: float) -> None:
    torque = 500.0 * -np.expm1(-np.maximum(TIME - dead, 0.0) / lag)
    asymptote = torque[TIME >= 3.0].mean()
    true = dead - lag * np.log1p(-RESPONDED * asymptote / 500.0)
    found = one("trailer_brake_delay", traces(trailer_brake_torque=torque, v_car=np.full_like(TIME, 20.0)))
    assert found == pytest.approx(true, abs=2e-3)


def test_what_a_run_has_not_is_nan_and_every_metric_has_a_unit() -> None:
    found = measured(tuple(METRICS), traces())
    assert all(metric.unit for metric in METRICS.values())
    assert np.isnan([found[name][0] for name in ("growth_rate", "frequency", "trailer_brake_delay")]).all()


def test_no_growth_rate_where_no_exponential_fits() -> None:
    """A swing that is cut off at one end, as by a stop: there is a residual, and it says how bad."""
    free = vibration(-0.1, 9.0)
    stopped = traces(**{**free.values, "compression": np.maximum(free.values["compression"], 0.025)})
    assert one("fit_residual", free) < 1e-3 and np.isfinite(one("growth_rate", free))
    assert one("fit_residual", stopped) > FITS
    assert np.isnan([one(name, stopped) for name in ("growth_rate", "frequency", "damping_ratio")]).all()
