"""CarTrailer.ssp in FMPy: read by its import, case ii's parameters, stepped with the right values from the start.

FMPy's own simulate_ssp fetches no outputs before the first step, so that the ball would stand still for one step. This
is the same master with that mended.
"""

from __future__ import annotations

import shutil
import sys

from fmpy import extract
from fmpy.ssp.simulation import do_step, free_fmu, get_value, instantiate_fmu
from fmpy.ssp.ssd import find_components, find_connectors, get_connections, read_ssd, read_ssv

STEPS, H = 600, 0.01  # s

file = (sys.argv[1:] or ["build/CarTrailer.ssp"])[0]
system = read_ssd(file).system
units, connections = find_components(system), get_connections(system)
parameters = read_ssv(file, resource=system.parameterBindings[0].source)
ports = {connector.name: connector for connector in system.connectors}
for connector in find_connectors(system):
    connector.value = 0.0
ports["brake_torque"].value = 1000.0

folder = extract(file)
for unit in units:
    instantiate_fmu(unit, folder, 0.0, parameter_set=parameters)
    for connector in unit.connectors:
        if connector.kind == "output":
            connector.value = get_value(unit, connector.name)

for n in range(STEPS):
    for start, end in connections:
        end.value = start.value
    for unit in units:
        do_step(unit, n * H, H)

for start, end in connections:
    end.value = start.value
print(f"ssp: v_car = {ports['v_car'].value:.6f} m/s, compression = {ports['compression'].value:.6f} m")
for unit in units:
    free_fmu(unit)
shutil.rmtree(folder)
