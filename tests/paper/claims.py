"""What the paper prints, claim by claim, each with a check against what this package computes.

Tantau, Perner, Wielitzka, "Model Selection for Servo Control Systems", International Journal of
Mechatronics and Automation, 2020. Tests assert every outcome, and the page "The paper, claim by claim" prints the same list.
"""

from tests.paper.claim import (
    Claim,
    Findings as Findings,
    Mode as Mode,
    Observed as Observed,
    Outcome as Outcome,
    Refit as Refit,
)
from tests.paper.fit_claims import COST_CLAIMS, SELECTION_CLAIMS
from tests.paper.model_claims import CANDIDATE_CLAIMS, FAMILY_CLAIMS
from tests.paper.verdict_claims import COMBINED_CLAIMS, DAMPED_CLAIMS, VERDICT_CLAIMS

SECTIONS: tuple[tuple[str, tuple[Claim, ...]], ...] = (
    ("Model selection, sections 2 and 3", COST_CLAIMS + SELECTION_CLAIMS),
    ("The models, section 5.1", FAMILY_CLAIMS),
    ("Verdicts on 3 masses, section 5.2", VERDICT_CLAIMS + DAMPED_CLAIMS),
    ("All conditions together, section 5.2 and conclusions", COMBINED_CLAIMS),
    ("Delay, lag and base dampers, section 5.2", CANDIDATE_CLAIMS),
)
"""Title and claims of each part of the list."""
CLAIMS = tuple(claim for _, claims in SECTIONS for claim in claims)
