"""What a sweep is to be, as the user writes it: SPEC.toml or keyword arguments. Its shape is checked here, names and
ranges of quantities in planner.py.

All numbers are in SI units. The runs are every combination of what the parts list: FMUs, profiles, each axis of `grid`,
the rows of `runs`, the points of `sample`.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Discriminator, Field, Strict, Tag, ValidationError

from overrun_hitch.parameters import HitchError, unknown
from overrun_hitch.toml_file import read_toml

Number = Annotated[float, Strict(), Field(allow_inf_nan=False)]  # no text, no true and false
Count = Annotated[int, Strict()]
Numbers = Annotated[list[Number], Field(min_length=1)]


class _Part(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class Span(_Part):
    """From `min` to `max`."""

    min: Number
    max: Number


class Range(Span):
    """`count` values from `min` to `max`, both included, at even distances or ratios."""

    count: Annotated[Count, Field(ge=2)]
    scale: Literal["linear", "log"] = "linear"


class Sample(_Part):
    """`count` points that fill the `ranges`; the same `seed` gives the same points."""

    method: Literal["sobol", "latin-hypercube"]
    count: Annotated[Count, Field(ge=1)]
    seed: Annotated[Count, Field(ge=0)] = 0
    ranges: Annotated[dict[str, Span], Field(min_length=1)]


def _kind(axis: object) -> str:
    return "values" if isinstance(axis, list | tuple) else "range"


Axis = Annotated[Annotated[Numbers, Tag("values")] | Annotated[Range, Tag("range")], Discriminator(_kind)]


class SweepSpec(_Part):
    """A sweep of step brakes, or of brakings by profiles. HitchError for anything that has not this shape."""

    name: Annotated[str, Field(pattern=r"^[\w .,=+-]{1,80}$")] = "sweep"
    case: str | None = None  # the paper's, as the base; else figure 8
    duration: Number = 6.0  # s
    communication_step: Number = 0.01  # s, also from output point to output point
    relative_tolerance: Number = 1e-6
    fmus: list[str] = []  # files; none: our own
    metrics: list[str] | None = None  # names in metrics.METRICS; None: all
    trajectories: list[str] = []  # names in results.VARIABLES to keep at every output point
    parameters: dict[str, Number] = {}  # parameters and inputs that stay the same
    profiles: dict[str, dict[str, Numbers]] = {}  # name: {"time": knots in s, input: values there}
    grid: dict[str, Axis] = {}
    runs: dict[str, Numbers] = {}  # columns of equal length
    sample: Sample | None = None

    def __init__(self, **values: Any) -> None:
        try:
            super().__init__(**values)
        except ValidationError as error:
            raise HitchError(_explained(error.errors()[0])) from None

    @property
    def varied(self) -> set[str]:
        """The quantities in which runs differ."""
        return {*self.grid, *self.runs, *(self.sample.ranges if self.sample else ())}

    def changed(self, parameters: Mapping[str, float]) -> SweepSpec:
        """A copy with these parameters (SI units) that stay the same, instead of or beside its own."""
        return self.model_copy(update={"parameters": {**self.parameters, **parameters}})


def read_spec(file: Path) -> SweepSpec:
    """The spec in a TOML file; FMU files in it are relative to its folder. HitchError, naming the file."""
    table = read_toml(file)
    try:
        spec = SweepSpec(**table)
    except HitchError as error:
        raise HitchError(f"{file}: {error}") from None
    return spec.model_copy(update={"fmus": [str(file.parent / fmu) for fmu in spec.fmus]})


def _explained(error: Any) -> str:
    """One line for the first thing that pydantic found wrong."""
    place = [str(part) for part in error["loc"] if part not in ("values", "range")]
    if error["type"] == "extra_forbidden":
        part: type[BaseModel] = SweepSpec
        if len(place) > 1:
            part = Range if place[0] == "grid" else Span if place[1] == "ranges" else Sample
        return unknown(f"setting in {'.'.join(place[:-1]) or 'a sweep'}", place[-1], part.model_fields)
    shown = "" if error["type"] == "missing" else f" = {error['input']!r:.40}"
    return f"{'.'.join(place)}{shown} is not allowed: {error['msg'][:1].lower()}{error['msg'][1:]}"
