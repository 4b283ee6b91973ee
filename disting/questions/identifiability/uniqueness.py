"""Whether an identifiable function has one value for all parameters with the same behaviour, or
several.

Seen at one random point. A difference there is one for generic points, where the solutions vary
continuously; agreement at exactly known solutions, which are rational functions of the point, is
generic but for a probability like that of their number.
"""

from typing import Any

from flint import acb, fmpq

from disting.algebra.certainty import Certainty
from disting.fibres.synthesis.result import Answer, Status
from disting.questions.identifiability.functions import Candidate
from disting.questions.identifiability.parts import Combination, Origin
from disting.questions.identifiability.solutions import Listing, Member

Judgement = tuple[Answer, Certainty]


def combination(candidate: Candidate, known: Listing) -> Combination:
    """The candidate with the answer that the listed solutions give."""
    return Combination(candidate.formula, candidate.name, *_judged(candidate, known))


def _judged(candidate: Candidate, known: Listing) -> Judgement:
    """Different at a solution that exists: NO. Equal at all exact ones, none other: YES. The
    rest rests on balls or is open.
    """
    if candidate.name:
        return Answer.YES, Certainty.THEOREM  # a coefficient is what an experiment shows
    here = candidate.formula.value(known.point)
    apart = [
        m.said.certainty
        for m in known.members
        if not _same(here, candidate.formula.value(m.values))
    ]
    for certainty in (Certainty.THEOREM, Certainty.PROVEN, Certainty.NUMERICAL):
        if certainty in apart:
            return Answer.NO, certainty
    if known.status not in (Status.COMPLETE, Status.INFINITE):
        return Answer.UNKNOWN, Certainty.NUMERICAL
    return Answer.YES, (
        known.grade[0] if known.most == _exact(known.members) else Certainty.NUMERICAL
    )


def _exact(members: tuple[Member, ...]) -> int:
    return sum(m.said.origin is not Origin.OTHER for m in members)


def _same(here: fmpq, there: Any) -> bool:
    return here == there if isinstance(there, fmpq) else bool(there.overlaps(acb(here)))
