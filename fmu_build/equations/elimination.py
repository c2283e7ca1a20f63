"""The order in which the integrator's matrix I/(gamma h) - J is eliminated, and where its factors are not zero.

Every pivot is taken from the diagonal, so that the pattern of the factors is known when the model is built. (SciPy's
minimum degree orders the pattern of A + A', and few Jacobians are symmetric.)
"""

from __future__ import annotations

from collections.abc import Iterable

from ..ir.models import Elimination


def eliminate(entries: Iterable[tuple[int, int]], count: int) -> Elimination:
    """Order ``count`` pivots so that little fills in, and follow what does.

    ``entries`` are (row, column) of the Jacobian's entries. The next pivot has the least product of the numbers of
    other entries in its row and in its column (H. M. Markowitz, The elimination form of the inverse and its application
    to linear programming, Management Science 3 (1957) 255-269). Of several it is the one that waits for the shortest
    chain of earlier ones, so that a processor can work on several at once; then the first.
    """
    jacobian = tuple(entries)
    columns = [{i} for i in range(count)]  # of the entries in each row that is left
    rows = [{i} for i in range(count)]  # in each column
    for i, j in jacobian:
        columns[i].add(j)
        rows[j].add(i)
    chain = [0] * count
    left = set(range(count))
    order: list[int] = []
    places: list[tuple[int, int]] = []
    while left:
        pivot = min(left, key=lambda k: ((len(columns[k]) - 1) * (len(rows[k]) - 1), chain[k], k))
        left.remove(pivot)
        order.append(pivot)
        right, below = columns[pivot] - {pivot}, rows[pivot] - {pivot}
        places += [(pivot, pivot), *((pivot, j) for j in right), *((i, pivot) for i in below)]
        for i in below:
            columns[i] = (columns[i] | right) - {pivot}
        for j in right:
            rows[j] = (rows[j] | below) - {pivot}
        for k in right | below:
            chain[k] = max(chain[k], chain[pivot] + 1)
    position = {state: k for k, state in enumerate(order)}
    return Elimination(jacobian, tuple(order), tuple(sorted((position[i], position[j]) for i, j in places)))
