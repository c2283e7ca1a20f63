"""Tables keep numbers on the right and whole, and become sentences where the terminal is narrow."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from overrun_hitch.show.table import Column, Numbers, coloured, console, number, show_rows, show_written, small, table

COLUMNS = (Column(), Column("unit"), Numbers("theory", "m", least=9), Numbers("allowed"), Column("verdict"))
ROWS = [("compression", "m", "0.02607", "2.4e-05", coloured("agrees")), ("A", "m/s2", "-2.6", "0", coloured("differs"))]


def test_numbers_stand_on_the_right(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setenv("COLUMNS", "100")
    show_rows(console(), COLUMNS, ROWS, [])
    assert capsys.readouterr().out.splitlines() == [
        "                      theory                  ",
        "             unit          m  allowed  verdict",
        "compression  m       0.02607  2.4e-05  agrees ",
        "A            m/s2       -2.6        0  differs",
    ]


def test_words_break_before_numbers_do(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setenv("COLUMNS", "40")
    console().print(table(COLUMNS, ROWS))
    out = capsys.readouterr().out
    assert "0.02607" in out and "2.4e-05" in out
    assert max(map(len, out.splitlines())) <= 40


@pytest.mark.parametrize(("width", "words"), [("77", ["one", "two"]), ("78", ["theory"])])
def test_a_narrow_terminal_gets_sentences(
    width: str, words: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("COLUMNS", width)
    show_rows(console(), COLUMNS, ROWS, ["one", "two"])
    out = capsys.readouterr().out
    assert out.split()[: len(words)] == words


def test_paths_stay_on_one_line_as_they_are(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("COLUMNS", "40")
    show_written(console(), [Path("build/[red]" + "x" * 60), Path("b.csv")])
    assert capsys.readouterr().out == f"wrote build/[red]{'x' * 60}\nwrote b.csv\n"


def test_numbers_and_differences() -> None:
    assert [number(1.0 / 3.0), number(-2.0, 2), number(math.nan), number(math.inf)] == ["0.33333", "-2.00", "-", "-"]
    assert [small(0.0), small(-1.24e-5), small(math.nan), small(-math.inf)] == ["0", "-1.2e-05", "-", "-"]
