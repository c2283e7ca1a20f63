"""linear.py and steady.py are the independent check: they may see numpy and the parameters, and nothing of the FMU."""

from __future__ import annotations

import ast
import sys
from pathlib import Path

import pytest

import overrun_hitch

PACKAGE = Path(overrun_hitch.__file__).parent


def imports(module: str) -> set[str]:
    """Every module imported anywhere in the source, the standard library's apart."""
    names: set[str] = set()
    for node in ast.walk(ast.parse((PACKAGE / f"{module}.py").read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            names.add("." * node.level + (node.module or ""))
    return {name for name in names if name.split(".")[0] not in sys.stdlib_module_names}


@pytest.mark.parametrize("module", ["theory/linear", "theory/steady"])
def test_theory_sees_numpy_and_parameters_alone(module: str) -> None:
    assert imports(module) <= {"numpy", "numpy.typing", "overrun_hitch.parameters"}


def test_the_boundary_sees_theory_and_a_root_finder_alone() -> None:
    assert imports("theory/boundary") <= {
        "numpy",
        "scipy.optimize",
        "overrun_hitch.theory.linear",
        "overrun_hitch.parameters",
    }


def test_parameters_see_pydantic_alone() -> None:
    assert imports("parameters") == {"pydantic"}


def test_fmpy_is_kept_in_one_folder() -> None:
    modules = [path.relative_to(PACKAGE).with_suffix("") for path in PACKAGE.rglob("*.py")]
    users = {module.parts[0] for module in modules if any(name.startswith("fmpy") for name in imports(str(module)))}
    assert users == {"fmu"}
