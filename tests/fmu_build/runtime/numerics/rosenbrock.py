"""Order conditions of Rosenbrock methods, from their coefficients in the transformed form."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import numpy as np


def trees(order: int) -> set[tuple]:
    """Rooted trees with `order` vertices."""

    @cache
    def forests(vertices: int) -> frozenset[tuple]:
        if vertices == 0:
            return frozenset({()})
        return frozenset(
            tuple(sorted((first, *rest)))
            for size in range(1, vertices + 1)
            for first in trees_of(size)
            for rest in forests(vertices - size)
        )

    @cache
    def trees_of(vertices: int) -> frozenset[tuple]:
        return forests(vertices - 1)

    return set(trees_of(order))


def vertices(tree: tuple) -> int:
    return 1 + sum(vertices(t) for t in tree)


def density(tree: tuple) -> int:
    result = vertices(tree)
    for t in tree:
        result *= density(t)
    return result


def all_trees(order: int) -> Iterator[tuple]:
    for n in range(1, order + 1):
        yield from trees(n)


def strictly_lower(rows: np.ndarray, stages: int) -> np.ndarray:
    """A square matrix from the rows of a table without its last column, or without its last rows too."""
    result = np.zeros((stages, stages))
    result[: len(rows), : rows.shape[1]] = rows
    return result


class Method:
    """alpha, gamma (as a matrix) from the transformed form: Hairer and Wanner II, equation IV.7.24."""

    def __init__(self, gamma: float, a: np.ndarray, c: np.ndarray) -> None:
        self.gamma = np.linalg.inv(np.eye(len(c)) / gamma - c)
        self.alpha = a @ self.gamma
        self.beta = self.alpha + self.gamma

    def stage_weights(self, tree: tuple) -> np.ndarray:
        """Hairer and Wanner II, theorem IV.7.3: beta = alpha + gamma above a vertex with one branch, else alpha."""
        matrix = self.beta if len(tree) == 1 else self.alpha
        result = np.ones(len(self.gamma))
        for t in tree:
            result = result * (matrix @ self.stage_weights(t))
        return result

    def residual(self, b: np.ndarray, tree: tuple, s: float = 1.0) -> float:
        return float(b @ self.stage_weights(tree) - s ** vertices(tree) / density(tree))

    def amplification(self, b: np.ndarray, z: complex) -> complex:
        """The stability function."""
        one = np.ones(len(self.gamma))
        return complex(1 + z * b @ np.linalg.solve(np.eye(len(one)) - z * self.beta, one))
