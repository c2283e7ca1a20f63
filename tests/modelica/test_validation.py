"""Every class of the package Validation: the component does what its closed form says, and a changed one does not."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np
import pytest

from tests.kept import LIBRARY, kept_fmus
from tests.sampling import sampled
from tests.unit import Unit

CLASSES = (LIBRARY / "Validation" / "package.order").read_text().split()
# The others in `make test-all`.
SAMPLED = {"Drawbar", "WheelAtRest", "SteadyBraking"}
STEPS = 500
BOUND = 1e-6  # of the largest value that is expected


@pytest.fixture(scope="module", params=sampled(CLASSES, SAMPLED))
def checked(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, Unit]]:
    """Name of the class, and its unit."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("CFLAGS", "-O0")  # compiling takes longer than all that follows
        fmu = kept_fmus(f"Validation.{request.param}", fmi=2)[request.param]
    unit = Unit(fmu, tmp_path_factory.mktemp(request.param))
    unit.slave.instantiate()
    yield request.param, unit
    unit.slave.freeInstance()


def simulate(unit: Unit, **changes: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """`value`, `expected` and `error` over the class's own experiment."""
    h = float(unit.description.defaultExperiment.stopTime) / STEPS
    unit.slave.reset()
    unit.start(**changes)
    rows = [unit.get("value", "expected", "error")]
    for n in range(STEPS):
        unit.slave.doStep(n * h, h)
        rows.append(unit.get("value", "expected", "error"))
    value, expected, error = np.array(rows).T
    return value, expected, error


def test_the_component_does_what_its_closed_form_says(checked: tuple[str, Unit]) -> None:
    name, unit = checked
    value, expected, error = simulate(unit)
    np.testing.assert_array_equal(error, value - expected)
    size = np.abs(expected).max()
    print(f"{name}: off by {np.abs(error).max() / size:.1e} of {size:g}")
    assert np.ptp(value) > 0.5 * size > 0.0
    assert np.abs(error).max() < BOUND * size


def test_a_changed_component_does_not(checked: tuple[str, Unit]) -> None:
    """Whatever the class gives to its component, a tenth more of it is found out."""
    name, unit = checked
    text = (LIBRARY / "Validation" / f"{name}.mo").read_text()
    found = re.search(r"^  (?:Components|Systems)\.\w+ (\w+)\((.*?)\) \"[A-Z]", text, re.MULTILINE)
    assert found, f"{name}: no component that is given something"
    instance, given = found.groups()
    starts = {v.name: float(v.start) for v in unit.description.modelVariables if v.causality == "parameter"}
    names = [f"{instance}.{p}" for p in re.findall(r"(\w+) ?=", given) if f"{instance}.{p}" in starts]
    assert names
    for parameter in names:
        # A value given through several levels is, once flattened, the value of a parameter on each.
        same = [other for other in starts if other.startswith(f"{instance}.") and starts[other] == starts[parameter]]
        _, expected, error = simulate(unit, **dict.fromkeys(same, 1.1 * starts[parameter]))
        assert np.abs(error).max() > 1e3 * BOUND * np.abs(expected).max(), parameter
