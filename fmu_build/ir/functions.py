"""Functions that SymPy does not have."""

from __future__ import annotations

import sympy


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
    """What there is where an array has no element or sqrt(-1) no value: NaN. SymPy's own NaN refuses to be compared."""

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
