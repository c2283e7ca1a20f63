"""``and``, ``or`` and ``not`` of arrays: element by element (Modelica 3.6, section 10.6.11)."""

from __future__ import annotations

import itertools
from collections.abc import Callable

from fmu_build.ir.equations import Assignment
from fmu_build.ir.models import SortedModel
from fmu_build.ir.symbols import symbol

TEXT = """
model M
  input Boolean p[2], q[2];
  Boolean a[2] = not p;
  Boolean b[2] = p and q;
  Boolean c[2];
  Boolean d[2] = not (p and {q[1], true});
  Boolean e[2, 2] = {p, q};
  Boolean f[2] = e[:, 1] or e[1, :];
  Integer n(start=0, fixed=true) "when one of them becomes true";
equation
  c = p or not q;
  when not (p or q) then
    n = pre(n) + 1;
  end when;
end M;
"""


def test_each_element_is_what_its_operands_say(sorted_model: Callable[[str], SortedModel]) -> None:
    assignments = {a.target: a.expression for a in sorted_model(TEXT).schedule.assignments if isinstance(a, Assignment)}
    names = [f"{name}[{i}]" for name in "pq" for i in (1, 2)]
    for truths in itertools.product((False, True), repeat=4):
        (p, q), values = (truths[:2], truths[2:]), {symbol(n): int(t) for n, t in zip(names, truths, strict=True)}
        values |= {symbol(f"e[{i + 1},{j + 1}]"): int((p, q)[i][j]) for i in (0, 1) for j in (0, 1)}
        expected = {
            "a": [not p[i] for i in (0, 1)],
            "b": [p[i] and q[i] for i in (0, 1)],
            "c": [p[i] or not q[i] for i in (0, 1)],
            "d": [not (p[0] and q[0]), not p[1]],
            "f": [p[0], q[0] or p[1]],
            "when": [not (p[i] or q[i]) for i in (0, 1)],
        }
        for name, parts in expected.items():
            for i, part in enumerate(parts, start=1):
                target = f"{name}{{{i}}}" if name == "when" else f"{name}[{i}]"
                assert assignments[target].subs(values) == part, (target, truths)
