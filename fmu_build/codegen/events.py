"""The part of model.c that is about events: what is computed there, and tables of what follows."""

from __future__ import annotations

from ..ir.events import Message
from ..ir.models import SortedModel
from ..ir.symbols import INITIAL, TERMINAL
from .text import Printer, assignment_lines, comment, function, string


def event_sizes(model: SortedModel) -> str:
    """The rest of the enumeration of sizes in variables.h."""
    schedule = model.schedule
    if schedule.is_empty:
        return ""
    sizes = {
        "N_MEMORIES": len(schedule.memories),
        "N_REINITS": len(schedule.reinits),
        "N_SAMPLES": len(schedule.samples),
        "N_TIME_EVENTS": len(schedule.time_events),
        "N_CHECKS": len(schedule.checks),
        "N_EVENT_CHECKS": schedule.n_event_checks,
        "INITIAL": model.value_references[INITIAL],
        "TERMINAL": model.value_references[TERMINAL],
    }
    return "".join(f",\n    {name} = {size}" for name, size in sizes.items())


def print_events(model: SortedModel, printer: Printer) -> str:
    """The functions and tables of model.h that only a model with events has."""
    schedule = model.schedule
    if schedule.is_empty:
        return ""
    at = model.value_references
    memories = [
        f"{{{at[m.name]}, {at[m.before]}, {'true' if m.is_discrete else 'false'}}}, {comment(m.name)}"
        for m in schedule.memories
    ]
    reinits = [f"{{{at[r.state]}, {at[r.active]}, {at[r.value]}}}, {comment(r.state)}" for r in schedule.reinits]
    samples = [f"{{{at[s.flag]}, {at[s.start]}, {at[s.interval]}}}," for s in schedule.samples]
    times = [f"{at[name]}," for name in schedule.time_events]
    checks = [f"{{{at[check.violated]}, {check.kind}}}," for check in schedule.checks]
    tables = [
        _table("Memory", "memories", "N_MEMORIES", memories, "{0, 0, false}"),
        _table("Reinit", "reinits", "N_REINITS", reinits, "{0, 0, 0}"),
        _table("Sample", "samples", "N_SAMPLES", samples, "{0, 0, 0}"),
        _table("unsigned", "time_events", "N_TIME_EVENTS", times, "0"),
        _table("Check", "checks", "N_CHECKS", checks, "{0, WARN}"),
    ]
    functions = [
        function("model_discrete(Variables *v, const bool holds[])", assignment_lines(schedule.assignments, printer)),
        function(
            "model_checks(Variables *v, const bool holds[])", assignment_lines(schedule.check_assignments, printer)
        ),
        _messages(model, printer),
    ]
    return "\n" + "\n".join([*tables, *functions])


def _table(kind: str, name: str, size: str, rows: list[str], empty: str) -> str:
    body = "\n".join(f"    {row}" for row in rows or [empty])
    return f"const {kind} {name}[AT_LEAST_ONE({size})] = {{\n{body}\n}};\n"


def _messages(model: SortedModel, printer: Printer) -> str:
    cases = []
    for index, check in enumerate(model.schedule.checks):
        arguments = [_conversion(value, kind, printer) for value, kind in check.message.values]
        cases += [
            f"case {index}:",
            f"    message_write(message, {', '.join([_format(check.message), *arguments])});",
            "    break;",
        ]
    body = "\n".join(["switch (check) {", *cases, "default:", "    break;", "}"])
    return function("model_message(const Variables *v, int check, Message *message)", [body])


def _format(message: Message) -> str:
    conversions = {"Boolean": "%s", "Real": "%.6g", "Integer": "%.0f", "Enumeration": "%.0f"}
    parts = message.format.replace("%%", "\0").split("%s")
    kinds = [conversions[kind] for _, kind in message.values]
    text = parts[0] + "".join(kind + part for kind, part in zip(kinds, parts[1:], strict=True))
    return string(text.replace("\0", "%%"))


def _conversion(value: object, kind: str, printer: Printer) -> str:
    text = printer.text(value)
    return f'({text}) > 0.5 ? "true" : "false"' if kind == "Boolean" else text
