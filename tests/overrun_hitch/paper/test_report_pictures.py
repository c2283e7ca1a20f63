"""The report's pictures: words that are words, values under the pointer, curves told apart in light, dark and grey."""

from __future__ import annotations

import itertools
import json
import re
import shutil
import subprocess
from pathlib import Path

import lxml.html
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from overrun_hitch.paper.report import page as report
from overrun_hitch.paper.report.label import pieces, plain
from overrun_hitch.paper.report.readings import readings
from overrun_hitch.paper.report.svg import inline
from overrun_hitch.paper.study.study import Study
from tests.sampling import sampled

ALL = ["3", "4", "5", "6a", "6b", "7", "8", "9", "10", "11", "boundary", "cycles", "device", "stops"]
SVG = "{http://www.w3.org/2000/svg}"
TELEPHONE = 358.0  # CSS pixels that a picture has on a screen of 390
LEAST_SIZE = 8.5  # CSS pixels of text
DARK = "#121212"  # the paper at night
APART = 3.0  # contrast of what has to be seen (WCAG 2.1, 1.4.11)
GREYS_APART = 1.5  # contrast of lines that are dashed and marked alike


@pytest.fixture(scope="module", params=sampled(ALL, ["4", "boundary"]))
def drawn(paper_figures: dict[str, Figure], request: pytest.FixtureRequest) -> tuple[Figure, etree._Element]:
    """A figure, and how it stands in the report."""
    figure = paper_figures[request.param]
    return figure, etree.fromstring(inline(figure, f"{request.param}-", request.param))


def texts(svg: etree._Element) -> list[str]:
    return ["".join(element.itertext()) for element in svg.iter(f"{SVG}text")]


def test_words_are_words(drawn: tuple[Figure, etree._Element]) -> None:
    figure, svg = drawn
    found = texts(svg)
    assert not [text for text in found if re.search(r"[$\\{}]", text)]
    assert not [path for path in svg.iter(f"{SVG}path") if "DejaVu" in str(path.get("id"))]
    for axes in figure.axes:
        assert "".join(piece.text for piece in pieces(axes.get_ylabel().splitlines()[0])) in found
    legends = [*figure.legends, *(axes.get_legend() for axes in figure.axes if axes.get_legend())]
    names = [line for legend in legends for text in legend.get_texts() for line in text.get_text().splitlines()]
    assert names and {"".join(piece.text for piece in pieces(name)) for name in names} <= set(found)


def test_words_can_be_read_on_a_telephone(drawn: tuple[Figure, etree._Element]) -> None:
    _, svg = drawn
    pixels = TELEPHONE / float(str(svg.get("viewBox")).split()[2])
    styles = [style for element in svg.iter() if "font-size:" in (style := str(element.get("style")))]
    sizes = [float(size) for style in styles for size in re.findall(r"font-size: ([\d.]+)px", style)]
    assert len(sizes) >= 20 and min(sizes) * pixels > LEAST_SIZE
    assert "font-family" not in etree.tostring(svg, encoding="unicode")


@given(st.text(st.characters(exclude_characters="$\\\r\n", exclude_categories=["C"]), min_size=1))
def test_a_label_keeps_its_words(words: str) -> None:
    assert plain(words) == words
    assert plain(f"$C_\\mathrm{{crit}}$ {words}").startswith("C_crit ")


@pytest.mark.parametrize(
    ("label", "text"),
    [("$\\tau_b$ (ms)", "τ_b (ms)"), ("$\\mathdefault{10^{-5}}$", "10^-5"), ("$A/A_c$", "A/A_c"), (r"5 \$", "5 $")],
)
def test_formulas(label: str, text: str) -> None:
    assert plain(label) == text


def test_nothing_of_a_label_becomes_part_of_the_page() -> None:
    hostile = '</script><script>alert("1")</script><b>&amp;'
    figure = Figure()
    axes = figure.subplots()
    axes.plot([0.0, 1.0], [0.0, 1.0], label=hostile)
    axes.set(xlabel=f"{hostile} $x$ (m)", ylabel=f"{hostile} (m)")
    axes.legend()
    picture = report._picture("8", figure, hostile, "")
    svg = lxml.html.fragment_fromstring(picture.svg)
    assert not list(svg.iter("script", "b")) and hostile in [text.text_content() for text in svg.iter("text")]
    assert "<" not in picture.readings
    assert json.loads(picture.readings)[0]["curves"][0]["name"] == hostile


def test_values_are_those_of_the_study(paper_figures: dict[str, Figure], paper_study: Study) -> None:
    accelerations, compression, _ = readings(paper_figures["8"])
    run = paper_study.runs["8"].dataset()
    assert accelerations["y"] == {"name": "Acceleration", "unit": "m/s²", "ends": (-8.0, 1.0), "log": False}
    assert [curve["name"] for curve in accelerations["curves"]] == ["car", "trailer", "steady (theory)"]
    assert accelerations["x"]["name"] == compression["x"]["name"] == "Time"
    np.testing.assert_allclose(accelerations["curves"][1]["y"], run["a_trailer"].values, rtol=6e-4, atol=1e-12)
    assert list(paper_figures) == ALL
    for name, figure in paper_figures.items():
        panels = readings(figure)
        assert panels and all(panel["x"]["name"] and panel["y"]["name"] for panel in panels), name
    names = {curve["name"] for name in ("4", "boundary") for curve in readings(paper_figures[name])[0]["curves"]}
    assert {"C_crit = 60 N·s/m", "case ii", "case ii, measured", "C = 400 N·s/m"} <= names


def browser() -> str | None:
    return next((found for name in ("chromium", "google-chrome") if (found := shutil.which(name))), None)


@pytest.mark.skipif(browser() is None, reason="neither chromium nor google-chrome is installed")
def test_the_pointer_reads_them(paper_figures: dict[str, Figure], paper_study: Study, tmp_path: Path) -> None:
    picture = report._picture("8", paper_figures["8"], "", "")
    left, top, width, height = readings(paper_figures["8"])[0]["box"]
    middle = f"svg.getScreenCTM(), new DOMPoint({left + width / 2}, {top + height / 2})"
    move = (
        "{ const svg = document.querySelector('svg'); const at = ((m, p) => p.matrixTransform(m))"
        f"({middle}); svg.dispatchEvent(new PointerEvent('pointermove', {{clientX: at.x, clientY: at.y}})); }}"
    )
    data = f'<script type="application/json">{picture.readings}</script>'
    scripts = f"<script>{report._part('readings.js')}</script><script>{move}</script>"
    (tmp_path / "page.html").write_text(f"<figure>{picture.svg}{data}</figure>{scripts}", encoding="utf-8")
    options = ["--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={tmp_path / 'profile'}", "--dump-dom"]
    done = subprocess.run(
        [browser() or "", *options, (tmp_path / "page.html").as_uri()],
        capture_output=True, text=True, encoding="utf-8", check=True, timeout=120,
    )  # fmt: skip
    told = [line.text_content() for line in lxml.html.fromstring(done.stdout).xpath("//output/div")]
    at = paper_study.runs["8"].dataset().sel(time=3.0, method="nearest")
    assert told[0] == "Time: 3 s" and told[1].startswith("car: ") and told[3].startswith("steady (theory): ")
    for line, name in zip(told[1:3], ("a_car", "a_trailer"), strict=True):
        value, unit = line.partition(": ")[2].replace("\N{MINUS SIGN}", "-").split()
        assert float(value) == pytest.approx(float(at[name]), rel=1e-3) and unit == "m/s²"


def luminance(colour: object) -> float:
    """Relative, as WCAG 2.1 has it."""
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in to_rgb(colour)]  # type: ignore[arg-type]
    return float(np.dot([0.2126, 0.7152, 0.0722], linear))


def contrast(one: object, other: object) -> float:
    high, low = sorted((luminance(one), luminance(other)), reverse=True)
    return (high + 0.05) / (low + 0.05)


def by_night(colour: object) -> tuple[float, ...]:
    """What page.css makes of it: invert(0.93) hue-rotate(180deg), by the matrix of the standard Filter Effects."""
    inverted = 0.93 - 0.86 * np.array(to_rgb(colour))  # type: ignore[arg-type]
    grey = np.array([0.213, 0.715, 0.072]) @ inverted
    return tuple(np.clip(2.0 * grey - inverted, 0.0, 1.0).tolist())


def seen(line: Line2D) -> object:
    """The colour by which a line or a mark is seen."""
    return line.get_color() if line.get_linestyle() != "None" else line.get_markeredgecolor()


def form(line: Line2D) -> tuple[object, ...]:
    """By what else it can be told."""
    return line._dash_pattern, line.get_linewidth(), line.get_marker(), line.get_markersize()  # type: ignore[attr-defined]


def test_curves_are_seen_by_day_and_by_night(paper_figures: dict[str, Figure]) -> None:
    assert contrast(by_night("#ffffff"), DARK) < 1.02  # the picture's white is the paper
    assert "invert(0.93) hue-rotate(180deg)" in report._part("page.css") and DARK in report._part("page.css")
    for name, figure in paper_figures.items():
        lines = [line for axes in figure.axes for line in axes.lines if not str(line.get_label()).startswith("_")]
        assert lines, name
        for line in lines:
            assert contrast(seen(line), "#ffffff") > APART, (name, line, seen(line))
            assert contrast(by_night(seen(line)), DARK) > APART, (name, line, seen(line))


def test_curves_are_told_apart_in_grey(paper_figures: dict[str, Figure]) -> None:
    for name, figure in paper_figures.items():
        for axes in figure.axes:
            lines = [line for line in axes.lines if not str(line.get_label()).startswith("_")]
            for one, other in itertools.combinations(lines, 2):
                if seen(one) != seen(other) and form(one) == form(other):
                    assert contrast(seen(one), seen(other)) > GREYS_APART, (name, one, other)
