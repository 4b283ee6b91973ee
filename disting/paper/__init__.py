"""What the paper prints, claim by claim, each with a check against what this package computes.

Tantau, Perner, Wielitzka, "Model Selection for Servo Control Systems", International Journal of
Mechatronics and Automation,
2020. Tests assert every outcome, and the page "The paper, claim by claim" prints the same list.
"""

from disting.paper.candidate_claims import CANDIDATE_CLAIMS
from disting.paper.claim import (
    Claim as Claim,
    Findings as Findings,
    Observed as Observed,
    Outcome as Outcome,
)
from disting.paper.combined_claims import COMBINED_CLAIMS
from disting.paper.cost_claims import COST_CLAIMS
from disting.paper.damped_claims import DAMPED_CLAIMS
from disting.paper.family_claims import FAMILY_CLAIMS
from disting.paper.refit import Mode as Mode, Refit as Refit
from disting.paper.selection_claims import SELECTION_CLAIMS
from disting.paper.verdict_claims import VERDICT_CLAIMS

SECTIONS: tuple[tuple[str, tuple[Claim, ...]], ...] = (
    ("Model selection, sections 2 and 3", COST_CLAIMS + SELECTION_CLAIMS),
    ("The models, section 5.1", FAMILY_CLAIMS),
    ("Verdicts on 3 masses, section 5.2", VERDICT_CLAIMS + DAMPED_CLAIMS),
    ("All conditions together, section 5.2 and conclusions", COMBINED_CLAIMS),
    ("Delay, lag and base dampers, section 5.2", CANDIDATE_CLAIMS),
)
"""Title and claims of each part of the list."""
CLAIMS = tuple(claim for _, claims in SECTIONS for claim in claims)
