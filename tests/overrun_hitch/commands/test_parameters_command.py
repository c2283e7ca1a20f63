"""`hitch parameters`: what is declared, whole, at every width of the terminal."""

from __future__ import annotations

import json

import pytest

from overrun_hitch import cli
from overrun_hitch.parameters import CASES, DATUM, Parameters


@pytest.mark.parametrize("case", [None, "ix"])
def test_the_document_has_what_is_declared(case: str | None, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["parameters", "--json", *(["--case", case] if case else [])]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["case"] == case
    assert list(found["parameters"]) == list(Parameters.model_fields)
    values = CASES[case] if case else DATUM
    for name, about in found["parameters"].items():
        assert (about["default"], about["value"]) == (getattr(DATUM, name), getattr(values, name))
        assert (about["least"], about["most"]) == Parameters.limits(name)
        assert (about["unit"], about["meaning"]) == (Parameters.unit(name), Parameters.description(name))
        assert about["source"] or name == "compression_start"


@pytest.mark.parametrize("columns", [60, 80, 120, 200])
def test_a_terminal_shows_all_of_it(
    columns: int, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", str(columns))
    assert cli.main(["parameters", "--case", "iii"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= columns
    first = [line.split()[0].removesuffix(":") for line in lines if line[:1].strip()]
    assert [name for name in first if name in Parameters.model_fields] == list(Parameters.model_fields)
    assert " ".join(lines).count("17488.8") >= 2  # case iii's r, the greatest of all cases


def test_a_case_that_is_none(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["parameters", "--case", "xi"]) == 2
    assert "there is no case 'xi'" in capsys.readouterr().err
