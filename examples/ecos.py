"""Car.fmu and Trailer.fmu in Ecos (ecospy), which steps all units at once."""

from __future__ import annotations

import ctypes
import sys
from pathlib import Path

# ecospy brings no TBB. Where the system has none, take that of the package tbb, before ecospy looks for it.
for tbb in Path(sys.prefix, "lib").glob("libtbb.so.12"):
    ctypes.CDLL(str(tbb), mode=ctypes.RTLD_GLOBAL)
from ecospy import EcosSimulation, EcosSimulationStructure  # noqa: E402

files = sys.argv[1:] or ["build/fmi2/Car.fmu", "build/fmi2/Trailer.fmu"]
with EcosSimulationStructure() as structure:
    structure.add_model("car", files[0])
    structure.add_model("trailer", files[1])
    structure.make_real_connection("car::v_car", "trailer::v_car")
    structure.make_real_connection("trailer::F_hitch_hold", "car::F_hitch")
    structure.add_parameter_set("figure 8", {"car::brake_torque": 1000.0})
    with EcosSimulation(structure=structure, step_size=0.01) as simulation:
        simulation.init(parameter_set="figure 8")
        simulation.step(600)
        speed, compression = simulation.get_real("car::v_car"), simulation.get_real("trailer::compression")
        simulation.terminate()
print(f"ecos: v_car = {speed:.6f} m/s, compression = {compression:.6f} m")
