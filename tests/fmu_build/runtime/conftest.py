"""Compiled models and instances of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest

from tests.fmu_build.runtime.hand_written import Model
from tests.fmu_build.runtime.runtime_fmi3 import Unit3
from tests.fmu_build.runtime.runtime_unit import Library, Unit, compile_model


@pytest.fixture(scope="session")
def library() -> Callable[..., Library]:
    """Each model is loaded once a session and facade."""
    loaded: dict[tuple[str, int], Library] = {}

    def get(model: Model, fmi: int = 2) -> Library:
        key = model.name, fmi
        if key not in loaded:
            loaded[key] = compile_model(model, fmi)
        return loaded[key]

    return get


@pytest.fixture
def unit(library: Callable[[Model], Library]) -> Iterator[Callable[..., Unit]]:
    """Instances, freed at the end of the test."""
    units: list[Unit] = []

    def create(model: Model, **options: object) -> Unit:
        units.append(Unit(library(model), **options))  # type: ignore[arg-type]
        return units[-1]

    yield create
    for u in units:
        u.free()


@pytest.fixture
def unit3(library: Callable[..., Library]) -> Iterator[Callable[..., Unit3]]:
    """Instances of FMI 3.0, freed at the end of the test."""
    units: list[Unit3] = []

    def create(model: Model, **options: object) -> Unit3:
        units.append(Unit3(library(model, 3), **options))  # type: ignore[arg-type]
        return units[-1]

    yield create
    for u in units:
        u.free()
