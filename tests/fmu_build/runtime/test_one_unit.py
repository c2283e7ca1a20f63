"""The C sources can be compiled as one translation unit, in any order: what one file calls its own no other does."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterable
from itertools import combinations
from pathlib import Path

import pytest

from fmu_build.fmu.compile import HEADERS, compiler
from tests.fmu_build.runtime.coupled_models import TOWED
from tests.fmu_build.runtime.generated_models import EVENTS, GeneratedModel, generate
from tests.fmu_build.runtime.hand_written import Model
from tests.fmu_build.runtime.runtime_models import CAR_TRAILER
from tests.fmu_build.runtime.runtime_unit import FLAGS, RUNTIME
from tests.sampling import spread

# A loop, linear and not, beside what EVENTS has.
LOOPS = """model Loops
  input Real u(start=0.2);
  Real x(start=0.5, fixed=true);
  Real y(start=1);
  Real a;
  Real b;
equation
  der(x) = -a;
  y^3 + y = 1 + x*u;
  a + 2*b = x;
  a - b = y;
end Loops;
"""


def compile_as_one(model: Model | GeneratedModel, fmi: int, folder: Path, *, backwards: bool) -> None:
    """The runtime with one facade and the model, its warnings errors."""
    for name, text in model.files().items():
        (folder / name).write_text(text, encoding="utf-8")
    other = {2: "fmi3", 3: "fmi2"}[fmi]
    parts = [RUNTIME, *(part for part in RUNTIME.iterdir() if part.is_dir() and part.name != other)]
    sources = [file.name for part in (*parts, folder) for file in part.glob("*.c")]
    unit = "".join(f'#include "{name}"\n' for name in sorted(sources, reverse=backwards))
    command = [*compiler(), *FLAGS, "-O0", f"-I{folder}", *(f"-I{part}" for part in parts)]
    command += [f"-isystem{HEADERS / f'fmi{fmi}'}", "-x", "c", "-", "-o", str(folder / "one.so"), "-lm"]
    subprocess.run(command, input=unit, text=True, check=True)


@pytest.mark.parametrize(("fmi", "backwards"), spread([2, 3], [False, True]))
@pytest.mark.parametrize("model", [CAR_TRAILER, TOWED], ids=lambda m: m.name)
def test_a_model_written_by_hand(model: Model, fmi: int, backwards: bool, tmp_path: Path) -> None:
    compile_as_one(model, fmi, tmp_path, backwards=backwards)


@pytest.mark.parametrize(("name", "fmi"), spread(["Events", "Loops"], [2, 3]))
def test_a_generated_model(name: str, fmi: int, tmp_path: Path) -> None:
    (tmp_path / f"{name}.mo").write_text({"Events": EVENTS, "Loops": LOOPS}[name], encoding="utf-8")
    model = generate(tmp_path / f"{name}.mo", name)
    (folder := tmp_path / "c").mkdir()
    for backwards in (False, True):
        compile_as_one(model, fmi, folder, backwards=backwards)


def own_names(text: str) -> set[str]:
    """Static functions and data of a file, enumerators, and macros that it leaves behind."""
    code = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    statics = re.findall(r"^static [^=;{(\[]*?(\w+)(?=\(|\[| =|;)", code, re.MULTILINE)
    enumerators = [
        re.match(r"\w*", item.strip())[0]  # type: ignore[index]
        for block in re.findall(r"^(?:typedef )?enum \{(.*?)\}", code, re.DOTALL | re.MULTILINE)
        for item in block.split(",")
    ]
    macros = set(re.findall(r"^#define (\w+)", code, re.MULTILINE)) - set(
        re.findall(r"^#undef (\w+)", code, re.MULTILINE)
    )
    return {*statics, *enumerators, *macros} - {""}


def shared_names(texts: Iterable[str]) -> set[str]:
    return {name for one, other in combinations(map(own_names, texts), 2) for name in one & other}


def test_each_static_name_occurs_in_one_file_only() -> None:
    texts = [file.read_text(encoding="utf-8") for file in sorted(RUNTIME.rglob("*.[ch]"))]
    assert shared_names(texts) == set()
    assert {"settle_start", "RODAS_A", "MAX_NEWTON_STEPS", "is_there", "EVENT_MODE"} <= set().union(
        *map(own_names, texts)
    )
    again = "static const double RODAS_A[2] = {1.0};\nstatic void settle_start(void)\n{\n}\nenum { EVENT_MODE };\n"
    assert shared_names([*texts, again]) == {"RODAS_A", "settle_start", "EVENT_MODE"}


def test_a_source_leaves_no_macro_behind() -> None:
    for file in RUNTIME.rglob("*.c"):
        text = file.read_text(encoding="utf-8")
        defined, undefined = (set(re.findall(rf"^#{word} (\w+)", text, re.MULTILINE)) for word in ("define", "undef"))
        assert defined == undefined, file.name
