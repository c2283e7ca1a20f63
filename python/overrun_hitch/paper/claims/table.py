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
from overrun_hitch.show.table import NARROW, Column, Numbers, Row, console, show_written, table

INDENT = 3
SIDES = ("theory", "fmu")
COLUMNS = (
    *(Column(heading) for heading in ("", "unit", "printed", "must be")),
    Numbers("theory", least=9),
    Numbers("FMU", least=9),
)
MISSES = " !"  # behind a number that does not meet its criterion


def show(claims: Sequence[Claim], paths: Sequence[Path]) -> None:
    """Print every claim, how many hold and the files written."""
    out = console()
    for claim in claims:
        _show_claim(out, claim)
    out.print(summary(claims), soft_wrap=True)
    if not all(claim.verdict == "holds" for claim in claims):
        out.print(f"a number with{MISSES} does not meet its criterion")
    show_written(out, paths)


def summary(claims: Sequence[Claim]) -> str:
    """How many claims hold, and which do not."""
    failing = [f"claim {claim.number} {claim.verdict}" for claim in claims if claim.verdict != "holds"]
    return "; ".join([f"{len(claims) - len(failing)} of {len(claims)} claims of the paper hold", *failing])


def document(study: Study, claims: Sequence[Claim], paths: Sequence[Path]) -> dict[str, Any]:
    """All claims with parts and verdicts for JSON: no number, NaN, or no verdict, None, where a side has none."""
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
                **{side: getattr(part, side) for side in SIDES},
                "holds": {side: part.holds(side) for side in SIDES},
            }
            for part in claim.parts
        ],
    }


def _show_claim(out: Console, claim: Claim) -> None:
    colour = "green" if claim.verdict == "holds" else "bold red"
    out.print(Text.assemble(f"{claim.number:>2} ", (claim.verdict, colour), f" ({claim.where})"))
    out.print(_indented(Text(claim.text)))
    if out.width >= NARROW:
        out.print(_indented(table(COLUMNS, map(_cells, claim.parts))))
    else:
        for part in claim.parts:
            out.print(_indented(Text(_sentence(part))))
    if claim.remark:
        out.print(_indented(Text(claim.remark)))
    out.print()


def _indented(content: Text | Table) -> Padding:
    return Padding(content, (0, 0, 0, INDENT), expand=False)


def _cells(part: Part) -> Row:
    numbers = [Text(_number(part, side), "bold red" if part.holds(side) is False else "") for side in SIDES]
    return (part.what, part.unit, part.printed, part.criterion.words, *numbers)


def _sentence(part: Part) -> str:
    both = f"theory {_number(part, 'theory')}, FMU {_number(part, 'fmu')}"
    return f"{part.what} ({part.unit}): printed {part.printed}; {part.criterion.words}; {both}"


def _number(part: Part, side: str) -> str:
    value = getattr(part, side)
    return "-" if math.isnan(value) else f"{value:#.5g}{MISSES if part.holds(side) is False else ''}"
