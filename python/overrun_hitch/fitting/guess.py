"""Where the search for a drawbar's parameters begins: a straight line through force and torque."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from overrun_hitch.fitting.motion import Motion
from overrun_hitch.fitting.trace import Trace
from overrun_hitch.parameters import Parameters


def first_guess(trace: Trace, moved: Motion, parameters: Parameters, names: Sequence[str]) -> dict[str, float]:
    """A value in its range for each of `names`, from what the trace has of a spring, a damper and dry friction."""
    x, v = moved.compression, moved.v_rel
    pushed = x > parameters.eps
    if pushed.sum() < len(names):
        pushed = np.ones_like(pushed)
    reach = float(x.max()) - parameters.eps
    found = {"k_t": parameters.k_t, "k_buffer": parameters.k_buffer, "travel": 0.9 * float(x.max()), "rebound": 1.0}
    found |= {"x_2": reach / 3.0, "x_3": 2.0 * reach / 3.0}
    bends = [found[name] if name in names else getattr(parameters, name) for name in ("x_2", "x_3")]
    beyond = [np.maximum(x - parameters.eps - bend, 0.0) for bend in bends]
    inside = np.column_stack([x, v, np.ones_like(x), np.sign(v), *beyond])[pushed]
    k, C, at_zero, F_f, *more = np.linalg.lstsq(inside, trace.F_hitch[pushed], rcond=None)[0].tolist()
    stiffness = max(k, 1e-3 * float(np.ptp(trace.F_hitch) / np.ptp(x)))
    found |= {"k": stiffness, "k_2": stiffness + more[0], "k_3": stiffness + sum(more), "C": C, "F_f": F_f}
    found |= {"F_0": at_zero + stiffness * parameters.eps, "eps": -at_zero / stiffness}
    if trace.trailer_brake_torque is not None:
        r, late, _ = np.linalg.lstsq(inside[:, :3], trace.trailer_brake_torque[pushed], rcond=None)[0].tolist()
        found |= {"r": r, "tau_b": -late / r if r > 0.0 else 0.0}
    return {name: float(np.clip(found[name], *Parameters.limits(name))) for name in names}
