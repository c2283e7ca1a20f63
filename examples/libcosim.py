"""Car.fmu and Trailer.fmu in libcosim (libcosimpy), which steps all units at once."""

from __future__ import annotations

import sys

from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

log_output_level(CosimLogLevel.WARNING)
files = sys.argv[1:] or ["build/fmi2/Car.fmu", "build/fmi2/Trailer.fmu"]
execution = CosimExecution.from_step_size(step_size=10_000_000)  # ns
car = execution.add_local_slave(CosimLocalSlave(fmu_path=files[0], instance_name="car"))
trailer = execution.add_local_slave(CosimLocalSlave(fmu_path=files[1], instance_name="trailer"))
named = {unit: {v.name.decode(): v.reference for v in execution.slave_variables(unit)} for unit in (car, trailer)}
execution.connect_real_variables(car, named[car]["v_car"], trailer, named[trailer]["v_car"])
execution.connect_real_variables(trailer, named[trailer]["F_hitch_hold"], car, named[car]["F_hitch"])
execution.real_initial_value(car, named[car]["brake_torque"], 1000.0)
observer = CosimObserver.create_last_value()
execution.add_observer(observer)
execution.step(600)
(speed,) = observer.last_real_values(car, [named[car]["v_car"]])
(compression,) = observer.last_real_values(trailer, [named[trailer]["compression"]])
print(f"libcosim: v_car = {speed:.6f} m/s, compression = {compression:.6f} m")
