"""Which number is not finite: against numpy, for arrays of all lengths and numbers of all sizes."""

from __future__ import annotations

import ctypes
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.fmu_build.runtime.hand_written import Model
from tests.fmu_build.runtime.runtime_models import SMOOTH
from tests.fmu_build.runtime.runtime_unit import Library

LARGE = st.sampled_from([1.7e308, -1.7e308, 0.0, -5e-324])  # whose sums overflow


@pytest.fixture(scope="module")
def find(library: Callable[[Model], Library]) -> Callable[[list[float]], int]:
    dll = library(SMOOTH).dll

    def call(numbers: list[float]) -> int:
        array = np.array(numbers)
        return int(dll.probe_first_not_finite(ctypes.c_void_p(array.ctypes.data), len(numbers)))

    return call


@settings(max_examples=300, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(numbers=st.lists(LARGE | st.floats(), max_size=40))
def test_first_not_finite(find: Callable[[list[float]], int], numbers: list[float]) -> None:
    bad = np.flatnonzero(~np.isfinite(numbers))
    assert find(numbers) == (bad[0] if bad.size else -1)
