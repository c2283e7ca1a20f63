"""Compiled models and instances of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from runtime_models import Model
from runtime_unit import Library, Unit, compile_model


@pytest.fixture(scope="session")
def library(tmp_path_factory: pytest.TempPathFactory) -> Callable[[Model], Library]:
    """Each model is compiled once a session."""
    compiled: dict[str, Library] = {}

    def get(model: Model) -> Library:
        if model.name not in compiled:
            compiled[model.name] = compile_model(model, tmp_path_factory.mktemp(model.name))
        return compiled[model.name]

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
