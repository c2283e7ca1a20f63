"""What a designer should take from the study: sentences whose numbers are computed, each with whether it is true."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from overrun_hitch.paper.claims.claim import Claim
from overrun_hitch.paper.study.beyond import CHECKED_RATIOS, CYCLE_SPEED, Boundary, Motion, designed
from overrun_hitch.paper.study.device import FRICTION, TYPICAL_LAG, Device
from overrun_hitch.paper.study.study import SteadyState, Study
from overrun_hitch.parameters import CASES, FIGURES, Parameters
from overrun_hitch.theory.boundary import critical_damping
from overrun_hitch.theory.linear import shunting_mode

MILLI = 1000.0
IN_PROPORTION = 0.01  # by how much C_crit / V may vary over the chart
SATURATED = 0.1  # by how much C_crit may rise when r/k doubles from STRONG on
STRONG = 5.0  # m, of r/k
THE_SAME = 1e-3  # relative: amplitudes that are called equal
CLOSE = 0.1  # relative error of a good estimate
SLOW = 5.0  # m/s
OSCILLATING = ("sustained", "unsettled")


@dataclass(frozen=True)
class Lesson:
    """One conclusion; `holds` says whether the numbers bear it out."""

    heading: str
    text: str
    holds: bool


def lessons(study: Study, claims: Sequence[Claim]) -> list[Lesson]:
    """All of them, the most useful first."""
    return [
        lag_decides(study.device),
        friction_hides(study.device),
        top_speed(study.boundary),
        small_oscillations_decide(study.motions),
        abrupt(study.motions),
        clearance_and_amplitude(study.motions),
        clearance_and_frequency(study.motions),
        strong_brakes(study.boundary, study.steady_fmu),
        margin(claims),
        estimate(study.motions),
    ]


def lag_decides(found: Device) -> Lesson:
    """A brake that lags needs a damper by its lag."""
    p = FIGURES["8"].parameters
    slow, fast = (lagging(p, V) for V in (SLOW, p.V_0))
    prompt = [critical_damping(p, V) for V in (SLOW, p.V_0)]
    text = (
        "The paper's brake answers at once; a real one follows its rods and cables, and that decides. With a lag of "
        f"{MILLI * TYPICAL_LAG:g} ms case ii needs {slow:.0f} N.s/m at {SLOW:g} m/s and {fast:.0f} at {p.V_0:g} m/s, "
        f"without one {prompt[0]:.0f} and {prompt[1]:.0f}. The combination of figure 8 (C = {p.C:g} N.s/m), which does "
        f"not shunt, bears {MILLI * found.borne:.0f} ms at {p.V_0:g} m/s. With {MILLI * TYPICAL_LAG:g} ms its shunting "
        f"grows with {found.growth_rate:.2f} 1/s, and as the lag's share does not fall with the speed, it slows to its "
        "stop shunting. Measure the lag, make it short (stiff rods, no slack cable), and choose the damper for it."
    )
    holds = all(check.holds for check in found.checks) and prompt[1] < p.C < slow < fast
    return Lesson("The lag of the brake decides, not the tyres.", text, holds)


def lagging(parameters: Parameters, V: float) -> float:
    """C_crit (N.s/m) at V (m/s) with TYPICAL_LAG."""
    return critical_damping(parameters.changed({"tau_b": TYPICAL_LAG}), V)


def friction_hides(found: Device) -> Lesson:
    """Dry friction makes a hard onset."""
    text = (
        f"Friction of {FRICTION:g} N in the drawbar's guide lets the same combination pass every gentle trial: motions "
        f"of the drawbar below {MILLI * found.onset:.0f} mm die out, those above grow, so that a hard brake step is "
        "what brings it out. Try a hitch with hard steps, or with the guide freshly greased."
    )
    return Lesson("Dry friction hides it until the driver brakes hard.", text, 0.0 < found.onset < np.inf)


def top_speed(found: Boundary) -> Lesson:
    """C_crit rises in proportion to the speed."""
    slope = found.C_crit / found.speeds[:, None]
    spread = float((slope.max(axis=0) / slope.min(axis=0) - 1.0).max())
    at = {V: critical_damping(CASES["ii"], V) for V in (10.0, CYCLE_SPEED)}
    lags = {V: lagging(CASES["ii"], V) for V in at}
    low, high = found.speeds[0], found.speeds[-1]
    text = (
        "Where the brake does not lag, the least damper that keeps the combination from shunting by itself, C_crit, "
        "rises in proportion to the "
        f"speed: between {low:g} and {high:g} m/s C_crit / V varies by {100.0 * spread:.2g} % at most. Case ii needs "
        f"{at[10.0]:.0f} N.s/m at 10 m/s and {at[CYCLE_SPEED]:.0f} N.s/m at {CYCLE_SPEED:g} m/s. The stiffness of the "
        "tyres and the inertia of the wheels set the factor: what delays the brake's force is the time that slip "
        "takes to build up, and it is proportional to the speed. What a lag asks comes on top: with "
        f"{MILLI * TYPICAL_LAG:g} ms case ii needs {lags[10.0]:.0f} and {lags[CYCLE_SPEED]:.0f} N.s/m."
    )
    return Lesson("Size the damper for the top speed.", text, spread < IN_PROPORTION)


def small_oscillations_decide(motions: Sequence[Motion]) -> Lesson:
    """Clearance does not move the boundary."""
    limit = critical_damping(CASES["ii"], CYCLE_SPEED)
    above = [motion for motion in motions if limit < motion.C]
    under = [motion for motion in motions if limit > motion.C]
    clearances = sorted({motion.eps for motion in motions})
    text = (
        "Linear theory knows no clearance, and still it decides. With C above C_crit, without lag "
        f"{limit:.1f} N.s/m, all {len(above)} oscillations faded on the FMU ({_list(_dampers(above))} N.s/m); with "
        f"C below it ({_list(_dampers(under))} N.s/m) none of {len(under)} did, whether the clearance was "
        f"{_list(clearances)} m. Take up backlash for the sake of comfort and of quick brakes; against shunting only "
        "the damper helps."
    )
    return Lesson("Clearance does not move the boundary.", text, decides(motions))


def decides(motions: Sequence[Motion]) -> bool:
    """Whether C_crit parts what fades from what does not."""
    limit = critical_damping(CASES["ii"], CYCLE_SPEED)
    return all((motion.fmu.verdict == "fades") == (limit < motion.C) for motion in motions)


def abrupt(motions: Sequence[Motion]) -> Lesson:
    """What lies just below the boundary is no small oscillation."""
    largest = max(motion.eps for motion in motions)
    heading = "A little too little damping is already rough."
    cycles = sorted((m for m in _cycles(motions) if m.eps == largest), key=lambda motion: -motion.C)
    if not cycles:
        return Lesson(heading, f"With a clearance of {largest:g} m no oscillation went on on the FMU.", False)
    first, last = cycles[0], cycles[-1]
    limit = critical_damping(CASES["ii"], CYCLE_SPEED)
    growing = all(
        less.fmu.amplitude > more.fmu.amplitude
        for group in _by_clearance(motions)
        for more, less in pairwise(sorted(group, key=lambda motion: -motion.C))
    )
    text = (
        f"There is no gentle onset. With C = {first.C:g} N.s/m, {100.0 * (1.0 - first.C / limit):.0f} % below C_crit, "
        f"the drawbar comes to oscillate with an amplitude of {MILLI * first.fmu.amplitude:.1f} mm about a steady "
        f"compression of {MILLI * first.steady:.1f} mm: once in every cycle the trailer's brake lets go, as it did in "
        f"every oscillation that went on. The amplitude grows as C falls: with a clearance of {largest:g} m it is "
        f"{MILLI * last.fmu.amplitude:.0f} mm at C = {last.C:g} N.s/m."
    )
    released = all(motion.fmu.lowest < motion.eps for motion in _cycles(motions))
    return Lesson(heading, text, growing and released)


def clearance_and_amplitude(motions: Sequence[Motion]) -> Lesson:
    """As long as nothing strikes the tension stop, the amplitude does not depend on the clearance."""
    free = [motion for motion in _cycles(motions) if motion.fmu.lowest > 0.0]
    groups = [[m for m in free if m.C == C] for C in _dampers(free)]
    shared = [group for group in groups if len(group) > 1]
    spread = max((_spread([m.fmu.amplitude for m in group]) for group in shared), default=np.nan)
    lost = [motion for motion in motions if motion.fmu.verdict == "runs away"]
    widest = max(shared, key=len, default=[])
    example = (
        f"At C = {widest[0].C:g} N.s/m it is {MILLI * widest[0].fmu.amplitude:.1f} mm with "
        f"{_list([m.eps for m in widest])} m alike (they differ by {spread:.1g} of it). "
        if widest
        else ""
    )
    away = (
        "Where the clearance is too small for the oscillation and the damping far too weak "
        f"({'; '.join(f'C = {m.C:g} N.s/m with {m.eps:g} m' for m in lost)}), the trailer, thrown to and fro between "
        "its stops, braked so much that the speed fell although the driver had let go of the brake: the table says "
        "that it runs away."
        if lost
        else ""
    )
    text = (
        "As long as the drawbar does not strike its tension stop, the amplitude does not depend on how large the "
        f"clearance is: it swings in as much of it as it needs. {example}{away}"
    )
    return Lesson("More clearance does not mean a larger oscillation.", text.strip(), bool(spread < THE_SAME))


def clearance_and_frequency(motions: Sequence[Motion]) -> Lesson:
    """Clearance lowers the frequency, the tension stop raises it."""
    linear = float(shunting_mode(CASES["ii"].changed({"C": 100.0}), CYCLE_SPEED).frequency)
    ordered = sorted(_cycles(motions), key=lambda motion: motion.fmu.amplitude)
    free = [motion.fmu.frequency for motion in ordered if motion.fmu.lowest > 0.0]
    without = [motion.fmu.frequency for motion in _cycles(motions) if motion.eps == 0.0]
    text = (
        f"Linear theory gives {linear:.2f} Hz. Oscillations that swing through clearance without striking the stop "
        f"have {_range(free)} Hz: the larger, the slower. Without clearance the drawbar strikes its stop in every "
        f"cycle and the frequency goes up, to {_range(without)} Hz. A frequency measured on the road so tells which "
        "of the two it is."
    )
    slower = bool((np.diff(free) < THE_SAME).all())
    holds = slower and max(free, default=np.nan) < linear < min(without, default=np.nan)
    return Lesson("Clearance lowers the frequency.", text, holds)


def strong_brakes(found: Boundary, steady: Mapping[str, SteadyState]) -> Lesson:
    """C_crit saturates with r/k."""
    row = int(np.abs(found.speeds - CYCLE_SPEED).argmin())
    rises = bool((np.diff(found.C_crit[row]) > 0.0).all())
    weak, _, strong = CHECKED_RATIOS
    at = {ratio: critical_damping(designed(ratio), CYCLE_SPEED) for ratio in (weak, strong, STRONG, 2.0 * STRONG)}
    doubled = at[2.0 * STRONG] / at[STRONG] - 1.0
    lags = [lagging(designed(ratio), CYCLE_SPEED) for ratio in (weak, strong)]
    text = (
        f"From case i (r/k = {weak:g} m) to case iii ({strong:g} m) the deceleration ratio A/A_c goes from "
        f"{steady['i'].ratio:.2f} to {steady['iii'].ratio:.2f}, and C_crit at {CYCLE_SPEED:g} m/s from {at[weak]:.0f} "
        f"to {at[strong]:.0f} N.s/m, with the spring chosen for the same deflection. Doubling r/k from {STRONG:g} to "
        f"{2.0 * STRONG:g} m adds only {100.0 * doubled:.1f} %. With a lag of {MILLI * TYPICAL_LAG:g} ms it goes from "
        f"{lags[0]:.0f} to {lags[1]:.0f}. So a good deceleration is not bought with shunting, if the damper is there."
    )
    return Lesson("A stronger trailer brake asks for little more damping.", text, rises and doubled < SATURATED)


def margin(claims: Sequence[Claim]) -> Lesson:
    """How much damping is comfortable, and what too much costs."""
    p = FIGURES["8"].parameters
    limit, mode = critical_damping(p, p.V_0), shunting_mode(p, p.V_0)
    share = p.C / lagging(p, p.V_0)
    delays = [part for claim in claims for part in claim.parts if "delay" in part.what and "figure 11" in part.what]
    delay = delays[0].fmu
    more, less = FIGURES["11"].parameters, FIGURES["10"].parameters
    text = (
        f"At C_crit oscillations merely do not grow. The damper of figure 8, C = {p.C:g} N.s/m or {p.C / limit:.1f} "
        f"times C_crit, gives {100.0 * float(mode.damping_ratio):.1f} % of critical damping at {p.V_0:g} m/s, and "
        f"every oscillation halves in {np.log(2.0) / -float(mode.growth_rate):.1f} s; with a lag of "
        f"{MILLI * TYPICAL_LAG:g} ms it is {share:.1f} times C_crit, too little. Too much is not free where "
        f"there is clearance: with {more.eps:g} m of it, C = {more.C:g} instead of {less.C:g} N.s/m lets the "
        f"trailer's brakes come {delay:.2f} s later."
    )
    holds = limit < p.C and share < 1.0 and delay > 0.0 and float(mode.growth_rate) < 0.0
    return Lesson("Leave a margin, but not a wall.", text, holds)


def estimate(motions: Sequence[Motion]) -> Lesson:
    """How far the describing function can be trusted."""
    limit = critical_damping(CASES["ii"], CYCLE_SPEED)
    both = [motion for motion in _cycles(motions) if motion.predicted is not None]
    free = [motion for motion in both if motion.fmu.lowest > 0.0]
    near = [motion for motion in free if 0.8 * limit < motion.C]
    struck = [motion for motion in both if motion.fmu.lowest <= 0.0]
    far = [motion for motion in free if 0.8 * limit >= motion.C]
    text = (
        "The describing function needs no simulation. Within 20 % of C_crit and without the stop its amplitude is "
        f"right to {_worst(near):.0f} %, further below to {_worst(far):.0f} %; where the drawbar strikes its stop it "
        f"is up to {_worst(struck):.0f} % off. It is good for the question how rough the onset is, and no substitute "
        "for a run where the stop is struck."
    )
    holds = _worst(near) < 100.0 * CLOSE < _worst(struck) and _worst(near) < _worst(far)
    return Lesson("Use the describing function near the boundary only.", text, holds)


def amplitude_error(motion: Motion) -> float:
    """Predicted amplitude less the FMU's, relative to the FMU's (1); NaN where there are not both."""
    return np.nan if motion.predicted is None else motion.predicted.amplitude / motion.fmu.amplitude - 1.0


def _worst(motions: Iterable[Motion]) -> float:
    """The largest error of the predicted amplitude in per cent."""
    return 100.0 * max((abs(amplitude_error(motion)) for motion in motions), default=np.nan)


def _cycles(motions: Iterable[Motion]) -> list[Motion]:
    return [motion for motion in motions if motion.fmu.verdict in OSCILLATING]


def _by_clearance(motions: Sequence[Motion]) -> list[list[Motion]]:
    cycles = _cycles(motions)
    return [[motion for motion in cycles if motion.eps == eps] for eps in sorted({m.eps for m in cycles})]


def _dampers(motions: Iterable[Motion]) -> list[float]:
    return sorted({motion.C for motion in motions})


def _spread(values: Sequence[float]) -> float:
    return (max(values) - min(values)) / min(values)


def _range(values: Sequence[float]) -> str:
    return f"{min(values):.2f} to {max(values):.2f}" if values else "no"


def _list(values: Sequence[float]) -> str:
    """ "0, 0.02 or 0.1"."""
    words = [f"{value:g}" for value in values]
    return " or ".join(filter(None, [", ".join(words[:-1]), *words[-1:]]))
