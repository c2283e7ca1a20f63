"""An FMU that is made only where something that goes into it has changed; what is kept is ``cache``'s affair."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from .cache import Part, kept, tools
from .fmu.archive import check_output, write
from .fmu.compile import compilers, named_platforms
from .frontend.loading import readable_files

PACKAGE = Path(__file__).parent


def rebuild(
    modelica: Path,
    class_name: str,
    output: Path,
    fmi: int = 2,
    platforms: Sequence[str] = ("host",),
    progress: Callable[[str], object] = lambda _: None,
    references: bool = True,
    libraries: Sequence[Path] = (),
) -> None:
    """As ``pipeline.build``, to the same bytes. Raises BuildError; then nothing is written."""
    chosen = named_platforms(platforms)
    check_output(output)

    def parts() -> Iterator[Part]:
        progress("comparing with earlier builds")
        yield from (os.path.abspath(modelica), class_name, f"FMI {fmi}, references: {references}")
        yield from (*tools(), *compilers(chosen))
        yield from sorted(path for path in PACKAGE.rglob("*") if path.is_file() and path.suffix != ".pyc")
        yield from readable_files(modelica, libraries)

    def make() -> bytes:
        progress("loading SymPy and others")  # for which nobody should wait if nothing has changed
        from .pipeline import made

        return made(modelica, class_name, fmi, chosen, progress, references, libraries)

    write(output, kept(parts, make))
