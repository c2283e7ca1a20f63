"""Functions, run on symbols."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import sympy

from fmu_build.ir.equations import Assignment
from fmu_build.ir.models import SortedModel
from fmu_build.ir.symbols import symbol

Sorted = Callable[[str], SortedModel]

TIME = symbol("time")


def test_defaults_may_read_what_is_declared_elsewhere(sorted_model: Sorted) -> None:
    """In all orders that rumoca takes: what is read before what reads it, if both are outputs, or both are not."""
    outputs, others = ("public output Real y = a;", "public output Real z = y;"), ("Real p = y + 1;", "Real q = 2*p;")
    declarations = (*outputs, *(f"protected {other}" for other in others))
    orders = [
        "\n".join(order)
        for order in itertools.permutations(declarations)
        if all(order.index(declarations[first]) < order.index(declarations[first + 1]) for first in (0, 2))
    ]
    functions = [
        f"function f{i}\ninput Real a;\n{order}\nalgorithm\nz := z + q;\nend f{i};\n" for i, order in enumerate(orders)
    ]
    components = [f"Real x{i}, w{i};\n" for i in range(len(orders))]
    equations = [f"(x{i}, w{i}) = f{i}(time);\n" for i in range(len(orders))]
    model = sorted_model(f"model M\n{''.join(functions + components)}equation\n{''.join(equations)}end M;\n")
    found = {a.target: sympy.expand(a.expression) for a in model.assignments if isinstance(a, Assignment)}
    expected = {f"x{i}": TIME for i in range(len(orders))} | {f"w{i}": 3 * TIME + 2 for i in range(len(orders))}
    assert found == expected
    assert len(orders) == 6
