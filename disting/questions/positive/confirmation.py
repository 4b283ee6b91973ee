"""Checks evidence on positive equivalents again, from itself and the two chains alone."""

from disting.algebra.certainty import Certainty
from disting.decide import SHARE_CHAINS, check
from disting.evidence.decision import WEAKER, Exclusion, Theorem
from disting.evidence.kind import PointText
from disting.evidence.positive import (
    BoxMap,
    EmptyFibre,
    Interlacing,
    OnlyOne,
    Points,
    PositiveEvidence,
    PositiveFinding,
    Share,
)
from disting.fibres.synthesis.decide import safety_of_point
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import Status, target
from disting.model.chain import Chain
from disting.model.question import Answer
from disting.questions.positive.obstacles import (
    Obstacle,
    obstacle,
    only_rows_sum_to_zero,
    swap_fails,
)
from disting.questions.positive.points import equivalent, read
from disting.questions.positive.shares import refuse, row_words, theorem, without_dead_time


def confirms(evidence: PositiveEvidence, chain: Chain, other: Chain) -> bool:
    """Return True if the evidence holds for the two chains; statements about ranges are confirmed
    by `ranges.confirms_within`.
    """
    refuse(chain, other)
    chain, other = without_dead_time(chain), without_dead_time(other)
    return check(evidence, SHARE_CHAINS.rows, chain, other)


def proves(finding: PositiveFinding, chain: Chain, other: Chain) -> bool:
    """Return True if the finding's evidence holds for the two chains and proves its share, with the
    stated certainty.
    """
    evidence = finding.evidence
    if evidence is None or (finding.share, finding.certainty) != _share_of(evidence):
        return False
    bounded = finding.safety <= safety_of_point(without_dead_time(other))
    return bounded and confirms(evidence, chain, other)


def _share_of(evidence: PositiveEvidence) -> tuple[Share, Certainty]:
    """Share that evidence of this kind shows, and how surely."""
    match evidence:
        case Theorem() | BoxMap():
            return Share.ALWAYS, Certainty.THEOREM
        case Exclusion():
            return Share.NEVER, Certainty.PROVEN if evidence.point else Certainty.THEOREM
        case EmptyFibre():
            return Share.NEVER, Certainty.BOUNDED
        case Interlacing():
            return (
                Share.SOMETIMES if any(p.lacking for p in evidence.parts) else Share.ALWAYS
            ), Certainty.THEOREM
        case Points():
            return Share.SOMETIMES, Certainty.PROVEN
        case OnlyOne():
            return Share.ALWAYS, Certainty.BOUNDED


def check_theorem(evidence: Theorem, chain: Chain, other: Chain) -> bool:
    """The theorem by its name, or by that of the weaker one."""
    named = theorem(chain, other)
    return named != "" and evidence.name in (named, WEAKER.get(named))


def check_empty_fibre(evidence: EmptyFibre, chain: Chain, other: Chain) -> bool:
    """The fibre over the point once more."""
    return _is_of(evidence.point, chain) and _is_empty(evidence.point, chain, other)


def check_points(evidence: Points, chain: Chain, other: Chain) -> bool:
    """Both points once more."""
    return _answers(evidence.with_one, chain, other, Answer.YES) and _answers(
        evidence.without, chain, other, Answer.NO
    )


def check_obstacle(evidence: Exclusion, chain: Chain, other: Chain) -> bool:
    """The obstacle once more, at its point where it has one."""
    if evidence.name != Obstacle.SWAPPED:
        return obstacle(chain, other) == evidence.name
    fails = _is_of(evidence.point, chain) and swap_fails(chain, other)
    return fails and only_rows_sum_to_zero(chain, read(evidence.point), 2 * other.gap)


def _is_empty(point: PointText, chain: Chain, other: Chain) -> bool:
    return fibre(other, target(chain.structure, read(point))).status is Status.EMPTY


def check_words(evidence: Interlacing, chain: Chain, other: Chain) -> bool:
    """The rows again; points, where there are any, are checked again."""
    same = not chain.damped and evidence.parts == row_words(chain, other) != ()
    points = ((evidence.with_one, Answer.YES), (evidence.without, Answer.NO))
    return same and all(
        not values or _answers(values, chain, other, answer) for values, answer in points
    )


def _answers(values: PointText, chain: Chain, other: Chain, answer: Answer) -> bool:
    return _is_of(values, chain) and equivalent(chain, read(values), other) is answer


def _is_of(values: PointText, chain: Chain) -> bool:
    """Return True if these are all parameters, positive."""
    return sorted(name for name, _ in values) == sorted(chain.parameters) and all(
        v > 0 for v in read(values).values()
    )
