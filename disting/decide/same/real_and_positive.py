"""Equivalence of indistinguishable models over real or positive parameters, the admissible
parameter sets of the paper.

Positive. Both ways it is asked which positive models of the one have a positive equivalent in the
other (`disting.decide.positive`). All, both ways: indistinguishable. None, both ways:
distinguishable. Some in any way, and others not: it depends on the parameters. None in one way and
some in the other cannot be: the images of both chains have one closure V, and the behaviours with
positive parameters on both sides are either part of a proper subvariety of V, so that none occurs
for generic parameters of either chain, or they contain an open set of V(R), which parameters on
both sides reach.

Real. Symmetry and duality are rational maps, which take real parameters to real ones. Undamped
chains: real factors of all degrees that are needed exist both ways, or in an open set of models of
either chain they do not (see `decide.positive.real`). In the second case the verdict is "some"
if in any way all or some positive models have positive, so real, equivalents. Odd fibres: let n be
the number of parameter vectors of a chain with one generic behaviour of V, each a simple solution
(n is the number of points of a generic fibre of a dominant map, all of them simple in
characteristic zero). If the behaviour is real, the conjugate of a solution is a solution, so an
odd n leaves at least one that is its own conjugate. A unique solution (n = 1) is real for that
reason.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeVar

from disting.algebra.certainty import Certainty, Grade, weakest
from disting.conditions.chain_view import ChainSide
from disting.conditions.rule import ADMISSIBLE, NOT_REAL, Finding, Outcome
from disting.conditions.side import Ask
from disting.decide import REAL_CHAINS, first_finding
from disting.decide.identifiability.analysis import IDENTIFIABILITY
from disting.decide.identifiability.answer import Identifiability
from disting.decide.positive import always_real, positive_finding, real_witness
from disting.decide.same.exact import theorem
from disting.errors import InputError
from disting.evidence.conditions import Renaming
from disting.evidence.decision import RATIONAL, Theorem
from disting.evidence.kind import PointText
from disting.evidence.kinds import Evidence
from disting.evidence.positive import OddFibres, PositiveFinding, RealFactors, RealWitnesses, Share
from disting.model.chain import Chain
from disting.model.question import Domain, Question, Settings

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Answerers:
    """Who answers what the real finding rests on: positive equivalents of the one in the other,
    real models of the one without any, and counts of solutions.
    """

    positive: Callable[[Chain, Chain], PositiveFinding]
    lacking: Callable[[Chain, Chain], PointText]
    counted: Callable[[Chain], Identifiability]


def positive_share(chain: Chain, other: Chain, settings: Settings) -> PositiveFinding:
    """Positive models of one canonical chain that have a positive equivalent in another; UNKNOWN
    for chains of two kinds.
    """
    try:
        return positive_finding(chain, other, settings)
    except InputError as reason:
        return PositiveFinding(Share.UNKNOWN, reason=str(reason))


def lacking_real(chain: Chain, other: Chain, settings: Settings) -> PointText:
    """A point of one canonical chain in an open set of real models without real equivalents in
    another; () if none is found.
    """
    return real_witness(chain, other, settings.seed)


def _values(data: list[tuple[str, str]]) -> PointText:
    return tuple((name, value) for name, value in data)


LACKING = Question.plain("real models without equivalents", lacking_real, list, _values)
POSITIVELY = Question.plain(
    "positive equivalents", positive_share, PositiveFinding.to_dict, PositiveFinding.from_dict
)


def rational_map(left: Chain, right: Chain) -> str:
    """Name of the theorem that gives a rational map, "" if there is none."""
    named = theorem(left, right)
    return named if named in RATIONAL else ""


def real_factors(left: Chain, right: Chain) -> bool:
    """Return True if every real model of either canonical chain has a real equivalent in the other,
    by real factors.
    """
    return always_real(left, right) and always_real(right, left)


def needs_counts(left: Chain, right: Chain) -> bool:
    """Return True if the numbers of solutions may be needed; undamped chains are usually decided by
    their factors.
    """
    return bool(left.damped or left.ground_dampers) and not rational_map(left, right)


def witness_ways(left: Chain, right: Chain) -> tuple[tuple[Chain, Chain], ...]:
    """The orders in which a real model without real equivalents is searched, the second one only if
    the first has none.
    """
    if rational_map(left, right) or real_factors(left, right):
        return ()
    return tuple(sorted(((left, right), (right, left)), key=lambda pair: pair[0].indices))


def of_sides(left: ChainSide, right: ChainSide, domain: Domain, why: Evidence | None) -> Finding:
    """Return the decision over real parameters about two chains."""

    def answer(question: Question[T], *forms: Chain) -> T:
        return left.answerer(question, forms, left.settings)

    asked = Answerers(
        partial(answer, POSITIVELY), partial(answer, LACKING), partial(answer, IDENTIFIABILITY)
    )
    return real_finding(left.view.form, right.view.form, asked)


def prepare(pairs: Sequence[tuple[ChainSide, ChainSide]], domain: Domain, ask: Ask) -> None:
    """Count solutions of many pairs, and look for real models without real equivalents, the second
    way where the first finds none.
    """
    forms = [(a.view.form, b.view.form) for a, b in pairs]
    counted = [pair for pair in forms if needs_counts(*pair)]
    ask(IDENTIFIABILITY, [(chain,) for pair in counted for chain in pair])
    ways = [(a, witness_ways(*pair)) for (a, _), pair in zip(pairs, forms, strict=True)]
    for k in range(2):
        asked = [(s, way[k]) for s, way in ways if len(way) > k]
        ask(LACKING, [chains for _, chains in asked])
        none = {chains for s, chains in asked if not s.answerer(LACKING, chains, s.settings)}
        ways = [(s, way) for s, way in ways if len(way) > k and way[k] in none]


def real_finding(left: Chain, right: Chain, asked: Answerers) -> Finding:
    """Over real parameters, for pairs of canonical chains that are equal over C."""
    finding: Finding = first_finding(REAL_CHAINS.rows, left, right, asked)
    return finding


def by_rational_map(left: Chain, right: Chain, asked: Answerers) -> Finding | None:
    """A theorem whose map takes real parameters to real ones."""
    named = rational_map(left, right)
    if not named:
        return None
    return Finding(ADMISSIBLE, Outcome.HOLDS, Certainty.THEOREM, evidence=Theorem(named))


def by_real_factors(left: Chain, right: Chain, asked: Answerers) -> Finding | None:
    """Real factors of all degrees that are needed, both ways."""
    if not real_factors(left, right):
        return None
    return Finding(ADMISSIBLE, Outcome.HOLDS, Certainty.THEOREM, evidence=RealFactors())


def by_witnesses(left: Chain, right: Chain, asked: Answerers) -> Finding | None:
    """An open set of real models without real equivalents, and positive ones with a positive
    equivalent.
    """
    pairs = witness_ways(left, right)
    lacking = ((chain is left, asked.lacking(chain, other)) for chain, other in pairs)
    left_given, without = next((x for x in lacking if x[1]), (False, ()))
    for chain, other in pairs if without else ():
        with_one = asked.positive(chain, other)
        if with_one.certainty and with_one.share in (Share.ALWAYS, Share.SOMETIMES):
            evidence = RealWitnesses(left_given, without, chain is left, with_one)
            certainty, safety = weakest(
                (Certainty.PROVEN, 0), (with_one.certainty, with_one.safety)
            )
            return Finding(
                rule=ADMISSIBLE,
                outcome=Outcome.SOMETIMES,
                certainty=certainty,
                safety=safety,
                evidence=evidence,
            )
    return None


def by_odd_fibres(left: Chain, right: Chain, asked: Answerers) -> Finding:
    """The numbers of solutions of both, as far as they are known."""
    return by_counts(asked.counted(left), asked.counted(right))


def by_counts(left: Identifiability, right: Identifiability) -> Finding:
    """As sure as both numbers are."""
    certainty, safety = weakest(left.count_grade, right.count_grade)
    if certainty is not Certainty.NUMERICAL and all(_is_odd(x) for x in (left, right)):
        return Finding(
            rule=ADMISSIBLE,
            outcome=Outcome.HOLDS,
            certainty=certainty,
            safety=safety,
            evidence=OddFibres(left.least, right.least),
        )
    return Finding(ADMISSIBLE, Outcome.ABANDONED, note=NOT_REAL)


def resting_on(finding: Finding, equal: Grade, why: Evidence | None = None) -> Finding:
    """The finding on admissible parameters, which may rest on that over complex ones, so sure, and
    on its evidence.

    Odd fibres presuppose that the images are equal over C. A renaming takes real and positive
    parameters to such ones, whatever the kinds of the two chains: it decides where nothing else
    does.
    """
    if finding.outcome is Outcome.ABANDONED and isinstance(why, Renaming):
        return Finding(ADMISSIBLE, Outcome.HOLDS, *equal, evidence=why)
    if not isinstance(finding.evidence, OddFibres):
        return finding
    certainty, safety = weakest((finding.certainty, finding.safety), equal)
    return replace(finding, certainty=certainty, safety=safety)


def _is_odd(answer: Identifiability) -> bool:
    return answer.least == answer.most and answer.least % 2 == 1
