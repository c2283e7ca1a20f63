"""The judgement of how building grows, and that the smallest models of each family are models."""

from __future__ import annotations

from pathlib import Path

import pytest

from benchmarks.building import FAMILIES, LIBRARIES, Family, growth
from fmu_build.pipeline import show


@pytest.mark.parametrize("power", [0.5, 1.0, 2.0])
def test_growth_is_the_exponent(power: float) -> None:
    family = Family("", str, (1, 2, 6), {})
    rows = [{"slow": 3.0 * n**power, "quick": 0.01 * n**2} for n in family.sizes]
    assert growth(family, rows) == {"slow": pytest.approx(power)}


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.title)
def test_models_are_sorted(family: Family, tmp_path: Path) -> None:
    path = tmp_path / "M.mo"
    path.write_text(family.text(3), encoding="utf-8")
    sorted_ = show(path, "M", "sorted", [LIBRARIES])
    assert sorted_.count("der(") >= 3
