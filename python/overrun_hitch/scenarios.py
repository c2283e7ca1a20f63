"""The scenario that somebody asks for: a figure or a case of the paper, and what is to be different."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from overrun_hitch.parameters import CASES, FIGURES, HitchError, Parameters, Scenario, named


def asked_scenario(
    figure: str | int | None, case: str | None, changes: Mapping[str, Any], **settings: float | None
) -> Scenario:
    """The step brake of the figure (8 unless said otherwise), or figure 8 with the case's parameters, and `changes`.

    `changes` are parameters in SI units, `settings` brake_torque (N.m) and duration (s); None: as in the figure.
    HitchError for unknown names and values out of range.
    """
    if figure is not None and case is not None:
        raise HitchError("figure and case exclude each other: a case is figure 8 with that case's parameters")
    scenario: Scenario = named("figure", "8" if figure is None else str(figure), FIGURES)
    if case is not None:
        scenario = scenario.changed(name=f"case {case}", parameters=named("case", case, CASES))
    given = {name: value for name, value in settings.items() if value is not None}
    changed = scenario.changed(parameters=scenario.parameters.changed(changes), **given)
    others = {name: getattr(changed, name) for name in given}
    return changed.changed(name=name_with(scenario.name, scenario.parameters, changed.parameters, others))


def name_with(name: str, before: Parameters, after: Parameters, others: Mapping[str, float] | None = None) -> str:
    """`name` and what was changed: "case ii, C=200". What is drawn and written must not pass for the paper's."""
    changed = {p: getattr(after, p) for p in Parameters.model_fields if getattr(after, p) != getattr(before, p)}
    return ", ".join([name, *(f"{key}={value:g}" for key, value in {**changed, **(others or {})}.items())])
