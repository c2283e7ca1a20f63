"""Which tolerance buys what at a stiff contact: the unit's own steps beside fmpy's CVode in Model Exchange."""

from __future__ import annotations

from math import sqrt

import fmpy
import numpy as np
import pytest
from scipy.optimize import brentq

from tests.fmu_build.conftest import Build

K, D, G, STOP = 1e6, 200.0, 9.81, 2.0  # N/m, N.s/m, m/s2, s; of a mass of 1 kg

BALL = """
model M "Falls 1 m on a stiff spring with damper"
  output Real h(start=1, fixed=true);
  output Real v(start=0, fixed=true);
equation
  der(h) = v;
  der(v) = -9.81 + (if h < 0 then -1e6*h - 200*v else 0);
end M;
"""


def contact(v: float, t: float) -> tuple[float, float]:
    """Height and speed at t after contact begins with v: a damped oscillator about its position of rest."""
    decay, rest = D / 2, -G / K
    rate = sqrt(K - decay**2)
    a, b = -rest, (v - rest * decay) / rate
    fades = np.exp(-decay * t)
    h = rest + fades * (a * np.cos(rate * t) + b * np.sin(rate * t))
    return h, fades * ((rate * b - decay * a) * np.cos(rate * t) - (rate * a + decay * b) * np.sin(rate * t))


def height(at: float) -> float:
    """The closed form: parabolas, and between them half a swing of the contact."""
    t, h, v = 0.0, 1.0, 0.0
    while True:
        flight = (v + sqrt(v**2 + 2 * G * h)) / G
        if t + flight > at:
            return h + v * (at - t) - G / 2 * (at - t) ** 2
        t, h, v = t + flight, 0.0, v - G * flight
        leaves = brentq(lambda s, v=v: contact(v, s)[0], 0.5 * np.pi / sqrt(K), 2 * np.pi / sqrt(K), xtol=1e-17)
        if t + leaves > at:
            return contact(v, at - t)[0]
        t, (h, v) = t + leaves, contact(v, leaves)
        h = 0.0


# Tolerance, and what is left of the height within two seconds (four contacts) in m: at most, by either way.
ALLOWED = {1e-4: (1e-4, 5e-2), 1e-6: (1e-6, 1e-4), 1e-8: (1e-8, 1e-5), 1e-10: (1e-9, 1e-6)}


@pytest.mark.parametrize("tolerance", ALLOWED)
def test_tolerance_buys(tolerance: float, built: Build) -> None:
    fmu, errors = str(built(BALL, 2)), []
    for kind in ("CoSimulation", "ModelExchange"):
        result = fmpy.simulate_fmu(fmu, fmi_type=kind, stop_time=STOP, output_interval=STOP / 100,
                                   relative_tolerance=tolerance, output=["h"], record_events=False)  # fmt: skip
        errors.append(max(abs(row["h"] - height(row["time"])) for row in result))
    print(f"{tolerance:.0e}: the height is off by {errors[0]:.0e} m, by CVode in Model Exchange {errors[1]:.0e} m")
    assert all(error < allowed for error, allowed in zip(errors, ALLOWED[tolerance], strict=True))
