"""The Modelica Association's compliance suite: what of it `fmu_build` builds, and whether that is right.

`CFLAGS=-O0 python -m benchmarks.compliance FOLDER`, with github.com/modelica/Modelica-Compliance in the folder, builds
and runs each class that should pass, alone with the packages around it; its own assertions judge. Exit status 1 where
one fails, does not end, or ends in anything but a result or a refusal. Takes half an hour on two cores.
"""

from __future__ import annotations

import os
import re
import shutil
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from multiprocessing import Pipe, Process
from multiprocessing.connection import Connection
from pathlib import Path

from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException

from fmu_build import cache
from fmu_build.errors import BuildError
from fmu_build.pipeline import build

SHOULD_PASS = re.compile(r"\bshouldPass\s*=\s*true\b")
CLASS = re.compile(r"\b(end|model|class|block|package)\s+(?:extends\s+)?(\w+)")
STRINGS = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)
LIMIT = 60  # s
PASSES, REFUSED = "passes", "is refused"


def main(folder: Path) -> int:
    """Print how many end how, the commonest reasons for refusals, and what is wrong."""
    os.environ[cache.SETTING] = ""  # nobody builds these again
    root = folder / "ModelicaCompliance"
    files = sorted(file for file in root.rglob("*.mo") if SHOULD_PASS.search(file.read_text(encoding="utf-8")))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found = list(pool.map(lambda file: outcome(root, file), files))
    reasons = Counter(reason for end, reason in found if end == REFUSED)
    for text, count in (*Counter(end for end, _ in found).most_common(), *reasons.most_common(12)):
        print(f"{count:5} {text}")
    wrong = [
        f"{file}: {end}: {why}" for file, (end, why) in zip(files, found, strict=True) if end not in {PASSES, REFUSED}
    ]
    print(*wrong, sep="\n")
    return 1 if wrong or not files else 0


def outcome(root: Path, file: Path) -> tuple[str, str]:
    """What becomes of the class in a file, and why. In a process of its own, which it may take with it."""
    with tempfile.TemporaryDirectory(prefix="compliance-") as folder:
        for source in (file, *(parent / "package.mo" for parent in file.parents), root / "Util.mo", root / "Icons.mo"):
            if source.is_file() and source.is_relative_to(root):
                copy = folder / source.relative_to(root.parent)
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(source, copy)
        name = ".".join([*file.relative_to(root.parent).parent.parts, tested(file.read_text(encoding="utf-8"))])
        answer, child = Pipe(duplex=False)
        process = Process(target=_attempt, args=(Path(folder), name, child))
        process.start()
        child.close()
        try:
            return answer.recv() if answer.poll(LIMIT) else ("does not end", f"within {LIMIT} s")
        except EOFError:
            return "kills the process", ""
        finally:
            process.kill()
            process.join()


def _attempt(folder: Path, name: str, answer: Connection) -> None:
    try:
        build(folder / "ModelicaCompliance", name, folder / "test.fmu")
        simulate_fmu(str(folder / "test.fmu"), stop_time=0.1, logger=lambda *_: None)
        answer.send((PASSES, ""))
    except BuildError as error:
        text = re.sub(r"^\S+?:(\d+:)? (\S+: )?", "", str(error))  # without places, names and numbers
        reason = re.sub(r"\d+", "N", re.sub(r"(['`\"]).*?\1", "...", text))[:100]
        answer.send(("is a defect" if "a defect of" in text else REFUSED, reason))
    except Exception as error:  # which a user would see as a traceback, unless the unit has said no
        answer.send(("fails" if isinstance(error, FMICallException) else "is a defect", repr(error)))


def tested(text: str) -> str:
    """The path of the class that the annotation is in, of those in the file."""
    plain = STRINGS.sub(lambda match: " " * len(match[0]), text)
    at = next(match.start() for match in SHOULD_PASS.finditer(text))
    around: list[str] = []
    for word, name in CLASS.findall(plain[:at]):
        if word != "end":
            around.append(name)
        elif name in around:
            del around[len(around) - 1 - around[::-1].index(name) :]  # with short classes in it, which have no end
    return ".".join(name for name in around if ("end", name) in CLASS.findall(plain[at:]))


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])) if len(sys.argv) == 2 else "usage: python -m benchmarks.compliance FOLDER")
