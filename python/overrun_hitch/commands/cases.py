"""`hitch cases`: the paper's nine cases and seven step brakes, and what sets them apart."""

from __future__ import annotations

from typing import Annotated, Any

import typer

from overrun_hitch.parameters import CASES, DATUM, FIGURES, Parameters, Scenario, with_unit

SPEEDS = (10.0, 40.0)  # m/s, the paper's range
FREE = ("k", "r")  # the designer's choices


def cases(
    json: Annotated[bool, typer.Option("--json", help="Print one JSON document instead of tables.")] = False,
) -> int:
    """The paper's nine cases and the step brakes of its figures: what sets them apart, what damper they need."""
    from overrun_hitch.show import files
    from overrun_hitch.show.table import Column, Numbers, console, table
    from overrun_hitch.theory.boundary import critical_damping
    from overrun_hitch.theory.steady import steady

    found: dict[str, dict[str, Any]] = {
        name: {
            "k": case.k,
            "r_over_k": case.r / case.k,
            "A_over_A_c": steady(case, 1000.0).ratio,
            "C_crit": {f"{V:g}": critical_damping(case, V) for V in SPEEDS},
            "parameters": case.model_dump(),
        }
        for name, case in CASES.items()
    }
    if json:
        step_brakes = {name: each.model_dump(exclude={"name"}) for name, each in FIGURES.items()}
        print(files.json_text({"cases": found, "figures": step_brakes}))
        return 0
    columns = [Column("case"), Numbers("k", "N/m"), Numbers("r/k", "m"), Numbers("A/A_c", "1"),
               *(Numbers(f"C_crit\nat {V:g} m/s", "N.s/m") for V in SPEEDS), Column("differs in")]  # fmt: skip
    rows = [
        (name, f"{row['k']:g}", f"{row['r_over_k']:g}", f"{row['A_over_A_c']:.3f}",
         *(f"{value:.1f}" for value in row["C_crit"].values()), _differences(CASES[name]))
        for name, row in found.items()
    ]  # fmt: skip

    def differs(scenario: Scenario, name: str) -> bool:
        return bool(getattr(scenario.parameters, name) != getattr(DATUM, name))

    out = console()
    out.print("the nine cases: below C_crit the combination shunts by itself")
    out.print(table(columns, rows))
    out.print("\nthe step brakes: case ii at 40 m/s, 1000 N.m on the car's wheels for 6 s")
    shown = [name for name in Parameters.model_fields if any(differs(each, name) for each in FIGURES.values())]
    brakes = [(name, *(f"{getattr(each.parameters, key):g}" for key in shown)) for name, each in FIGURES.items()]
    out.print(table([Column("figure"), *(Numbers(key, Parameters.unit(key)) for key in shown)], brakes))
    return 0


def _differences(parameters: Parameters) -> str:
    changed = [name for name in Parameters.model_fields if name not in FREE]
    return ", ".join(
        f"{name} = {with_unit(getattr(parameters, name), Parameters.unit(name))}"
        for name in changed
        if getattr(parameters, name) != getattr(DATUM, name)
    )
