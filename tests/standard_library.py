"""The Modelica Standard Library, where MODELICAPATH names one."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

FOLDER = next(
    (
        path
        for folder in os.environ.get("MODELICAPATH", "").split(os.pathsep)
        for path in sorted(Path(folder or os.devnull).glob("Modelica*"))
        if (path / "Mechanics" / "package.mo").is_file()
    ),
    Path(os.devnull),
)
needed = pytest.mark.skipif(not FOLDER.is_dir(), reason="MODELICAPATH names no Modelica Standard Library")
