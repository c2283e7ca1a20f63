"""`hitch crosscheck`: the same step brakes by several files, compared with the first."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from overrun_hitch.commands.options import TimeLimitOption, asked_use, file_stem
from overrun_hitch.parameters import FIGURES, HitchError, named

if TYPE_CHECKING:
    from overrun_hitch.comparison.sources import Asked

EACH = "for all but A; A=... or B=... for one"


def crosscheck(
    files_: Annotated[
        list[Path], typer.Argument(metavar="FMU", help="Two FMUs or more; the first, A, is the reference.")
    ],
    figure: Annotated[
        list[str] | None, typer.Option(help=f"Step brake of this figure; may be repeated (all: {', '.join(FIGURES)}).")
    ] = None,
    map_: Annotated[
        list[str] | None,
        typer.Option("--map", metavar="[A=]FILE.toml", help=f"Their names, signs and units, {EACH}."),
    ] = None,
    type_: Annotated[
        list[str] | None,
        typer.Option(
            "--type", metavar="[A=]cs|me", help=f"Co-Simulation (where it is offered) or Model Exchange, {EACH}."
        ),
    ] = None,
    tolerance: Annotated[float, typer.Option(help="Relative tolerance of the integrators.")] = 1e-6,
    step: Annotated[float, typer.Option(help="Communication step in s.")] = 0.01,
    funnel: Annotated[float, typer.Option(help="Allowed distance, relative to a variable's range in A.")] = 1e-3,
    funnel_time: Annotated[float, typer.Option(help="Allowed shift in time, in s.")] = 1e-4,
    time_limit: TimeLimitOption = 60.0,
    json: Annotated[bool, typer.Option("--json", help="Print one JSON document instead of tables.")] = False,
    junit: Annotated[Path | None, typer.Option(metavar="FILE.xml", help="Write the verdicts as JUnit XML.")] = None,
    output: Annotated[Path, typer.Option(help="Folder for the files written.")] = Path("build/crosscheck"),
) -> int:
    """Run FMUs of the same model, other tools' exports say, through the paper's figures and compare with the first."""
    if len(files_) < 2:
        raise HitchError(f"{files_[0]} alone cannot be compared: two FMUs at least are needed, the reference first")
    scenarios = [named("figure", name, FIGURES) for name in dict.fromkeys(figure or FIGURES)]

    # Imported here, because fmpy, xarray and matplotlib would slow down `hitch --help` and wrong options.
    from overrun_hitch.comparison import crosscheck_figures, crosscheck_table, record
    from overrun_hitch.comparison.crosscheck import LABELS, crosscheck
    from overrun_hitch.comparison.distances import Allowed
    from overrun_hitch.comparison.sources import opened_sources
    from overrun_hitch.fmu.settings import Settings
    from overrun_hitch.show import files, terminal, traces

    if len(files_) > len(LABELS):
        raise HitchError(f"{len(files_)} FMUs are too many: {len(LABELS)} at most")
    settings = Settings(relative_tolerance=tolerance, communication_step=step)
    allowed = Allowed(funnel=funnel, funnel_time=funnel_time)
    checks = []
    contents: dict[Path, bytes] = {}  # written when all are there, so that an interrupted run leaves nothing
    names = crosscheck_figures.names(files_)
    with terminal.patience("Crosschecking"), opened_sources(_asked(files_, map_, type_), time_limit) as sources:
        for scenario in scenarios:
            checks.append(crosscheck(scenario, sources, settings, allowed))
            picture = crosscheck_figures.draw(checks[-1], names, allowed)
            for kind in traces.KINDS:
                contents[output / f"{file_stem(scenario.name)}.{kind}"] = traces.rendered(picture, kind)
        compared = record.compared(sources)
    if junit:
        contents[junit] = record.junit(checks, compared)
    document = output / "crosscheck.json"
    paths = [*contents, document]
    text = files.json_text(record.document(checks, compared, settings, allowed, paths))
    files.write({**contents, document: f"{text}\n".encode()})
    if json:
        print(text)
    else:
        crosscheck_table.show(checks, compared, allowed, paths)
    return record.status(checks)


def _asked(paths: Sequence[Path], maps: list[str] | None, types: list[str] | None) -> list[Asked]:
    from overrun_hitch.comparison.sources import Asked
    from overrun_hitch.foreign.mapping import NO_NAMES, read_mapping

    names = {text: read_mapping(Path(text)) for text in {_of_one(text)[1] for text in maps or []}}
    mapped = _for_each("--map", maps, len(paths))
    used = _for_each("--type", types, len(paths))
    return [
        Asked(path, names.get(mapping or "", NO_NAMES), asked_use(use))
        for path, mapping, use in zip(paths, mapped, used, strict=True)
    ]


def _for_each(option: str, texts: list[str] | None, count: int) -> list[str | None]:
    """What the option says for each file: with a label for that one alone, without for all but A."""
    given: list[str | None] = [None] * count
    for label, text in sorted(map(_of_one, texts or [])):  # those without a label first
        places = [ord(label) - ord("A")] if label else range(1, count)
        for place in places:
            if place >= count:
                raise HitchError(
                    f"{option} {label}={text:.40}: there is no file {label}; allowed: A to {chr(64 + count)}"
                )
            given[place] = text
    return given


def _of_one(text: str) -> tuple[str, str]:
    """Label, or "", and the rest."""
    found = re.fullmatch(r"([A-Z])=(.*)", text, re.DOTALL)
    return (found[1], found[2]) if found else ("", text)
