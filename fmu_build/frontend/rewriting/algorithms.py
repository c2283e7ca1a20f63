"""Algorithm sections as equations: rumoca refuses sections of several outputs, loops, and what is assigned twice.

Statements are followed in their order, and a variable's last value is its equation: ``s := time; p := 2*s; s := s+1``
is ``s = (time) + 1; p = 2*(time)``. Loops whose bounds are numbers are unrolled; others are sums, products, or loops of
equations. When-clauses stay statements; those of one section that assign the same become one. No line moves.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence, Set

import networkx as nx

from .loop_words import loop_words, numbers
from .references import base_of, canonical, replaced
from .statements import (
    Assigned,
    Branches,
    Called,
    NotSaidOtherwiseError,
    Outputs,
    Repeated,
    Statement,
    Tokens,
    Whens,
    assigned_in,
    statements_of,
)
from .tokens import ClassBody, Token, classes_of, discrete_types, placed, sections_of, tokens_of, written
from .when_words import when_words

LONGEST = 20_000  # characters of an expression: what grows from statement to statement is refused
Values = dict[str, str]


def as_equations(text: str) -> str:
    """The Modelica text with those algorithm sections of models and blocks as equations that can be said so."""
    changes = []
    for owner in classes_of(tokens_of(text)):
        for initial in (False, True):
            for word, tokens in sections_of(owner, initial=initial):
                if word.text == "algorithm" and tokens and owner.kind != "function":
                    changes += _changes(text, owner, word, tokens, initial)
    for start, end, replacement in sorted(changes, reverse=True):
        text = text[:start] + replacement + text[end:]
    return text


def first_section(text: str) -> int | None:
    """Where the first algorithm section begins that is in no function."""
    starts = [
        word.start
        for owner in classes_of(tokens_of(text))
        for word, _ in sections_of(owner)
        if word.text == "algorithm" and owner.kind != "function"
    ]
    return min(starts, default=None)


def _changes(text: str, owner: ClassBody, word: Token, tokens: Tokens, initial: bool) -> list[tuple[int, int, str]]:
    kept = {} if initial else discrete_types(owner)
    try:
        statements = statements_of(tokens)
        section = _Section(text, owner, statements, kept, frozenset())
        if section.is_cyclic():
            section = _Section(text, owner, statements, kept, section.targets)
    except NotSaidOtherwiseError:
        return []
    if not section.declarations and all(piece.startswith("algorithm") for _, piece in section.pieces):
        return []
    first, last = (text.count("\n", 0, place) for place in (word.start, tokens[-1].end))
    equations = f"equation{placed(section.pieces, first, last)}"
    declared = [(owner.start, owner.start, section.declarations)] if section.declarations else []
    return [*declared, (word.start, tokens[-1].end, equations)]


class _Section:
    """A section's statements, followed in their order. ``kept``: variables that without an assignment keep the value
    from before; ``inlined``: targets that are never read by their names."""

    def __init__(
        self,
        text: str,
        owner: ClassBody,
        statements: Sequence[Statement],
        kept: Collection[str],
        inlined: Set[str],
    ) -> None:
        self._text, self._owner, self._kept, self._inlined = text, owner, kept, inlined
        self._numbers: dict[str, str] = {}  # the variables of loops that are being unrolled
        self._settled: set[str] = set()  # targets that equations of their own determine
        self._lines: dict[str, int] = {}
        self.targets = set(assigned_in(statements))
        self.pieces: list[tuple[int, str]] = []
        self.declarations = ""
        self._values: Values = {}
        self._follow(statements, self._values, frozenset(), ())
        self._equations = [f"{key} = {value};" for key, value in self._values.items()]
        self.pieces += [(self._lines[key], text) for key, text in zip(self._values, self._equations, strict=True)]

    def is_cyclic(self) -> bool:
        """Whether the equations, which statements never do, depend on each other."""
        graph = nx.DiGraph()
        for key, value in self._values.items():
            names: set[str] = set()
            replaced(tokens_of(value), lambda name, _, found=names: found.add(name) or name)  # type: ignore[misc]
            graph.add_edges_from((key, name) for name in names)
        return not nx.is_directed_acyclic_graph(graph)

    def _line(self, token: Token) -> int:
        return self._text.count("\n", 0, token.start)

    def _follow(
        self, statements: Sequence[Statement], values: Values, later: Set[str], guards: tuple[str, ...]
    ) -> None:
        """``later``: what is assigned behind these statements; ``guards``: the conditions under which they are."""
        index = 0
        while index < len(statements):
            statement, rest = statements[index], statements[index + 1 :]
            behind = later | set(assigned_in(rest))
            index += 1
            if isinstance(statement, Assigned):
                self._assign(statement, values, behind)
            elif isinstance(statement, Branches):
                self._choose(statement, values, behind, guards)
            elif isinstance(statement, Repeated):
                self._repeat(statement, values, behind, guards)
            elif isinstance(statement, Called):
                self._check(statement, values, behind, guards)
            elif guards:
                raise NotSaidOtherwiseError
            elif isinstance(statement, Outputs):
                self._take_outputs(statement, values, behind)
            else:
                whens = [statement]
                while index < len(statements) and isinstance(following := statements[index], Whens):
                    whens.append(following)
                    index += 1
                self._keep(whens, values, later | set(assigned_in(statements[index:])))

    def _read(self, tokens: Tokens, values: Values, later: Set[str], kept: Set[str] = frozenset()) -> str:
        """The expression with values from before; names of ``kept`` stay."""

        def value(reference: str, function: str) -> str:
            return reference if base_of(reference) in kept else self._value(reference, function, values, later)

        text = replaced(tokens, value)
        if len(text) > LONGEST:
            raise NotSaidOtherwiseError
        return text

    def _value(self, reference: str, function: str, values: Values, later: Set[str]) -> str:
        if reference in self._numbers:
            return self._numbers[reference]
        base = base_of(reference)
        parts = {
            other
            for other in self.targets
            if other.startswith((f"{base}.", f"{base}[")) or base.startswith(f"{other}.")
        }
        if (base not in self.targets and not parts) or function == "pre":
            return reference
        if parts or function in {"edge", "change"}:
            raise NotSaidOtherwiseError
        is_last = base not in later
        if reference in values and not (is_last and function == "der"):
            return reference if is_last and base not in self._inlined else f"({values[reference]})"
        if base not in self._settled and all(base_of(key) != base for key in values):
            return self._initial(reference)
        if not is_last:
            raise NotSaidOtherwiseError
        return reference

    def _initial(self, reference: str) -> str:
        """The value before the section: that before the event, of what is discrete."""
        if base_of(reference) not in self._kept:
            raise NotSaidOtherwiseError
        return f"pre({reference})"

    def _target(self, tokens: Tokens, values: Values) -> str:
        return canonical(tokens, lambda reference, function: self._value(reference, function, values, self.targets))

    def _assign(self, statement: Assigned, values: Values, later: Set[str]) -> None:
        target = self._target(statement.target, values)
        base = base_of(target)
        others = [key for key in values if base_of(key) == base and key != target]
        if base in self._settled or (others and base in {target, *others}):  # as a whole, and in elements
            raise NotSaidOtherwiseError
        values[target] = self._read(statement.value, values, later | {base})
        self._lines[target] = self._line(statement.target[0])

    def _choose(self, statement: Branches, values: Values, later: Set[str], guards: tuple[str, ...]) -> None:
        results: list[tuple[str, Values]] = []
        before: tuple[str, ...] = ()
        own = later | set(assigned_in([statement]))
        for condition, statements in (
            *statement.branches,
            *([] if statement.branches[-1][0] is None else [(None, ())]),
        ):
            chosen = "" if condition is None else self._read(condition, values, own)
            result = dict(values)
            guard = (*before, f"({chosen})") if chosen else before
            self._follow(statements, result, later, (*guards, *guard))
            before = (*before, f"not ({chosen})")
            results.append((chosen, result))
        for key in dict.fromkeys(key for _, result in results for key in result):
            found = [result[key] if key in result else self._initial(key) for _, result in results]
            if any(value != found[0] for value in found):
                pairs = zip([chosen for chosen, _ in results[:-1]], found[:-1], strict=True)
                values[key] = " else".join(f"if {c} then {v}" for c, v in pairs) + f" else {found[-1]}"
            else:
                values[key] = found[0]

    def _repeat(self, loop: Repeated, values: Values, later: Set[str], guards: tuple[str, ...]) -> None:
        own = later | set(assigned_in([loop]))
        bounds = self._read(loop.range, values, own)
        if (found := numbers(bounds)) is None:
            words = loop_words(loop, bounds, lambda tokens, kept: self._read(tokens, values, own, kept))
            if words.equations and (guards or words.arrays & later):
                raise NotSaidOtherwiseError
            for target, (operator, term) in words.terms.items():
                values[target] = f"({values[target] if target in values else self._initial(target)}) {operator} {term}"
                self._lines[target] = self._line(loop.range[0])
            if words.equations:
                self._settled |= words.arrays
                self.pieces.append((self._line(loop.range[0]), words.equations))
            return
        for count, number in enumerate(found, start=1):
            self._numbers[loop.variable] = str(number)
            self._follow(loop.body, values, later if count == len(found) else own, guards)
        self._numbers.pop(loop.variable, None)

    def _check(self, statement: Called, values: Values, later: Set[str], guards: tuple[str, ...]) -> None:
        if statement.call[0].text != "assert":
            raise NotSaidOtherwiseError
        text = self._read(statement.call, values, later).partition("(")[2]
        unless = f"not ({' and '.join(guards)}) or " if guards else ""
        self.pieces.append((self._line(statement.call[0]), f"assert({unless}{text};"))

    def _take_outputs(self, statement: Outputs, values: Values, later: Set[str]) -> None:
        targets = {written(target) for target in statement.targets}
        if targets & (later | values.keys() | self._settled):
            raise NotSaidOtherwiseError
        call = self._read(statement.value, values, later | targets)
        self.pieces.append((self._line(statement.whole[0]), f"{written(statement.whole)} = {call};"))
        self._settled |= targets

    def _keep(self, whens: Sequence[Whens], values: Values, later: Set[str]) -> None:
        """When-clauses, which may read the last values of other variables."""
        targets = set(assigned_in(whens))
        if targets & (later | values.keys() | self._settled):
            raise NotSaidOtherwiseError
        self._settled |= targets
        others = self.targets - targets
        open_names = {
            name.partition(".")[0] for name in others if name in later or name not in values.keys() | self._settled
        }
        if any(token.text in open_names for when in whens for token in when.tokens):
            raise NotSaidOtherwiseError
        text, declarations = when_words(whens, self._text, self._owner, self.targets)
        self.declarations += declarations
        self.pieces.append((self._line(whens[0].tokens[0]), f"algorithm {text} equation"))
