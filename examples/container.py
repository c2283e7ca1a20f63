"""One FMU of two: Car.fmu and Trailer.fmu in a container of fmu-manipulation-toolbox, run by FMPy."""

from __future__ import annotations

import logging
import sys
import tempfile
from pathlib import Path

from fmpy import simulate_fmu
from fmu_manipulation_toolbox.container import FMUContainer

H = 0.01  # s

# Most ports stay open, and that is no news: without a line for each.
logging.getLogger("fmu_manipulation_toolbox").addFilter(lambda record: "is not connected" not in record.getMessage())
car, trailer = map(Path, sys.argv[1:] or ["build/fmi2/Car.fmu", "build/fmi2/Trailer.fmu"])
with tempfile.TemporaryDirectory() as folder:
    builder = FMUContainer("CarTrailer", car.parent, fmi_version=2)
    builder.get_fmu(car.name)
    builder.get_fmu(trailer.name)
    builder.add_link(car.name, "v_car", trailer.name, "v_car")
    builder.add_link(trailer.name, "F_hitch_hold", car.name, "F_hitch")
    builder.add_input("brake_torque", car.name, "brake_torque")
    builder.add_output(car.name, "v_car", "v_car")
    builder.add_output(trailer.name, "compression", "compression")
    builder.make_fmu(Path(folder) / "Container.fmu", step_size=H)
    result = simulate_fmu(
        str(Path(folder) / "Container.fmu"),
        stop_time=6.0,
        step_size=H,
        output_interval=H,
        start_values={"brake_torque": 1000.0},
    )
print(f"container: v_car = {result['v_car'][-1]:.6f} m/s, compression = {result['compression'][-1]:.6f} m")
