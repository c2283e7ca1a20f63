"""The thirteen claims of the paper, each with theory and the FMU where both can speak, and that verdicts can fail."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest

from overrun_hitch.paper.claims.all import CLAIMS, all_claims
from overrun_hitch.paper.claims.claim import Claim, Part, above, below, near, rounds_to
from overrun_hitch.paper.claims.mode import claim_4, claim_5, claim_6, claim_7, claim_8, claim_9
from overrun_hitch.paper.claims.motion import claim_10, claim_11, claim_12, claim_13
from overrun_hitch.paper.claims.steady import claim_1, claim_2, claim_3
from overrun_hitch.paper.study.study import Study


def checked(claim: Claim, silent_in_theory: int = 0) -> Claim:
    """The claim, if it holds on both sides. So many parts are of motions that linear theory does not cover."""
    for part in claim.parts:
        print(
            f"{claim.number}: {part.what} ({part.unit}): {part.printed}, theory {part.theory:.5g}, FMU {part.fmu:.5g}"
        )
    assert claim.verdict == "holds"
    assert claim.holds("fmu") is True and claim.holds("theory") is True
    assert sum(np.isnan(part.theory) for part in claim.parts) == silent_in_theory
    return claim


def both(part: Part) -> tuple[float, float]:
    return part.theory, part.fmu


def test_1_deceleration_ratios(paper_study: Study) -> None:
    claim = checked(claim_1(paper_study))
    assert [round(part.fmu, 2) for part in claim.parts] == [0.90, 0.95, 0.98] + 6 * [0.95]
    for part in claim.parts:
        assert part.fmu == pytest.approx(part.theory, rel=1e-4)


def test_2_one_centimetre(paper_study: Study) -> None:
    for part in checked(claim_2(paper_study)).parts:
        assert both(part) == pytest.approx((1.0, 1.0), rel=2e-3)


def test_3_what_the_steady_state_depends_on(paper_study: Study) -> None:
    claim = checked(claim_3(paper_study))
    halved = [part for part in claim.parts if part.printed == "halved"]
    assert len(claim.parts) == 8 and len(halved) == 1
    assert both(halved[0]) == pytest.approx((0.5, 0.5), rel=1e-4)


def test_4_self_excitation(paper_study: Study) -> None:
    for part in checked(claim_4(paper_study)).parts:
        assert part.fmu == pytest.approx(part.theory, abs=1e-4)


def test_5_amplitude_ratios(paper_study: Study) -> None:
    claim = checked(claim_5(paper_study))
    assert [round(part.fmu) for part in claim.parts] == [9, 3, 19, 3, 48, 3]
    assert "49.0" in claim.remark  # without any damper


def test_6_phases(paper_study: Study) -> None:
    light, heavy = checked(claim_6(paper_study)).parts
    assert light.fmu == pytest.approx(174.1, abs=0.1)
    assert heavy.fmu == pytest.approx(110.0, abs=0.1)


def test_7_cases_beside_each_other(paper_study: Study) -> None:
    checked(claim_7(paper_study))


def test_8_stiffness_and_speed(paper_study: Study) -> None:
    checked(claim_8(paper_study))


def test_9_insensitivity(paper_study: Study) -> None:
    checked(claim_9(paper_study))


def test_10_growth_and_frequencies(paper_study: Study) -> None:
    checked(claim_10(paper_study), silent_in_theory=2)


def test_11_who_moves(paper_study: Study) -> None:
    checked(claim_11(paper_study), silent_in_theory=1)


def test_12_linear_theory_in_figures_7_and_8(paper_study: Study) -> None:
    claim = checked(claim_12(paper_study))
    growth, frequency = (part for part in claim.parts if part.what.startswith("figure 8"))
    assert growth.fmu == pytest.approx(growth.theory, abs=1e-3)
    assert frequency.fmu == pytest.approx(frequency.theory, rel=1e-3)


def test_13_clearance(paper_study: Study) -> None:
    claim = checked(claim_13(paper_study), silent_in_theory=9)
    delays = [part for part in claim.parts if "delay" in part.what]
    for part in delays:
        assert part.fmu == pytest.approx(part.theory, abs=1e-3)


def test_they_are_all_there(paper_study: Study) -> None:
    assert [claim.number for claim in all_claims(paper_study)] == list(range(1, 14))
    assert len(CLAIMS) == 13


# What the FMU says is changed, claim by claim; the verdict must follow.
def steady_off(study: Study) -> Study:
    wrong = {
        name: dataclasses.replace(state, ratio=state.ratio - 0.02, D=1.2 * state.D)
        for name, state in study.steady_fmu.items()
    }
    wrong["C = 250 N.s/m"] = study.steady_fmu["i"]
    return dataclasses.replace(study, steady_fmu=wrong)


def modes_off(study: Study) -> Study:
    """Every measured mode becomes that of its neighbour with twice the damping, and cases change places."""
    loci = {
        figure: tuple(
            dataclasses.replace(locus, fmu=other.fmu[1:] + other.fmu[-1:])
            for locus, other in zip(group, group[1:] + group[:1], strict=True)
        )
        for figure, group in study.loci.items()
    }
    return dataclasses.replace(study, loci=loci)


def runs_off(study: Study) -> Study:
    """Every run becomes that of another figure."""
    names = list(study.runs)
    runs = dict(zip(names, [study.runs[name] for name in names[::-1]], strict=True))
    return dataclasses.replace(study, runs=runs, run_without_clearance=study.runs["9"])


@pytest.mark.parametrize(
    ("claim", "change"),
    [
        *((claim, steady_off) for claim in (claim_1, claim_2, claim_3)),
        *((claim, modes_off) for claim in (claim_4, claim_5, claim_6, claim_7, claim_8, claim_9)),
        *((claim, runs_off) for claim in (claim_10, claim_11, claim_12, claim_13)),
    ],
)
def test_a_claim_can_fail(
    paper_study: Study, claim: Callable[[Study], Claim], change: Callable[[Study], Study]
) -> None:
    assert claim(change(paper_study)).verdict.startswith("does not hold")


def test_criteria() -> None:
    assert rounds_to(0.95, 2).is_met(0.9549) and not rounds_to(0.95, 2).is_met(0.9551)
    assert near(1.0, 0.1).is_met(0.9) and not near(1.0, 0.1).is_met(1.11)
    assert above(1.0).is_met(1.1) and not above(1.0).is_met(1.0)
    assert below(1.0).is_met(0.9) and not below(1.0).is_met(1.0)


def test_verdicts_name_the_side() -> None:
    def claim(theory: float, fmu: float) -> Claim:
        return Claim(0, "", "", (Part("", "1", "", above(0.0), theory, fmu),))

    nan = float("nan")
    assert claim(1.0, 1.0).verdict == "holds"
    assert claim(1.0, -1.0).verdict == "does not hold on the FMU"
    assert claim(-1.0, 1.0).verdict == "does not hold in theory"
    assert claim(-1.0, -1.0).verdict == "does not hold in theory and on the FMU"
    assert claim(nan, 1.0).holds("theory") is None and claim(nan, 1.0).verdict == "holds"


def test_the_boundary_is_where_theory_has_it(paper_study: Study) -> None:
    checks = paper_study.boundary.checks
    assert len(checks) == 9 and all(check.holds for check in checks)
    for check in checks:  # the growth rate is a straight line there: zero in the middle
        assert check.growth_below + check.growth_above == pytest.approx(0.0, abs=2e-4)


def test_with_clearance_it_is_still_the_boundary_that_decides(paper_study: Study) -> None:
    """Case ii at 40 m/s: above C_crit (120.7 N.s/m) every motion fades, below it none does, whatever the clearance."""
    verdicts = {(motion.C, motion.eps): motion.fmu.verdict for motion in paper_study.motions}
    assert {verdict for (C, _), verdict in verdicts.items() if C > 120.7} == {"fades"}
    assert "fades" not in {verdict for (C, _), verdict in verdicts.items() if C < 120.7}
    assert all(verdicts[C, 0.1] == "sustained" for C in (40.0, 60.0, 80.0, 100.0, 110.0))
