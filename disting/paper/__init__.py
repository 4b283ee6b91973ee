"""What the paper prints, claim by claim, each with a check against what this package computes.

Tantau, Perner, Wielitzka, "Model Selection for Servo Control Systems", International Journal of
Mechatronics and Automation,
2020. Tests assert every outcome, and the page "The paper, claim by claim" prints the same list.
"""

from disting.paper.claim import (
    Claim as Claim,
    Findings as Findings,
    Found as Found,
    Outcome as Outcome,
)
from disting.paper.claims import CLAIMS as CLAIMS
from disting.paper.refit import Mode as Mode, Refit as Refit
