"""abs, min and max with an event and, within noEvent, without; conditions within noEvent."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from tests.fmu_build.conftest import CompiledModel

MODEL = """
model M
  parameter Real p(unit="1") = -1.5;
  Real x(unit="1", start={at_start}, fixed=true);
  Real y(unit="1", start=0.3, fixed=true);
  Real kinks(unit="1");
  Real choice(unit="1");
equation
  kinks = {opened}abs(x - y)^3 + min(x, 2*y)*max(x*y, p) + smooth(0, abs(y)){closed};
  choice = {opened}if x > 0.5 and y >= 0.25 then x^2 elseif not (x < -0.5 or abs(y) > 1) then x*y else y^3{closed};
  der(x) = kinks;
  der(y) = choice*x;
end M;
"""
POINTS = [(x, y) for x in (-0.9, -0.3, 0.2, 0.9) for y in (-1.4, -0.5, 0.13, 0.8)]


def model_text(event_free: bool) -> str:
    opened, closed = ("noEvent(", ")") if event_free else ("", "")
    start = "noEvent(if p < 0 then abs(p) else 7)" if event_free else "1.5"
    return MODEL.format(opened=opened, closed=closed, at_start=start)


def expected(x: float, y: float, p: float) -> tuple[float, float]:
    kinks = abs(x - y) ** 3 + min(x, 2 * y) * max(x * y, p) + abs(y)
    choice = x**2 if x > 0.5 and y >= 0.25 else x * y if not (x < -0.5 or abs(y) > 1) else y**3
    return kinks, choice * x


@pytest.fixture(params=[True, False], ids=["noEvent", "events"])
def model(request: pytest.FixtureRequest, compiled_model: Callable[[str], CompiledModel]) -> CompiledModel:
    return compiled_model(model_text(request.param))


def test_only_conditions_outside_of_no_event_are_relations(
    model: CompiledModel, request: pytest.FixtureRequest
) -> None:
    texts = [r.text for r in model.model.relations]
    if "noEvent" in request.node.name:
        assert texts == []
    else:  # abs(y) stands twice
        assert texts == [
            *("abs(x - y)", "min(x, 2*y)", "max(x*y, p)", "abs(y)"),
            *("x > 0.5", "y >= 0.25", "x < -0.5", "abs(y) > 1"),
        ]


def test_values(model: CompiledModel) -> None:
    assert model["x"] == 1.5
    for x, y in POINTS:
        model["x"], model["y"] = x, y
        np.testing.assert_allclose(model.derivatives(), expected(x, y, -1.5), rtol=1e-15)


def test_at_zero_abs_is_zero_and_rises(model: CompiledModel) -> None:
    model["x"], model["y"] = 0.1, 0.1
    assert model.derivatives()[0] == pytest.approx(0.1 * 0.01 + 0.1, rel=1e-15)


def test_partial_derivatives_are_those_of_the_branch_in_force(model: CompiledModel) -> None:
    step = 1e-6
    for point in POINTS:
        model["x"], model["y"] = point
        exact = model.jacobian()[:, :2]
        for column, name in enumerate(("x", "y")):
            around = []
            for sign in (1.0, -1.0):
                model[name] = point[column] + sign * step
                around.append(model.derivatives())
            model[name] = point[column]
            model.outputs()
            np.testing.assert_allclose(exact[:, column], (around[0] - around[1]) / (2 * step), rtol=1e-7, atol=1e-9)
            tangent = model.tangent({name: 1.0}, at_start=False)
            assert [tangent[f"der({s})"] for s in ("x", "y")] == pytest.approx(exact[:, column], rel=1e-14)
