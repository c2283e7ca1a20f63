"""The Modelica Association's compliance suite: what of it `fmu_build` builds, and whether that is right.

`python -m benchmarks.compliance FOLDER`, the suite's (github.com/modelica/Modelica-Compliance), builds each class that
should pass, alone with the packages around it, and runs it; what it says of itself by assertions decides. Exit status 1
where one fails, is not finished within a minute, or is no refusal in one line. Takes half an hour on two cores.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SHOULD_PASS = re.compile(r"\bshouldPass\s*=\s*true\b")
CLASS = re.compile(r"\b(end|model|class|block|package)\s+(?:extends\s+)?(\w+)")
STRINGS = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)
LIMIT = 60  # s
PASSES, REFUSED = "passes", "refused"


def main(folder: Path) -> int:
    """Print the table."""
    root = folder / "ModelicaCompliance"
    files = sorted(file for file in root.rglob("*.mo") if SHOULD_PASS.search(file.read_text(encoding="utf-8")))
    if not files:
        print(f"{folder}: no ModelicaCompliance with classes that should pass in it", file=sys.stderr)
        return 2
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found = list(pool.map(lambda file: outcome(root, file), files))
    counts = Counter(kind for kind, _ in found)
    for kind, count in counts.most_common():
        print(f"{count:5} {kind}")
    print("\nrefused most often:")
    for reason, count in Counter(reason for kind, reason in found if kind == REFUSED).most_common(12):
        print(f"{count:5} {reason}")
    wrong = [
        (file, kind, reason) for file, (kind, reason) in zip(files, found, strict=True) if kind not in {PASSES, REFUSED}
    ]
    for file, kind, reason in wrong:
        print(f"{file}: {kind}: {reason}")
    return 1 if wrong else 0


def outcome(root: Path, file: Path) -> tuple[str, str]:
    """What becomes of the class in a file, and why."""
    with tempfile.TemporaryDirectory(prefix="compliance-") as folder:
        suite, fmu = Path(folder) / root.name, Path(folder) / "test.fmu"
        for source in (file, *(parent / "package.mo" for parent in file.parents), root / "Util.mo", root / "Icons.mo"):
            if source.is_file() and source.is_relative_to(root):
                (suite / source.relative_to(root)).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(source, suite / source.relative_to(root))
        name = ".".join([root.name, *file.relative_to(root).parent.parts, tested(file.read_text(encoding="utf-8"))])
        environment = {**os.environ, "CFLAGS": "-O0"}
        try:
            built = _run("fmu_build", str(suite), name, "-o", str(fmu), environment=environment)
            if built.returncode != 0:
                said = built.stderr.strip()
                is_refusal = built.returncode == 2 and "\n" not in said and "a defect of" not in said
                return (REFUSED, reason_of(said)) if is_refusal else ("is a defect", said)
            ran = _run("fmpy", "simulate", str(fmu), "--stop-time", "0.1", environment=environment)
        except subprocess.TimeoutExpired:
            return "does not end", f"within {LIMIT} s"
        return (PASSES, "") if ran.returncode == 0 else ("fails", (ran.stderr or ran.stdout).strip()[-300:])


def tested(text: str) -> str:
    """The path of the class that the annotation is in, of those in the file."""
    plain = STRINGS.sub(lambda match: " " * len(match[0]), text)
    found = SHOULD_PASS.search(text)
    at = found.start() if found else 0
    around: list[str] = []
    for word, name in CLASS.findall(plain[:at]):
        if word != "end":
            around.append(name)
        elif name in around:
            del around[len(around) - 1 - around[::-1].index(name) :]  # with short classes in it, which have no end
    return ".".join(name for name in around if ("end", name) in CLASS.findall(plain[at:]))


def reason_of(message: str) -> str:
    """The message without places, names and numbers."""
    text = re.sub(r"^fmu_build: \S+?:(\d+:)? (\S+: )?", "", message)
    return re.sub(r"\d+", "N", re.sub(r"(['`\"]).*?\1|`[^`]*`", "...", text))[:100]


def _run(*command: str, environment: dict[str, str]) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", *command], capture_output=True, text=True, check=False, timeout=LIMIT, env=environment
    )


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])) if len(sys.argv) == 2 else "usage: python -m benchmarks.compliance FOLDER")
