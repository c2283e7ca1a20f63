"""The thirteen claims of the paper, in its order."""

from __future__ import annotations

from overrun_hitch.paper.claims import mode as claims_mode
from overrun_hitch.paper.claims import motion as claims_motion
from overrun_hitch.paper.claims import steady as claims_steady
from overrun_hitch.paper.claims.claim import Claim
from overrun_hitch.paper.study.study import Study

CLAIMS = (
    claims_steady.claim_1,
    claims_steady.claim_2,
    claims_steady.claim_3,
    claims_mode.claim_4,
    claims_mode.claim_5,
    claims_mode.claim_6,
    claims_mode.claim_7,
    claims_mode.claim_8,
    claims_mode.claim_9,
    claims_motion.claim_10,
    claims_motion.claim_11,
    claims_motion.claim_12,
    claims_motion.claim_13,
)


def all_claims(study: Study) -> list[Claim]:
    """Every claim with its numbers and its verdict."""
    return [claim(study) for claim in CLAIMS]
