"""The order of what happens at events: an EquationSystem's discrete part, with what it takes of the continuous one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import networkx as nx
import sympy

from ..errors import BuildError
from ..ir.dependencies import reaching
from ..ir.equations import Assignment, Block, Relation, Variable
from ..ir.events import Memory, Schedule, ScheduledCheck, ScheduledReinit, ScheduledSample
from ..ir.models import EquationSystem
from ..ir.symbols import INITIAL, TERMINAL, TIME, pre, symbol, time_left, truth


@dataclass(frozen=True)
class Scheduled:
    """A schedule with the variables that it brings along, and the relations, time events among them rewritten."""

    schedule: Schedule
    variables: tuple[Variable, ...]
    residuals: tuple[sympy.Expr, ...]


def schedule(system: EquationSystem, continuous: Sequence[Block]) -> Scheduled:
    """The schedule of ``system``, whose unknowns ``continuous`` computes; BuildError where a loop leads through it."""
    events = system.events
    times = [(f"time_event[{i + 1}]", r) for i, r in enumerate(r for r in system.relations if r.until is not None)]
    extra = [Assignment(name, _until(relation), relation.origin) for name, relation in times]
    reinits, samples, checks = [], [], []
    for i, reinit in enumerate(events.reinits, start=1):
        entry = ScheduledReinit(reinit.state, f"reinit[{i}].active", f"reinit[{i}].value")
        reinits.append(entry)
        extra.append(Assignment(entry.active, truth(reinit.active), reinit.origin))
        extra.append(Assignment(entry.value, reinit.value, reinit.origin))
    for i, sample in enumerate(events.samples, start=1):
        clock = ScheduledSample(f"sample[{i}]", f"sample[{i}].start", f"sample[{i}].interval")
        samples.append(clock)
        extra.append(Assignment(clock.start, sample.start, sample.origin))
        extra.append(Assignment(clock.interval, sample.interval, sample.origin))
    tests = []
    for i, check in enumerate(events.checks, start=1):
        checks.append(ScheduledCheck(f"check[{i}]", check.message, check.kind))
        tests.append(Assignment(f"check[{i}]", truth(check.violated), check.origin))
    extra += tests[: events.n_event_checks]
    at_any_time = tests[events.n_event_checks :]
    own = [*events.assignments, *extra]
    memories = _memories(system, own, continuous)
    wanted = {symbol(a.target) for a in own} | {symbol(m.name) for m in memories}
    wanted |= {s for check in events.checks[: events.n_event_checks] for s in _values(check.message)}
    ordered = _ordered([*continuous, *own])
    named = {name: relation for name, relation in times}
    return Scheduled(
        Schedule(
            assignments=reaching(wanted, ordered) if own or memories else (),
            check_assignments=_for_checks(system, continuous, at_any_time),
            memories=memories,
            reinits=tuple(reinits),
            samples=tuple(samples),
            time_events=tuple(named),
            checks=tuple(checks),
            n_event_checks=events.n_event_checks,
            asks_phase=any(symbol(flag) in block.arguments for block in continuous for flag in (INITIAL, TERMINAL)),
        ),
        variables=tuple(
            Variable(name, type="Real", variability="discrete", hidden=True, origin=a.origin)
            for a in (*extra, *tests)
            for name in [a.target]
        ),
        residuals=tuple(_residuals(system.relations, [name for name, _ in times])),
    )


def _until(relation: Relation) -> sympy.Expr:
    assert relation.until is not None
    return relation.until


def _values(message: object) -> set[sympy.Symbol]:
    return set().union(*(value.free_symbols for value, _ in getattr(message, "values", ())))


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
    calculated = {a.target for a in system.events.assignments if not a.target.startswith("fires[")}
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
