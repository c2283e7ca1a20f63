"""Friction's equivalent damper: its energy a cycle, and the amplitude beyond which an oscillation grows."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import trapezoid

from overrun_hitch.parameters import CASES
from overrun_hitch.theory.boundary import critical_damping
from overrun_hitch.theory.dry_friction import equivalent_damping, onset_amplitude
from overrun_hitch.theory.linear import shunting_mode


@given(F_f=st.floats(1.0, 500.0), a=st.floats(1e-3, 0.1), omega=st.floats(1.0, 50.0))
def test_the_equivalent_damper_takes_what_friction_takes(F_f: float, a: float, omega: float) -> None:
    phase = np.linspace(0.0, 2.0 * np.pi, 20001)
    v = a * omega * np.cos(phase)
    time = phase / omega
    friction = trapezoid(F_f * np.sign(v) * v, time)
    assert trapezoid(equivalent_damping(F_f, a, omega) * v**2, time) == pytest.approx(friction, rel=1e-6)


@given(tau_b=st.floats(0.005, 0.05), share=st.floats(0.1, 0.9), F_f=st.floats(1.0, 200.0))
def test_at_the_onset_the_mode_with_the_equivalent_damper_stands(tau_b: float, share: float, F_f: float) -> None:
    p = CASES["ii"].changed({"tau_b": tau_b, "F_f": F_f})
    p = p.changed({"C": share * critical_damping(p, 40.0)})
    a = onset_amplitude(p, 40.0)
    omega = float(shunting_mode(p.changed({"C": critical_damping(p, 40.0)}), 40.0).eigenvalue.imag)
    helped = p.changed({"C": p.C + equivalent_damping(F_f, a, omega)})
    assert abs(float(shunting_mode(helped, 40.0).growth_rate)) < 1e-6


def test_without_friction_all_grows_and_above_the_boundary_nothing() -> None:
    p = CASES["ii"].changed({"C": 100.0})
    assert onset_amplitude(p, 40.0) == 0.0
    assert math.isinf(onset_amplitude(p.changed({"C": 500.0, "F_f": 50.0}), 40.0))
