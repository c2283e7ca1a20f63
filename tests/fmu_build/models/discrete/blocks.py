"""Many small blocks in one model, each with outputs that are known functions of the time: one build tests them all."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from tests.fmu_build.models.discrete.conftest import Way

# Declarations, what stands between them and the end of the block, and the outputs as functions of the time.
Case = tuple[str, str, Mapping[str, Callable[[float], float]]]
AROUND = 1e-9  # s: at an event the value behind it counts


def text_of(name: str, cases: Mapping[str, Case], around: str = "") -> str:
    """A model of that name with a block for each case; ``around`` stands before the blocks."""
    blocks = "".join(
        f'  block B{i} "{case}"\n    {declarations}\n  {body}\n  end B{i};\n'
        for i, (case, (declarations, body, _)) in enumerate(cases.items())
    )
    components = "".join(f"  B{i} b{i};\n" for i in range(len(cases)))
    return f"model {name}\n{around}{blocks}{components}end {name};\n"


def check(
    way: Way, name: str, cases: Mapping[str, Case], around: str = "", stop: float = 1.0, step: float = 0.05
) -> None:
    """Run the model of the cases, and compare every output at every step."""
    outputs = {
        f"b{i}.{output}": (case, exact)
        for i, (case, (_, _, exacts)) in enumerate(cases.items())
        for output, exact in exacts.items()
    }
    result = way.run(text_of(name, cases, around), stop, step, list(outputs))
    for output, (case, exact) in outputs.items():
        expected = [exact(float(time)) for time in result["time"]]
        np.testing.assert_allclose(result[output], expected, rtol=1e-7, atol=1e-9, err_msg=f"{case}: {output}")


def ticks(time: float, interval: float, start: float = 0.0) -> int:
    """How often ``sample(start, interval)`` has been true from 0 up to ``time``."""
    first = max(0, int(np.ceil(-start / interval - AROUND)))
    return max(0, int(np.floor((time - start) / interval + AROUND)) - first + 1)
