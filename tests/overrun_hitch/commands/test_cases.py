"""`hitch cases` against the paper's table, and that each step brake shown is what its figure runs."""

from __future__ import annotations

import json

import pytest

from overrun_hitch import cli
from overrun_hitch.parameters import CASES, FIGURES

# Section 8.1: A/A_c of cases i to iii, and 0.95 for the rest.
RATIOS = {"i": 0.90, "ii": 0.95, "iii": 0.98}


def test_what_the_paper_has(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["cases", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    for name, case in CASES.items():
        assert found["cases"][name]["A_over_A_c"] == pytest.approx(RATIOS.get(name, 0.95), abs=0.0006)
        assert found["cases"][name]["parameters"] == case.model_dump()
    assert {name: each["parameters"] for name, each in found["figures"].items()} == {
        name: each.parameters.model_dump() for name, each in FIGURES.items()
    }


def test_the_tables(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["cases"]) == 0
    lines = capsys.readouterr().out.splitlines()
    row = next(line.split() for line in lines if line.startswith("ii "))
    assert row == ["ii", "5480", "2.975", "0.950", "30.2", "120.7"]
    assert next(line.split() for line in lines if line.startswith("10 ")) == ["10", "548000", "500", "0.1"]
    assert next(line for line in lines if line.startswith("ix ")).rstrip().endswith("R_t = 0.28 m")


@pytest.mark.parametrize("command", ["run", "stability", "cases"])
def test_the_short_option_for_help(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main([command, "-h"]) == 0
    assert capsys.readouterr().out.startswith(f"Usage: hitch {command}")
