"""The page documentation/index.html of an FMU: what it is, what goes in and out, parameters, how it was made."""

from __future__ import annotations

from html import escape

import nh3

from ..ir.models import Claims
from .interface import GENERATION_TOOL, Entry, Interface
from .licences import of_the_model

STYLE = """
body { font: 16px/1.5 sans-serif; max-width: 54em; margin: 2em auto; padding: 0 1em; color: #222 }
table { border-collapse: collapse; width: 100% }
th, td { text-align: left; padding: .25em .6em .25em 0; vertical-align: top }
th { border-bottom: 1px solid #888 } td { border-bottom: 1px solid #ddd } code { font-size: .95em }
img { float: right; margin: 0 0 1em 1em }
"""
REFERENCES = """<h2>Reference results</h2>
<p>Another tool's results for examples of this unit are in <code>extra/</code>, see
<a href="fmi-ls-ref.txt">fmi-ls-ref.txt</a>.</p>
"""
SECTIONS = {"input": "Inputs", "output": "Outputs", "parameter": "Parameters"}


def document(interface: Interface, text: str, claims: Claims, picture: str, *, has_references: bool) -> bytes:
    """The page: ``text`` is the HTML of the class's documentation, of which what could run is dropped, ``picture`` the
    path of the class's icon from the page.

    ``has_references``: fmi-ls-ref.txt stands beside it and describes reference results.
    """
    references = REFERENCES if has_references else ""
    tables = "".join(_table(heading, causality, interface) for causality, heading in SECTIONS.items())
    page = f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{escape(interface.identifier)}</title>
<style>{STYLE}</style>
</head>
<body>
<img src="{escape(picture)}" alt="Icon of {escape(interface.identifier)}" width="128" height="128">
<h1>{escape(interface.identifier)}</h1>
<p><strong>{escape(interface.description)}</strong></p>
{nh3.clean(text)}
{tables}
{_indicators(interface)}<h2>How it runs</h2>
<p>Co-Simulation and Model Exchange. As a Co-Simulation unit it brings its own integrator, Rodas5P (Steinebach 2023), a
linearly implicit method of order 5 with the exact Jacobian. Error control chooses its steps: while no input changes,
they go on across communication points, which are read off the solution. An input that gets a new value ends a step. The
relative tolerance is the importer's, {interface.experiment["tolerance"]} if it gives none; the absolute tolerance of a
state is the relative one times its nominal value. Switching points are located on the solution.</p>
<p>The unit needs the C library and its mathematical part, no resources and no files. Values outside the ranges above
are refused with a message.</p>
{references}<h2>Licence</h2>
<p>The model: {escape(of_the_model(claims))}. The runtime in it: MIT, see
<a href="licenses/license.txt">licenses/license.txt</a>. Made by {escape(GENERATION_TOOL)} from the Modelica class
<code>{escape(interface.name)}</code>.</p>
</body>
</html>
"""
    return page.encode()


def _indicators(interface: Interface) -> str:
    """What switches at the zeros of each event indicator, which FMI 2 gives a number and no name."""
    rows = "".join(
        f"<tr><td>{number}</td><td>{escape(entry.variable.description)}</td></tr>\n"
        for number, entry in enumerate(interface.event_indicators, start=1)
    )
    return f"<h2>Event indicators</h2>\n<table><tr><th>number</th><th></th></tr>\n{rows}</table>\n" if rows else ""


def _table(heading: str, causality: str, interface: Interface) -> str:
    """A table of the variables of one causality, with the columns that say something."""
    rows = [_row(entry) for entry in interface.entries if entry.causality == causality]
    if not rows:
        return ""
    names = ("name", "unit", "start", "range", "meaning")
    shown = [column for column in range(len(names)) if any(row[column] for row in rows)]
    head = "".join(f"<th>{names[column]}</th>" for column in shown)
    lines = ["".join(f"<td>{row[column]}</td>" for column in shown) for row in rows]
    body = "".join(f"<tr>{line}</tr>\n" for line in lines)
    return f"<h2>{heading}</h2>\n<table><tr>{head}</tr>\n{body}</table>\n"


def _row(entry: Entry) -> tuple[str, ...]:
    v = entry.variable
    start = "" if entry.start is None else f"{entry.start:g}"
    low = "" if v.min is None else f"at least {v.min:g}"
    high = "" if v.max is None else f"at most {v.max:g}"
    remark = " (fixed after initialization)" if entry.causality == "parameter" and entry.variability == "fixed" else ""
    limits = ", ".join(filter(None, (low, high)))
    return f"<code>{escape(v.name)}</code>", escape(v.unit), start, limits, escape(v.description) + remark
