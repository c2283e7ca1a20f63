"""Claims 1 to 3: steady deceleration (the paper's sections 4 and 8.1)."""

from __future__ import annotations

from overrun_hitch.paper.claims.claim import Claim, Part, near, rounds_to
from overrun_hitch.paper.study.study import VARIATIONS, SteadyState, Study

PRINTED_RATIO = {"i": 0.90, "ii": 0.95, "iii": 0.98} | dict.fromkeys(("iv", "v", "vi", "vii", "viii", "ix"), 0.95)
# Slip lets the wheels turn a little slower than theory has it: slip times the wheels' share of the inertia.
STEADY_ALLOWED = 1e-3


def claim_1(study: Study) -> Claim:
    """A/A_c of the nine cases."""
    parts = [
        Part(
            f"case {case}: A / A_c",
            "1",
            f"{printed:.2f}",
            rounds_to(printed, 2),
            study.steady_theory[case].ratio,
            study.steady_fmu[case].ratio,
        )
        for case, printed in PRINTED_RATIO.items()
    ]
    text = "The deceleration ratio A/A_c is 0.90, 0.95, 0.98 for cases i, ii, iii and 0.95 for iv to ix."
    return Claim(1, text, "sections 8.1, 8.2", tuple(parts))


def claim_2(study: Study) -> Claim:
    """1 cm of deflection for 1 m/s2."""

    def deflection(state: SteadyState) -> float:
        return 100.0 * state.D / abs(state.A)

    parts = [
        Part(
            f"case {case}: D / |A|",
            "cm per m/s2",
            "1",
            rounds_to(1.0, 1),
            deflection(study.steady_theory[case]),
            deflection(study.steady_fmu[case]),
        )
        for case in ("i", "ii", "iii")
    ]
    text = "Cases i, ii, iii each deflect the drawbar by 1 cm for 1 m/s2 of deceleration."
    return Claim(2, text, "section 8.1", tuple(parts))


def claim_3(study: Study) -> Claim:
    """What the steady state depends on."""
    names = list(VARIATIONS)
    base = names[0]
    parts = []
    for name in names[1:]:
        scaled = name == "k and r doubled"
        sides = (study.steady_theory, study.steady_fmu)
        ratios = [side[name].ratio / side[base].ratio for side in sides]
        deflections = [side[name].D / side[base].D for side in sides]
        parts.append(Part(f"{name}: A/A_c against case ii", "1", "unchanged", near(1.0, STEADY_ALLOWED), *ratios))
        expected, printed = (0.5, "halved") if scaled else (1.0, "unchanged")
        parts.append(Part(f"{name}: D against case ii", "1", printed, near(expected, STEADY_ALLOWED), *deflections))
    text = "C and V do not enter the steady state; scaling k and r together scales D and leaves A/A_c."
    return Claim(3, text, "section 8.1", tuple(parts), "Equation 15 has neither C nor V in it: theory's 1 is by form.")
