"""What an input moves: truths, and which of the derivatives' assignments."""

from __future__ import annotations

from ..ir.dependencies import needed_for
from ..ir.models import SortedModel
from .early import Early
from .text import LONGEST_FUNCTION, assignment_lines, function

ENOUGH = 0.5  # of the assignments: where one input moves more of them, all are computed


def print_inputs(model: SortedModel, early: Early) -> str:
    """moves_truths and model_derivatives_by."""
    sources = [model.sources[name] for name in model.residuals]
    events = not model.schedule.is_empty
    truths = [events or any(name in s for s in sources) for name in model.inputs]
    blocks = early.others(needed_for(model.derivatives, model))
    cases: list[str] = []
    for number, (name, is_truth) in enumerate(zip(model.inputs, truths, strict=True)):
        moved = [block for block in blocks if any(name in model.sources[target] for target in block.targets)]
        if is_truth or early.depends_on(name):
            continue
        whole = len(moved) > ENOUGH * len(blocks) or len(cases) > LONGEST_FUNCTION
        lines = ["model_derivatives(v, holds);"] if whole else assignment_lines(moved, early.printer)
        cases += [f"case {number}:", *(f"    {line}" for line in lines), "    break;"]
    body = "\n".join(["switch (input) {", *cases, "default:", "    break;", "}"])
    row = ", ".join(str(is_truth).lower() for is_truth in truths) or "true"
    table = f"const bool moves_truths[AT_LEAST_ONE(N_INPUTS)] = {{{row}}};\n"
    return table + "\n" + function("model_derivatives_by(Variables *v, const bool holds[], int input)", [body])
