"""Pieces of C: names, expressions, assignments, functions, comments."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

import sympy
from sympy.printing.c import C11CodePrinter

from ..errors import BuildError
from ..ir.equations import Block, Loop
from ..ir.functions import no_number, power, reach_time, round_down, time_left
from ..ir.symbols import TIME, relation_of

# In statements. Compilers take longer than in proportion for a function: of 6000 statements five times as long as for
# the same in pieces.
LONGEST_FUNCTION = 300
PIECE = 100


def identifiers(names: Iterable[str]) -> dict[str, str]:
    """Names to distinct C names: ``der(car.body.v)`` to ``m_der_car_body_v``, ``d(a)/d(b)`` to ``m_d_a__d_b``.

    All begin with ``m_``, so that none is a keyword, a macro of some header, or begins with a digit, whatever the model
    calls its variables. The time is the runtime's too, and has the name that it knows.
    """
    result: dict[str, str] = {}
    taken: set[str] = set()
    for name in names:
        parts = (re.sub(r"\W+", "_", part, flags=re.ASCII).strip("_") for part in name.split("/"))
        identifier = "time" if name == TIME else f"m_{'__'.join(parts)}"
        while identifier in taken:
            identifier += "_"
        taken.add(identifier)
        result[name] = identifier
    return result


class Printer(C11CodePrinter):  # type: ignore[misc]
    """C expressions over ``v->name``; doubles with the digits that give them back exactly.

    ``names`` are the C names of the variables, ``locals_`` those of partial derivatives, ``steady`` names of variables
    that do not change while the states do, ``loops`` the loops by their C names. ``early`` is what is computed of these
    variables before all else, by its place in ``v->steady[]``, and is added to on the way; None: nothing is.
    """

    def __init__(
        self,
        names: dict[str, str],
        locals_: dict[str, str],
        steady: frozenset[str],
        loops: dict[str, Loop],
        early: dict[sympy.Expr, int] | None = None,
    ) -> None:
        super().__init__({"math_macros": {}})  # C11 has no M_PI
        self.names = names
        self.locals = locals_
        self.shares_locals = any("[" in text for text in locals_.values())  # they stand in an array
        self.steady = steady
        self.loops = loops
        self.early = early
        self._texts: dict[sympy.Expr, str] = {}

    def _print(self, expr: sympy.Basic, **options: object) -> str:
        if self.early is not None and self.is_early(expr):
            return f"v->steady[{self.early.setdefault(expr, len(self.early))}]"
        return str(super()._print(expr, **options))

    def is_early(self, expr: sympy.Basic) -> bool:
        """Whether it is known early and slow: with a quotient, a root or a function, each as long as a dozen sums."""
        return (
            isinstance(expr, (sympy.Mul, sympy.Add, sympy.Pow, sympy.Function))
            and {s.name for s in expr.free_symbols} <= self.steady
            and bool(expr.free_symbols)
            and any(
                isinstance(part, sympy.Function) != isinstance(part, sympy.Piecewise)
                or (isinstance(part, sympy.Pow) and not part.exp.is_nonnegative)
                for part in sympy.preorder_traversal(expr)
            )
        )

    def _print_Symbol(self, expr: sympy.Symbol) -> str:
        if (relation := relation_of(expr)) is not None:
            return f"holds[{relation}]"
        if expr.name not in self.names and expr.name not in self.locals:
            raise BuildError(f"{expr.name} is used, and nothing declares it: a defect of fmu_build, please report it")
        return f"v->{self.names[expr.name]}" if expr.name in self.names else self.locals[expr.name]

    def _print_Float(self, expr: sympy.Float) -> str:
        return repr(float(expr))

    def _print_Integer(self, expr: sympy.Integer) -> str:
        return f"{int(expr)}.0"

    def _print_Rational(self, expr: sympy.Rational) -> str:
        return f"{expr.p}.0/{expr.q}.0"

    def _print_Mul(self, expr: sympy.Mul) -> str:
        """A quotient of what is known early comes first: no other operation has to wait for that division."""
        moving = [s for s in expr.free_symbols if s.name not in self.steady]
        known, rest = expr.as_independent(*moving, as_Add=False)
        if rest == 1 or known.is_number or sympy.denom(known).is_number:
            return str(super()._print_Mul(expr))
        return f"({self._print(known)})*{self.parenthesize(rest, sympy.printing.precedence.PRECEDENCE['Mul'])}"

    def _print_Pow(self, expr: sympy.Pow) -> str:
        base, exponent = expr.as_base_exp()
        if exponent.is_Integer and 2 <= abs(int(exponent)) <= 4:
            factor = self.parenthesize(base, sympy.printing.precedence.PRECEDENCE["Atom"])
            product = "*".join([factor] * abs(int(exponent)))
            return f"({product})" if exponent > 0 else f"1.0/({product})"
        return str(super()._print_Pow(expr))

    def _print_NumberSymbol(self, expr: sympy.NumberSymbol) -> str:
        return repr(float(expr))

    def _print_power(self, expr: power) -> str:
        base, exponent = (self._print(argument) for argument in expr.args)
        return f"pow({base}, {exponent})"

    def _print_no_number(self, expr: no_number) -> str:
        return "(double)NAN"

    # What sqrt(p) and 1/p become of a final parameter.
    _print_ImaginaryUnit = _print_ComplexInfinity = _print_NaN = _print_no_number

    def _print_reach_time(self, expr: reach_time) -> str:
        value, rest, slope = (self._print(argument) for argument in expr.args)
        return f"((({value}) - ({rest}))/({slope}))"

    def _print_time_left(self, expr: time_left) -> str:
        until, time = (self._print(argument) for argument in expr.args)
        return f"time_left({until}, {time})"

    def _print_round_down(self, expr: round_down) -> str:
        return f"floor({self._print(expr.args[0])})"

    def _print_sin(self, expr: sympy.sin) -> str:
        return f"sine({self._print(expr.args[0])})"

    def _print_atan(self, expr: sympy.atan) -> str:
        return f"arctangent({self._print(expr.args[0])})"

    def _print_Or(self, expr: sympy.Or) -> str:
        """With the brackets that compilers ask for."""
        arguments = sorted(expr.args, key=sympy.default_sort_key)
        return " || ".join(f"({self._print(a)})" if isinstance(a, sympy.And) else self._print(a) for a in arguments)

    def _print_Piecewise(self, expr: sympy.Piecewise) -> str:
        *branches, (last, _) = expr.args
        text = str(self._print(last))
        for value, condition in reversed(branches):
            text = f"({self._print(condition)} ? {self._print(value)} : {text})"
        return text

    def text(self, expression: sympy.Expr) -> str:
        """The C of an expression. Most are printed in several functions."""
        if expression not in self._texts:
            self._texts[expression] = str(self.doprint(expression))
        return self._texts[expression]

    def seed(self, name: str) -> str:
        """The tangent or adjoint of a variable."""
        return f"d->{self.names[name]}"

    def left(self, name: str) -> str:
        """The left side of the statement that gives a partial derivative its value."""
        return self.locals[name] if self.shares_locals else f"const double {self.locals[name]}"

    def loop_name(self, loop: Loop) -> str:
        """The C name of a loop."""
        return next(name for name, other in self.loops.items() if other is loop)


def function(signature: str, statements: Sequence[str]) -> str:
    """A C function, in pieces if it is long. Its signature may begin with ``static``."""
    return (whole if len(statements) <= LONGEST_FUNCTION else in_pieces)(signature, statements)


def in_pieces(signature: str, statements: Sequence[str], n_locals: int = 0) -> str:
    """A C function that calls pieces of itself, which share ``local[]`` if there are locals."""
    name, _, parameters = signature.removeprefix("static ").removesuffix(")").partition("(")
    arguments = ", ".join(_arguments(signature)) + (", local" if n_locals else "")
    pieces, calls = [], [f"double local[{n_locals}];"] if n_locals else []
    for number, first in enumerate(range(0, len(statements), PIECE), start=1):
        piece = f"{name}_{number}({parameters}{', double local[]' if n_locals else ''})"
        pieces.append(f"NOT_INLINED {whole(f'static {piece}', statements[first : first + PIECE])}")
        calls.append(f"{name}_{number}({arguments});")
    return "\n".join([*pieces, whole(signature, calls)])


def whole(signature: str, statements: Sequence[str]) -> str:
    """A C function in one; parameters that its statements do not use are marked so."""
    lines = [line for statement in statements for line in statement.split("\n")]
    body = re.sub(r'/\*.*?\*/|->\w+|"(\\.|[^"\\])*"', "", "\n".join(lines))  # which may hold the same name
    unused = [f"(void){a};" for a in _arguments(signature) if not re.search(rf"\b{a}\b", body)]
    text = "\n".join(f"    {line}" for line in [*unused, *lines])
    static = "static " if signature.startswith("static ") else ""
    return f"{static}void {signature.removeprefix('static ')}\n{{\n{text}\n}}\n"


def _arguments(signature: str) -> list[str]:
    return re.findall(r"(\w+)(?:\[\])?[,)]", signature)


def assignment_lines(blocks: Iterable[Block], printer: Printer) -> list[str]:
    """A line for each, with the place that it comes from."""
    return [
        f"{printer.loop_name(block)}_solve(v, holds);"
        if isinstance(block, Loop)
        else f"v->{printer.names[block.target]} = {printer.text(block.expression)}; {comment(block.origin)}"
        for block in blocks
    ]


def braced(lines: Iterable[str], origin: str) -> str:
    """Lines in brackets, with the place that they come from: one statement."""
    return "\n".join([f"{{ {comment(origin)}", *(f"    {line}" for line in lines), "}"])


def comment(text: str) -> str:
    """A comment. Names in quotes, and names of files, may contain anything, what ends a comment too."""
    plain = text.encode("ascii", "backslashreplace").decode()
    plain = "".join(c if c.isprintable() else " " for c in plain)
    return f"/* {plain.replace('*/', '* /').replace('/*', '/ *')} */"


def string(text: str) -> str:
    """A string literal, of the bytes of its UTF-8; ``?`` is escaped because C11 knows trigraphs."""
    plain = "".join(chr(b) if 32 <= b < 127 and chr(b) not in '\\"?' else f"\\{b:03o}" for b in text.encode())
    return f'"{plain}"'
