"""CarTrailer.ssp: Car.fmu and Trailer.fmu wired for a master that steps both at once (SSP 1.0).

The package (System Structure and Parameterization 1.0.1, sections 3, 5 and 6) holds both units, a parameter set (SSV)
for each of the paper's nine cases, and a system structure (SSD) for each. SystemStructure.ssd, which every tool opens,
is the datum, case ii; case-i.ssd and so on are what the standard calls variants. They differ in the one parameter
binding alone, so a tool that knows no variants gets another case by another SSV.
"""

from __future__ import annotations

import argparse
import sys
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from lxml import etree

from overrun_hitch.coupling.ssp_xml import Described, add, add_connectors, add_units, described, root, text
from overrun_hitch.parameters import CASES, HitchError, Parameters

DATUM_CASE = "ii"
STOP_TIME = 6.0  # s, as in the paper's figures
EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest time that a zip can tell: the same input gives the same bytes

# Both units step at the same time and hold what they get: hence the force to be held, and the settings that go with it.
LINKS = (("Trailer", "F_hitch_hold", "Car", "F_hitch"), ("Car", "v_car", "Trailer", "v_car"))
SETTINGS = {"extrapolation": 1.0, "applied_force": 3.0}
INPUTS = {"brake_torque": ("Car",), "grade": ("Car", "Trailer")}  # of the system: the units that get them
OUTPUTS = {  # of the system, named as in CarTrailer.fmu: the unit that has them
    "v_car": "Car", "a_car": "Car", "slip_car": "Car",
    "v_trailer": "Trailer", "a_trailer": "Trailer", "slip_trailer": "Trailer", "trailer_brake_torque": "Trailer",
    "compression": "Trailer", "F_hitch": "Trailer", "coupling_energy": "Trailer",
}  # fmt: skip


def wired(element: str) -> list[str]:
    """The inputs of the unit that get something. The trailer's a_car stays free: FMPy wires all that the SSD lists."""
    return [link[3] for link in LINKS if link[2] == element] + [name for name, to in INPUTS.items() if element in to]


def _needed(element: str) -> list[str]:
    """The variables without which the unit can't be wired."""
    outputs = [link[1] for link in LINKS if link[0] == element] + [
        name for name, by in OUTPUTS.items() if by == element
    ]
    return [*wired(element), *outputs]


def values(case: Parameters, units: Mapping[str, Described]) -> dict[str, float]:
    """The parameters of both units for `case`, and the speed that the trailer starts with: "Car.M_c" to a value."""
    known = {**case.model_dump(), **SETTINGS}
    names = [(element, name) for element, unit in units.items() for name in unit.names("parameter") if name in known]
    return {**{f"{element}.{name}": known[name] for element, name in names}, "Trailer.v_car": case.V_0}


def parameter_set(name: str, case: Parameters, units: Mapping[str, Described]) -> bytes:
    """The SSV of the case called `name`."""
    top = root("ssv:ParameterSet", version="1.0", name=f"case_{name}")
    parameters = add(top, "ssv:Parameters")
    used = []
    for path, value in values(case, units).items():
        element, variable = path.split(".")
        used.append(units[element].unit(variable))
        add(add(parameters, "ssv:Parameter", name=path), "ssv:Real", value=repr(value), unit=used[-1])
    add_units(top, "ssv:Units", used, units.values())
    return text(top)


def structure(name: str, units: Mapping[str, Described]) -> bytes:
    """The SSD that binds the SSV of the case called `name`."""
    about = f"Car and trailer with an overrun brake (Sharp 1982), case {name}, both stepped at the same time"
    top = root("ssd:SystemStructureDescription", version="1.0", name=f"CarTrailer_case_{name}", description=about)
    system = add(top, "ssd:System", name="CarTrailer", description=about)
    owners = {**{port: to[0] for port, to in INPUTS.items()}, **OUTPUTS}
    used = add_connectors(system, [(port, units[element]) for port, element in owners.items()])
    add(add(system, "ssd:ParameterBindings"), "ssd:ParameterBinding", source=f"resources/case-{name}.ssv")
    elements = add(system, "ssd:Elements")
    for element, unit in units.items():
        component = add(elements, "ssd:Component", name=element, source=f"resources/{element}.fmu",
                        type="application/x-fmu-sharedlibrary", implementation="CoSimulation")  # fmt: skip
        used += add_connectors(component, [(port, unit) for port in [*wired(element), *unit.names("output")]])
    _add_connections(system)
    add_units(top, "ssd:Units", used, units.values())
    add(top, "ssd:DefaultExperiment", startTime="0.0", stopTime=repr(STOP_TIME))
    return text(top)


def _add_connections(system: etree._Element) -> None:
    """Links between the units, then from the system's inputs, then to its outputs (which have no element)."""
    into = [("", port, element, port) for port, elements in INPUTS.items() for element in elements]
    out = [(element, port, "", port) for port, element in OUTPUTS.items()]
    connections = add(system, "ssd:Connections")
    for start, source, end, target in (*LINKS, *into, *out):
        ends = {"startElement": start, "startConnector": source, "endElement": end, "endConnector": target}
        add(connections, "ssd:Connection", **{key: name for key, name in ends.items() if name})


def write_ssp(car: Path, trailer: Path, output: Path) -> None:
    """Write the package. HitchError for files that are not these two units in FMI 2.0."""
    fmus = {"Car": car, "Trailer": trailer}
    units = {element: described(fmu, _needed(element)) for element, fmu in fmus.items()}
    files = {f"resources/{element}.fmu": fmu.read_bytes() for element, fmu in fmus.items()}
    for name, case in CASES.items():
        files[f"resources/case-{name}.ssv"] = parameter_set(name, case, units)
        files["SystemStructure.ssd" if name == DATUM_CASE else f"case-{name}.ssd"] = structure(name, units)
    output.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(output, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(files):
            entry = zipfile.ZipInfo(path, EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, files[path])


def main(arguments: Sequence[str] | None = None) -> int:
    """The command `python -m overrun_hitch.coupling.ssp`; exit status 2 for bad input."""
    parser = argparse.ArgumentParser(
        prog="python -m overrun_hitch.coupling.ssp", description="Write CarTrailer.ssp (SSP 1.0)."
    )
    parser.add_argument("car", type=Path, help="Car.fmu of FMI 2.0")
    parser.add_argument("trailer", type=Path, help="Trailer.fmu of FMI 2.0")
    parser.add_argument("-o", "--output", type=Path, default=Path("build/CarTrailer.ssp"), help="the package to write")
    chosen = parser.parse_args(arguments)
    try:
        write_ssp(chosen.car, chosen.trailer, chosen.output)
    except (HitchError, OSError) as error:
        print(f"ssp: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
