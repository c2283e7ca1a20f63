"""Random calls under AddressSanitizer and UndefinedBehaviorSanitizer: python fuzz.py [--calls N] [--seed S]."""

from __future__ import annotations

import argparse
import subprocess
import sys
from pathlib import Path

from tests.fmu_build.runtime.coupled_models import JOINED, TOWED
from tests.fmu_build.runtime.hand_written import Model
from tests.fmu_build.runtime.runtime_models import CAR_TRAILER, NO_STATES, OSCILLATOR, PARADOX, SINGULAR, SLIDING
from tests.fmu_build.runtime.runtime_unit import compile_sources

MODELS = (CAR_TRAILER, OSCILLATOR, SINGULAR, SLIDING, PARADOX, NO_STATES, TOWED, JOINED)
FLAGS = "-std=gnu11 -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all -Wall -Wextra -Werror".split()


def fuzzer(model: Model, fmi: int) -> Path:
    """The program that calls `model` through one facade at random: PROGRAM SEED CALLS."""
    return compile_sources(model, fmi, FLAGS, f"fuzz_fmi{fmi}.c")


def main() -> int:
    """Share the calls among the facades and the models; the exit status is 1 if one fails."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--calls", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    share = -(-options.calls // (2 * len(MODELS)))
    failed = 0
    for model in MODELS:
        for fmi in (2, 3):
            result = subprocess.run([fuzzer(model, fmi), str(options.seed), str(share)], capture_output=True, text=True)
            verdict = "passed" if result.returncode == 0 else "FAILED"
            print(f"FMI {fmi} {model.name:12} {verdict}: {result.stdout.strip()}{result.stderr[-3000:]}", flush=True)
            failed += result.returncode != 0
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
