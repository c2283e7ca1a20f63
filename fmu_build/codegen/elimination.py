"""An Elimination to C: elimination.h and elimination.c, its tables and, if they are few, its operations one by one."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable

from ..ir.models import CSources, Elimination

# Up to this many factors are handled by a line of C for each operation: for ten states a factorization takes a tenth,
# and a solution a third, of the time of loops over tables. More would be more code than a processor keeps at hand.
MOST_WRITTEN_OUT = 256


def print_elimination(elimination: Elimination) -> CSources:
    """elimination.h and elimination.c; what they have to contain stands in runtime/model.h."""
    written_out = len(elimination.pattern) <= MOST_WRITTEN_OUT
    header = f"""/* Generated: the sizes of the Jacobian and of the factors. */
#ifndef ELIMINATION_H
#define ELIMINATION_H

#include "unit.h"

#define ELIMINATION_WRITTEN_OUT {int(written_out)}

enum {{ N_JACOBIAN = {len(elimination.jacobian)}, N_FACTORS = {len(elimination.pattern)} }};

#endif
"""
    rows = _Rows(elimination)
    text = _tables(elimination, rows)
    if written_out:
        text += "\nvoid model_factorize(const double *restrict jacobian, double shift, double *restrict factors)\n"
        text += _body(_factorize(elimination, rows))
        text += "\nvoid model_solve(const double *restrict factors, const double *restrict b, double *restrict x)\n"
        text += _body(_solve(elimination, rows))
        text += (
            "\nvoid model_subtract_product(const double *restrict jacobian, double shift, const double *restrict x,\n"
        )
        text += "                            double *restrict b)\n"
        text += _body(_subtract_product(elimination))
    return CSources({"elimination.h": header, "elimination.c": text})


class _Rows:
    """Where the factors of each row stand in the pattern: those of L, the pivot, those of U."""

    def __init__(self, elimination: Elimination) -> None:
        pattern, numbers = elimination.pattern, range(len(elimination.order))
        position = {state: k for k, state in enumerate(elimination.order)}
        places = {place: p for p, place in enumerate(pattern)}
        self.first = [bisect_left(pattern, (i, 0)) for i in (*numbers, len(numbers))]
        self.pivot = [places[i, i] for i in numbers]
        self.lower = [range(self.first[i], self.pivot[i]) for i in numbers]
        self.upper = [range(self.pivot[i] + 1, self.first[i + 1]) for i in numbers]
        self.jacobian = [places[position[i], position[j]] for i, j in elimination.jacobian]
        self.places = places


def _tables(elimination: Elimination, rows: _Rows) -> str:
    tables: dict[str, Iterable[int]] = {
        "jacobian_row[AT_LEAST_ONE(N_JACOBIAN)]": (i for i, _ in elimination.jacobian),
        "jacobian_column[AT_LEAST_ONE(N_JACOBIAN)]": (j for _, j in elimination.jacobian),
        "jacobian_factor[AT_LEAST_ONE(N_JACOBIAN)]": rows.jacobian,
        "pivot_state[AT_LEAST_ONE(N_STATES)]": elimination.order,
        "pivot_factor[AT_LEAST_ONE(N_STATES)]": rows.pivot,
        "first_factor[N_STATES + 1]": rows.first,
        "factor_column[AT_LEAST_ONE(N_FACTORS)]": (j for _, j in elimination.pattern),
    }
    lines = [f"const int {name} = {{{', '.join(map(str, values)) or '0'}}};" for name, values in tables.items()]
    title = "/* Generated: where the Jacobian and the factors are not zero, and how they are made. */"
    return "\n".join([title, '#include "model.h"', "", *lines, ""])


def _body(lines: list[str]) -> str:
    return "\n".join(["{", *(f"    {line}" for line in lines), "}", ""])


def _factorize(elimination: Elimination, rows: _Rows) -> list[str]:
    """What factorize() in runtime/numerics/lu.c does, in the same order."""
    pattern = elimination.pattern
    entries = {p: f"jacobian[{e}]" for e, p in enumerate(rows.jacobian)}
    lines = []
    for i, pivot in enumerate(rows.pivot):
        lines.append(f"/* pivot {i}: state {elimination.order[i]} */")
        for p in range(rows.first[i], rows.first[i + 1]):
            entry = entries.get(p, "0.0")
            lines.append(f"factors[{p}] = {f'shift - {entry}' if p == pivot else f'-{entry}'};")
        for p in rows.lower[i]:
            k = pattern[p][1]
            for q in rows.upper[k]:
                lines.append(f"factors[{rows.places[i, pattern[q][1]]}] -= factors[{p}] * factors[{q}];")
        lines.append(f"factors[{pivot}] = 1.0 / factors[{pivot}];")
        lines += [f"factors[{p}] *= factors[{rows.pivot[pattern[p][1]]}];" for p in rows.lower[i]]
        lines += [f"factors[{p}] *= factors[{pivot}];" for p in rows.upper[i]]
    unused = [] if elimination.jacobian else ["(void)jacobian;"]
    return [*unused, *(lines or ["(void)shift;", "(void)factors;"])]


def _solve(elimination: Elimination, rows: _Rows) -> list[str]:
    """What solve() in runtime/numerics/lu.c does, in the same order."""
    pattern, order = elimination.pattern, elimination.order
    lines = []
    for i, lower in enumerate(rows.lower):
        terms = "".join(f" - factors[{p}] * y{pattern[p][1]}" for p in lower)
        lines.append(f"const double y{i} = b[{order[i]}]{terms};")
    for i in reversed(range(len(order))):
        terms = "".join(f" - factors[{p}] * x{pattern[p][1]}" for p in reversed(rows.upper[i]))
        lines.append(f"const double x{i} = y{i} * factors[{rows.pivot[i]}]{terms};")
    lines += [f"x[{state}] = x{i};" for i, state in enumerate(order)]
    return lines or ["(void)factors;", "(void)b;", "(void)x;"]


def _subtract_product(elimination: Elimination) -> list[str]:
    """What subtract_product() in runtime/numerics/lu.c does, in the same order."""
    lines = [f"b[{i}] -= shift * x[{i}];" for i in range(len(elimination.order))]
    lines += [f"b[{i}] += jacobian[{e}] * x[{j}];" for e, (i, j) in enumerate(elimination.jacobian)]
    return [
        *([] if elimination.jacobian else ["(void)jacobian;"]),
        *(lines or ["(void)shift;", "(void)x;", "(void)b;"]),
    ]
