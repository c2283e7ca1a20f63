"""What `hitch paper` shows: each claim with its verdict and its numbers, in the terminal and as a JSON document."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from overrun_hitch.paper.claims.claim import Claim, Part
from overrun_hitch.paper.study.study import Study

NARROW = 78  # columns that the table needs
INDENT = 3
SIDES = ("theory", "fmu")
MISSES = " !"  # behind a number that does not meet its criterion


def show(claims: Sequence[Claim], paths: Sequence[Path]) -> None:
    """Print every claim, how many hold and the files written."""
    console = Console(highlight=False)
    for claim in claims:
        _show_claim(console, claim)
    console.print(summary(claims), soft_wrap=True)
    if not all(claim.verdict == "holds" for claim in claims):
        console.print(f"a number with{MISSES} does not meet its criterion")
    for path in paths:
        console.print(f"wrote {path}", markup=False, soft_wrap=True)


def summary(claims: Sequence[Claim]) -> str:
    """How many claims hold, and which do not."""
    failing = [f"claim {claim.number} {claim.verdict}" for claim in claims if claim.verdict != "holds"]
    return "; ".join([f"{len(claims) - len(failing)} of {len(claims)} claims of the paper hold", *failing])


def document(study: Study, claims: Sequence[Claim], paths: Sequence[Path]) -> dict[str, Any]:
    """All claims with parts and verdicts for JSON: null where a side has no number or no verdict."""
    return {
        "fmu": study.fmu,
        "guid": study.guid,
        "holds": all(claim.verdict == "holds" for claim in claims),
        "claims": [_claim(claim) for claim in claims],
        "files": [str(path) for path in paths],
    }


def _claim(claim: Claim) -> dict[str, Any]:
    return {
        "number": claim.number,
        "claim": claim.text,
        "where": claim.where,
        "verdict": claim.verdict,
        "holds": {side: claim.holds(side) for side in SIDES},
        "remark": claim.remark,
        "parts": [
            {
                "what": part.what,
                "unit": part.unit,
                "printed": part.printed,
                "criterion": part.criterion.words,
                **{side: _finite(getattr(part, side)) for side in SIDES},
                "holds": {side: part.holds(side) for side in SIDES},
            }
            for part in claim.parts
        ],
    }


def _finite(value: float) -> float | None:
    """JSON knows neither NaN nor infinity."""
    return value if math.isfinite(value) else None


def _show_claim(console: Console, claim: Claim) -> None:
    colour = "green" if claim.verdict == "holds" else "bold red"
    console.print(Text.assemble(f"{claim.number:>2} ", (claim.verdict, colour), f" ({claim.where})"))
    console.print(Padding(Text(claim.text), (0, 0, 0, INDENT), expand=False))
    if console.width >= NARROW:
        console.print(Padding(_table(claim.parts), (0, 0, 0, INDENT), expand=False))
    else:
        for part in claim.parts:
            sentence = (
                f"{part.what} ({part.unit}): printed {part.printed}; {part.criterion.words}; "
                f"theory {_number(part, 'theory')}, FMU {_number(part, 'fmu')}"
            )
            console.print(Padding(Text(sentence), (0, 0, 0, INDENT), expand=False))
    if claim.remark:
        console.print(Padding(Text(claim.remark), (0, 0, 0, INDENT), expand=False))
    console.print()


def _table(parts: Sequence[Part]) -> Table:
    table = Table(box=None, pad_edge=False, header_style="dim")
    table.add_column("", ratio=4)
    table.add_column("unit", ratio=1)
    table.add_column("printed", ratio=2)
    table.add_column("must be", ratio=2)
    for heading in ("theory", "FMU"):
        table.add_column(heading, justify="right", no_wrap=True, min_width=9)
    for part in parts:
        numbers = [Text(_number(part, side), "bold red" if part.holds(side) is False else "") for side in SIDES]
        table.add_row(part.what, part.unit, part.printed, part.criterion.words, *numbers)
    return table


def _number(part: Part, side: str) -> str:
    value = getattr(part, side)
    return "-" if math.isnan(value) else f"{value:#.5g}{MISSES if part.holds(side) is False else ''}"
