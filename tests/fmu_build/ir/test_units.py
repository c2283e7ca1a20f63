from __future__ import annotations

from collections import Counter

import pytest

from fmu_build.ir.units import base_unit, conversion, per_second


@pytest.mark.parametrize(
    ("unit", "exponents", "factor"),
    [
        ("1", {}, 1.0),
        ("kg.m2", {"kg": 1, "m": 2}, 1.0),
        ("N.s/m", {"kg": 1, "s": -1}, 1.0),
        ("N.m/m", {"kg": 1, "m": 1, "s": -2}, 1.0),
        ("rad/s", {"s": -1, "rad": 1}, 1.0),
        ("km/h", {"m": 1, "s": -1}, 1000.0 / 3600.0),
        ("J/(kg.K)", {"m": 2, "s": -2, "K": -1}, 1.0),
        ("mm", {"m": 1}, 1e-3),
        ("s-1", {"s": -1}, 1.0),
    ],
)
def test_base_units(unit: str, exponents: dict[str, int], factor: float) -> None:
    base = base_unit(unit)
    assert base is not None
    assert dict(base.exponents) == exponents
    assert base.factor == pytest.approx(factor, rel=1e-15)


def test_an_unknown_symbol_has_no_base_unit() -> None:
    assert base_unit("furlong/s") is None


@pytest.mark.parametrize(
    ("unit", "rate"),
    [("m", "m/s"), ("m/s", "m/s2"), ("rad/s", "rad/s2"), ("1", "1/s"), ("N.s", "N"), ("kg/m", "kg/(m.s)"), ("", "")],
)
def test_the_unit_of_a_derivative(unit: str, rate: str) -> None:
    assert per_second(unit) == rate


@pytest.mark.parametrize("unit", ["m", "N.m", "N.s/m", "W/(m2.K)", "1"])
def test_the_unit_of_a_derivative_has_one_second_less(unit: str) -> None:
    before, after = base_unit(unit), base_unit(per_second(unit))
    assert before is not None and after is not None
    difference = Counter(dict(after.exponents))
    difference.subtract(dict(before.exponents))
    assert {name: power for name, power in difference.items() if power} == {"s": -1}


@pytest.mark.parametrize(
    ("unit", "shown", "value", "expected"),
    [
        ("m/s", "km/h", 25.0, 90.0),
        ("rad", "deg", 3.141592653589793, 180.0),
        ("K", "degC", 300.0, 26.85),
        ("m", "mm", 0.1, 100.0),
        ("degC", "K", 0.0, 273.15),
        ("1", "1", 0.5, 0.5),
    ],
)
def test_conversion_for_display(unit: str, shown: str, value: float, expected: float) -> None:
    found = conversion(unit, shown)
    assert found is not None
    factor, offset = found
    assert factor * value + offset == pytest.approx(expected, rel=1e-14)


def test_what_does_not_convert() -> None:
    assert conversion("m", "km/h") is None and conversion("m", "furlong") is None
    assert conversion("m/s", "km/h") == (3.6, 0.0)
