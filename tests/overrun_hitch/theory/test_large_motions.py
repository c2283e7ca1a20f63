"""What predicts large motions takes every parameter into account, or refuses it by name."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from overrun_hitch.parameters import CASES, HitchError, Parameters, Scenario
from overrun_hitch.theory.describing_function import predicted_cycles
from overrun_hitch.theory.envelope import integrated_compression, predicted_amplitude, turning_speed

TIME = np.linspace(0.0, 1.0, 3)
BASE = CASES["ii"].changed({"C": 100.0, "eps": 0.1, "compression_start": 0.13})  # shunts above 33 m/s
NEVER = {"reverse_braking"}  # counts backward alone
BEYOND = {"k_2", "k_3", "k_buffer"}  # count from x_2, x_3, travel on, which are out of reach
OF_THE_START = {"V_0", "compression_start"}
IN_TENSION = {"k_t"}


def braked(p: Parameters) -> Scenario:
    return Scenario(name="", parameters=p)


ASKED: list[tuple[Callable[[Parameters], object], set[str]]] = [
    (lambda p: [cycle.amplitude for cycle in predicted_cycles(p, 40.0, 488.0)], OF_THE_START),
    (lambda p: predicted_amplitude(braked(p), TIME).tolist(), IN_TENSION),
    (lambda p: integrated_compression(braked(p), TIME).tolist(), IN_TENSION),
    (lambda p: turning_speed(p, 80.0), OF_THE_START | IN_TENSION | {"eps"}),
]


@pytest.mark.full
@pytest.mark.parametrize(("ask", "of_no_account"), ASKED, ids=["cycles", "amplitude", "integrated", "turning speed"])
def test_none_is_ignored(ask: Callable[[Parameters], object], of_no_account: set[str]) -> None:
    known = ask(BASE)
    for name in Parameters.model_fields:
        value = getattr(BASE, name)
        changed = BASE.changed({name: 0.9 * value if value else 0.05})
        if name in NEVER | BEYOND | of_no_account:
            assert ask(changed) == known, name
        else:
            try:
                assert ask(changed) != known, name
            except HitchError as error:
                assert f"know {name} = " in str(error), name
