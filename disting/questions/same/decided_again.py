"""How surely evidence shows what it shows: what the settings would have found with evidence of its
kind. A point, a prime or a bound that somebody chose bounds nothing.
"""

from disting.algebra.certainty import Certainty, Grade, weakest
from disting.conditions.finding import Finding, Outcome
from disting.conditions.rule import ADMISSIBLE, EXACT, Rule
from disting.evidence.decision import DeadTime, FibreAt, Theorem
from disting.evidence.ideals import FullRows, Refuted, Shared, Solved
from disting.evidence.kinds import Evidence
from disting.evidence.real import BothWays, OddFibres, RealFactors, RealWitnesses
from disting.fibres.decision import Decision
from disting.fibres.ideals import PolynomialMap, coefficient_map, matched, normalised, safety_of
from disting.model.chain import Chain
from disting.model.question import Membership
from disting.model.settings import Settings
from disting.questions.identifiability import identifiability
from disting.questions.same.exact import (
    by_full_rows,
    by_shares,
    by_synthesis,
    decided,
    rational_part,
    theorem,
)
from disting.questions.same.real_and_positive import (
    by_counts,
    lacking_real,
    positive_share,
    positive_ways,
    rational_map,
    real_factors,
    resting_on,
)


def exact_again(evidence: Evidence, a: Chain, b: Chain, settings: Settings) -> Finding | None:
    """What evidence of this kind says of two canonical chains of equal rank; None if nothing.

    All is computed again, but for ideals: of these the labels are drawn again.
    """
    match evidence:
        case Theorem():
            return _by_theorem(EXACT, theorem(a, b))
        case DeadTime() if a.dead_time != b.dead_time:
            time = DeadTime(a.dead_time)
            return Finding(EXACT, Outcome.FAILS, Certainty.THEOREM, evidence=time)
        case FibreAt():
            return by_synthesis(a, b, settings)
        case FullRows():
            return by_full_rows(a, b)
        case Shared():
            return by_shares(a, b, settings)
        case Solved() | Refuted():
            coordinates = normalised if evidence.is_normalised else coefficient_map
            maps = (coordinates(rational_part(chain)) for chain in (a, b))
            return by_labels(evidence, *matched(*maps), settings.seed)
    return None


def by_labels(
    evidence: Solved | Refuted, left: PolynomialMap, right: PolynomialMap, seed: str
) -> Finding:
    """What the ideals at these labels say of two models of equal rank, if the seed draws them."""
    is_solved = isinstance(evidence, Solved)
    told = Membership.MEMBER if is_solved else Membership.EXCLUDED
    return decided(Decision(told, safety_of(evidence, left, right, seed), evidence))


def admissible_again(
    evidence: Evidence, a: Chain, b: Chain, settings: Settings, equal: Grade
) -> Finding | None:
    """What evidence of this kind says over real or positive parameters of two canonical chains,
    which are equal over complex ones, so surely; None if nothing.
    """
    match evidence:
        case BothWays():
            return positive_ways(positive_share(a, b, settings), positive_share(b, a, settings))
        case Theorem():
            return _by_theorem(ADMISSIBLE, rational_map(a, b))
        case RealFactors() if real_factors(a, b):
            return Finding(ADMISSIBLE, Outcome.HOLDS, Certainty.THEOREM, evidence=evidence)
        case RealWitnesses():
            return _witnessed(evidence, a, b, settings)
        case OddFibres():
            counts = (identifiability(chain, settings) for chain in (a, b))
            return resting_on(by_counts(*counts), equal)
    return None


def _by_theorem(rule: Rule, name: str) -> Finding | None:
    if not name:
        return None
    return Finding(rule, Outcome.HOLDS, Certainty.THEOREM, evidence=Theorem(name))


def _witnessed(evidence: RealWitnesses, a: Chain, b: Chain, settings: Settings) -> Finding | None:
    without = (a, b) if evidence.without_left_given else (b, a)
    given, other = (a, b) if evidence.with_left_given else (b, a)
    found = positive_share(given, other, settings)
    point = lacking_real(*without, settings)
    if not point or found.certainty is None:
        return None
    again = RealWitnesses(evidence.without_left_given, point, evidence.with_left_given, found)
    grade = weakest((Certainty.PROVEN, 0), (found.certainty, found.safety))
    return Finding(ADMISSIBLE, Outcome.SOMETIMES, *grade, evidence=again)
