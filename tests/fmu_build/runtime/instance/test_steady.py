"""What follows from parameters and inputs alone is computed where these are set: wherever and however they are."""

from __future__ import annotations

from collections.abc import Callable
from math import atan, sqrt
from random import Random

import numpy as np
import pytest

from tests.fmu_build.runtime.generated_models import GeneratedModel, generate
from tests.fmu_build.runtime.runtime_unit import OK, Unit

# Of p alone, of u, of v, which no quotient depends on, and of a variable on the way to one of them.
STEADY = """model Steady
  parameter Real p(unit="1") = 2;
  parameter Real g(unit="1") = p*p;
  input Real u(unit="1", start=0.5);
  input Real v(unit="1", start=0.3);
  Real k(unit="1") = p/(1 + u*u);
  Real x(unit="1", start=0, fixed=true);
  Real w(unit="1", start=1, fixed=true);
  output Real y(unit="1");
  output Real z(unit="1");
equation
  der(x) = k*sqrt(1 + g)/(2 + u);
  der(w) = v - w*k/(1 + u);
  y = x/(3 + u) + v*k + (if x > 0.5 then 1/(p + 1) else 0);
  z = u/(1 + p);
end Steady;
"""


@pytest.fixture(scope="module")
def steady(tmp_path_factory: pytest.TempPathFactory) -> GeneratedModel:
    path = tmp_path_factory.mktemp("modelica") / "Steady.mo"
    path.write_text(STEADY, encoding="utf-8")
    return generate(path, "Steady")


def check(unit: Unit) -> None:
    p, u, v, x, w = unit.get("p", "u", "v", "x", "w")
    k = p / (1 + u * u)
    y = x / (3 + u) + v * k + (1 / (p + 1) if x > 0.5 else 0.0)
    expected = [k, k * sqrt(1 + p * p) / (2 + u), v - w * k / (1 + u), y, u / (1 + p)]
    np.testing.assert_allclose(unit.get("k", "der(x)", "der(w)", "y", "z"), expected, rtol=1e-14)


def test_it_is_kept_of_what_takes_long(steady: GeneratedModel) -> None:
    """And of nothing that v would change."""
    text = steady.sources["model.c"]
    assert "moves_steady[AT_LEAST_ONE(N_INPUTS)] = {true, false};" in text
    derivatives = text.partition("void model_derivatives")[2].partition("\n}\n")[0]
    assert "m_der_w = " in derivatives and "/(" not in derivatives


@pytest.mark.parametrize("exchange", [False, True])
def test_it_follows_what_is_set(unit: Callable[..., Unit], steady: GeneratedModel, exchange: bool) -> None:
    """In any order, between steps or in event mode, with slopes, and behind a state that is restored."""
    random = Random(1)
    unit_ = unit(steady, exchange=exchange)
    assert unit_.set(p=3.0) == OK and unit_.setup() == OK and unit_.initialize() == OK
    saved = [unit_.save()]
    for _ in range(300):
        name = random.choice("uv" if exchange else "puv")
        assert unit_.set(**{name: random.uniform(0.1, 3.0)}) == OK
        if random.random() < 0.5:
            check(unit_)
        if random.random() < 0.2:
            saved.append(unit_.save())
        if random.random() < 0.2:
            assert unit_.restore(random.choice(saved)) == OK
            check(unit_)
            unit_.time = unit_.get("time")[0]
        if not exchange:
            if random.random() < 0.3:
                assert unit_.slopes(u=random.uniform(-1.0, 1.0)) == OK
            assert unit_.step(0.01) == OK
        check(unit_)
    for snapshot in saved:
        unit_.drop(snapshot)


def test_it_follows_an_input_that_moves(unit: Callable[..., Unit], steady: GeneratedModel) -> None:
    """The integral of 1/((1 + u^2)(2 + u)) in closed form: u goes from 0.5 to 1.5."""
    unit_ = unit(steady)
    assert unit_.setup(1e-10) == OK and unit_.initialize() == OK and unit_.slopes(u=1.0) == OK
    assert unit_.step(1.0) == OK

    def integral(u: float) -> float:
        return 0.2 * np.log(2 + u) - 0.1 * np.log(1 + u * u) + 0.4 * atan(u)

    expected = 2.0 * sqrt(5.0) * (integral(1.5) - integral(0.5))
    assert unit_.get("u", "x") == pytest.approx([1.5, expected], rel=1e-9)
