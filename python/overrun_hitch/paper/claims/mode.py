"""Claims 4 to 9: the shunting mode (the paper's section 8.2)."""

from __future__ import annotations

import numpy as np

from overrun_hitch.paper.claims.claim import Claim, Part, above, below, near, rounds_to
from overrun_hitch.paper.study.curves import DAMPERS, Locus
from overrun_hitch.paper.study.study import Study

SIDES = ("theory", "fmu")
LIGHTEST, HEAVIEST = 0, -1  # of DAMPERS
AMPLITUDE_RATIOS = {"case i": (9.0, 3.0), "case ii": (19.0, 3.0), "case iii": (48.0, 3.0)}
AXIS = 5.3  # 1/s, the length of the paper's real axis: -5 to 0.3
LITTLE = 0.03 * AXIS  # 1/s: what moves a curve by less looks unmoved in the paper's figures


def _locus(study: Study, label: str) -> Locus:
    return next(locus for loci in study.loci.values() for locus in loci if locus.curve.label == label)


def claim_4(study: Study) -> Claim:
    """Self-excitation without any forcing."""
    cases = [_locus(study, f"case {case}") for case in ("i", "ii", "iii")]
    growth = [
        Part(
            f"{locus.curve.label}, C = {DAMPERS[LIGHTEST]:g} N.s/m: growth rate",
            "1/s",
            "unstable",
            above(0.0),
            *(float(locus.growth_rates(side)[LIGHTEST]) for side in SIDES),
        )
        for locus in cases
    ]
    margin = [
        Part(
            f"{locus.curve.label}, C = 100 N.s/m: growth rate",
            "1/s",
            "stable",
            below(0.0),
            *(float(locus.growth_rates(side)[DAMPERS.index(100.0)]) for side in SIDES),
        )
        for locus in cases
    ]
    text = "The shunting mode becomes self-excited when C is small enough, on a smooth road and with even brakes."
    return Claim(4, text, "sections 8.2, 9", (*growth, *margin))


def claim_5(study: Study) -> Claim:
    """Amplitude ratios."""
    parts = []
    for label, (light, heavy) in AMPLITUDE_RATIOS.items():
        locus = _locus(study, label)
        for place, printed in ((LIGHTEST, light), (HEAVIEST, heavy)):
            found = [float(getattr(locus, side)[place].amplitude_ratio) for side in SIDES]
            what = f"{label}, C = {DAMPERS[place]:g} N.s/m: |x_t / x_c|"
            parts.append(Part(what, "1", f"{printed:.0f}", rounds_to(printed, 0), *found))
    text = "The shunting mode's amplitude ratio |x_t/x_c| falls from 9 to 3 (i), 19 to 3 (ii), 48 to 3 (iii)."
    undamped = float(_locus(study, "case iii").curve.theory(0.0).amplitude_ratio)
    remark = (
        f"The paper does not say which C is light damping. With C = {DAMPERS[LIGHTEST]:g} N.s/m all its figures come "
        f"out; with C = 0 case iii gives {undamped:.1f}."
    )
    return Claim(5, text, "section 8.2", tuple(parts), remark)


def claim_6(study: Study) -> Claim:
    """Phases of case ii."""
    locus = _locus(study, "case ii")
    light, heavy = ([float(getattr(locus, side)[place].phase) for side in SIDES] for place in (LIGHTEST, HEAVIEST))
    parts = (
        Part(f"C = {DAMPERS[LIGHTEST]:g} N.s/m: phase", "degrees", "near 180", near(180.0, 10.0), *light),
        Part(f"C = {DAMPERS[HEAVIEST]:g} N.s/m: phase", "degrees", "around 110", near(110.0, 5.0), *heavy),
    )
    text = (
        "x_t and x_c are nearly in antiphase for light damping; at C = 3200 the phase is about 110 degrees (case ii)."
    )
    return Claim(6, text, "section 8.2", parts)


def claim_7(study: Study) -> Claim:
    """Cases i, ii, iii beside each other."""
    cases = [_locus(study, f"case {case}") for case in ("i", "ii", "iii")]
    spreads, margins = [], []
    for side in SIDES:
        frequencies = np.array([locus.frequencies(side) for locus in cases])
        growth = np.array([locus.growth_rates(side) for locus in cases])
        spreads.append(float((np.ptp(frequencies, axis=0) / frequencies.mean(axis=0)).max()))
        margins.append(float((growth[2] - growth[:2].max(axis=0)).min()))
    parts = (
        Part("largest spread of the three frequencies at any C", "1", "very similar", below(0.06), *spreads),
        Part("growth rate of iii over the others', smallest at any C", "1/s", "least damped", above(0.0), *margins),
        Part("the same", "1/s", "marginally", below(LITTLE), *margins),
    )
    text = (
        "At V = 20 m/s cases i, ii, iii have very similar frequencies; iii is marginally the least damped at every C."
    )
    return Claim(7, text, "section 8.2", parts)


def claim_8(study: Study) -> Claim:
    """k and V."""
    base = _locus(study, "case ii")
    halved, slow, fast = (_locus(study, f"case ii, {what}") for what in ("k halved", "V = 10 m/s", "V = 40 m/s"))
    parts = []
    for locus in (halved, slow, fast):
        moved = [float(np.abs(locus.growth_rates(side) - base.growth_rates(side)).max()) for side in SIDES]
        what = f"{locus.curve.label}: largest shift of the growth rate"
        parts.append(Part(what, "1/s", "little", below(LITTLE), *moved))
    for locus, printed, criterion in ((slow, "stable", below(0.0)), (fast, "destabilised", above(0.0))):
        found = [float(locus.growth_rates(side)[LIGHTEST]) for side in SIDES]
        what = f"{locus.curve.label}, C = {DAMPERS[LIGHTEST]:g} N.s/m: growth rate"
        parts.append(Part(what, "1/s", printed, criterion, *found))
    text = (
        "Halving k and changing V move the real parts little, but at low C a higher V is significantly destabilising."
    )
    remark = (
        f"Little: less than {LITTLE:.2f} 1/s, 3 % of the paper's axis. Significant: what is stable becomes unstable."
    )
    return Claim(8, text, "section 8.2", tuple(parts), remark)


def claim_9(study: Study) -> Claim:
    """Changes by 20 %."""
    base = _locus(study, "case ii")

    def shifts(case: str, side: str) -> np.ndarray:
        return np.asarray(_locus(study, f"case {case}").growth_rates(side) - base.growth_rates(side))

    insensitive = ("iv", "v", "vi", "ix")
    largest = [max(float(np.abs(shifts(case, side)).max()) for case in insensitive) for side in SIDES]
    parts = [
        Part("cases iv, v, vi, ix: largest shift of the growth rate", "1/s", "insensitive", below(LITTLE), *largest)
    ]
    for case, what in (("vii", "M_c"), ("viii", "M_t")):
        everywhere = [float(-shifts(case, side).max()) for side in SIDES]
        parts.append(Part(f"{what} reduced: least gain in damping at any C", "1/s", "rises", above(0.0), *everywhere))
        clear = [float(-shifts(case, side)[HEAVIEST]) / largest[n] for n, side in enumerate(SIDES)]
        of_others = "the others' largest shift"
        parts.append(
            Part(f"{what} reduced: gain at C = 3200 N.s/m over {of_others}", "1", "significantly", above(2.0), *clear)
        )
    text = "Stability is insensitive to changes by 20 %, but damping rises clearly when M_c or M_t is reduced."
    return Claim(9, text, "section 8.2", tuple(parts))
