"""Every claim of the paper that is listed, in the paper's order of sections."""

from disting.paper.candidate_claims import CANDIDATE_CLAIMS
from disting.paper.claim import Claim
from disting.paper.combined_claims import COMBINED_CLAIMS
from disting.paper.damped_claims import DAMPED_CLAIMS
from disting.paper.family_claims import FAMILY_CLAIMS
from disting.paper.selection_claims import SELECTION_CLAIMS
from disting.paper.verdict_claims import VERDICT_CLAIMS

SECTIONS: tuple[tuple[str, tuple[Claim, ...]], ...] = (
    ("Model selection, sections 2 and 3", SELECTION_CLAIMS),
    ("The models, section 5.1", FAMILY_CLAIMS),
    ("Verdicts on 3 masses, section 5.2", VERDICT_CLAIMS + DAMPED_CLAIMS),
    ("All conditions together, section 5.2 and conclusions", COMBINED_CLAIMS),
    ("Delay, lag and base dampers, section 5.2", CANDIDATE_CLAIMS),
)
"""Title and claims of each part of the list."""
CLAIMS = tuple(claim for _, claims in SECTIONS for claim in claims)
