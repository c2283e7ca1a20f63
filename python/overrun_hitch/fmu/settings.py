"""How finely a run is computed and written, and how long it may take."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from overrun_hitch.parameters import Quantities, quantity

Use = Literal["cs", "me"]
USES: Mapping[Use, str] = {"cs": "Co-Simulation", "me": "Model Exchange"}

TIME_LIMIT = 60.0  # s: six seconds of ours take 0.3 ms, a million communication points 20 s


class Settings(Quantities):
    """How finely a run is computed and how finely it is written."""

    relative_tolerance: float = quantity(1e-6, "", "relative tolerance of the integrator", ge=1e-12, le=1e-2)
    communication_step: float = quantity(0.01, "s", "communication step", ge=1e-6)


class _Patience(Quantities):
    time_limit: float = quantity(TIME_LIMIT, "s", "time that a run may take", gt=0.0)


def checked_time_limit(seconds: float) -> float:
    """The time that a run may take. HitchError where it is none."""
    return _Patience(time_limit=seconds).time_limit
