"""web/src/linear.ts against theory/linear.py: matrices, eigenvalues, the shunting mode."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from overrun_hitch.parameters import CASES, Parameters
from overrun_hitch.theory.boundary import critical_damping
from overrun_hitch.theory.linear import compression_matrix, shunting_mode, wheel_decay_rate
from tests.web.conftest import NodeRunner

KNOWN = ("M_c", "M_t", "I_c", "I_t", "R_c", "R_t", "C_kc", "C_kt", "k", "C", "rebound", "r", "tau_b", "sigma")
SEED, RANDOM = 20261128, 200
DAMPED = 9  # of which one has its boundary computed, twenty eigenvalue problems


def parameters() -> Iterator[tuple[Parameters, float]]:
    """The paper's cases at its speeds, and what lies around them: each value up to three times as large or small."""
    for case in CASES.values():
        yield from ((case.changed({"C": C}), V) for C in (0.0, 500.0, 3200.0) for V in (10.0, 20.0, 40.0))
    rng = np.random.default_rng(SEED)
    for n in range(RANDOM):
        case = CASES[list(CASES)[n % len(CASES)]].changed({"C": 500.0, "tau_b": 0.2, "sigma": 0.3})
        factors = dict(zip(KNOWN, 3.0 ** rng.uniform(-1.0, 1.0, len(KNOWN)), strict=True))
        changes = {name: getattr(case, name) * factor for name, factor in factors.items()}
        changes |= {"tau_b": changes["tau_b"] * (n % 2), "sigma": changes["sigma"] * (n // 2 % 2)}
        yield case.changed(changes), 20.0 * 3.0 ** rng.uniform(-1.0, 1.0)


def case(p: Parameters, V: float) -> dict[str, Any]:
    matrix = compression_matrix(p, V)
    values = np.linalg.eigvals(matrix).astype(complex)
    shunting = complex(shunting_mode(p, V).eigenvalue)
    return {
        "parameters": {name: getattr(p, name) for name in KNOWN},
        "V": V,
        "matrix": matrix.tolist(),
        "eigenvalues": [[value.real, value.imag] for value in values],
        "shunting": [shunting.real, shunting.imag],
        "wheels": wheel_decay_rate(p, V),
    }


def test_linear_theory(run_node: NodeRunner, tmp_path: Path) -> None:
    cases = [case(p, V) for p, V in parameters()]
    for one, (p, V) in list(zip(cases, parameters(), strict=True))[::DAMPED]:
        one["critical"] = critical_damping(p, V)
    assert {len(one["matrix"]) for one in cases} == {5, 6, 7, 8}
    file = tmp_path / "cases.json"
    file.write_text(json.dumps(cases), encoding="utf-8")
    run_node("linear", LINEAR_CASES=str(file))
