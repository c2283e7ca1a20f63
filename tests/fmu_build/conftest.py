"""Small Modelica models, written by the tests themselves."""

from __future__ import annotations

import ctypes
import re
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from fmpy.validation import validate_fmu

from fmu_build.codegen.elimination import print_elimination
from fmu_build.codegen.model import print_c
from fmu_build.equations.derive import derive
from fmu_build.equations.elimination import eliminate
from fmu_build.equations.initialize import initialize
from fmu_build.equations.jacobian import differentiate
from fmu_build.equations.lower import lower
from fmu_build.equations.sort import sort
from fmu_build.fmu.compile import RUNTIME, WARNINGS, compiler
from fmu_build.frontend.flatten import flatten
from fmu_build.ir.dependencies import start_value
from fmu_build.ir.models import SortedModel
from fmu_build.pipeline import build
from tests.kept import kept

Writer = Callable[[str], Path]
Build = Callable[[str, int], Path]


@pytest.fixture(scope="session")
def built() -> Build:
    """The FMU of a Modelica text (its last class) in a version of FMI.

    Compilers take most of the time of these tests: what they optimize is left to the other tests.
    """

    def get(text: str, fmi: int) -> Path:
        name = re.findall(r"^(?:model|block|package) (\w+)", text, re.MULTILINE)[-1]

        def make(folder: Path) -> None:
            (folder / f"{name}.mo").write_text(text, encoding="utf-8")
            build(folder / f"{name}.mo", name, folder / f"{name}.fmu", fmi)
            assert validate_fmu(str(folder / f"{name}.fmu")) == []

        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("CFLAGS", "-O0 -Werror")
            return kept(make, "FMU of a text", text, str(fmi)) / f"{name}.fmu"

    return get


@pytest.fixture
def modelica_file(tmp_path: Path) -> Writer:
    """Write the text of class M to a file of its own folder."""

    def write(text: str) -> Path:
        path = tmp_path / "M.mo"
        path.write_text(text, encoding="utf-8")
        return path

    return write


@pytest.fixture
def sorted_model(modelica_file: Writer) -> Callable[[str], SortedModel]:
    """Class M of a text, up to the intermediate representation."""
    return lambda text: sort(initialize(derive(lower(flatten(modelica_file(text), "M")))))


class CompiledModel:
    """The generated C of a model, without the runtime, behind numpy arrays."""

    def __init__(self, model: SortedModel, folder: Path) -> None:
        jacobian = differentiate(model)
        algebra = print_elimination(eliminate(jacobian.entries, len(model.states)))
        files = {**print_c(model, jacobian, "M").files, **algebra.files}
        for name, text in files.items():
            (folder / name).write_text(text, encoding="utf-8")
        (folder / "unit.h").touch()
        library = folder / "model.so"
        flags = ["-std=c11", "-O1", "-fPIC", "-shared", *WARNINGS, "-Werror", f"-I{folder}", f"-I{RUNTIME}"]
        flags.append(f"-I{RUNTIME / 'numerics'}")
        sources = [str(folder / "model.c"), *(str(RUNTIME / name) for name in ("numerics/loops.c", "message.c"))]
        subprocess.run([*compiler(), *flags, *sources, "-o", str(library), "-lm"], check=True)
        self._library = ctypes.CDLL(str(library))
        self.model = model
        self._entries = tuple(jacobian.entries)
        self.references = model.value_references
        steady = re.search(r"double steady\[(\d+)\]", files["variables.h"])
        self.at = np.zeros(len(self.references) + (int(steady[1]) if steady else 0))
        for name in (*model.parameters, *model.states, *model.inputs):
            self.at[self.references[name]] = start_value(name, model)
        self._call("model_parameters")
        self._call("model_start", self.relations() > 0)

    def _call(self, function: str, *arrays: np.ndarray) -> None:
        getattr(self._library, function)(*(ctypes.c_void_p(a.ctypes.data) for a in (self.at, *arrays)))

    def __getitem__(self, name: str) -> float:
        return float(self.at[self.references[name]])

    def __setitem__(self, name: str, value: float) -> None:
        self.at[self.references[name]] = value

    def relations(self) -> np.ndarray:
        """Residuals of the relations at the present values; a relation may depend on the truth of others."""
        z = np.zeros(max(1, len(self.model.relations)))
        self._call("model_steady")
        for _ in range(z.size + 1):
            self._call("model_relations", z > 0, z)
        return z

    def outputs(self) -> None:
        self._call("model_parameters")
        self._call("model_outputs", self.relations() > 0)

    def derivatives(self) -> np.ndarray:
        self._call("model_derivatives", self.relations() > 0)
        return np.array([self[name] for name in self.model.derivatives])

    def derivatives_by(self, name: str) -> np.ndarray:
        """The same where nothing has changed since but this input."""
        holds = self.relations() > 0
        number = ctypes.c_int(self.model.inputs.index(name))
        at, truths = (ctypes.c_void_p(a.ctypes.data) for a in (self.at, holds))
        self._library.model_derivatives_by(at, truths, number)
        return np.array([self[name] for name in self.model.derivatives])

    def jacobian(self) -> np.ndarray:
        count = len(self.model.states)
        jacobian, time_derivative = np.zeros((count, count)), np.full(count, np.nan)
        entries = np.full(len(self._entries), np.nan)
        self.derivatives()
        self._call("model_jacobian", self.relations() > 0, entries, time_derivative)
        for place, value in zip(self._entries, entries, strict=True):
            jacobian[place] = value
        return np.column_stack([jacobian, time_derivative])

    def tangent(self, seeds: dict[str, float], at_start: bool) -> dict[str, float]:
        return self._chained("model_tangent", seeds, at_start)

    def input_tangent(self, seeds: dict[str, float]) -> dict[str, float]:
        return self._chained("model_input_tangent", seeds, None)

    def adjoint(self, seeds: dict[str, float], at_start: bool) -> dict[str, float]:
        return self._chained("model_adjoint", seeds, at_start)

    def _chained(self, function: str, seeds: dict[str, float], at_start: bool | None) -> dict[str, float]:
        d = np.zeros(len(self.at))
        for name, value in seeds.items():
            d[self.references[name]] = value
        holds = self.relations() > 0
        *known, seeded = (ctypes.c_void_p(a.ctypes.data) for a in (self.at, holds, d))
        choice = () if at_start is None else (ctypes.c_bool(at_start),)
        getattr(self._library, function)(*known, *choice, seeded)
        return {name: float(d[reference]) for name, reference in self.references.items()}


@pytest.fixture
def compiled_model(sorted_model: Callable[[str], SortedModel], tmp_path: Path) -> Callable[[str], CompiledModel]:
    return lambda text: CompiledModel(sorted_model(text), tmp_path)
