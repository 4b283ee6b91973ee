"""Which positive parameters of one measured chain have positive equivalents in another, where
generic complex ones have equivalents.

One experiment alone. No positive equivalents in one of them: none in all of them together. Always
positive equivalents in one of them, in which the searched chain has but one parameter vector for
a generic behaviour: that one is the equivalent under all of them.

Points. At a random rational point, positive, the list of one experiment is put into the others
(`listing`). Equivalents are among those that are not refuted. If all of these are certainly not
positive, the point has none. If one is left, it is the equivalent, which exists at generic points;
its conjugate is one too and has no other place, so it is real, and it is positive if its ball is.
Both are so all around the points. They are as sure as that the models are the same, and that the
points are generic (see `listing`; a scale of each coordinate changes none of it).
"""

from collections.abc import Iterator
from math import ceil, log2

from flint import arb, fmpq

from disting.algebra.certainty import Certainty, weakest
from disting.algebra.sampling import about, residues
from disting.evidence.positive import Empirical, OnlyOne, Points, PositiveFinding, Share
from disting.experiments.experiment import MeasuredChain
from disting.experiments.listing import Listed, listable, listed_at, without_dead_time
from disting.fibres.synthesis.decide import point_bits, rational_point, safety_of_point
from disting.fibres.synthesis.result import Answer, Solution
from disting.model.chain import Chain
from disting.model.question import Settings
from disting.model.symmetry import canonical
from disting.questions.identifiability import identifiability
from disting.questions.same.real_and_positive import positive_share

TRIES = 12  # points
SCALES = 4  # each coordinate is 2^-4, .., 2^4 times a number between 1/2 and 2
NO_LIST = "the equivalents under these experiments cannot be listed"
ONE_KIND = "all points that were tried are of one kind, and no argument for all of them is known"


def positive_finding(
    given: MeasuredChain, other: MeasuredChain, settings: Settings
) -> PositiveFinding:
    """Which positive models of `given` have a positive equivalent in `other`."""
    given, other = without_dead_time(given), without_dead_time(other)
    for at in range(len(given.experiments)):
        one, there = given.alone(at), other.alone(at)
        if one is not None and there is not None:
            found = _by_one(canonical(one).chain, canonical(there).chain, at + 1, settings)
            if found is not None:
                return found
    return _by_points(given, other, settings)


def _by_one(given: Chain, other: Chain, number: int, settings: Settings) -> PositiveFinding | None:
    """What one experiment says for all of them."""
    found = positive_share(given, other, settings)
    if found.share is Share.NEVER:
        return found
    if found.share is not Share.ALWAYS or found.certainty is None:
        return None
    count = identifiability(other, settings)
    if not count.least == count.most == 1 or count.count_grade[0] is Certainty.NUMERICAL:
        return None
    certainty, safety = weakest((found.certainty, found.safety), count.count_grade)
    return PositiveFinding(Share.ALWAYS, certainty, safety, OnlyOne(number))


def _by_points(given: MeasuredChain, other: MeasuredChain, settings: Settings) -> PositiveFinding:
    seen = list(_seen(given, other, settings.seed))
    if not seen:
        return PositiveFinding(Share.UNKNOWN, reason=NO_LIST)
    by_answer = dict(reversed(seen))
    answers = [answer for answer, _ in seen]
    empirical = Empirical(answers.count(Answer.YES), len(answers), answers.count(Answer.UNKNOWN))
    if not {Answer.YES, Answer.NO} <= set(answers):
        return PositiveFinding(Share.UNKNOWN, empirical=empirical, reason=ONE_KIND)
    evidence = Points(by_answer[Answer.YES].point, by_answer[Answer.NO].point)
    safety = safety_of_point(other.chain) - ceil(log2(TRIES))
    return PositiveFinding(
        share=Share.SOMETIMES,
        certainty=Certainty.BOUNDED,
        safety=safety,
        evidence=evidence,
        empirical=empirical,
    )


def _seen(given: MeasuredChain, other: MeasuredChain, seed: str) -> Iterator[tuple[Answer, Listed]]:
    """Yield whether random positive points have a positive equivalent, each with its list."""
    at = next((at for at, _, _ in listable(given, other)), None)
    if at is None:
        return
    for k in range(TRIES):
        label = about(f"positive:{seed}:{k}", given, other)
        listed = listed_at(given, other, at, _scaled(given, other, label))
        if listed is not None and listed.kept:
            yield answer_of(listed.kept), listed


def _scaled(given: MeasuredChain, other: MeasuredChain, label: str) -> dict[str, fmpq]:
    values = rational_point(given.chain, label, point_bits(other.chain))
    steps = residues(f"scale:{label}", len(values), 2 * SCALES + 2)
    return {
        name: value * fmpq(2) ** (step - 1 - SCALES)
        for (name, value), step in zip(values.items(), steps, strict=True)
    }


def answer_of(kept: tuple[Solution, ...]) -> Answer:
    """Whether the equivalent among these is positive."""
    if all(s.positive is Answer.NO for s in kept):
        return Answer.NO
    alone = len(kept) == 1 and all(bool(v.real > arb(0)) for v in kept[0].values.values())
    return Answer.YES if alone else Answer.UNKNOWN
