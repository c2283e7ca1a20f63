"""Our parts connect to parts whose flanges are those of the Modelica Standard Library, and keep their signs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import rumoca

# Written after the declarations of Modelica.Mechanics.Translational: a flange, a mass, a fixed point.
MASS_ON_DRAWBAR = """
connector TheirFlange
  Real s(unit="m");
  flow Real f(unit="N");
end TheirFlange;

model TheirMass
  parameter Real m(unit="kg") = 1;
  Real s(unit="m", start=0.03, fixed=true);
  Real v(unit="m/s", start=0, fixed=true);
  TheirFlange flange_a;
  TheirFlange flange_b;
equation
  flange_a.s = s;
  flange_b.s = s;
  v = der(s);
  m*der(v) = flange_a.f + flange_b.f;
end TheirMass;

model TheirFixed
  TheirFlange flange;
equation
  flange.s = 0;
end TheirFixed;

model MassOnDrawbar
  TheirFixed wall;
  TheirMass mass(m=500);
  OverrunHitch.Components.Drawbar drawbar(k=5480, C=500, k_t=5480);
equation
  connect(wall.flange, drawbar.front);
  connect(drawbar.rear, mass.flange_a);
end MassOnDrawbar;
"""


def test_a_mass_pushes_the_drawbar_in_and_is_thrown_back(modelica_library: Path) -> None:
    """A mass released 3 cm forward of a free drawbar: the damped oscillation of the textbook, by its closed form."""
    m, c, k, start = 500.0, 500.0, 5480.0, 0.03
    model = rumoca.Session(roots=[str(modelica_library)]).loads(MASS_ON_DRAWBAR, model="MassOnDrawbar")
    config = rumoca.SimConfig(solver="rk-like", rtol=1e-10, atol=1e-12, max_wall_seconds=60)
    result = model.simulate(t=(0, 2), dt=0.01, config=config)
    time = np.asarray(result.time)
    decay, omega = c / (2 * m), np.sqrt(k / m - (c / (2 * m)) ** 2)
    expected = start * np.exp(-decay * time) * (np.cos(omega * time) + decay / omega * np.sin(omega * time))
    np.testing.assert_allclose(np.asarray(result["drawbar.compression"]), expected, atol=1e-9)
    first = {name: float(np.asarray(result[f"drawbar.{name}"])[0]) for name in ("F_h", "front.f")}
    assert first["F_h"] == -k * start  # compressed: the hitch force, positive in tension, is negative
    assert first["front.f"] == -k * start  # what acts on the drawbar's front is the wall's push back
