"""What the annotations ``coupling`` and ``terminal`` of a class declare, checked against its variables.

    annotation(__fmu_build(
      coupling(across="v", acrossDerivative="a", extrapolate="extrapolation", through="F", impulse="p", work="W",
        mean="F_mean", hold="F_hold", applied="applied_force", energy="coupling_energy"),
      terminal(name="hitch", signal(v="v"), outflow(F="F_hold"))))

What a coupling does is told in runtime/instance/coupling.h, what its variables are in runtime/model.h. Of what goes
across and through there may be several: across="v_1, -v_2", acrossDerivative="a_1, a_2", inertia="m_1, m_2" (which may
be left out); through="F, T", and impulse, mean and hold likewise. The sign is that with which the first through acts
there. A terminal is one of FMI 3: member names with variables, by the kind of the member.
"""

from __future__ import annotations

import re
from itertools import starmap

from ..errors import BuildError
from ..ir.models import Across, Coupling, FlatModel, Member, Ports, SortedModel, Terminal, Through
from ..ir.symbols import symbol

COUPLING_KINDS = {
    "across": "input",
    "acrossDerivative": "input",
    "inertia": "parameter",
    "extrapolate": "parameter",
    "through": "output",
    "impulse": "state",
    "work": "state",
    "mean": "output",
    "hold": "output",
    "applied": "parameter",
    "energy": "output",
}
ACROSS = ("across", "acrossDerivative", "inertia")  # lists of equal length
THROUGH = ("through", "impulse", "mean", "hold")  # likewise
WHOLE = ("extrapolate", "work", "applied", "energy")  # one variable each
OPTIONAL = ("inertia",)
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
    texts, rest = _strings(text)
    if rest:
        raise BuildError(f'{place}: "{rest}" is not of the form key="variable"')
    for key in texts:
        if key not in COUPLING_KINDS:
            raise BuildError(f"{place}: {key} is not one of {', '.join(COUPLING_KINDS)}")
    names = {key: [name.strip() for name in listed.split(",")] for key, listed in texts.items()}
    signs = [-1.0 if name.startswith("-") else 1.0 for name in names.get("across", [])]
    names["across"] = [name.removeprefix("-").lstrip() for name in names.get("across", [])]
    for key, needed in COUPLING_KINDS.items():
        _check_kinds(key, names.get(key, []), needed, model, place)
    for keys in (ACROSS, THROUGH, WHOLE):
        _check_numbers({key: names[key] for key in keys if key in names}, place)
    inertias = names.get("inertia", [None] * len(signs))
    across = zip(names["across"], names["acrossDerivative"], inertias, signs, strict=True)
    through = zip(*(names[key] for key in THROUGH), strict=True)
    (extrapolate,), (work,), (applied,), (energy,) = (names[key] for key in WHOLE)
    coupling = Coupling(
        tuple(starmap(Across, across)), tuple(starmap(Through, through)), extrapolate, work, applied, energy
    )
    for name in coupling.replaced:
        users = [block for block in model.assignments if symbol(name) in block.arguments]
        if users:
            raise BuildError(f"{place}: {users[0].targets[0]} depends on {name} ({users[0].origin}), nothing may")
    return coupling


def _check_kinds(key: str, names: list[str], needed: str, model: SortedModel, place: str) -> None:
    """BuildError unless these variables, of which there is at least one, are of the kind that is needed."""
    if not names and key not in OPTIONAL:
        raise BuildError(f'{place}: {key}="..." is missing, the name of a variable of kind {needed}')
    for name in names:
        found = _kind(name, model, place)
        if found != needed:
            raise BuildError(f"{place}: {key} = {name}: this is of kind {found}, needed is {needed}")


def _check_numbers(names: dict[str, list[str]], place: str) -> None:
    """BuildError unless there are as many names to each key as to the first; more than one only in lists."""
    first = next(iter(names))
    needed = 1 if first in WHOLE else len(names[first])
    for key, listed in names.items():
        if len(listed) != needed:
            raise BuildError(f"{place}: {key} names {len(listed)} variables, needed are {needed}")


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
