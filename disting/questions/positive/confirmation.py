"""Checks evidence on positive equivalents again, from itself and the two chains alone."""

from disting.algebra.certainty import Certainty
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
    """Whether the evidence is true of the two chains; statements about ranges are confirmed by
    `ranges.confirms_within`.
    """
    refuse(chain, other)
    chain, other = without_dead_time(chain), without_dead_time(other)
    match evidence:
        case Theorem():
            named = theorem(chain, other)
            return named != "" and evidence.name in (named, WEAKER.get(named))
        case Exclusion():
            return _excluded(evidence, chain, other)
        case EmptyFibre():
            return _is_of(evidence.point, chain) and _is_empty(evidence.point, chain, other)
        case Interlacing():
            return _interlaced(evidence, chain, other)
        case Points():
            return _answers(evidence.with_one, chain, other, Answer.YES) and _answers(
                evidence.without, chain, other, Answer.NO
            )
        case BoxMap() | OnlyOne():
            return False  # of ranges, and of chains under several experiments


def proves(finding: PositiveFinding, chain: Chain, other: Chain) -> bool:
    """Whether the finding's evidence is true of the two chains and shows its share, as surely
    as it says.
    """
    evidence = finding.evidence
    if evidence is None or (finding.share, finding.certainty) != _shown(evidence):
        return False
    bounded = finding.safety <= safety_of_point(without_dead_time(other))
    return bounded and confirms(evidence, chain, other)


def _shown(evidence: PositiveEvidence) -> tuple[Share, Certainty]:
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


def _excluded(evidence: Exclusion, chain: Chain, other: Chain) -> bool:
    if evidence.name != Obstacle.SWAPPED:
        return obstacle(chain, other) == evidence.name
    fails = _is_of(evidence.point, chain) and swap_fails(chain, other)
    return fails and only_rows_sum_to_zero(chain, read(evidence.point), 2 * other.gap)


def _is_empty(point: PointText, chain: Chain, other: Chain) -> bool:
    return fibre(other, target(chain.structure, read(point))).status is Status.EMPTY


def _interlaced(evidence: Interlacing, chain: Chain, other: Chain) -> bool:
    """The rows again; points, where there are any, are looked at again."""
    same = not chain.damped and evidence.parts == row_words(chain, other) != ()
    points = ((evidence.with_one, Answer.YES), (evidence.without, Answer.NO))
    return same and all(
        not values or _answers(values, chain, other, answer) for values, answer in points
    )


def _answers(values: PointText, chain: Chain, other: Chain, answer: Answer) -> bool:
    return _is_of(values, chain) and equivalent(chain, read(values), other) is answer


def _is_of(values: PointText, chain: Chain) -> bool:
    """Whether these are all parameters, positive."""
    return sorted(name for name, _ in values) == sorted(chain.parameters) and all(
        v > 0 for v in read(values).values()
    )
