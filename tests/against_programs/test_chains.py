"""Random chains with dampers to the ground, lag, dead time and all ports, against Singular and
matrices of its own.
"""

from fractions import Fraction

import pytest

from disting import Chain, Query, Relation, View, compare
from disting.decide.identifiability.analysis import identifiability
from tests.against_programs.draws import Tally, cases
from tests.oracles.plain_chains import drawn_chain, plain_chain
from tests.oracles.plain_models import by_fibres, shaped_zeros
from tests.oracles.singular import PROGRAM

pytestmark = [pytest.mark.slow, pytest.mark.skipif(not PROGRAM, reason="Singular is not installed")]
RELATION = {True: Relation.INDISTINGUISHABLE, False: Relation.DISTINGUISHABLE}
# what most pairs share, so that they are not told apart by counting
ALIKE = ("sensor", "lag", "dead_time")


def drawn_pair(draw):
    masses, damped = draw.choice([2, 3, 3]), draw.random() < 0.5
    one, other = (drawn_chain(draw, masses, damped) for _ in range(2))
    if draw.random() < 0.85:
        other |= {name: one[name] for name in ALIKE}
        other["ground_dampers"] = tuple(
            sorted(draw.sample(range(1, masses + 1), len(one["ground_dampers"])))
        )
    return Chain(**one), Chain(**other)


def same(one, other, draw):
    """The truth; models with and without a dead time differ, and two dead times are one more
    parameter on both sides.
    """
    if one.dead_time != other.dead_time:
        return False
    true = by_fibres(plain_chain(one), plain_chain(other), draw)
    return None if true is None else true.same


def point(draw, names):
    return {name: str(Fraction(draw.randint(1, 60), draw.randint(1, 60))) for name in names}


def test_verdicts_over_complex_parameters(record_property):
    tally = Tally()
    for label, draw in cases("chains", 250):
        one, other = drawn_pair(draw)
        true = same(one, other, draw)
        if true is None:
            tally["open in Singular"] += 1
            continue
        for left, right in ((one, other), (other, one)):
            verdict = compare(left, right, query=Query(View.EXACT))
            if verdict.relation is Relation.UNDECIDED:
                tally["undecided"] += 1
            else:
                tally.check(
                    verdict.relation is RELATION[true],
                    f"{label}: {left} | {right}: {true}, {verdict.sentence}",
                )
    tally.report(record_property)


def test_numbers_of_parameter_vectors(record_property):
    """Rank and number of parameter vectors with one behaviour, against dimension and degree of
    a fibre at a random point.
    """
    tally = Tally()
    for label, draw in cases("counts", 80):
        arguments = drawn_chain(draw, draw.choice([1, 2, 2, 3]), draw.random() < 0.6)
        chain = Chain(**arguments | {"lag": draw.random() < 0.5, "dead_time": False})
        plain = plain_chain(chain)
        true = shaped_zeros(plain, point(draw, plain.parameters), plain, draw)
        if true is None:
            tally["open in Singular"] += 1
            continue
        found = identifiability(chain)
        tally.check(
            found.rank == len(chain.parameters) - true.dimension,
            f"{label}: {chain}: rank {found.rank}, {true}",
        )
        if true.dimension == 0:
            most = true.count if found.most is None else found.most
            tally.check(
                found.least <= true.count <= most,
                f"{label}: {chain}: {found.least} to {found.most}, {true}",
            )
    tally.report(record_property)


@pytest.mark.parametrize("view", [View.REAL, View.POSITIVE])
def test_verdicts_over_real_and_positive_parameters(view, record_property):
    """As for general models: "always" and "never" hold at random positive points, and both
    orders agree.
    """
    tally = Tally()
    for label, draw in cases(f"chains:{view}", 120):
        one, other = drawn_pair(draw)
        if one.dead_time or other.dead_time or not same(one, other, draw):
            continue
        verdict, back = (compare(*pair, query=Query(view)) for pair in ((one, other), (other, one)))
        tally[verdict.relation.value] += 1
        tally.check(
            verdict.relation is back.relation, f"{label}: {verdict.sentence} {back.sentence}"
        )
        for given, searched in ((one, other), (other, one)):
            for _ in range(3 if verdict.relation in RELATION.values() else 0):
                here, there = plain_chain(given), plain_chain(searched)
                true = shaped_zeros(here, point(draw, here.parameters), there, draw)
                if true is None or true.dimension > 0:
                    tally["points left open"] += 1
                    continue
                exists = bool(true.real if view is View.REAL else true.positive)
                expected = verdict.relation is Relation.INDISTINGUISHABLE
                tally.check(
                    exists is expected,
                    f"{label}: {given} in {searched}: {true}, {verdict.sentence}",
                )
    tally.report(record_property)
