"""Whether indistinguishable models stay so over real or positive parameters: what the paper calls admissible parameter sets.

A pair that is indistinguishable over complex parameters is looked at both ways: has every model of the one with admissible
parameters an equivalent in the other with admissible parameters, have some, or none? Every one, both ways: indistinguishable.
None, both ways: distinguishable. Known otherwise: it depends on the parameters.
"""

from collections.abc import Mapping

from disting.certainty import Certainty
from disting.conditions.codec import finding_from_json, finding_to_json
from disting.conditions.evidence import Sometimes, Theorem
from disting.conditions.exact import theorem
from disting.conditions.finding import Finding, Outcome
from disting.conditions.question import Question
from disting.domain import Domain
from disting.model.chain import Chain
from disting.settings import Settings
from disting.synthesis.admit import positive_equivalent, positive_point
from disting.synthesis.result import Answer

ADMISSIBLE = 11  # number of this question, after the exact decision
RATIONAL = ("symmetry", "duality")  # theorems whose maps are rational, so that they take real parameters to real ones
TRIES = 40  # random points a direction
WAYS = ("of the first", "of the second")


def positive_finding(a: Chain, b: Chain, settings: Settings) -> Finding:
    """Over positive parameters: a theorem, or points with and without an equivalent."""
    named = theorem(a, b)
    if named:
        return Finding(ADMISSIBLE, Outcome.HOLDS, Certainty.THEOREM, evidence=Theorem(named))
    ways = [_sampled(left_given, a, b, settings) for left_given in (True, False)]
    for found in ways:
        if found.with_one and found.without:
            return Finding(ADMISSIBLE, Outcome.SOMETIMES, Certainty.PROVEN, evidence=found)
    shares = " and ".join(f"{found.hits} of {found.tries} random points {way}" for found, way in zip(ways, WAYS, strict=True))
    return Finding(
        ADMISSIBLE, Outcome.ABANDONED, note=f"{shares} are known to have a positive equivalent, which proves nothing"
    )


def _sampled(left_given: bool, a: Chain, b: Chain, settings: Settings) -> Sometimes:
    """What random points of one model show."""
    given, searched = (a, b) if left_given else (b, a)
    points = [positive_point(given, f"positive:{settings.seed}:{k}") for k in range(TRIES)]
    answers = [positive_equivalent(given, point, searched) for point in points]
    first = {answer: points[answers.index(answer)] for answer in set(answers)}
    with_one, without = (_spelled(first.get(answer, {})) for answer in (Answer.YES, Answer.NO))
    return Sometimes(left_given, with_one, without, answers.count(Answer.YES), TRIES)


def _spelled(point: Mapping[str, object]) -> tuple[tuple[str, str], ...]:
    return tuple((name, str(value)) for name, value in point.items())


def real_finding(a: Chain, b: Chain, settings: Settings) -> Finding:
    """Over real parameters the theorems with rational maps decide."""
    named = theorem(a, b)
    if named in RATIONAL:
        return Finding(ADMISSIBLE, Outcome.HOLDS, Certainty.THEOREM, evidence=Theorem(named))
    return Finding(ADMISSIBLE, Outcome.ABANDONED, note="over real parameters no theorem applies, and nothing else is tried")


ADMISSIBLY = {
    Domain.REAL: Question("real equivalents", real_finding, finding_to_json, finding_from_json),
    Domain.POSITIVE: Question("positive equivalents", positive_finding, finding_to_json, finding_from_json),
}
