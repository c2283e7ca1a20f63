"""The report: everything of a study that one page shows, computed; and the page, made from page.html.jinja."""

from __future__ import annotations

import json
import math
import platform
import re
from base64 import b64encode
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from hashlib import sha256
from importlib.metadata import version
from importlib.resources import files
from pathlib import Path

import jinja2
from markupsafe import Markup, escape
from matplotlib.figure import Figure

from overrun_hitch.experiments.stop import SLOWEST
from overrun_hitch.paper.claims import table as claims_table
from overrun_hitch.paper.claims.all import all_claims
from overrun_hitch.paper.claims.claim import Claim
from overrun_hitch.paper.figures.all import figures, stem
from overrun_hitch.paper.report import captions
from overrun_hitch.paper.report.lessons import Lesson, amplitude_error, decides, lessons
from overrun_hitch.paper.report.readings import readings
from overrun_hitch.paper.report.svg import inline
from overrun_hitch.paper.study import beyond, device, jacobian
from overrun_hitch.paper.study.study import BRAKE_TORQUE, DAMPED, SETTINGS, Study
from overrun_hitch.show.table import console, show_written

COMMAND = ".venv/bin/hitch report"  # what `make report` does
SHOWN_CASE = "ii"  # of the linearisations
PACKAGES = ("overrun-hitch", "fmpy", "rumoca", "sympy", "numpy", "scipy", "xarray", "matplotlib", "jinja2")


@dataclass(frozen=True)
class Finding:
    """One line of the summary: what was asked of the numbers, and whether it is so."""

    text: str
    link: str  # the section that shows it
    holds: bool

    @property
    def verdict(self) -> str:
        """ "holds" or "does not hold"."""
        return "holds" if self.holds else "does not hold"


@dataclass(frozen=True)
class Picture:
    """A figure with the words around it."""

    key: str  # of its file, and its anchor
    title: str
    caption: str
    svg: str
    readings: Markup  # JSON: what readings.js shows


@dataclass(frozen=True)
class Report:
    """What the page shows."""

    study: Study
    claims: Sequence[Claim]
    findings: Sequence[Finding]
    lessons: Sequence[Lesson]
    pictures: Sequence[Picture]  # the paper's
    beyond: dict[str, Picture]
    versions: dict[str, str]
    command: str  # that makes this page

    @property
    def holds(self) -> bool:
        """Whether all findings hold, and so all claims."""
        return all(finding.holds for finding in self.findings)


def report_of(study: Study, command: str, progress: Callable[[str], object] = lambda _: None) -> Report:
    """Judge and draw a study; `progress` is told what is being done."""
    claims = all_claims(study)
    drawn = figures(study, progress)
    return Report(
        study=study,
        claims=claims,
        findings=_findings(study, claims),
        lessons=lessons(study, claims),
        pictures=[_picture(name, drawn[name], *words) for name, words in captions.PAPER.items()],
        beyond={name: _picture(name, drawn[name], *words) for name, words in captions.BEYOND.items()},
        versions={"Python": platform.python_version(), **{name: version(name) for name in PACKAGES}},
        command=command,
    )


def page(report: Report) -> str:
    """The page as HTML, complete in itself: nothing to load, and of scripts its own alone may run."""
    environment = jinja2.Environment(
        autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters |= {"number": number, "typeset": typeset, "complex": complex_number}
    template = environment.from_string(_part("page.html.jinja"))
    script = _part("readings.js")
    study = report.study
    return template.render(
        report=report,
        style=Markup(_part("page.css")),
        script=Markup(script),
        script_hash=b64encode(sha256(script.encode()).digest()).decode(),
        study=study,
        engaged=study.at_zero_slip[SHOWN_CASE],
        engaged_modes=jacobian.eigenvalues(study.at_zero_slip[SHOWN_CASE]),
        braking=study.at_braking,
        braking_modes=jacobian.eigenvalues(study.at_braking),
        braking_entries=jacobian.differing_entries(study.at_braking),
        states=jacobian.UNITS,
        shown_case=SHOWN_CASE,
        damped=DAMPED,
        settings=SETTINGS,
        brake_torque=BRAKE_TORQUE,
        beyond=beyond,
        device=device,
        slowest=SLOWEST,
        default_command=COMMAND,
        amplitude_error=amplitude_error,
        isnan=math.isnan,
    )


def show(report: Report, path: Path) -> None:
    """Print the findings and the page's path."""
    out = console()
    for finding in report.findings:
        out.print(f"[{'green' if finding.holds else 'bold red'}]{finding.verdict}[/]: {finding.text}")
    show_written(out, [path])


def _findings(study: Study, claims: Sequence[Claim]) -> list[Finding]:
    largest = jacobian.largest_difference(study.at_zero_slip)
    checks, motions, stops = study.boundary.checks, study.motions, study.stops
    good = sum(check.holds for check in checks)
    return [
        Finding(claims_table.summary(claims), "claims", all(claim.verdict == "holds" for claim in claims)),
        Finding(
            f"the FMU's Jacobian is the paper's dynamic matrix: over {len(study.at_zero_slip)} cases no entry differs "
            f"by more than {largest:.1e} of its value (allowed: {jacobian.ALLOWED:.0e})",
            "jacobian",
            largest <= jacobian.ALLOWED,
        ),
        Finding(
            f"at {good} of {len(checks)} points of speed and r/k the FMU's oscillation grows with "
            f"{100.0 * beyond.BESIDE:g} % less damping than theory's C_crit, and decays with "
            f"{100.0 * beyond.BESIDE:g} % more",
            "boundary-of-self-excitation",
            good == len(checks),
        ),
        _lagging(study.device.checks),
        Finding(
            f"of {len(motions)} oscillations at held speed, with clearances up to "
            f"{max(motion.eps for motion in motions):g} m, those with more damping than C_crit fade on the FMU, the "
            "others do not",
            "limit-cycles",
            decides(motions),
        ),
        Finding(
            f"from {beyond.STOP_SPEED:g} m/s down to standstill the FMU's shunting grows and fades in the envelope "
            f"that theory's growth rate predicts: in {len(stops)} stops, as far as theory applies, no amplitude "
            f"differs by more than {100.0 * max(abs(stop.in_theory.largest_error) for stop in stops):.2g} % (allowed: "
            f"{100.0 * beyond.STOP_ALLOWED:g} %)",
            "standstill",
            all(stop.agrees for stop in stops),
        ),
    ]


def _lagging(checks: Sequence[device.LagCheck]) -> Finding:
    good = sum(check.holds for check in checks)
    text = (
        f"with a brake that lags the same holds at {good} of {len(checks)} points of lag and speed, "
        f"{100.0 * device.BESIDE:g} % beside C_crit"
    )
    return Finding(text, "lag", good == len(checks))


def _picture(name: str, figure: Figure, title: str, caption: str) -> Picture:
    key = stem(name)
    svg = inline(figure, f"{key}-", title)
    # No element of the page ends in what a curve may be called.
    read = json.dumps(readings(figure), separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    return Picture(key, title, caption, svg, Markup(read))


def _part(name: str) -> str:
    return files(__package__).joinpath(name).read_text("utf-8")


def number(value: float, digits: int = 5, keep_zeros: bool = False) -> Markup:
    """A number for the page: significant digits, a true minus, powers of ten; a dash where there is none."""
    if math.isnan(value):
        return Markup("&ndash;")
    mantissa, _, exponent = f"{value + 0.0:{'#' if keep_zeros else ''}.{digits}g}".partition("e")
    mantissa = mantissa.removesuffix(".").replace("-", "\N{MINUS SIGN}")
    if not exponent:
        return escape(mantissa)
    return Markup("{}&nbsp;&middot;&nbsp;10<sup>{}</sup>").format(
        mantissa, f"{int(exponent)}".replace("-", "\N{MINUS SIGN}")
    )


def complex_number(value: complex, digits: int = 8) -> Markup:
    """An eigenvalue: one number, or a pair with plus-minus."""
    if value.imag == 0.0:
        return number(value.real, digits)
    return Markup("{} &plusmn; {} i").format(number(value.real, digits), number(abs(value.imag), digits))


INDEXED = re.compile(r"\b([A-Za-z]|omega)_(crit|k?c|k?t|0)\b")
SMALL = re.compile(r"\b(\d(?:\.\d+)?)e-0*(\d+)\b")
SIGNS = {"m/s2": "m/s\N{SUPERSCRIPT TWO}", "N.s/m": "N\N{MIDDLE DOT}s/m", "N.m": "N\N{MIDDLE DOT}m"}
SIGNS |= {"rad/s2": "rad/s\N{SUPERSCRIPT TWO}", "omega": "\N{GREEK SMALL LETTER OMEGA}"}


def typeset(text: str) -> Markup:
    """Plain text with its units and indices as they are printed: m/s2, N.s/m, C_crit, 1e-09."""
    marked = INDEXED.sub(r"\1<sub>\2</sub>", str(escape(text)))
    marked = SMALL.sub("\\1\N{NO-BREAK SPACE}\N{MIDDLE DOT}\N{NO-BREAK SPACE}10<sup>\N{MINUS SIGN}\\2</sup>", marked)
    for plain, printed in SIGNS.items():
        marked = marked.replace(plain, printed)
    return Markup(marked)
