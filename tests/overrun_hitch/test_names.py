"""What is named wrongly is answered by what was meant, whatever table the name belongs to."""

from __future__ import annotations

import re
from collections.abc import Iterable

import pytest

from overrun_hitch.measure.metrics import METRICS
from overrun_hitch.parameters import CASES, FIGURES, HitchError, Parameters, named, unknown, with_unit
from overrun_hitch.results import VARIABLES

TABLES: list[Iterable[str]] = [Parameters.model_fields, CASES, FIGURES, METRICS, VARIABLES]


@pytest.mark.parametrize("table", TABLES, ids=["parameters", "cases", "figures", "metrics", "variables"])
def test_case_and_signs_do_not_matter_to_the_suggestion(table: Iterable[str]) -> None:
    names = list(table)
    for name in names:
        for wrong in {name.swapcase(), name.upper(), f" {name}", name.replace("_", ""), name.replace("_", "-")} - {
            *names
        }:
            meant = [other for other in names if other.replace("_", "").casefold() == name.replace("_", "").casefold()]
            with pytest.raises(HitchError) as caught:
                named("thing", wrong, dict.fromkeys(names))
            listed = ", ".join(names)
            expected = f"there is no thing {wrong!r}; did you mean {' or '.join(meant)}? allowed: {listed}"
            assert str(caught.value) == expected


def test_slips_of_the_pen() -> None:
    for wrong, meant in [("rebond", "rebound"), ("compresion_start", "compression_start"), ("sigmma", "sigma")]:
        assert f"did you mean {meant}? allowed: M_c, " in unknown("parameter", wrong, Parameters.model_fields)
    assert "did you mean 6a or 6b? allowed" in unknown("figure", "6", FIGURES)
    assert unknown("case", "figure 8", CASES) == f"there is no case 'figure 8'; allowed: {', '.join(CASES)}"


def test_the_unit_1_is_not_said() -> None:
    for name in [name for name in Parameters.model_fields if Parameters.unit(name) == "1"]:
        with pytest.raises(HitchError) as caught:
            Parameters(**{name: -2.0})
        assert str(caught.value).startswith(f"{name} = -2 is not allowed: ")
        assert not re.search(r"\d 1\b", str(caught.value))
    assert [with_unit(2.0, unit) for unit in ("1", "", "m", "1/s")] == ["2", "2", "2 m", "2 1/s"]
