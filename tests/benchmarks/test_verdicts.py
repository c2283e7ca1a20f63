"""A slow machine misses no requirement; what is slow beside the same work does."""

from __future__ import annotations

from dataclasses import replace

import pytest

from benchmarks import six_seconds, sweep
from benchmarks.contender import SCENARIO
from tests.oracles import radau

IN_C = {
    "total": [1.5e-4], "ratio": [2.5], "bytes": [4000.0], "steps": [100.0], "rejected": [5.0], "events": [1.0],
    "repeated": [0.0], "right-hand side: 1700": [4e-5],
}  # fmt: skip
SWEEP = sweep.Measured(workers=2, wall=1e-3, cpu=1.8e-3, bare_wall=1.7e-3, bare_cpu=1.7e-3, memory=(100.0, 100.0))


def judged(**changes: float) -> tuple[list[str], bool]:
    exact = radau.trajectory(SCENARIO.parameters, SCENARIO.brake_torque).compression[::10].tolist()
    changed = {what: [value] for what, value in changes.items()}
    return six_seconds.table({**IN_C, "compression": exact * six_seconds.PROCESSES, **changed})


def test_a_run_in_c() -> None:
    lines, met = judged(total=10.0)
    assert met and "CPU time: 10000.000 ms." in "\n".join(lines)


@pytest.mark.parametrize(("what", "value"), [("ratio", 3.1), ("bytes", 70000.0), ("rejected", 10.0)])
def test_a_run_in_c_that_misses(what: str, value: float) -> None:
    lines, met = judged(**{what: value})
    assert not met and sum("NOT MET" in line for line in lines) == 1


def test_a_sweep() -> None:
    slow = replace(SWEEP, wall=10.0, cpu=18.0, bare_wall=17.0, bare_cpu=17.0)
    assert sweep.is_cheap([SWEEP, slow])
    assert not sweep.is_cheap([SWEEP, replace(SWEEP, cpu=1.21 * SWEEP.bare_cpu)])
