"""Conditions with conditional values in them, powers, subscripts that change: where SymPy might go astray."""

from __future__ import annotations

import itertools
import operator

import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from fmu_build.ir.conditions import compare, insert
from fmu_build.ir.symbols import holds, symbol
from tests.fmu_build.cases import Case, check
from tests.fmu_build.conftest import Build
from tests.sampling import spread

NAMES = ("a", "b", "c")
TRUTHS = (holds(0), holds(1))
OPERATIONS = {sympy.Lt: operator.lt, sympy.Le: operator.le, sympy.Gt: operator.gt, sympy.Eq: operator.eq}

numbers = st.integers(-3, 3).map(sympy.Integer)
leaves = st.sampled_from([symbol(name) for name in NAMES]) | numbers


def _choices(values: st.SearchStrategy[sympy.Expr]) -> st.SearchStrategy[sympy.Expr]:
    conditions = st.sampled_from(TRUTHS) | st.builds(sympy.Gt, st.sampled_from([symbol("a"), symbol("b")]), numbers)
    choice = st.builds(lambda v, c, w: sympy.Piecewise((v, c), (w, True), evaluate=False), values, conditions, values)
    return choice | st.builds(operator.add, values, values) | st.builds(operator.neg, values)


expressions = st.recursive(leaves, _choices, max_leaves=6)


def value(expression: sympy.Basic, at: dict[sympy.Symbol, object]) -> object:
    """By hand, without SymPy's simplifications."""
    if expression in at:
        return at[expression]
    if not expression.args:
        return expression
    if isinstance(expression, sympy.Piecewise):
        return next(value(v, at) for v, condition in expression.args if condition == True or value(condition, at))  # noqa: E712
    if isinstance(expression, sympy.And):
        return all(value(a, at) for a in expression.args)
    if isinstance(expression, sympy.Or):
        return any(value(a, at) for a in expression.args)
    if isinstance(expression, sympy.Not):
        return not value(expression.args[0], at)
    arguments = [value(a, at) for a in expression.args]
    return bool(expression.func(*arguments)) if expression.is_Relational else expression.func(*arguments)


POINTS = [
    {**{symbol(n): sympy.Integer(v) for n, v in zip(NAMES, numbers, strict=True)}, TRUTHS[0]: one, TRUTHS[1]: other}
    for numbers in itertools.product((-2, 1), repeat=3)
    for one, other in itertools.product((True, False), repeat=2)
]


@settings(deadline=None, max_examples=50)
@given(expressions, expressions, st.sampled_from(list(OPERATIONS)))
def test_a_comparison_is_true_where_the_values_say_so(left: sympy.Expr, right: sympy.Expr, operation: type) -> None:
    condition = compare(operation, left, right)
    assert not condition.has(sympy.Piecewise)
    for at in POINTS:
        truth = condition if condition in (sympy.true, sympy.false) else value(condition, at)
        assert bool(truth) == OPERATIONS[operation](value(left, at), value(right, at))


@settings(deadline=None, max_examples=50)
@given(expressions, expressions, expressions)
def test_values_put_into_a_conditional_expression(inside: sympy.Expr, a: sympy.Expr, b: sympy.Expr) -> None:
    put_in = {symbol("a"): a, symbol("b"): b}
    result = insert(inside, put_in)
    for at in POINTS:
        assert value(result, at) == value(inside, {**at, symbol("a"): value(a, at), symbol("b"): value(b, at)})


CASES = {
    "conditions of parameters": Case(
        """
model M
  parameter Real p = 0.5, q = -2;
  parameter Integer n = 3;
  Real x(start=1, fixed=true);
  Real y = if abs(p) <= 0.1 then 1 elseif sign(q) > 0 then 2 elseif max({p, q, 0.2}) < 0.4 then 3 else x;
  Real z = if abs(n - 4) <= 1 and not min(n, 2) > 2 then x else -x;
equation
  der(x) = -x;
end M;""",
        1.0,
        lambda t: {"y": np.exp(-t), "z": np.exp(-t)},
    ),
    "functions of conditional values": Case(
        """
model M
  function f
    input Real a, b;
    output Real y;
  protected
    Real most = max(a, b);
  algorithm
    if most > 0.7 and min(a, b) < 0.5 then
      y := most;
    else
      y := 2*most;
    end if;
  end f;
  Real x(start=1, fixed=true);
  Real y = f(x, time);
equation
  der(x) = -x;
end M;""",
        1.5,
        lambda t: {
            "y": np.maximum(np.exp(-t), t)
            * np.where((np.maximum(np.exp(-t), t) > 0.7) & (np.minimum(np.exp(-t), t) < 0.5), 1, 2)
        },
    ),
    "return and while": Case(
        """
model M
  function f
    input Real a;
    output Real y;
  algorithm
    y := a;
    if a > 0.5 then
      y := 7;
      return;
    end if;
    y := y + 1;
  end f;
  function g
    input Real a;
    output Real y;
  protected
    Integer i;
  algorithm
    y := a;
    i := 0;
    while i < 5 loop
      y := y + 1;
      i := i + 1;
    end while;
  end g;
  Real y = f(time), z = g(time);
end M;""",
        0.9,
        lambda t: {"y": np.where(t > 0.5, 7, t + 1), "z": t + 5},
    ),
    "subscripts that change": Case(
        """
model M
  parameter Real t_i[5] = {0, 0.3, 0.6, 1.2, 3}, u_i[5] = {1, 2, 0, 5, 6};
  Integer k(start=1, fixed=true);
  Real u = u_i[k] + (u_i[k + 1] - u_i[k])*(time - t_i[k])/(t_i[k + 1] - t_i[k]);
  Real y(start=0, fixed=true);
equation
  when time >= t_i[pre(k) + 1] then
    k = pre(k) + 1;
  end when;
  der(y) = u;
end M;""",
        2.0,
        lambda t: {"u": np.interp(t, [0, 0.3, 0.6, 1.2, 3], [1, 2, 0, 5, 6])},
    ),
    "a power with a parameter, at zero": Case(
        """
model M
  parameter Real n = 1.5;
  parameter Integer k = 2;
  Real x(start=0, fixed=true);
  Real y = x^n + (time - 1)^k;
equation
  der(x) = 1 - x^n;
end M;""",
        2.0,
    ),
    "other equations at the start": Case(
        """
model M
  Real x(start=1, fixed=true), y;
equation
  der(x) = -y;
  if initial() then
    y = 3;
  else
    y = x;
  end if;
end M;""",
        1.0,
        lambda t: {"x": np.exp(-t)},
    ),
}


@pytest.mark.parametrize(("name", "fmi"), spread(CASES, [2, 3], every=3))
def test_a_model_against_an_independent_solution(name: str, fmi: int, built: Build) -> None:
    check(CASES[name], fmi, built)
