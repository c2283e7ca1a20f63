"""CPU time of building models of growing size, stage by stage.

`python -m benchmarks.building` prints two tables: road trains, 1 to 16 of the library's drawbars between bodies, and
rods, cells of heat conduction by `for`. A stage's growth is the exponent p in time ~ size^p between the last two rows;
n log n has 1.25 between 8 and 16, and 1.15 between 1000 and 3000.
"""

from __future__ import annotations

import math
import os
import resource
import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from fmu_build import cache
from fmu_build.pipeline import build

LIBRARIES = Path(__file__).parents[1] / "modelica"
SHORT = 0.5  # s: of what takes less nobody knows the growth
ROUNDING = 0.15  # of an exponent that is measured once, on a machine that does other work too


@dataclass(frozen=True)
class Family:
    """Models of one kind: the text for each size, and the CPU time that the building of some may take, in s."""

    title: str
    text: Callable[[int], str]
    sizes: Sequence[int]
    limits: dict[int, float]


def train(n: int) -> str:
    """n + 1 bodies with n drawbars between them; the first one brakes."""
    parts = [f"  Body body{i}(v(start=20));" for i in range(n + 1)]
    parts += [f"  Drawbar drawbar{i}(eps=0.01);" for i in range(1, n + 1)]
    wires = [f"  body{i}.g_x = {-2 if i == 0 else 0};" for i in range(n + 1)]
    for i in range(1, n + 1):
        wires.append(f"  connect(drawbar{i}.front, body{i - 1}.hitch);")
        wires.append(f"  connect(drawbar{i}.rear, body{i}.hitch);")
    return "\n".join(["model M", "  import OverrunHitch.Components.*;", *parts, "equation", *wires, "end M;\n"])


def rod(n: int) -> str:
    """n cells between insulated ends."""
    return f"""model M
  parameter Real k = 2;
  Real T[{n}](start=linspace(300, 400, {n}), each fixed=true);
  Real Q[{n + 1}];
equation
  Q[1] = 0;
  for i in 2:{n} loop
    Q[i] = k*(T[i - 1] - T[i]);
  end for;
  Q[{n + 1}] = 0;
  for i in 1:{n} loop
    der(T[i]) = Q[i] - Q[i + 1];
  end for;
end M;
"""


FAMILIES = (
    Family("drawbars", train, (1, 2, 4, 8, 16), {16: 20.0}),
    Family("cells of a rod", rod, (300, 1000, 3000), {1000: 20.0, 3000: 60.0}),
)


def cpu_time() -> float:
    """Seconds of this process and of those that it has waited for."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(u.ru_utime + u.ru_stime for u in used)


def measured(text: str) -> dict[str, float]:
    """CPU time by stage."""
    marks: list[tuple[str, float]] = []
    with tempfile.TemporaryDirectory(prefix="benchmark-") as folder:
        path = Path(folder) / "M.mo"
        path.write_text(text, encoding="utf-8")
        build(
            path,
            "M",
            path.with_suffix(".fmu"),
            progress=lambda stage: marks.append((stage.partition(" for ")[0], cpu_time())),
            libraries=[LIBRARIES],
        )
    ends = [*(begin for _, begin in marks[1:]), cpu_time()]
    return {stage: end - begin for (stage, begin), end in zip(marks, ends, strict=True)}


def growth(family: Family, rows: Sequence[dict[str, float]]) -> dict[str, float]:
    """The exponent of each stage that takes long enough to have one."""
    ratio = math.log(family.sizes[-1] / family.sizes[-2])
    before, last = rows[-2:]
    return {stage: math.log(last[stage] / before[stage]) / ratio for stage in last if before[stage] > SHORT}


def main() -> int:
    """Print the tables; 1 where a build takes too long, or a stage grows faster than n log n."""
    os.environ[cache.SETTING] = ""  # what is measured is done
    status = 0
    for family in FAMILIES:
        rows: list[dict[str, float]] = []
        for n in family.sizes:
            rows.append(measured(family.text(n)))
            if n == family.sizes[0]:
                print(
                    f"\n| {family.title} | {' | '.join(rows[0])} | in all | at most |\n|{'---|' * (len(rows[0]) + 3)}"
                )
            total, limit = sum(rows[-1].values()), family.limits.get(n, math.inf)
            cells = [f"{seconds:.2f}" for seconds in (*rows[-1].values(), total)]
            print(f"| {n} | {' | '.join(cells)} | {'' if limit == math.inf else f'{limit:g}'} |", flush=True)
            status |= total > limit
        exponents = growth(family, rows)
        print(f"| growth | {' | '.join(f'{exponents[s]:.2f}' if s in exponents else '' for s in rows[0])} | | |")
        n, m = family.sizes[-2:]
        allowed = 1 + math.log(math.log(m) / math.log(n)) / math.log(m / n) + ROUNDING
        status |= max(exponents.values()) > allowed
    return status


if __name__ == "__main__":
    sys.exit(main())
