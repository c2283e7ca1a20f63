"""What scripts call: ``fmu_build.build``."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from .errors import BuildError

_END = re.compile(r"\bend\s+(\w+)\s*;")  # of a class


def build(
    modelica: str | Path,
    class_name: str | None = None,
    output: str | Path | None = None,
    *,
    fmi: int = 2,
    platforms: str | Sequence[str] = "host",
    libraries: Sequence[str | Path] = (),
    references: bool = True,
    progress: Callable[[str], object] = lambda _: None,
) -> Path:
    """Build an FMU, for FMI version ``fmi`` (2 or 3), from Modelica; returns its path.

    modelica: a file, a library's folder, or Modelica text itself, which has a semicolon or several lines. class_name:
    the full name of the class; without, the one that ends last in a text, or that a file is named after. output: the
    file to write; without, the class's name and .fmu, in the working directory. platforms: "host", "all", "wasm", or
    names. libraries: folders of other libraries, or with libraries in them. references: with results that another tool
    computes from the class's examples. progress is told each stage.

    BuildError, in one line, for whatever the caller can mend, a missing package among it; then nothing is written.

    >>> fmu = build("model Decay Real x(start=1, fixed=true); equation der(x) = -x; end Decay;")
    >>> import fmpy
    >>> float(fmpy.simulate_fmu(fmu, stop_time=1, output=["x"])["x"][-1].round(4))
    0.3679
    """
    if fmi not in (2, 3):
        raise BuildError(f"fmi = {fmi!r:.40} is not allowed; allowed: 2 or 3")
    text = modelica if isinstance(modelica, str) and re.search("[;\n]", modelica) else None
    name = class_name or _named(modelica, text)
    target = Path(f"{name.rpartition('.')[2]}.fmu" if output is None else output)
    chosen = [platforms] if isinstance(platforms, str) else platforms
    with tempfile.TemporaryDirectory(prefix="fmu_build-") as folder:
        source = Path(modelica if text is None else Path(folder, f"{name.partition('.')[0]}.mo"))
        if text is not None:
            source.write_text(text, encoding="utf-8")
        try:
            if text is None:
                from .rebuild import rebuild as make
            else:
                from .pipeline import build as make
            make(source, name, target, fmi, chosen, progress, references, [Path(library) for library in libraries])
        except ModuleNotFoundError as error:
            raise BuildError(f"needs {error.name}: pip install 'overrun-hitch[build]'") from None
        except BuildError as error:
            raise BuildError(str(error).replace(f"{folder}{os.sep}", "")) from None  # a text's place is its line
    return target


def _named(modelica: str | Path, text: str | None) -> str:
    """The class that is meant where none is named."""
    if text is not None:
        ends = _END.findall(text)
        if not ends:
            raise BuildError("the Modelica text has no class: it must end with `end NAME;`")
        return str(ends[-1])
    file = Path(modelica)
    if file.is_dir():
        raise BuildError(f"{file} is a folder: name the class to build; a file or a text tells it by itself")
    return file.stem
