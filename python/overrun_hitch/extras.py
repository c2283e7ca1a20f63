"""What is installed only on request: pip install 'overrun-hitch[sweep]' and so on."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.metadata import PackageNotFoundError, requires

from overrun_hitch.parameters import HitchError

NAME = "overrun-hitch"


@contextmanager
def what_is_missing_told() -> Iterator[None]:
    """A package that is not there, of those that an extra brings, as a HitchError that names the extra."""
    try:
        yield
    except ModuleNotFoundError as error:
        package = (error.name or "").partition(".")[0]
        extra = _extra_of(package)
        if extra is None:
            raise
        raise HitchError(f"this needs {package}, which is not installed: pip install '{NAME}[{extra}]'") from None


def _extra_of(package: str) -> str | None:
    try:
        asked = requires(NAME) or []
    except PackageNotFoundError:
        return None
    found = [re.fullmatch(rf"{re.escape(package)}\b.*\bextra == ['\"](\w+)['\"].*", line, re.I) for line in asked]
    return next((match[1] for match in found if match and match[1] not in ("all", "dev")), None)
