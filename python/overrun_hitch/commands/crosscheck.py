"""`hitch crosscheck`: the same step brakes by several files, compared with the first."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from overrun_hitch.arguments import check_one_torque
from overrun_hitch.commands.options import (
    ParametersOption,
    ProfileOption,
    SetOption,
    TimeLimitOption,
    asked_changes,
    asked_use,
    file_stem,
    our_fmu,
)
from overrun_hitch.parameters import FIGURES, HitchError
from overrun_hitch.scenarios import asked_scenario

if TYPE_CHECKING:
    from overrun_hitch.comparison.crosscheck import Crosscheck
    from overrun_hitch.comparison.distances import Allowed
    from overrun_hitch.comparison.sources import Asked, Manoeuvre, Source

EACH = "for all but A; A=... or B=... for one"


def crosscheck(
    files_: Annotated[
        list[Path] | None,
        typer.Argument(
            metavar="FILE", help="FMUs and traces, two or more; the first, A, is the reference: also ours, theory."
        ),
    ] = None,
    figure: Annotated[
        list[str] | None, typer.Option(help=f"Step brake of this figure; may be repeated (all: {', '.join(FIGURES)}).")
    ] = None,
    set_: SetOption = None,
    parameters: ParametersOption = None,
    duration: Annotated[float | None, typer.Option(help="Length of the run in s (6).")] = None,
    brake_torque: Annotated[float | None, typer.Option(help="Brake torque on the car's wheels in N.m (1000).")] = None,
    profile: ProfileOption = None,
    measured: Annotated[
        bool, typer.Option("--measured", help="Traces have noise, and a clock of their own: align, allow for it.")
    ] = False,
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
    propose: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Write a mapping for this one to start from, and stop.")
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
    """Compare other people's FMUs and traces of the paper's step brakes with the first of them, ours or theory."""
    if propose is not None:
        return _propose(propose, output)
    given = files_ or []
    changes = asked_changes(parameters, set_)
    check_one_torque(profile, brake_torque)
    settings_ = {"duration": duration, "brake_torque": brake_torque}
    scenarios = [asked_scenario(name, None, changes, **settings_) for name in dict.fromkeys(figure or FIGURES)]

    # Imported here, because fmpy, xarray and matplotlib would slow down `hitch --help` and wrong options.
    from overrun_hitch.comparison import crosscheck_table, record
    from overrun_hitch.comparison.distances import Allowed
    from overrun_hitch.comparison.sources import Manoeuvre, is_trace, opened_sources, read_profile
    from overrun_hitch.fmu.settings import Settings
    from overrun_hitch.show import files, terminal

    if any(map(is_trace, given)) and len(scenarios) != 1:
        raise HitchError("a trace is of one scenario: say which with --figure, once, and --set, --duration, --profile")
    settings = Settings(relative_tolerance=tolerance, communication_step=step)
    allowed = Allowed(funnel=funnel, funnel_time=funnel_time)
    torque = read_profile(profile) if profile else None
    if profile:  # what is drawn and written must not pass for the paper's
        scenarios = [one.changed(name=f"{one.name}, profile {profile.stem}") for one in scenarios]
    manoeuvres = [Manoeuvre(scenario, settings, torque) for scenario in scenarios]
    asked = _asked(given, map_, type_)
    with terminal.patience("Crosschecking"), opened_sources(asked, time_limit) as sources:
        checks, contents = _checked(manoeuvres, sources, allowed, measured, given, output)
        compared = record.compared(sources)
    if junit:
        contents[junit] = record.junit(checks, compared)
    document = output / "crosscheck.json"
    paths = [*contents, document]
    text = files.json_text(record.document(checks, compared, manoeuvres, allowed, paths))
    files.write({**contents, document: f"{text}\n".encode()})
    if json:
        print(text)
    else:
        crosscheck_table.show(checks, compared, allowed, paths)
    return record.status(checks)


def _checked(
    manoeuvres: Sequence[Manoeuvre],
    sources: Sequence[Source],
    allowed: Allowed,
    measured: bool,
    given: Sequence[Path],
    output: Path,
) -> tuple[list[Crosscheck], dict[Path, bytes]]:
    """Every scenario, and pictures: written when all are there, so that an interrupted run leaves nothing."""
    from overrun_hitch.comparison import crosscheck_figures
    from overrun_hitch.comparison.crosscheck import crosscheck
    from overrun_hitch.show import traces

    checks = []
    contents: dict[Path, bytes] = {}
    names = crosscheck_figures.names(given)
    for one in manoeuvres:
        checks.append(crosscheck(one, sources, allowed, measured))
        if checks[-1].reference is not None:
            picture = crosscheck_figures.draw(checks[-1], names, allowed)
            for kind in traces.KINDS:
                contents[output / f"{file_stem(one.scenario.name)}.{kind}"] = traces.rendered(picture, kind)
    return checks, contents


def _propose(path: Path, output: Path) -> int:
    from overrun_hitch.comparison.proposal import proposal
    from overrun_hitch.show import files

    mapping = output / f"{file_stem(path.stem)}.toml"
    files.write({mapping: proposal(path).encode()})
    print(f"wrote {mapping}")
    return 0


def _asked(paths: Sequence[Path], maps: list[str] | None, types: list[str] | None) -> list[Asked]:
    from overrun_hitch.comparison.sources import OURS, Asked
    from overrun_hitch.fmu.files import CAR_TRAILER
    from overrun_hitch.foreign.mapping import NO_NAMES, read_mapping

    names = {text: read_mapping(Path(text)) for text in {_of_one(text)[1] for text in maps or []}}
    mapped = _for_each("--map", maps, len(paths))
    used = _for_each("--type", types, len(paths))
    return [
        Asked(our_fmu(CAR_TRAILER) if path == OURS else path, names.get(mapping or "", NO_NAMES), asked_use(use))
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
