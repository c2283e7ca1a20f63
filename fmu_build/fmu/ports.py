"""What the annotations ``coupling`` and ``terminal`` of a class declare, checked against its variables.

    annotation(__fmu_build(
      coupling(across="v", acrossDerivative="a", extrapolate="extrapolation", through="F", impulse="p", work="W",
        mean="F_mean", hold="F_hold", applied="applied_force", energy="coupling_energy"),
      terminal(name="hitch", signal(v="v"), outflow(F="F_hold"))))

What a coupling does is told in runtime/instance/coupling.h, what its variables are in runtime/model.h. A terminal is
one of FMI 3: member names with variables, by the kind of the member.
"""

from __future__ import annotations

import re

from ..errors import BuildError
from ..ir.models import Coupling, FlatModel, Member, Ports, SortedModel, Terminal
from ..ir.symbols import symbol

COUPLING_KINDS = {
    "across": "input",
    "acrossDerivative": "input",
    "extrapolate": "parameter",
    "through": "output",
    "impulse": "state",
    "work": "state",
    "mean": "output",
    "hold": "output",
    "applied": "parameter",
    "energy": "output",
}
REPLACED = ("mean", "hold", "energy")  # in Co-Simulation, so that nothing may be calculated from them
MEMBER_KINDS = ("signal", "inflow", "outflow")

_STRING = re.compile(r'\s*(\w+)\s*=\s*"([^"]*)"\s*(?:,|$)')
_GROUP = re.compile(r"\s*(\w+)\s*\(([^()]*)\)\s*(?:,|$)")


def declare(flat: FlatModel, model: SortedModel) -> Ports:
    """The ports of ``model``. Raises BuildError where an annotation names what is not there."""
    if len(flat.couplings) > 1:
        raise BuildError(f"{flat.name}: {len(flat.couplings)} coupling annotations: only one is supported")
    couplings = [_coupling(text, model) for text in flat.couplings]
    terminals = tuple(_terminal(text, model) for text in flat.terminals)
    names = [terminal.name for terminal in terminals]
    if repeated := sorted({name for name in names if names.count(name) > 1}):
        raise BuildError(f"{flat.name}: two terminal annotations have the name {repeated[0]}")
    return Ports(couplings[0] if couplings else None, terminals)


def _coupling(text: str, model: SortedModel) -> Coupling:
    place = f"{model.name}: coupling annotation"
    names, rest = _strings(text)
    if rest:
        raise BuildError(f'{place}: "{rest}" is not of the form key="variable"')
    for key in names:
        if key not in COUPLING_KINDS:
            raise BuildError(f"{place}: {key} is not one of {', '.join(COUPLING_KINDS)}")
    for key, needed in COUPLING_KINDS.items():
        if key not in names:
            raise BuildError(f'{place}: {key}="..." is missing, the name of a variable of kind {needed}')
        found = _kind(names[key], model, place)
        if found != needed:
            raise BuildError(f"{place}: {key} = {names[key]}: this is of kind {found}, needed is {needed}")
    for key in REPLACED:
        users = [block for block in model.assignments if symbol(names[key]) in block.arguments]
        if users:
            raise BuildError(
                f"{place}: {key} = {names[key]}: {users[0].targets[0]} depends on it ({users[0].origin}), nothing may"
            )
    snake = {re.sub(r"[A-Z]", lambda m: "_" + m.group().lower(), key): name for key, name in names.items()}
    return Coupling(**snake)


def _terminal(text: str, model: SortedModel) -> Terminal:
    place = f"{model.name}: terminal annotation"
    members: list[Member] = []
    names, rest = _strings(text)
    while group := _GROUP.match(rest):
        variables, wrong = _strings(group.group(2))
        if group.group(1) not in MEMBER_KINDS or wrong:
            kinds = ", ".join(MEMBER_KINDS)
            raise BuildError(f'{place}: {group.group().strip()} is not KIND(member="variable"), KIND one of {kinds}')
        members += [Member(member, variable, group.group(1)) for member, variable in variables.items()]
        rest = rest[group.end() :]
    if rest or list(names) != ["name"] or not members:
        raise BuildError(f'{place}: it needs a name="..." first and then members, and nothing else: {text.strip()}')
    for member in members:
        _kind(member.variable, model, place)
    return Terminal(names["name"], tuple(members))


def _strings(text: str) -> tuple[dict[str, str], str]:
    """The leading ``key="string"`` arguments, and what is left of the text."""
    found: dict[str, str] = {}
    text = text.strip()
    while match := _STRING.match(text):
        found[match.group(1)] = match.group(2)
        text = text[match.end() :]
    return found, text.strip()


def _kind(name: str, model: SortedModel, place: str) -> str:
    """What the variable ``name`` is to users."""
    if name not in model.value_references or name not in model.variables:
        raise BuildError(f"{place}: there is no variable {name}")
    if name in model.states:
        return "state"
    if name in model.inputs:
        return "input"
    if name in model.parameters:
        return "parameter"
    return "output" if model.variables[name].causality == "output" else "local variable"
