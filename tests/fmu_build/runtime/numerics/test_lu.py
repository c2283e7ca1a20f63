"""The sparse factors against numpy: patterns, fill, accuracy without pivoting, what is refused."""

from __future__ import annotations

import ctypes
import subprocess
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from fmu_build.codegen import elimination as c_elimination
from fmu_build.codegen.elimination import print_elimination
from fmu_build.equations.elimination import eliminate
from fmu_build.fmu.compile import RUNTIME, WARNINGS, compiler
from tests.sampling import sampled

EPSILON = np.finfo(float).eps
VARIABLES = """
#ifndef VARIABLES_H
#define VARIABLES_H
#define N_COUPLINGS 0
enum {{ N_STATES = {}, N_INPUTS = 0, N_PARAMETERS = 0, N_RELATIONS = 0, N_VARIABLES = 1 + 2 * N_STATES }};
typedef union {{ double at[N_VARIABLES]; }} Variables;
#endif
"""


class Factors:
    """runtime/lu.c for one pattern."""

    def __init__(self, entries: list[tuple[int, int]], count: int, folder: Path) -> None:
        self.elimination = eliminate(entries, count)
        folder.mkdir()
        files = {**print_elimination(self.elimination).files, "variables.h": VARIABLES.format(count), "unit.h": ""}
        for name, text in files.items():
            (folder / name).write_text(text, encoding="utf-8")
        sources = [str(RUNTIME / "numerics" / "lu.c"), str(folder / "elimination.c")]
        flags = ["-std=c11", "-O2", "-ffp-contract=off", "-fPIC", "-shared", *WARNINGS, "-Werror"]
        command = [
            *compiler(),
            *flags,
            f"-I{folder}",
            f"-I{RUNTIME}",
            f"-I{RUNTIME / 'numerics'}",
            *sources,
            "-o",
            str(folder / "lu.so"),
            "-lm",
        ]
        subprocess.run(command, check=True)
        self._library = ctypes.CDLL(str(folder / "lu.so"))
        self._library.lu_factorize.restype = ctypes.c_bool
        self._factors = np.full(len(self.elimination.pattern), np.nan)

    def make(self, jacobian: np.ndarray, shift: float) -> bool:
        values = np.array([jacobian[place] for place in self.elimination.jacobian])
        pointers = [ctypes.c_void_p(a.ctypes.data) for a in (values, self._factors)]
        return bool(self._library.lu_factorize(pointers[0], ctypes.c_double(shift), pointers[1]))

    def solve(self, b: np.ndarray) -> np.ndarray:
        x = np.full_like(b, np.nan)
        self._library.lu_solve(*(ctypes.c_void_p(a.ctypes.data) for a in (self._factors, b, x)))
        return x

    def error(self, jacobian: np.ndarray, shift: float, b: np.ndarray, x: np.ndarray) -> np.ndarray:
        values = np.array([jacobian[place] for place in self.elimination.jacobian])
        result = np.full_like(b, np.nan)
        v, f, *others = (ctypes.c_void_p(a.ctypes.data) for a in (values, self._factors, b, x, result))
        self._library.lu_error(v, ctypes.c_double(shift), f, *others)
        return result


def places(jacobian: np.ndarray) -> list[tuple[int, int]]:
    return [(int(i), int(j)) for i, j in np.argwhere(jacobian)]


def backward_error(jacobian: np.ndarray, shift: float, x: np.ndarray, b: np.ndarray) -> float:
    """Least relative change of the entries that makes x exact (Oettli and Prager 1964); no matter in which units."""
    matrix = shift * np.eye(len(b)) - jacobian
    scale = np.abs(matrix) @ np.abs(x) + np.abs(b)
    return float(np.max(np.abs(b - matrix @ x) / np.where(scale > 0.0, scale, 1.0), initial=0.0))


def exact_solution(jacobian: np.ndarray, shift: float, b: np.ndarray) -> np.ndarray:
    """In rational arithmetic, with pivots wherever they are not zero."""
    n = len(b)
    rows = [[Fraction(shift) * (i == j) - Fraction(jacobian[i, j]) for j in range(n)] for i in range(n)]
    rows = [[*row, Fraction(value)] for row, value in zip(rows, b, strict=True)]
    for k in range(n):
        at = next(i for i in range(k, n) if rows[i][k] != 0)
        rows[k], rows[at] = rows[at], rows[k]
        for i in range(n):
            if i != k and rows[i][k] != 0:
                factor = rows[i][k] / rows[k][k]
                rows[i] = [a - factor * c for a, c in zip(rows[i], rows[k], strict=True)]
    return np.array([float(row[n] / row[k]) for k, row in enumerate(rows)])


def rounding(jacobian: np.ndarray, shift: float, b: np.ndarray, x: np.ndarray) -> float:
    """How far x moves at most if each entry is changed by four roundings."""
    matrix = shift * np.eye(len(b)) - jacobian
    return float(4 * EPSILON * (np.abs(np.linalg.inv(matrix)) @ (np.abs(matrix) @ np.abs(x) + np.abs(b))).max())


def reactions(rng: np.random.Generator, count: int) -> np.ndarray:
    """Kinetics of first order, rates over fifteen decades."""
    jacobian = np.zeros((count, count))
    for i, j in rng.integers(count, size=(2 * count, 2)):
        if i != j:
            rate = 10 ** rng.uniform(-3, 12)
            jacobian[j, j] -= rate
            jacobian[i, j] += rate
    return jacobian


def springs(rng: np.random.Generator, count: int) -> np.ndarray:
    """A chain of masses, the first one tied to the ground; every other spring has no damper."""
    mass, stiffness = 10 ** rng.uniform(-3, 3, count), 10 ** rng.uniform(0, 12, count)
    damping = 10 ** rng.uniform(-2, 6, count) * (rng.random(count) < 0.5)
    stretch = np.eye(count) - np.eye(count, k=-1)
    return np.block(
        [
            [np.zeros((count, count)), np.eye(count)],
            [-(stretch.T * stiffness) @ stretch / mass[:, None], -(stretch.T * damping) @ stretch / mass[:, None]],
        ]
    )


def scattered(rng: np.random.Generator, count: int) -> np.ndarray:
    """Entries anywhere, over nine decades, moved to the left until all modes are stable."""
    some = rng.random((count, count)) < 3 / count
    jacobian = np.where(some, rng.standard_normal((count, count)) * 10 ** rng.uniform(-3, 6, (count, count)), 0.0)
    return jacobian - max(0.0, np.linalg.eigvals(jacobian).real.max(initial=0.0)) * np.eye(count)


SYSTEMS = {"reactions": reactions, "springs": springs, "scattered": scattered}


@pytest.mark.parametrize("count", [1, 2, 7, 30])
def test_written_out_or_by_table_the_same_bits(count: int, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    rng = np.random.default_rng(count)
    jacobian = scattered(rng, count)
    b = rng.standard_normal(count)
    solutions, errors = [], []
    for limit in (0, 10**6):
        monkeypatch.setattr(c_elimination, "MOST_WRITTEN_OUT", limit)
        factors = Factors(places(jacobian), count, tmp_path / str(limit))
        assert factors.make(jacobian, 1e3)
        solutions.append(factors.solve(b))
        errors.append(factors.error(jacobian, 1e3, b, 1.001 * solutions[0]))
    np.testing.assert_array_equal(*solutions)
    np.testing.assert_array_equal(*errors)
    np.testing.assert_allclose(solutions[0], np.linalg.solve(1e3 * np.eye(count) - jacobian, b), rtol=1e-9)
    np.testing.assert_allclose(errors[0], -0.001 * solutions[0], rtol=1e-9)


def test_fill() -> None:
    tridiagonal = [(i, j) for i in range(50) for j in (i - 1, i, i + 1) if 0 <= j < 50]
    assert len(eliminate(tridiagonal, 50).pattern) == len(tridiagonal)
    hub_first = [(i, 0) for i in range(50)] + [(0, j) for j in range(1, 50)]
    assert len(eliminate(hub_first, 50).pattern) == len(hub_first) + 49
    side = 12
    grid = np.kron(np.eye(side), np.eye(side, k=1) + np.eye(side, k=-1))
    grid += np.kron(np.eye(side, k=1) + np.eye(side, k=-1), np.eye(side))
    banded = side**2 * (2 * side + 1) - side * (side + 1)  # what the natural order fills
    assert len(eliminate(places(grid), side**2).pattern) < 0.6 * banded


def test_the_pattern_holds_all_that_fills(tmp_path: Path) -> None:
    """L D U multiplied out, from the stored factors, is the matrix."""
    rng = np.random.default_rng(3)
    for number in range(5):
        jacobian = scattered(rng, 12)
        factors = Factors(places(jacobian), 12, tmp_path / str(number))
        assert factors.make(jacobian, 1e3)
        stored = np.zeros((12, 12))
        for (i, j), value in zip(factors.elimination.pattern, factors._factors, strict=True):
            stored[i, j] = value
        lower, upper = np.tril(stored, -1) + np.eye(12), np.triu(stored, 1) + np.eye(12)
        order = np.ix_(factors.elimination.order, factors.elimination.order)
        product = lower @ np.diag(1.0 / np.diag(stored)) @ upper
        np.testing.assert_allclose(product, (1e3 * np.eye(12) - jacobian)[order], rtol=1e-9, atol=1e-6)


@pytest.mark.parametrize("name", sampled(SYSTEMS, ["reactions", "scattered"]))
def test_stiff_systems(name: str, tmp_path: Path) -> None:
    """Steps of a millisecond and of a second. What digits are lost, beyond those that rounding the matrix costs, is
    told."""
    rng = np.random.default_rng(7)
    worst = {1e-3: 0.0, 1.0: 0.0}
    for number in range(6):
        jacobian = SYSTEMS[name](rng, 10)
        count = len(jacobian)
        factors = Factors(places(jacobian), count, tmp_path / str(number))
        for length in worst:
            shift, b = 1.0 / (0.21 * length), rng.standard_normal(count)
            assert factors.make(jacobian, shift)
            x = factors.solve(b)
            worst[length] = max(worst[length], backward_error(jacobian, shift, x, b))
            exact = exact_solution(jacobian, shift, b)
            told = np.abs(factors.error(jacobian, shift, b, x)).max()
            assert np.abs(x - exact).max() <= 2.0 * told + rounding(jacobian, shift, b, exact)
    print(name, worst)
    assert worst[1e-3] < 1e-13
    assert worst[1.0] < (1e-9 if name == "springs" else 1e-11)


@pytest.mark.parametrize("jacobian", [np.array([[4.0]]), np.array([[4.0, 1.0], [0.0, -1.0]]), np.array([[np.nan]])])
def test_no_pivot(jacobian: np.ndarray, tmp_path: Path) -> None:
    factors = Factors(places(jacobian), len(jacobian), tmp_path / "lu")
    assert not factors.make(jacobian, 4.0)
    if np.isfinite(jacobian).all():
        assert factors.make(jacobian, 5.0)
