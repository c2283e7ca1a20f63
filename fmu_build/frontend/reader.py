"""What functions and subscripts need of whoever reads expressions: the ExpressionReader, seen from below."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager
from typing import Any, Protocol

import sympy
from sympy.logic.boolalg import Boolean

from .components import Components
from .values import Value


class Reader(Protocol):
    """Reads expressions; see ExpressionReader for what each method promises."""

    components: Components

    def read(self, node: Mapping[str, Any]) -> Value:
        """The value of an expression."""

    def condition(self, node: Mapping[str, Any]) -> Boolean:
        """The truth of a condition."""

    def outputs(self, body: Mapping[str, Any]) -> tuple[Value, ...]:
        """All outputs of a function call."""

    def assertion(self, node: Mapping[str, Any]) -> None:
        """Keep what a function asserts."""

    def share(self, name: str, value: Value) -> Value:
        """The value, of which large expressions are replaced by variables that equal them."""

    def named(self, name: str, scalar: sympy.Expr) -> sympy.Expr:
        """A variable that equals an expression; the expression where there can be none."""

    def shape(self, sizes: Sequence[Mapping[str, Any]]) -> list[int]:
        """The sizes of a declaration as numbers."""

    def empty_record(self, type_id: int) -> dict[str, Value]:
        """A record without values."""

    def inside_function(self, names: dict[str, Value]) -> AbstractContextManager[None]:
        """What is read is the body of a function with these variables."""

    def inside_branch(self) -> AbstractContextManager[None]:
        """What is read counts under a condition only."""
