"""What the page takes from parameters.py: ``python web/presets.py FOLDER`` writes presets.json there."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from overrun_hitch.parameters import CASES, DATUM, FIGURES, Parameters, Scenario


def presets() -> dict[str, Any]:
    """What src/paper.ts calls a Paper: figure 8 whole, figures and cases where they differ, roles of parameters."""
    figures = {name: _values(scenario) for name, scenario in FIGURES.items()}
    datum = figures["8"]
    assert datum == {**DATUM.model_dump(), "brake_torque": FIGURES["8"].brake_torque}
    cases = {name: {**datum, **case.model_dump()} for name, case in CASES.items()}
    return {
        "datum": datum,
        "duration": FIGURES["8"].duration,
        "figures": {name: _differences(values, datum) for name, values in figures.items()},
        "cases": {name: _differences(values, datum) for name, values in cases.items()},
        "meanings": {
            **{name: Parameters.description(name) for name in Parameters.model_fields},
            "brake_torque": Scenario.description("brake_torque"),
        },
        "link": Parameters.having("of", "link"),
        "neutral": Parameters.having("theory", "neutral"),
        "beyond": Parameters.having("theory", "small", "large", "approximate", "neutral"),
    }


def _values(scenario: Scenario) -> dict[str, float]:
    return {**scenario.parameters.model_dump(), "brake_torque": scenario.brake_torque}


def _differences(values: dict[str, float], datum: dict[str, float]) -> dict[str, float]:
    return {name: value for name, value in values.items() if value != datum[name]}


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "presets.json").write_text(json.dumps(presets()), encoding="utf-8")
