"""Algebraic loops as C: what runtime/numerics/loops.h needs to know of each, and the lines that call it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

import sympy

from ..errors import BuildError
from ..ir.equations import Assignment, Loop
from ..ir.linear import rest
from ..ir.models import JacobianModel, LoopGradient, LoopPartials, SortedModel
from .text import braced, comment, function, string

MOST_DOUBLES = 48_000  # on the stack, 384 KB: a thread may have no more than 512 KB (macOS)

Text = Callable[[sympy.Expr], str]
Lines = Callable[[Iterable[Assignment]], list[str]]


def check_stack(model: SortedModel, jacobian: JacobianModel) -> None:
    """BuildError where the work space of the loops would not fit on the stack.

    It is largest in model_jacobian, which keeps the factors of every loop and a column for each seed.
    """
    loops = list(numbered(model).values())
    columns = sum(len(gradient.right) for gradient in jacobian.assignments if isinstance(gradient, LoopGradient))
    room = sum(len(loop.unknowns) * (len(loop.unknowns) + 4) for loop in loops) + columns
    if room > MOST_DOUBLES:
        largest = max(loops, key=lambda loop: len(loop.unknowns))
        raise BuildError(
            f"{largest.residuals[0].origin}: {len(largest.unknowns)} equations determine {largest.unknowns[0]} and"
            f" others together: the loops of a model may take {8e-3 * MOST_DOUBLES:.0f} KB of stack, some 200 unknowns,"
            f" and here they take {8e-3 * room:.0f} KB; make some of the unknowns states"
        )


def declare_loops(model: SortedModel, text: Text, lines: Lines) -> str:
    """The functions and the table of all loops."""
    loops = numbered(model)
    parts = [_declare(name, loop, model.value_references, text, lines) for name, loop in loops.items()]
    table = ", ".join(f"&{name}" for name in loops)
    return "\n".join([*parts, f"const Loop *const model_loops[N_LOOPS] = {{{table}}};\n" if loops else ""])


def numbered(model: SortedModel) -> dict[str, Loop]:
    """The loops by their C names."""
    loops = [block for block in (*model.assignments, *model.start_assignments) if isinstance(block, Loop)]
    return {f"loop_{number}": loop for number, loop in enumerate(loops, start=1)}


def tangent_statement(name: str, partials: LoopPartials, text: Text, seed: Callable[[str], str]) -> str:
    """Tangents of the residuals, then those of the unknowns."""
    size = len(partials.loop.unknowns)
    right = [
        f"    -({' + '.join(f'({text(value)})*{seed(argument)}' for argument, value in row) or '0.0'}),"
        for row in partials.by_argument
    ]
    lines = [
        f"double right[{size}] = {{",
        *right,
        "};",
        *_room(size),
        f"loop_tangent(&{name}, v, holds, right, d, work, pivots);",
    ]
    return braced(lines, partials.loop.origin)


def adjoint_statement(name: str, partials: LoopPartials, text: Text, seed: Callable[[str], str]) -> str:
    """Adjoints of the residuals, then those of the arguments."""
    size = len(partials.loop.unknowns)
    lines = [
        f"double right[{size}];",
        *_room(size),
        f"loop_adjoint(&{name}, v, holds, d, right, work, pivots);",
        *(
            f"{seed(argument)} -= ({text(value)})*right[{row}];"
            for row, arguments in enumerate(partials.by_argument)
            for argument, value in arguments
        ),
    ]
    return braced(lines, partials.loop.origin)


def gradient_lines(
    name: str, gradient: LoopGradient, number: int, is_first: bool, text: Text, targets: Mapping[str, str]
) -> list[str]:
    """The derivatives of the unknowns by one seed; the first one makes the factors for all.

    ``targets`` has the left sides of the statements that define those that are used.
    """
    size = len(gradient.right)
    column = f"{name}_column_{number}"
    factors = [
        f"double {name}_factors[LOOP_WORK({size})];",
        f"unsigned {name}_pivots[{size}];",
        f"loop_factor(&{name}, v, holds, {name}_factors, {name}_pivots);",
    ]
    right = ", ".join(f"-({text(value)})" for value in gradient.right)
    return [
        *(factors if is_first else []),
        f"double {column}[{size}] = {{{right}}};",
        f"loop_back(&{name}, {name}_factors, {name}_pivots, {column});",
        *(f"{targets[target]} = {column}[{i}];" for i, target in enumerate(gradient.targets) if target in targets),
    ]


def _room(size: int) -> list[str]:
    return [f"double work[LOOP_WORK({size})];", f"unsigned pivots[{size}];"]


def _declare(name: str, loop: Loop, references: dict[str, int], text: Text, lines: Lines) -> str:
    size = len(loop.unknowns)
    values = (
        [rest(r, loop.unknowns) for r in loop.residuals]
        if loop.is_linear
        else [r.residual for r in loop.residuals[: len(loop.iterated)]]
    )
    residuals = [
        *lines(loop.explicit),
        *(
            f"residual[{row}] = {text(value)}; {comment(equation.origin)}"
            for row, (value, equation) in enumerate(zip(values, loop.residuals, strict=False))
        ),
    ]
    slopes = [f"slope[{row * size + column}] = {text(value)};" for (row, column), value in loop.slopes.items()]
    unknowns = ", ".join(str(references[unknown]) for unknown in loop.unknowns)
    guesses = ", ".join(str(references[guess]) for guess in loop.guesses) or "0"
    described = string(f"{', '.join(loop.unknowns)} ({loop.origin})")
    return f"""{function(f"static {name}_residuals(Variables *v, const bool holds[], double residual[])", residuals)}
{function(f"static {name}_slopes(const Variables *v, const bool holds[], double slope[])", slopes)}
static const unsigned {name}_unknowns[] = {{{unknowns}}};
static const unsigned {name}_guesses[] = {{{guesses}}};
static const Loop {name} = {{
    .text = {described},
    .size = {size},
    .n_iterated = {len(loop.iterated)},
    .linear = {str(loop.is_linear).lower()},
    .unknowns = {name}_unknowns,
    .guesses = {name}_guesses,
    .residuals = {name}_residuals,
    .slopes = {name}_slopes,
}};

static void {name}_solve(Variables *v, const bool holds[])
{{
{chr(10).join(f"    {line}" for line in _room(size))}
    loop_solve(&{name}, v, holds, work, pivots);
}}
"""
