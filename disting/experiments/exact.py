"""The exact decision under several experiments, where conditions 1 to 7 stay silent: a list of all
parameters that fit one experiment, put into the others (`listing`), then the ideal of one fibre of
the stacked map.

All statements of `fibres.ideals` on one transfer function are statements on polynomial maps:
closures of images, fibres over a random point, tangent equations, slices, and bounds that are
computed from the degrees, the numbers and the count of the coordinates at hand. The stacked map
(`maps`) is such a map, so its fibre is that of all experiments with one parameter vector, and its
bounds are those of all equations together. More equations make the ideal easier, as a rule.

Of a whole menu, `quick_finding`: rows that show the same (`equal_machines`), lists that are made
once for all places, ranks of parts, and ideals within limits that are soon reached.

Ranks of parts. Equal closures of the images have equal closures of their projections, so whatever
coordinates are left out, as many parameters are determined on both sides. Meaningful parts are
compared (`maps`): numerators, denominators, and where an inertia is added, the coefficients with
the mass locked, those that its mass multiplies, and its mass. Condition 5 compares all sets of
invariants, one by one; where those are too many, or where it does not decide because the
coordinates differ, these few are compared quickly.

A rank found at a point modulo a prime is a lower bound. So the larger one is proven, and the
smaller one is wrong only where a minor that is not zero vanishes at all points
(`algebra.certainty`). A minor of k rows has a degree of at most the sum of those of the
coordinates, less one each; its coefficients sum to at most k! times the product of the largest sums
of a gradient's entry.

Which positive parameters of one measured chain have positive equivalents in another, where
generic complex ones have equivalents.

One experiment alone. No positive equivalents in one of them: none in all of them together. Always
positive equivalents in one of them, in which the searched chain has but one parameter vector for
a generic behaviour: that one is the equivalent under all of them.

Points. At a random rational point, positive, the list of one experiment is put into the others
(`listing`). Equivalents are among those that are not refuted. If all of these are certainly not
positive, the point has none. If one is left, it is the equivalent, which exists at generic points;
its conjugate is one too and has no other place, so it is real, and it is positive if its ball is.
Both are so all around the points. They are as certain as the equivalence of the models, and that
the points are generic (see `listing`; a scale of each coordinate changes none of it).
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import accumulate, combinations, pairwise
from math import ceil, log2

from flint import arb, fmpq, nmod_mat

from disting.algebra.certainty import (
    LEAST_SAFETY,
    PROOF_BITS,
    Certainty,
    Size,
    about,
    enough,
    residues,
    safety,
    weakest,
)
from disting.conditions.rule import EXACT, Finding, Outcome
from disting.decide import (
    SAME_MEASURED,
    SAME_MEASURED_QUICKLY,
    SHARE_MEASURED,
    first_finding,
)
from disting.evidence.positive import Empirical, OnlyOne, Points, PositiveFinding, Share
from disting.experiments.equal_machines import same_by_rows
from disting.experiments.experiment import MeasuredChain
from disting.experiments.listing import (
    ExperimentFibre,
    by_list,
    listable,
    listed_at,
    without_dead_time,
)
from disting.experiments.maps import match_maps
from disting.fibres.ideals import Limits, StackedMap, Terms, decide_matched
from disting.fibres.ideals.fibre_ideal import draw_point, jacobian
from disting.fibres.synthesis.decide import point_bits, rational_point, safety_of_point
from disting.fibres.synthesis.task import Solution
from disting.model.chain import Chain
from disting.model.question import Answer, Question, Settings
from disting.model.symmetry import canonical
from disting.questions.identifiability.analysis import identifiability
from disting.questions.same.exact import SAFETY, as_finding
from disting.questions.same.real_and_positive import positive_share

TRIES = 12  # points
SCALES = 4  # each coordinate is 2^-4, .., 2^4 times a number between 1/2 and 2
NO_LIST = "the equivalents under these experiments cannot be listed"
ONE_KIND = "all points that were tried are of one kind, and no argument for all of them is known"
LIMITS = Limits(seconds=600.0, entries=4_000_000, safety=SAFETY)
SHARED = 10  # bits: a table rests on up to a thousand findings, and says nothing below LEAST_SAFETY
QUICK = replace(LIMITS, entries=1_000_000, safety=LEAST_SAFETY + SHARED)
"""A matrix takes a second or two: there are hundreds of pairs."""


def positive_finding(
    machine: MeasuredChain, other: MeasuredChain, settings: Settings
) -> PositiveFinding:
    """Positive models of `machine` that have a positive equivalent in `other`."""
    machine, other = without_dead_time(machine), without_dead_time(other)
    finding: PositiveFinding = first_finding(SHARE_MEASURED.rows, machine, other, settings)
    return finding


def by_one_experiment(
    machine: MeasuredChain, other: MeasuredChain, settings: Settings
) -> PositiveFinding | None:
    """Finding of a single experiment that holds for all experiments."""
    for at in range(len(machine.experiments)):
        chain, other_chain = machine.alone(at), other.alone(at)
        if chain is not None and other_chain is not None:
            finding = _by_one(
                canonical(chain).chain, canonical(other_chain).chain, at + 1, settings
            )
            if finding is not None:
                return finding
    return None


def _by_one(chain: Chain, other: Chain, number: int, settings: Settings) -> PositiveFinding | None:
    """Finding of one experiment that holds for all experiments."""
    finding = positive_share(chain, other, settings)
    if finding.share is Share.NEVER:
        return finding
    if finding.share is not Share.ALWAYS or finding.certainty is None:
        return None
    count = identifiability(other, settings)
    if not count.least == count.most == 1 or count.count_grade[0] is Certainty.NUMERICAL:
        return None
    certainty, safety = weakest((finding.certainty, finding.safety), count.count_grade)
    return PositiveFinding(Share.ALWAYS, certainty, safety, OnlyOne(number))


def by_points(machine: MeasuredChain, other: MeasuredChain, settings: Settings) -> PositiveFinding:
    """Random points: one with a positive equivalent and one without."""
    sampled = list(_sample_answers(machine, other, settings.seed))
    if not sampled:
        return PositiveFinding(Share.UNKNOWN, reason=NO_LIST)
    by_answer = dict(reversed(sampled))
    answers = [answer for answer, _ in sampled]
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


def _sample_answers(
    machine: MeasuredChain, other: MeasuredChain, seed: str
) -> Iterator[tuple[Answer, ExperimentFibre]]:
    """Yield whether random positive points have a positive equivalent, each with its list."""
    at = next((at for at, _, _ in listable(machine, other)), None)
    if at is None:
        return
    for k in range(TRIES):
        label = about(f"positive:{seed}:{k}", machine, other)
        listed = listed_at(machine, other, at, _scale_values(machine, other, label))
        if listed is not None and listed.kept:
            yield answer_of(listed.kept), listed


def _scale_values(machine: MeasuredChain, other: MeasuredChain, label: str) -> dict[str, fmpq]:
    values = rational_point(machine.chain, label, point_bits(other.chain))
    steps = residues(f"scale:{label}", len(values), 2 * SCALES + 2)
    return {
        name: value * fmpq(2) ** (step - 1 - SCALES)
        for (name, value), step in zip(values.items(), steps, strict=True)
    }


def answer_of(kept: tuple[Solution, ...]) -> Answer:
    """Decide whether the equivalent among these is positive."""
    if all(s.positive is Answer.NO for s in kept):
        return Answer.NO
    alone = len(kept) == 1 and all(bool(v.real > arb(0)) for v in kept[0].values.values())
    return Answer.YES if alone else Answer.UNKNOWN


def by_parts(left: MeasuredChain, right: MeasuredChain, settings: Settings) -> Finding | None:
    """FAILS where the ranks of some parts differ, None where they are equal."""
    maps = match_maps(left, right)
    size = minor_size(maps)
    points = enough(size, settings.points)
    label = about(f"parts:{settings.seed}", *(m.content for m in maps))
    found = [ranks(m, [f"{label}:{k}" for k in range(points)]) for m in maps]
    if found[0] == found[1]:
        return None
    bits = safety(size, points) - ceil(log2(2 * len(found[0])))
    return Finding(EXACT, Outcome.FAILS, Certainty.BOUNDED, safety=bits)


def ranks(stacked: StackedMap, labels: Sequence[str]) -> tuple[int, ...]:
    """The largest rank of each union of parts found at the points of the labels."""
    return tuple(map(max, zip(*(_ranks_at(stacked, label) for label in labels), strict=True)))


def _ranks_at(stacked: StackedMap, label: str) -> list[int]:
    modulus, point = draw_point(stacked, label, PROOF_BITS)
    rows = [[int(x) for x in row] for row in jacobian(stacked, point, modulus).tolist()]
    width = len(point)
    return [
        nmod_mat(len(chosen), width, [x for i in chosen for x in rows[i]], modulus).rank()
        for chosen in _unions(stacked.parts)
    ]


def minor_size(maps: Sequence[StackedMap]) -> Size:
    """Bounds of the minors of both Jacobian matrices."""
    degree = bits = 0
    for stacked in maps:
        k = len(stacked.parameters)
        highest = sorted((_degree(c) for c in stacked.coordinates), reverse=True)
        height = max(sum(abs(n) for _, n in c) for c in stacked.coordinates)
        degree = max(degree, sum(highest[:k]))
        each = log2(max(height, 1)) + log2(max(highest[0], 1)) + log2(k + 1)
        bits = max(bits, ceil(k * each))
    return Size(degree, bits)


def _degree(terms: Terms) -> int:
    return max((sum(e) for e, _ in terms), default=0)


def _unions(parts: Sequence[int]) -> Iterator[list[int]]:
    """Positions of the coordinates of every union of parts."""
    ends = list(pairwise(accumulate(parts, initial=0)))
    for count in range(1, len(ends) + 1):
        for chosen in combinations(ends, count):
            yield [i for first, last in chosen for i in range(first, last)]


def exact_finding(left: MeasuredChain, right: MeasuredChain, settings: Settings) -> Finding:
    """The finding for two measured chains of equal ranks and degrees; dead times are equal where
    conditions 1 to 3 hold, and a factor of their own.
    """
    finding: Finding = first_finding(SAME_MEASURED.rows, left, right, settings)
    return finding


def by_ideals(
    left: MeasuredChain, right: MeasuredChain, settings: Settings, limits: Limits | None = None
) -> Finding:
    """Finding from the ideal of one fibre of the stacked map."""
    maps = match_maps(left, right)
    decision = decide_matched(*maps, equal_rank=True, seed=settings.seed, limits=limits or LIMITS)
    return as_finding(decision)


def quick_finding(left: MeasuredChain, right: MeasuredChain, settings: Settings) -> Finding:
    """One of many decisions on the same chains; it names no evidence where rows or parts
    decide.
    """
    finding: Finding = first_finding(SAME_MEASURED_QUICKLY.rows, left, right, settings)
    return finding


def by_rows(left: MeasuredChain, right: MeasuredChain, settings: Settings) -> Finding | None:
    """Rows that show the same."""
    return Finding(EXACT, Outcome.HOLDS, Certainty.PROVEN) if same_by_rows(left, right) else None


def by_shared_list(left: MeasuredChain, right: MeasuredChain, settings: Settings) -> Finding | None:
    """A list of equivalents at a point that all places of a menu share."""
    return by_list(left, right, settings, shared=True)


def by_small_ideals(left: MeasuredChain, right: MeasuredChain, settings: Settings) -> Finding:
    """The ideals within limits that are soon reached."""
    return by_ideals(left, right, settings, QUICK)


QUICKLY = Question(
    "exact decisions under experiments, quickly", quick_finding, Finding.to_json, Finding.from_json
)
