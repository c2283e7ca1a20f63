"""`hitch parameters`: every parameter, what it means and what is usual."""

from __future__ import annotations

import textwrap
from typing import Annotated, Any

import typer

from overrun_hitch.parameters import CASES, DATUM, FIGURES, Parameters, named, with_unit

WIDE = 120  # columns of a terminal in which the table is one


def parameters(
    case: Annotated[str | None, typer.Option(help="The values of a case of the paper, too.")] = None,
    json: Annotated[bool, typer.Option("--json", help="Print one JSON document instead of a table.")] = False,
) -> int:
    """Every parameter: symbol, meaning, unit, default, range, what is typical, and whose these numbers are."""
    from overrun_hitch.show import files
    from overrun_hitch.show.table import Column, Numbers, console, table

    values = DATUM if case is None else named("case", case, CASES)
    found = {name: _about(name, values) for name in Parameters.model_fields}
    chosen = [] if case is None else [f"case {case}"]
    if json:
        print(files.json_text({"case": case, "parameters": found}))
    elif (out := console()).width < WIDE:
        for name, about in found.items():
            sentence = f"{name}: {_sentence(about, *chosen)}"
            out.print(textwrap.fill(sentence, out.width, subsequent_indent="  "), markup=False)
    else:
        numbers = [Numbers(heading) for heading in ("default", *chosen)]
        columns = [Column("parameter"), Column("meaning"), Column("unit"), *numbers, Column("allowed"),
                   Column("typical"), Column("source")]  # fmt: skip
        kinds = ("default", "value")[: len(numbers)]
        rows = [
            (name, about["meaning"], about["unit"], *(f"{about[kind]:g}" for kind in kinds),
             f"{about['least']:g} to {about['most']:g}", about["typical"], about["source"])
            for name, about in found.items()
        ]  # fmt: skip
        out.print(table(columns, rows))
    return 0


def _about(name: str, values: Parameters) -> dict[str, Any]:
    least, most = Parameters.limits(name)
    return {
        "meaning": Parameters.description(name),
        "unit": Parameters.unit(name),
        "default": getattr(DATUM, name),
        "value": getattr(values, name),
        "least": least,
        "most": most,
        "typical": Parameters.typical(name) or _in_the_paper(name),
        "source": Parameters.source(name),
    }


def _in_the_paper(name: str) -> str:
    """From the least to the greatest value in the paper's cases and figures; "" where it has but one."""
    sets = [*CASES.values(), *(figure.parameters for figure in FIGURES.values())]
    least, *_, greatest = sorted(getattr(each, name) for each in sets)
    return f"{least:g} to {greatest:g}" if least < greatest else ""


def _sentence(about: dict[str, Any], case: str = "") -> str:
    default, value = (with_unit(about[kind], about["unit"]) for kind in ("default", "value"))
    beside = f", {case} {value}" if case else ""
    typical = f"; typical {about['typical']}" if about["typical"] else ""
    source = f" ({about['source']})" if about["source"] else ""
    return f"{about['meaning']}; default {default}{beside}; {about['least']:g} to {about['most']:g}{typical}{source}"
