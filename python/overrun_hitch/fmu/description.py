"""What an FMU file says of itself, without being loaded."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from overrun_hitch.fmu.translation import REALS
from overrun_hitch.fmu.unpacking import to_read, unpacked
from overrun_hitch.foreign.candidates import Candidate


@dataclass(frozen=True)
class Variable:
    """A real parameter or input as an FMU describes it."""

    unit: str  # "" where the FMU gives none
    description: str
    low: float  # -inf: no limit
    high: float


@dataclass(frozen=True)
class Description:
    """What an FMU file says of itself, without being loaded."""

    guid: str
    parameters: Mapping[str, Variable]
    inputs: Mapping[str, Variable]
    interpolates: bool  # takes slopes of its inputs


def described(fmu: Path) -> Description:
    """What the FMU file says of its parameters and inputs. HitchError for a file that is none or of another kind."""
    with unpacked(fmu, wanted=to_read) as (description, _):
        tables = {
            causality: {
                variable.name: Variable(
                    unit=variable.unit or "",
                    description=variable.description or variable.name,
                    low=-np.inf if variable.min is None else float(variable.min),
                    high=np.inf if variable.max is None else float(variable.max),
                )
                for variable in description.modelVariables
                if variable.type == "Real" and variable.causality == causality
            }
            for causality in ("parameter", "input")
        }
        interpolates = bool(description.coSimulation.canInterpolateInputs)
        return Description(str(description.guid), tables["parameter"], tables["input"], interpolates)


def variables(fmu: Path) -> Iterator[Candidate]:
    """The real inputs, outputs and parameters of an FMU of any kind. HitchError for a file that is none."""
    with unpacked(fmu, lambda *_: None, to_read) as (description, _):
        for variable in description.modelVariables:
            kind = "output" if variable.causality == "local" else variable.causality
            if variable.type in REALS and kind in ("input", "output", "parameter"):
                yield Candidate(variable.name, variable.unit, variable.description or "", kind)
