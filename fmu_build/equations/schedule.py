"""The order of what happens at events: an EquationSystem's discrete part, with what it takes of the continuous one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import networkx as nx
import sympy

from ..errors import BuildError
from ..ir.dependencies import reaching
from ..ir.equations import Assignment, Block, Relation, Variable
from ..ir.events import (
    Check,
    Memory,
    Message,
    Reinit,
    Sample,
    Schedule,
    ScheduledCheck,
    ScheduledReinit,
    ScheduledSample,
)
from ..ir.functions import time_left
from ..ir.models import EquationSystem
from ..ir.symbols import INITIAL, TERMINAL, TIME, Kind, kind_of, numbered, pre, symbol, truth


@dataclass(frozen=True)
class Scheduled:
    """A schedule with the variables that it brings along, and the relations, time events among them rewritten."""

    schedule: Schedule
    variables: tuple[Variable, ...]
    residuals: tuple[sympy.Expr, ...]


def schedule(system: EquationSystem, continuous: Sequence[Block]) -> Scheduled:
    """The schedule of ``system``, whose unknowns ``continuous`` computes; BuildError where a loop leads through it."""
    events = system.events
    times = _time_events(system.relations)
    reinits, of_reinits = _reinits(events.reinits)
    samples, of_samples = _samples(events.samples)
    checks, tests = _checks(events.checks)
    extra = [*times, *of_reinits, *of_samples, *tests[: events.n_event_checks]]
    own = [*events.assignments, *extra]
    memories = _memories(system, own, continuous)
    wanted = {symbol(a.target) for a in own} | {symbol(m.name) for m in memories}
    wanted |= {s for check in events.checks[: events.n_event_checks] for s in _values(check.message)}
    ordered = _ordered([*continuous, *own])
    return Scheduled(
        Schedule(
            assignments=reaching(wanted, ordered) if own or memories else (),
            check_assignments=_for_checks(system, continuous, tests[events.n_event_checks :]),
            memories=memories,
            reinits=reinits,
            samples=samples,
            time_events=tuple(a.target for a in times),
            checks=checks,
            n_event_checks=events.n_event_checks,
            asks_phase=any(symbol(flag) in block.arguments for block in continuous for flag in (INITIAL, TERMINAL)),
        ),
        variables=tuple(
            Variable(a.target, type="Real", variability="discrete", hidden=True, origin=a.origin)
            for a in (*extra, *tests)
        ),
        residuals=tuple(_residuals(system.relations, [a.target for a in times])),
    )


def _time_events(relations: Sequence[Relation]) -> list[Assignment]:
    timed = [(r.until, r.origin) for r in relations if r.until is not None]
    return [Assignment(numbered(Kind.TIME_EVENT, i), until, origin) for i, (until, origin) in enumerate(timed)]


def _reinits(reinits: Sequence[Reinit]) -> tuple[tuple[ScheduledReinit, ...], list[Assignment]]:
    """New values of states, and how they and their conditions are computed."""
    entries, assignments = [], []
    for i, reinit in enumerate(reinits):
        entry = ScheduledReinit(reinit.state, numbered(Kind.REINIT, i, "active"), numbered(Kind.REINIT, i, "value"))
        entries.append(entry)
        assignments.append(Assignment(entry.active, truth(reinit.active), reinit.origin))
        assignments.append(Assignment(entry.value, reinit.value, reinit.origin))
    return tuple(entries), assignments


def _samples(samples: Sequence[Sample]) -> tuple[tuple[ScheduledSample, ...], list[Assignment]]:
    """Clocks, and how their times are computed."""
    entries, assignments = [], []
    for i, sample in enumerate(samples):
        entry = ScheduledSample(*(numbered(Kind.SAMPLE, i, part) for part in ("", "start", "interval")))
        entries.append(entry)
        assignments.append(Assignment(entry.start, sample.start, sample.origin))
        assignments.append(Assignment(entry.interval, sample.interval, sample.origin))
    return tuple(entries), assignments


def _checks(checks: Sequence[Check]) -> tuple[tuple[ScheduledCheck, ...], list[Assignment]]:
    """Checks, and how it is computed whether they are violated."""
    names = [numbered(Kind.CHECK, i) for i in range(len(checks))]
    return (
        tuple(ScheduledCheck(name, check.message, check.kind) for name, check in zip(names, checks, strict=True)),
        [Assignment(name, truth(check.violated), check.origin) for name, check in zip(names, checks, strict=True)],
    )


def _values(message: Message) -> set[sympy.Symbol]:
    return set().union(*(value.free_symbols for value, _ in message.values))


def _for_checks(system: EquationSystem, continuous: Sequence[Block], tests: list[Assignment]) -> tuple[Block, ...]:
    wanted = {symbol(a.target) for a in tests}
    for check in system.events.checks[system.events.n_event_checks :]:
        wanted |= _values(check.message)
    return reaching(wanted, [*continuous, *tests]) if tests else ()


def _residuals(relations: Sequence[Relation], times: list[str]) -> list[sympy.Expr]:
    names = iter(times)
    return [r.residual if r.until is None else time_left(symbol(next(names)), symbol(TIME)) for r in relations]


def _memories(system: EquationSystem, own: Sequence[Assignment], continuous: Sequence[Block]) -> tuple[Memory, ...]:
    """Of every discrete variable, and of others whose value before an event is asked for."""
    variables = {v.name: v for v in system.model.variables}
    symbols = set().union(
        *(block.arguments for block in (*own, *continuous)), *(r.residual.free_symbols for r in system.relations)
    )
    asked = {s.name for s in symbols}
    calculated = {a.target for a in system.events.assignments if kind_of(a.target) is not Kind.FIRES}
    names = [v.name for v in variables.values() if v.name in calculated or pre(v.name) in asked]
    return tuple(Memory(name, pre(name), variables[name].variability == "discrete") for name in names)


def _ordered(blocks: Sequence[Block]) -> list[Block]:
    """Each behind those that it needs, otherwise as they are."""
    by_target = {target: index for index, block in enumerate(blocks) for target in block.targets}
    needs = nx.DiGraph()
    needs.add_nodes_from(range(len(blocks)))
    for index, block in enumerate(blocks):
        needed = sorted(s.name for s in block.arguments if s.name in by_target)
        needs.add_edges_from((by_target[name], index) for name in needed)
    try:
        return [blocks[index] for index in nx.lexicographical_topological_sort(needs)]
    except nx.NetworkXUnfeasible:
        loop = [blocks[index] for index, _ in nx.find_cycle(needs)]
        places = ", ".join(dict.fromkeys(block.origin for block in loop))
        names = ", ".join(name for block in loop for name in block.targets)
        raise BuildError(
            f"{places}: {names} depend on each other, and not all are continuous: put pre() around one"
        ) from None
