"""Whether indistinguishable models stay so over real or positive parameters: what the paper calls admissible parameter sets.

A pair that is indistinguishable over complex parameters is looked at both ways: has every model of the one with admissible
parameters an equivalent in the other with admissible parameters, have some, or none? Every one, both ways: indistinguishable.
None, both ways: distinguishable. Known otherwise: it depends on the parameters.
"""

from disting.certainty import Certainty
from disting.conditions.codec import finding_from_json, finding_to_json
from disting.conditions.evidence import Theorem
from disting.conditions.exact import theorem
from disting.conditions.finding import Finding, Outcome
from disting.conditions.question import Question
from disting.domain import Domain
from disting.model.chain import Chain
from disting.settings import Settings

ADMISSIBLE = 11  # number of this question, after the exact decision


def real_finding(a: Chain, b: Chain, settings: Settings) -> Finding:
    """Over real parameters the theorems decide, whose maps are rational."""
    named = theorem(a, b)
    if named:
        return Finding(ADMISSIBLE, Outcome.HOLDS, Certainty.THEOREM, evidence=Theorem(named))
    return Finding(ADMISSIBLE, Outcome.ABANDONED, note="over real parameters only theorems decide, and none applies")


ADMISSIBLY = {
    Domain.REAL: Question("real equivalents", real_finding, finding_to_json, finding_from_json),
    Domain.POSITIVE: Question("positive equivalents", real_finding, finding_to_json, finding_from_json),
}
