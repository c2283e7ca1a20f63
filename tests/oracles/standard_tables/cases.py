"""Tables by smoothness, extrapolation and kind of events, numbered as in Modelica.Blocks.Types, and where they are
read.

A name such as ``time_1_3_2``: a table of time, linear, periodic, with events where it jumps.
"""

from __future__ import annotations

from collections.abc import Iterator

POINTS = [0.25, 1.0, 1.5, 2.5, 3.0, 4.5]
REPEATED = [0.25, 1.0, 1.0, 2.5, 3.0, 4.5]  # of what may jump
VALUES = [1.0, 2.0, 2.5, 2.5, -1.0, 0.5]
START, SHIFT = 0.4, 0.35
TIMES = [0.01 + 0.13 * i for i in range(107)]  # none at a point, in any period


def names() -> Iterator[str]:
    """All tables."""
    for smoothness in range(1, 7):
        for extrapolation in range(1, 4):
            yield f"curve_{smoothness}_{extrapolation}_0"
            for events in {1: (1, 2, 3), 3: (1,)}.get(smoothness, (3,)):
                yield f"time_{smoothness}_{extrapolation}_{events}"


def parts(name: str) -> tuple[str, int, int, int]:
    """Kind, smoothness, extrapolation, events."""
    kind, *numbers = name.split("_")
    smoothness, extrapolation, events = map(int, numbers)
    return kind, smoothness, extrapolation, events


def curve(time: float) -> float:
    """Where a table that is none of time is read."""
    return time - 5.033
