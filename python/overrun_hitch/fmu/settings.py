"""How finely a run is computed and written."""

from __future__ import annotations

from overrun_hitch.parameters import Quantities, quantity


class Settings(Quantities):
    """How finely a run is computed and how finely it is written."""

    relative_tolerance: float = quantity(1e-6, "", "relative tolerance of the integrator", ge=1e-12, le=1e-2)
    communication_step: float = quantity(0.01, "s", "communication step", ge=1e-6)
