"""Names of variables inside expressions, and functions that SymPy does not have.

A variable is ``symbol(name)``, the time derivative of ``x`` is ``symbol(der(x))``, its value before an event
``symbol(pre(x))`` and the truth value of relation ``i`` is ``holds(i)``. Real literals are SymPy Floats of double
precision. A Boolean variable is 0 or 1, and true as a condition where it is above 0.5 (``is_true``). An enumeration is
the number of its literal, from 1.
"""

from __future__ import annotations

import re

import sympy

TIME = "time"
INITIAL = "initial()"  # Boolean variables: true while the model is initialized, and at its end
TERMINAL = "terminal()"


def symbol(name: str) -> sympy.Symbol:
    """The SymPy symbol of the variable ``name``."""
    return sympy.Symbol(name, real=True)


def der(name: str) -> str:
    """Name of the time derivative of ``name``, as FMI's structured naming convention writes it: ``der(x)``, of that
    ``der(x,2)``."""
    base, order = derivative_of(name)
    return f"der({base},{order + 1})" if order else f"der({name})"


def derivative_of(name: str) -> tuple[str, int]:
    """The variable that ``name`` is a time derivative of, and how often it has been differentiated."""
    found = re.fullmatch(r"der\((.*?)(?:,(\d+))?\)", name)
    return (found.group(1), int(found.group(2) or 1)) if found else (name, 0)


def pre(name: str) -> str:
    """Name of the value of ``name`` just before an event."""
    return f"pre({name})"


def relation_name(index: int) -> str:
    """Name of the variable that is the residual of relation ``index``."""
    return f"relation[{index + 1}]"


def holds(index: int) -> sympy.Symbol:
    """The truth value of relation ``index``, constant between events."""
    return sympy.Symbol(f"holds[{index}]")


def is_true(name: str) -> sympy.Expr:
    """The condition that the Boolean variable ``name`` is true."""
    return symbol(name) > sympy.Float(0.5)


def truth(condition: sympy.Expr) -> sympy.Expr:
    """1 where ``condition`` is true, else 0: what a Boolean variable is set to."""
    return sympy.Piecewise((sympy.Integer(1), condition), (sympy.Integer(0), True), evaluate=False)


class power(sympy.Function):  # type: ignore[misc]
    """``x^n`` with an exponent that is a parameter: arguments (x, n). SymPy's derivative, n x^n / x, fails at zero."""

    nargs = 2
    is_real = True

    @classmethod
    def eval(cls, base: sympy.Expr, exponent: sympy.Expr) -> sympy.Expr | None:
        """SymPy's own, where the exponent is a number; one like 2.0 as an integer, which is printed as products."""
        if not exponent.is_number:
            return None
        is_integer = exponent.is_Float and float(exponent).is_integer()
        return base ** (sympy.Integer(int(exponent)) if is_integer else exponent)

    def fdiff(self, argindex: int = 1) -> sympy.Expr:
        """n x^(n - 1), or x^n log(x)"""
        base, exponent = self.args
        if argindex == 1:
            return exponent * power(base, exponent - 1)
        return no_number() if base.is_negative else self * sympy.log(base)


class no_number(sympy.Function):  # type: ignore[misc]
    """What there is where an array has no element: NaN. SymPy's own NaN refuses to be compared."""

    nargs = 0
    is_real = True
    is_number = False


class round_down(sympy.Function):  # type: ignore[misc]
    """The largest integer not above its argument, whose derivative is 0 wherever it has one."""

    nargs = 1
    is_real = True

    @classmethod
    def eval(cls, argument: sympy.Expr) -> sympy.Expr | None:
        """A number, of a number."""
        return sympy.floor(argument) if argument.is_number else None

    def fdiff(self, argindex: int = 1) -> sympy.Expr:
        """0"""
        return sympy.Integer(0)


class reach_time(sympy.Function):  # type: ignore[misc]
    """The time at which ``rest + slope*time`` reaches ``value``: arguments (value, rest, slope).

    It is a function, and not the quotient, because SymPy would write that differently for different values, and so
    round one and the same time differently.
    """

    nargs = 3
    is_real = True


class time_left(sympy.Function):  # type: ignore[misc]
    """From now to an event: arguments (its time, now). Their difference, zero where that is rounding."""

    nargs = 2
    is_real = True

    def fdiff(self, argindex: int = 1) -> sympy.Expr:
        """1 or -1"""
        return sympy.Integer(1 if argindex == 1 else -1)
