"""The report: one page, complete in itself, whose verdicts and sentences follow the numbers."""

from __future__ import annotations

import dataclasses
import math
import re
import shutil
import subprocess
from base64 import b64encode
from collections.abc import Callable, Iterator
from hashlib import sha256
from html.parser import HTMLParser
from pathlib import Path

import lxml.html
import numpy as np
import pytest
from matplotlib.figure import Figure

from overrun_hitch import cli
from overrun_hitch.experiments.limit_cycle import NOTHING, Sustained
from overrun_hitch.paper.claims.all import all_claims
from overrun_hitch.paper.report import page as report
from overrun_hitch.paper.report.lessons import lessons
from overrun_hitch.paper.report.page import COMMAND, number, typeset
from overrun_hitch.paper.report.svg import inline
from overrun_hitch.paper.study import jacobian
from overrun_hitch.paper.study import study as study_module
from overrun_hitch.paper.study.study import Study

VOID = {"meta", "link", "br", "hr", "img", "input", "col"}
NOT_HERE = {"iframe", "object", "embed", "img", "form"}
PICTURES = ["figure-3", "figure-4", "figure-5", "figure-6a", "figure-6b", *(f"figure-{n}" for n in range(7, 12))]


class Page(HTMLParser):
    """What a page is made of; complains about tags that are not closed in order."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str]]] = []
        self.texts: dict[str, str] = {}  # of elements with an id, by id
        self._open: list[tuple[str, str | None]] = []
        self.feed(text)
        self.close()
        assert self._open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        attributes = {name: value or "" for name, value in attrs}
        self.tags.append((tag, attributes))
        if tag not in VOID:
            self._open.append((tag, attributes.get("id")))

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, {name: value or "" for name, value in attrs}))

    def handle_endtag(self, tag: str) -> None:
        assert self._open.pop()[0] == tag

    def handle_data(self, data: str) -> None:
        for _, name in self._open:
            if name:
                self.texts[name] = self.texts.get(name, "") + data

    def all(self, attribute: str) -> list[str]:
        return [attributes[attribute] for _, attributes in self.tags if attribute in attributes]


@pytest.fixture(scope="module")
def drawn_once(paper_figures: dict[str, Figure]) -> Iterator[None]:
    """Reports get the figures of the study, and each is rendered once."""
    drawn: dict[str, str] = {}

    def once(figure: Figure, prefix: str, label: str) -> str:
        if prefix not in drawn:
            drawn[prefix] = inline(figure, prefix, label)
        return drawn[prefix]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(report, "figures", lambda *_: paper_figures)
        patch.setattr(report, "inline", once)
        yield


@pytest.fixture(scope="module")
def made(paper_study: Study, drawn_once: None) -> Callable[..., report.Report]:
    """The report of a study."""
    return lambda study=paper_study: report.report_of(study, COMMAND)


@pytest.fixture(scope="module")
def text(made: Callable[..., report.Report]) -> str:
    return report.page(made())


@pytest.fixture(scope="module")
def page(text: str) -> Page:
    return Page(text)


def changed(study: Study, **motions: object) -> Study:
    """The study with something else in every motion of its FMU."""
    wrong = tuple(dataclasses.replace(m, fmu=dataclasses.replace(m.fmu, **motions)) for m in study.motions)
    return dataclasses.replace(study, motions=wrong)


def test_nothing_is_loaded(text: str, page: Page) -> None:
    assert not {tag for tag, _ in page.tags} & NOT_HERE
    for tag, attributes in page.tags:
        assert "src" not in attributes
        for name in ("href", "xlink:href"):
            target = attributes.get(name, "#")
            assert target.startswith("#") or (tag == "a") or target == "data:,", (tag, target)
    (allowed,) = re.findall(r"script-src 'sha256-([^']+)'", text)
    (script,) = re.findall(r"<script>(.*?)</script>", text, re.DOTALL)  # others are data
    assert allowed == b64encode(sha256(script.encode()).digest()).decode() and "default-src 'none'" in text
    assert "@import" not in text and not re.search(r"url\((?!#)", text)
    assert text.startswith("<!DOCTYPE html>\n<html lang=")
    assert ("meta", {"name": "viewport", "content": "width=device-width, initial-scale=1"}) in page.tags


def test_ids_are_unique_and_lead_somewhere(text: str, page: Page) -> None:
    ids = page.all("id")
    assert len(ids) == len(set(ids)) > 1000
    inner = [target[1:] for target in page.all("href") + page.all("xlink:href") if target.startswith("#")]
    assert set(inner) | set(re.findall(r"url\(#([^)]+)\)", text)) <= set(ids)


def test_every_figure_is_there_with_words(page: Page) -> None:
    figures = [attributes["id"] for tag, attributes in page.tags if tag == "figure"]
    assert figures == [*PICTURES, "boundary", "cycles", "device", "stops"]
    drawn = [attributes for tag, attributes in page.tags if tag == "svg"]
    assert len(drawn) == len(figures)
    for name, attributes in zip(figures, drawn, strict=True):
        assert attributes["role"] == "img" and attributes["aria-label"]
        assert "viewbox" in attributes and "width" not in attributes
        assert len(page.texts[name].strip()) > 50


def test_every_claim_with_its_verdict(page: Page, paper_study: Study) -> None:
    for claim in all_claims(paper_study):
        words = " ".join(page.texts[f"claim-{claim.number}"].split())
        assert f"Claim {claim.number}: {claim.verdict}" in words
        for part in claim.parts:
            assert part.criterion.words in words
            for value in (part.theory, part.fmu):
                assert str(number(value, 5, True).striptags()) in words
            assert words.count(f"({typeset(part.unit).striptags()})") > 0


def test_tables_are_folded_under_what_they_bear_out(text: str, paper_study: Study) -> None:
    document = lxml.html.fromstring(text)
    for section in ("claims", "boundary-of-self-excitation", "limit-cycles", "lag", "standstill"):
        tables = document.xpath(f"//*[@id='{section}']//table")
        assert tables and [table for table in tables if not table.xpath("ancestor::details[not(@open)]")] == []
    assert len(document.xpath("//*[@id='claims']//details")) == len(all_claims(paper_study))


def test_numbers_have_units(text: str) -> None:
    """Every column of numbers names its unit, or its rows do."""
    tables = re.findall(r"<table.*?</table>", text, re.DOTALL)
    assert len(tables) > 15
    for table in tables:
        heads = re.findall(r"<thead>.*?</thead>", table, re.DOTALL)[0]
        columns = [re.sub(r"<.*?>", "", head) for head in re.findall(r"<th .*?</th>", heads)]
        rows = re.findall(r'<th scope="row">(.*?)</th>', table)
        rows_bear_units = bool(rows) and all(row.endswith(")</span>") or row.endswith(")") for row in rows)
        for number_column in re.findall(r'<th [^>]*class="number"[^>]*>(.*?)</th>', heads):
            assert "(" in number_column or rows_bear_units, columns


def test_the_summary_and_the_matrices(page: Page, paper_study: Study) -> None:
    summary = page.texts["summary"]
    assert "13 of 13 claims of the paper hold" in summary
    assert "9 of 9 points" in summary and "does not hold" not in summary
    words = " ".join(page.texts["jacobian"].split())
    for value in (-20.5, 6521.2, -489.8685):
        assert str(number(value, 7)) in words
    assert "shunting" in words and "rigid body (double zero)" in words
    assert paper_study.guid in page.texts["made"] and "fmpy" in page.texts["made"]
    assert "make report" in page.texts["made"]


def test_the_envelopes_of_stops(page: Page, paper_study: Study) -> None:
    summary, words = (" ".join(page.texts[name].split()) for name in ("summary", "standstill"))
    assert "in 4 stops, as far as theory applies, no amplitude differs by more than 0.16 %" in summary
    *to_the_end, leaves = paper_study.stops
    assert all(found.lowest_speed < 0.55 for found in to_the_end) and 20.0 < leaves.lowest_speed < 35.0
    for found in paper_study.stops:
        assert found.agrees
        assert found.turning_on_fmu == pytest.approx(found.turning, rel=0.02)
        assert str(number(1000.0 * found.in_theory.predicted[-1], 4, True)) in words


def test_slip_explains_what_differs_while_braking(paper_study: Study) -> None:
    entries = jacobian.differing_entries(paper_study.at_braking)
    assert {(entry.rate, entry.state) for entry in entries if entry.relative > 1e-4} == {
        ("v_c", "v_c"), ("omega_c", "v_c"), ("v_t", "v_t"), ("omega_t", "v_t"),
    }  # fmt: skip
    assert max(entry.relative for entry in entries) == pytest.approx(paper_study.at_braking.slip_car, rel=1e-3)
    assert max(entry.left for entry in entries) < 1e-4
    assert all(entry.left < 1e-12 for entry in entries if entry.state == "v_c")
    assert jacobian.differing_entries(paper_study.at_zero_slip["ii"]) == []


def test_eigenvalues_by_name(paper_study: Study) -> None:
    for found in (*paper_study.at_zero_slip.values(), paper_study.at_braking):
        modes = [row.mode for row in jacobian.eigenvalues(found)]
        assert modes == ["wheel slip", "wheel slip", "shunting", "rigid body (double zero)"]
    rows = jacobian.eigenvalues(paper_study.at_zero_slip["ii"])
    assert all(row.difference < 1e-9 for row in rows[:3])


def test_every_sentence_for_a_designer_is_borne_out(paper_study: Study, page: Page) -> None:
    found = lessons(paper_study, all_claims(paper_study))
    assert len(found) == 10 and all(lesson.holds for lesson in found)
    assert all(lesson.heading in page.texts["designer"] for lesson in found)
    for reach in ("What the paper says", "What a lag changes", "What friction hides"):
        assert reach in " ".join(page.texts["designer"].split())
    assert "bear this out" not in page.texts["designer"] and "nan" not in page.texts["designer"]


@pytest.mark.parametrize(
    "fmu",
    [
        Sustained("fades", *NOTHING),
        pytest.param(Sustained("runs away", *NOTHING), marks=pytest.mark.full),
        Sustained("sustained", 0.02, 2.0, 0.0, 0.5),
        Sustained("unsettled", 0.5, 1.0, 0.1, -0.1),
    ],
)
def test_sentences_that_are_not_are_marked(
    paper_study: Study, made: Callable[..., report.Report], fmu: Sustained
) -> None:
    wrong = changed(paper_study, **dataclasses.asdict(fmu))
    found = lessons(wrong, all_claims(wrong))
    assert sum(not lesson.holds for lesson in found) >= 3
    assert "The numbers of this study do not bear this out." in report.page(made(wrong))


@pytest.mark.usefixtures("drawn_once")
def test_a_claim_that_does_not_hold(paper_study: Study, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    off = dataclasses.replace(paper_study.steady_fmu["ii"], ratio=0.9)
    wrong = dataclasses.replace(paper_study, steady_fmu={**paper_study.steady_fmu, "ii": off})
    monkeypatch.setattr(study_module, "study", lambda *_: wrong)
    assert cli.main(["report", "--fmu", "any.fmu", "--output", str(tmp_path)]) == 1
    page = Page((tmp_path / "index.html").read_text("utf-8"))
    assert "does not hold: 12 of 13 claims" in " ".join(page.texts["summary"].split())
    assert "Claim 1: does not hold on the FMU" in page.texts["claim-1"]
    assert "0.90000 fails" in page.texts["claim-1"]
    document = lxml.html.fromstring((tmp_path / "index.html").read_text("utf-8"))
    unfolded = document.xpath("//details[@open]/ancestor::section[1]/@id")
    assert unfolded == ["claim-1"]
    assert "does not hold" not in page.texts["claim-2"]


@pytest.mark.full
def test_each_finding_can_fail(paper_study: Study, made: Callable[..., report.Report]) -> None:
    engaged = dict(paper_study.at_zero_slip)
    matrix = engaged["iv"].fmu * (1.0 + 1e-8 * np.eye(6))
    engaged["iv"] = dataclasses.replace(engaged["iv"], fmu=matrix)
    check = dataclasses.replace(paper_study.boundary.checks[0], growth_above=1.0)
    boundary = dataclasses.replace(paper_study.boundary, checks=(check, *paper_study.boundary.checks[1:]))
    cycles = changed(paper_study, verdict="fades").motions
    first, *others = paper_study.stops
    envelope = dataclasses.replace(first.in_theory, amplitude=1.004 * first.in_theory.amplitude)
    stops = (dataclasses.replace(first, in_theory=envelope), *others)
    lagging = dataclasses.replace(paper_study.device.checks[0], growth_above=1.0)
    device = dataclasses.replace(paper_study.device, checks=(lagging, *paper_study.device.checks[1:]))
    changes = (
        {"at_zero_slip": engaged}, {"boundary": boundary}, {"device": device}, {"motions": cycles}, {"stops": stops},
    )  # fmt: skip
    for place, change in enumerate(changes, start=1):
        found = made(dataclasses.replace(paper_study, **change))
        assert [finding.holds for finding in found.findings] == [n != place for n in range(6)]
        assert not found.holds and "does not hold" in Page(report.page(found)).texts["summary"]


def test_the_command_writes_the_page(
    paper_study: Study,
    text: str,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(study_module, "study", lambda *_: paper_study)
    assert cli.main(["report", "--fmu", "my unit.fmu", "--output", str(tmp_path / "out")]) == 0
    written = (tmp_path / "out" / "index.html").read_text("utf-8")
    assert list((tmp_path / "out").iterdir()) == [tmp_path / "out" / "index.html"]
    assert "hitch report --fmu &#39;my unit.fmu&#39; --output" in written
    assert len(written) == pytest.approx(len(text), rel=0.01)
    out = " ".join(capsys.readouterr().out.split())
    assert out.count("holds:") == 6 and "index.html" in out


def test_interrupted(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(study_module, "study", interrupt)
    assert cli.main(["report", "--fmu", "any.fmu", "--output", str(tmp_path / "out")]) == 130
    assert not (tmp_path / "out").exists()


def test_bad_fmu(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["report", "--fmu", str(tmp_path / "none.fmu"), "--output", str(tmp_path / "out")]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_numbers_as_they_are_printed() -> None:
    assert str(number(math.nan)) == "&ndash;"
    assert str(number(-0.0)) == "0"
    assert str(number(-1.5)) == "\N{MINUS SIGN}1.5"
    assert str(number(2.0, 3, True)) == "2.00"
    assert str(number(12345.0, 5, True)) == "12345"
    assert str(number(-1.25e-7, 3)) == "\N{MINUS SIGN}1.25&nbsp;&middot;&nbsp;10<sup>\N{MINUS SIGN}7</sup>"
    assert str(number(2e12, 2)) == "2&nbsp;&middot;&nbsp;10<sup>12</sup>"


def test_text_is_escaped_and_typeset() -> None:
    assert str(typeset("a < b & C_crit in N.s/m")) == "a &lt; b &amp; C<sub>crit</sub> in N\N{MIDDLE DOT}s/m"
    assert "x<sub>t</sub>" in typeset("|x_t / x_c|") and "a_car" in typeset("a_car")
    assert str(typeset("2.0e-16 of it")).startswith("2.0\N{NO-BREAK SPACE}")


def test_two_figures_share_no_id(paper_figures: dict[str, Figure]) -> None:
    figure = paper_figures["3"]
    first, second = (set(re.findall(r'id="([^"]+)"', inline(figure, f"{n}-", "a figure"))) for n in "ab")
    assert first and not first & second


def browser() -> str | None:
    return next((found for name in ("chromium", "google-chrome") if (found := shutil.which(name))), None)


@pytest.mark.skipif(browser() is None, reason="neither chromium nor google-chrome is installed")
def test_a_browser_opens_it_without_complaint(text: str, tmp_path: Path) -> None:
    (tmp_path / "index.html").write_text(text, encoding="utf-8")
    options = (
        "--headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking "
        "--disable-component-update --disable-sync --virtual-time-budget=5000 --enable-logging=stderr --v=0 --dump-dom"
    )
    done = subprocess.run(
        [browser() or "", *options.split(), f"--user-data-dir={tmp_path / 'profile'}", f"file://{tmp_path}/index.html"],
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    assert "CONSOLE" not in done.stderr
    page = Page(done.stdout.partition("\n")[2] if done.stdout.startswith("\n") else done.stdout)
    drawn = [attributes for tag, attributes in page.tags if tag == "svg"]
    assert len(drawn) == len(PICTURES) + 4  # beyond the paper: boundary, cycles, stops, device
    assert sum(tag == "path" for tag, _ in page.tags) > 500 and sum(tag == "text" for tag, _ in page.tags) > 400
    assert "13 of 13 claims" in page.texts["summary"]
