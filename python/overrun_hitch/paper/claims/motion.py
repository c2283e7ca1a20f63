"""Claims 10 to 13: simulated step brakes (the paper's section 8.3)."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from scipy.optimize import brentq
from scipy.signal import find_peaks

from overrun_hitch.comparison.theory import compare, shunting
from overrun_hitch.measure.judged import Judged
from overrun_hitch.measure.oscillation import Oscillation
from overrun_hitch.paper.claims.claim import Claim, Part, above, below, near
from overrun_hitch.paper.study.study import BRAKE_TORQUE, Study
from overrun_hitch.parameters import FIGURES, Parameters
from overrun_hitch.results import Run, scenario_of, values
from overrun_hitch.theory.linear import shunting_mode
from overrun_hitch.theory.steady import steady

NOTHING = math.nan
TRANSIENT = 1.0  # s: the onset of the brake is not part of the oscillation
# What a reader can tell from a printed curve over 6 s.
READABLE_GROWTH = 0.05  # 1/s: 30 % of the amplitude over the run
READABLE_FREQUENCY = 0.03  # relative: a third of a period over the run


def claim_10(study: Study) -> Claim:
    """Figure 6: growth and frequencies."""
    theory = shunting_mode(FIGURES["6b"].parameters, _mean_speed(study.runs["6b"]))
    expected = float(theory.frequency)
    frequencies = {name: peak_frequency(study.runs[name]) / expected for name in ("6a", "6b")}
    rows = _rows(study, "6b")
    parts = (
        Part(
            "6b: growth rate",
            "1/s",
            "build up",
            above(0.0),
            rows["shunting growth"].expected,
            _measured(study, "6b")[0],
        ),
        Part(
            "6a: swing in the last 2 s over that in the first",
            "1",
            "build up",
            above(1.0),
            NOTHING,
            _swelling(study, "6a"),
        ),
        Part("6b: frequency over the eigenvalue's", "1", "near", near(1.0, 0.1), 1.0, frequencies["6b"]),
        Part(
            "6a: frequency over the eigenvalue's", "1", "considerably greater", above(1.1), NOTHING, frequencies["6a"]
        ),
    )
    text = "In figure 6 the oscillations grow; in 6b the frequency is near the eigenvalue's, in 6a considerably higher."
    remark = "6b stays below the eigenvalue's frequency: in tension the trailer brake, which acts like a spring, rests."
    return Claim(10, text, "section 8.3", parts, remark)


def claim_11(study: Study) -> Claim:
    """Figure 6: who moves."""
    ratio = float(shunting_mode(FIGURES["6b"].parameters, _mean_speed(study.runs["6b"])).amplitude_ratio)
    car = {name: _swing(study.runs[name], "a_car") for name in ("6a", "6b")}
    trailer = _swing(study.runs["6b"], "a_trailer")
    parts = (
        Part(
            "6b: trailer's motion over the car's",
            "1",
            "the bulk is the trailer's",
            above(5.0),
            ratio,
            trailer / car["6b"],
        ),
        Part(
            "car's acceleration: variation in 6a over 6b",
            "1",
            "much greater",
            above(2.0),
            NOTHING,
            car["6a"] / car["6b"],
        ),
    )
    text = "In 6b most of the motion is the trailer's; in 6a the car's deceleration varies much more than in 6b."
    return Claim(
        11, text, "section 8.3", parts, "Variation: standard deviation of the acceleration after the first second."
    )


def claim_12(study: Study) -> Claim:
    """Figures 7 and 8: linear theory."""
    parts = []
    for name in ("7", "8"):
        rows = _rows(study, name)
        growth, frequency = rows["shunting growth"], rows["shunting frequency"]
        measured = _measured(study, name)
        close = near(round(growth.expected, 4), READABLE_GROWTH)
        parts.append(Part(f"figure {name}: growth rate", "1/s", "as linear", close, growth.expected, measured[0]))
        close = near(round(frequency.expected, 4), READABLE_FREQUENCY * frequency.expected)
        parts.append(Part(f"figure {name}: frequency", "Hz", "as linear", close, frequency.expected, measured[1]))
    text = "Figures 7 and 8: growth or decay and frequency agree with the linear theory."
    remark = (
        "In figure 7 the drawbar leaves compression for moments, where linear theory is silent; hence its frequency."
    )
    return Claim(12, text, "section 8.3", tuple(parts), remark)


def claim_13(study: Study) -> Claim:
    """Figures 9 to 11: clearance."""
    runs, without = study.runs, {"9": study.runs["7"], "10": study.runs["8"], "11": study.run_without_clearance}
    parts = _delays(study)
    for name, other in without.items():
        lowered = peak_frequency(runs[name]) / peak_frequency(other)
        parts.append(
            Part(f"figure {name}: frequency over that without clearance", "1", "lowered", below(0.99), NOTHING, lowered)
        )
    for name in ("10", "11"):
        raised = _settled_compression(runs[name]) - _settled_compression(without[name])
        theory = steady(FIGURES[name].parameters, BRAKE_TORQUE).D
        theory -= steady(FIGURES[name].parameters.changed({"eps": 0.0}), BRAKE_TORQUE).D
        parts.append(Part(f"figure {name}: steady compression gained", "m", "0.1", near(0.1, 1e-3), theory, raised))
    text = (
        "Figures 9 to 11: the trailer brakes act after a delay that grows with C; the clearance lowers the frequency; "
        "the steady compression is 0.1 m larger; the mean deceleration over 6 s is slightly smaller than without it."
    )
    remark = (
        "Figure 11's counterpart without clearance is not in the paper; it was run for this. A motion that is over "
        "after an overshoot or two, as figure 11's, has no frequency."
    )
    return Claim(13, text, "section 8.3", (*parts, *_lost_decelerations(runs, without)), remark)


def _delays(study: Study) -> list[Part]:
    """By how much later than in the figure before the trailer's brakes act."""
    parts = []
    for less, more in (("9", "10"), ("10", "11")):
        predicted = [_predicted_delay(FIGURES[name].parameters) for name in (less, more)]
        measured = [_delay(study.runs[name]) for name in (less, more)]
        grown = [delays[1] - delays[0] for delays in (predicted, measured)]
        parts.append(
            Part(
                f"figure {more}: delay of the trailer brakes beyond figure {less}'s",
                "s",
                "increases",
                above(0.0),
                *grown,
            )
        )
    return parts


def _lost_decelerations(runs: Mapping[str, Run], without: Mapping[str, Run]) -> list[Part]:
    """What the clearance costs, over the whole run."""
    parts = []
    for name, other in without.items():
        lost = _mean_deceleration(other) - _mean_deceleration(runs[name])
        parts.append(
            Part(f"figure {name}: mean deceleration lost over 6 s", "m/s2", "slightly", above(0.0), NOTHING, lost)
        )
        share = lost / _mean_deceleration(other)
        parts.append(
            Part(f"figure {name}: the same, of the deceleration", "1", "slightly", below(0.05), NOTHING, share)
        )
    return parts


def peak_frequency(run: Run) -> float:
    """Mean frequency (Hz) between the peaks of the compression: also for motions that are no sine.

    NaN where there are fewer than three that stand out by 2 % of the swing: a motion that is over after an overshoot.
    """
    time, compression = values(run, "time"), values(run, "compression")
    peaks, _ = find_peaks(compression, prominence=0.02 * np.ptp(compression))
    return float((len(peaks) - 1) / (time[peaks[-1]] - time[peaks[0]])) if len(peaks) > 2 else NOTHING


def _rows(study: Study, figure: str) -> dict[str, Judged]:
    return {row.quantity: row for row in compare(study.runs[figure], study.alone[figure])}


def _measured(study: Study, figure: str) -> tuple[float, float]:
    """Growth rate (1/s) and frequency (Hz) of the oscillation, though 6b's is no exponential: the fit leaves 7 %."""
    found, _ = shunting(study.runs[figure])
    return (found.growth_rate, found.frequency) if isinstance(found, Oscillation) else (NOTHING, NOTHING)


def _swelling(study: Study, figure: str) -> float:
    time, compression = values(study.runs[figure], "time"), values(study.runs[figure], "compression")
    return float(np.ptp(compression[time >= time[-1] - 2.0]) / np.ptp(compression[time <= 2.0]))


def _swing(run: Run, name: str) -> float:
    return float(values(run, name)[values(run, "time") > TRANSIENT].std())


def _mean_speed(run: Run) -> float:
    return float(values(run, "v_car").mean())


def _delay(run: Run) -> float:
    """When (s) the trailer's brakes begin to act, on the straight line between samples of the compression."""
    time, compression, eps = values(run, "time"), values(run, "compression"), float(run.attrs["eps"])
    first = int((compression > eps).argmax())
    return float(np.interp(eps, compression[first - 1 : first + 1], time[first - 1 : first + 1]))


def _predicted_delay(p: Parameters) -> float:
    """When (s) the drawbar has crossed its clearance: v' = a - kappa v under the car's deceleration a, from rest.

    kappa = C (1/M_c' + 1/M_t'), the masses with their wheels' inertia, slip neglected.
    """
    car, trailer = p.M_c + p.I_c / p.R_c**2, p.M_t + p.I_t / p.R_t**2
    a, kappa = BRAKE_TORQUE / p.R_c / car, p.C * (1.0 / car + 1.0 / trailer)

    def compression(t: float) -> float:
        return a / kappa * (t + math.expm1(-kappa * t) / kappa)

    return float(brentq(lambda t: compression(t) - p.eps, 1e-9, 10.0))


def _settled_compression(run: Run) -> float:
    """Mean compression (m) over the last two periods."""
    time, compression = values(run, "time"), values(run, "compression")
    periods = 2.0 / float(shunting_mode(scenario_of(run).parameters, float(values(run, "v_car")[-1])).frequency)
    return float(compression[time > time[-1] - periods].mean())


def _mean_deceleration(run: Run) -> float:
    speed, time = values(run, "v_car"), values(run, "time")
    return float((speed[0] - speed[-1]) / (time[-1] - time[0]))
