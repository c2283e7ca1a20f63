"""What is computed where parameters and inputs are set, and not again wherever the states are: model_steady."""

from __future__ import annotations

from collections.abc import Iterable

import sympy

from ..ir.dependencies import reaching
from ..ir.equations import Assignment, Block
from ..ir.models import JacobianModel, SortedModel
from ..ir.symbols import symbol
from .text import Printer, assignment_lines, function


class Early:
    """The part of derivatives, outputs, relations and Jacobian that takes long and depends on no state.

    ``printer`` is the one for them: it takes that part from where it is kept. The operations stay the same, and so do
    the bits.
    """

    def __init__(self, model: SortedModel, jacobian: JacobianModel, plain: Printer) -> None:
        self._parts: dict[sympy.Expr, int] = {}
        self._model = model
        self.printer = Printer(plain.names, plain.locals, plain.steady, plain.loops, self._parts)
        assignments = [a for a in (*model.assignments, *jacobian.assignments) if isinstance(a, Assignment)]
        slow = {a.target for a in assignments if a.target in plain.steady and self.printer.is_early(a.expression)}
        moving = (a.expression for a in assignments if a.target not in slow)
        for expression in (*moving, *jacobian.entries.values(), *jacobian.time_entries.values()):
            self.printer.text(expression)
        used = slow.union(s.name for part in self._parts for s in part.free_symbols)
        self._blocks = reaching({symbol(name) for name in used}, model.assignments)
        self._sources = used.union(*(model.sources.get(name, frozenset()) for name in used))
        self._targets = {name for block in self._blocks for name in block.targets}

    @property
    def size(self) -> int:
        """How many numbers are kept beside variables."""
        return len(self._parts)

    def others(self, blocks: Iterable[Block]) -> list[Block]:
        """Those that are left to compute."""
        return [block for block in blocks if not self._targets.issuperset(block.targets)]

    def depends_on(self, name: str) -> bool:
        """Whether what is kept does, on an input."""
        return name in self._sources

    def text(self, plain: Printer) -> str:
        """model_steady, and whether it depends on an input."""
        truths = ", ".join(str(self.depends_on(name)).lower() for name in self._model.inputs) or "false"
        parts = [f"v->steady[{place}] = {plain.text(part)};" for part, place in self._parts.items()]
        lines = assignment_lines(self._blocks, plain) + parts
        return "\n".join(
            [
                f"const bool moves_steady[AT_LEAST_ONE(N_INPUTS)] = {{{truths}}};",
                "",
                function("model_steady(Variables *v)", lines),
            ]
        )
