"""Modelica in, FMU out.

import fmu_build

fmu_build.build("model M Real x(start=1, fixed=true); equation der(x) = -x; end M;")  # M.fmu
fmu_build.build("Library", "Library.Examples.Damper", "damper.fmu", fmi=3)

``pipeline.build`` shows every stage in order; ``python -m fmu_build`` is the command line. The package knows Modelica,
C and FMI, and nothing of any particular model.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .api import build
    from .errors import BuildError

_HOMES = {"build": "api", "BuildError": "errors"}  # loaded when they are asked for
__all__ = ["BuildError", "build"]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
