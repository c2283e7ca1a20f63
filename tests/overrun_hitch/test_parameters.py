"""Parameters: values from the paper, and one line that helps for each wrong value."""

from __future__ import annotations

import math
from typing import get_args

import pytest
from hypothesis import given
from hypothesis import strategies as st

from overrun_hitch.parameters import (
    CASES,
    DATUM,
    FIGURES,
    HitchError,
    InTheory,
    Owner,
    Parameters,
    Scenario,
    named,
    quantity,
)


def test_defaults_are_figure_8() -> None:
    assert Parameters() == DATUM == FIGURES["8"].parameters
    assert FIGURES["8"].brake_torque == 1000.0
    assert FIGURES["8"].duration == 6.0


def test_figures_differ_as_in_the_paper() -> None:
    differing = {name: (s.parameters.C, s.parameters.k_t, s.parameters.eps) for name, s in FIGURES.items()}
    assert differing == {
        "6a": (20.0, 548e3, 0.0),
        "6b": (20.0, 5480.0, 0.0),
        "7": (100.0, 548e3, 0.0),
        "8": (500.0, 548e3, 0.0),
        "9": (100.0, 548e3, 0.1),
        "10": (500.0, 548e3, 0.1),
        "11": (2500.0, 548e3, 0.1),
    }


def test_cases_change_one_datum_to_80_percent() -> None:
    drawbar = {"k", "r"}
    reduced = {"iv": "C_kt", "v": "I_c", "vi": "I_t", "vii": "M_c", "viii": "M_t", "ix": "R_t"}
    for name, case in CASES.items():
        changed = {n: v for n, v in case.model_dump().items() if v != getattr(DATUM, n) and n not in drawbar}
        expected = {reduced[name]: 0.8 * getattr(DATUM, reduced[name])} if name in reduced else {}
        assert changed == pytest.approx(expected)


@pytest.mark.parametrize("name", Parameters.model_fields)
def test_every_parameter_has_unit_meaning_and_range(name: str) -> None:
    assert Parameters.unit(name)
    assert Parameters.description(name)[0].islower()
    assert Parameters.allowed(name).startswith("a finite number")


def test_every_parameter_says_whose_it_is_and_what_theory_makes_of_it() -> None:
    for role, allowed in (("of", get_args(Owner)), ("theory", get_args(InTheory))):
        parts = [Parameters.having(role, value) for value in allowed]
        assert sorted(name for part in parts for name in part) == sorted(Parameters.model_fields)
        assert all(parts)
    assert Parameters.having("of", *get_args(Owner)) == tuple(Parameters.model_fields)


def test_what_theory_takes_is_not_what_it_does_not_know() -> None:
    assert {"M_t", "C", "r", "eps", "sigma", "k_2"} <= set(Parameters.having("theory", "exact"))
    assert {"CdA_c", "C_rr"} <= set(Parameters.having("theory", "neutral"))
    odd = DATUM.changed({"CdA_c": 0.7, "rebound": 3.0, "M_t": 400.0})
    assert odd.off_default("neutral", "approximate") == ("rebound", "CdA_c")
    assert odd.at_default("neutral") == odd.changed({"CdA_c": 0.0})


def test_the_stiffness_is_k_up_to_x_2_whatever_x_3() -> None:
    """An x_3 below x_2 counts as x_2."""
    assert DATUM.changed({"x_2": 0.05, "x_3": 0.01, "eps": 0.1}).linear_until == pytest.approx(0.15)
    assert DATUM.changed({"x_3": 0.01, "travel": 0.2}).linear_until == 0.2


@given(st.sampled_from(sorted(Parameters.model_fields)), st.floats())
def test_a_wrong_value_costs_one_line_that_names_it(name: str, value: float) -> None:
    try:
        changed = DATUM.changed({name: value})
    except HitchError as error:
        message = str(error)
        assert "\n" not in message
        assert message.startswith(f"{name} = ")
        assert Parameters.allowed(name) in message
    else:
        assert math.isfinite(value)
        assert getattr(changed, name) == value


@pytest.mark.parametrize(
    ("name", "value"),
    [("M_c", 0.0), ("I_t", -1.0), ("R_c", 0.0), ("mu", 0.0), ("eps", -0.1), ("k", -1.0), ("C", -1.0), ("k", math.nan),
     ("V_0", math.nan), ("compression_start", math.inf), ("M_c", "heavy"), ("M_c", None)],
)  # fmt: skip
def test_values_that_the_fmu_refuses_are_refused(name: str, value: object) -> None:
    with pytest.raises(HitchError, match=f"^{name} = .* is not allowed: .* must be a finite number"):
        DATUM.changed({name: value})


def test_unknown_names_list_the_closest_first() -> None:
    with pytest.raises(HitchError, match=r"^there is no parameter 'M_x'; allowed: M_[ct], M_[ct], .*compression_start"):
        DATUM.changed({"M_x": 1.0})
    with pytest.raises(HitchError, match=r"^there is no case 'xi'; .*allowed: i, ii, "):
        named("case", "xi", CASES)
    with pytest.raises(HitchError, match=r"^there is no figure '6'; allowed: 6a|6b"):
        named("figure", "6", FIGURES)


def test_scenarios_are_checked_too() -> None:
    with pytest.raises(HitchError, match=r"^duration = 0 s is not allowed: .* greater than 0 s"):
        FIGURES["8"].changed(duration=0.0)
    with pytest.raises(HitchError, match=r"^brake_torque = -1 N.m is not allowed: .* at least 0 N.m"):
        FIGURES["8"].changed(brake_torque=-1.0)
    with pytest.raises(HitchError, match=r"^parameters is missing"):
        Scenario(name="nothing")


def test_quantity_declares_what_messages_need() -> None:
    field = quantity(1.0, "kg", "mass", "car", "exact", "1 to 2", "a scale", ge=1.0)
    assert field.json_schema_extra == {
        "unit": "kg", "of": "car", "theory": "exact", "typical": "1 to 2", "source": "a scale"
    }  # fmt: skip
    assert field.description == "mass"
