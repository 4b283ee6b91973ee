"""Random general models against Singular: verdicts in both orders, ranks, all equivalents at a
point, verdicts over real and positive parameters against the equivalents at random points.
"""

from fractions import Fraction

import pytest

from disting import (
    Domain,
    InputError,
    Query,
    Relation,
    View,
    alternatives,
    compare,
    local_identifiability,
)
from disting.general.fibre import Extent
from disting.general.target import rational_values, target
from tests.against_programs.draws import Tally, cases
from tests.oracles import plain_by_sympy
from tests.oracles.drawn_models import pair
from tests.oracles.plain_models import truth, zeros
from tests.oracles.singular import PROGRAM

pytestmark = pytest.mark.slow
needs_singular = pytest.mark.skipif(not PROGRAM, reason="Singular is not installed")
RELATION = {True: Relation.INDISTINGUISHABLE, False: Relation.DISTINGUISHABLE}
POINTS = 6  # of each model


def drawn(draw):
    """A pair written down, and as the package has it; None where the package refuses a model (a
    transfer function 0).
    """
    try:
        kind, left, right = pair(draw)
        return kind, (left, left.model("left")), (right, right.model("right"))
    except InputError:
        return None


def same(left, right, draw):
    """The truth and the ranks, by Singular where it is installed, else by SymPy, which leaves
    the ranks out; None: open.
    """
    if not PROGRAM:
        return plain_by_sympy.same(left, right, draw), None
    true = truth(left, right, draw)
    return (true.same, true.ranks) if true else (None, None)


def test_verdicts_over_complex_parameters(record_property):
    tally = Tally()
    for label, draw in cases("general", 400 if PROGRAM else 40):
        if not (found := drawn(draw)):
            tally["refused"] += 1
            continue
        kind, (one, first), (other, second) = found
        true, ranks = same(one.plain(), other.plain(), draw)
        if true is None:
            tally["open in the other program"] += 1
            continue
        for left, right in ((first, second), (second, first)):
            verdict = compare(left, right, query=Query(View.EXACT))
            tally.check(
                verdict.relation is RELATION[true],
                f"{label} {kind}: {left}; {right}: {true}, {verdict.sentence}",
            )
        if ranks:
            seen = tuple(local_identifiability(model).rank for model in (first, second))
            tally.check(seen == ranks, f"{label} {kind}: ranks {seen}, {ranks}; {first}; {second}")
    tally.report(record_property)


@needs_singular
def test_all_equivalents_at_a_point(record_property):
    """Extent and numbers of complex, real and positive parameter vectors; a third of the points
    are special.
    """
    tally = Tally()
    for label, draw in cases("fibres", 150):
        if not (found := drawn(draw)):
            continue
        for given, searched in (found[1:], found[:0:-1], (found[1], found[1])):
            values = (
                _special(draw, given[0].names)
                if draw.random() < 0.3
                else _point(draw, given[0].names, True)
            )
            try:
                seen = alternatives(given[1], values, searched[1], seconds=10)
            except InputError:
                tally["leading coefficient is zero"] += 1
                continue
            true = zeros(given[0].plain(), values, searched[0].plain())
            if true is None or seen.extent is Extent.UNKNOWN:
                tally["open"] += 1
                continue
            tally.check(
                _agree(seen, true),
                f"{label}: {given[1]} at {values} in {searched[1]}: {true}, {seen.sentence}",
            )
    tally.report(record_property)


def _agree(seen, true):
    if seen.extent is not Extent.FINITE:
        return (
            seen.extent is (Extent.FAMILY if true.dimension > 0 else Extent.NONE)
            and true.dimension != 0
        )
    counts = tuple(
        len(seen.within(domain)) for domain in (Domain.COMPLEX, Domain.REAL, Domain.POSITIVE)
    )
    return true.dimension == 0 and counts == (true.count, true.real, true.positive)


def _exists(model, values):
    """Whether the model is defined, with its full order, at these values."""
    try:
        return bool(target(model, rational_values(model, values)))
    except InputError:
        return False


def _special(draw, names):
    return {name: str(draw.choice([0, 1, -1, 2])) for name in names}


def _point(draw, names, signs):
    """Numerators and denominators of up to four digits."""
    number = lambda: draw.randint(1, 10 ** draw.randint(1, 4))  # noqa: E731
    return {
        name: str(Fraction(number() * (draw.choice([1, -1]) if signs else 1), number()))
        for name in names
    }


@needs_singular
@pytest.mark.parametrize("view", [View.REAL, View.POSITIVE])
def test_verdicts_over_real_and_positive_parameters(view, record_property):
    """Of pairs that agree over complex parameters: "always" has an equivalent at every random
    point, "never" at none; the same answer in both orders. "Sometimes" is contradicted by no
    point.
    """
    tally = Tally()
    for label, draw in cases(f"domain:{view}", 120):
        found = drawn(draw)
        if not found or max(len(written.names) for written, _ in found[1:]) > 3:
            continue
        (_, one), (_, other) = found[1:]
        if compare(one, other, query=Query(View.EXACT)).relation is not Relation.INDISTINGUISHABLE:
            continue
        verdict, back = (compare(*pair, query=Query(view)) for pair in ((one, other), (other, one)))
        tally[verdict.relation.value] += 1
        tally.check(
            verdict.relation is back.relation, f"{label}: {verdict.sentence} {back.sentence}"
        )
        for given, searched in (found[1:], found[:0:-1]):
            for _ in range(POINTS if verdict.relation in RELATION.values() else 0):
                values = _point(draw, given[0].names, view is View.REAL)
                if not _exists(given[1], values):
                    tally["leading coefficient is zero"] += 1
                    continue
                true = zeros(given[0].plain(), values, searched[0].plain(), 10.0)
                if true is None or true.dimension > 0:
                    tally["points left open"] += 1
                    continue
                exists = bool(true.real if view is View.REAL else true.positive)
                expected = verdict.relation is Relation.INDISTINGUISHABLE
                tally.check(
                    exists is expected,
                    f"{label}: {given[1]} at {values} in {searched[1]}: {true}, {verdict.sentence}",
                )
    tally.report(record_property)
