"""Points of either of two models with and without equivalents, and what they tell of both: by lists
of all equivalents, by inequalities between coefficients, by searches in rounded numbers and
combinations of equations.
"""

from collections.abc import Iterator
from fractions import Fraction
from functools import lru_cache
from itertools import islice, repeat

from disting.algebra.certainty import Certainty, residues
from disting.algebra.groebner.rational import Bounds, TooLarge
from disting.conditions.finding import Finding, Outcome
from disting.conditions.rule import ADMISSIBLE
from disting.evidence.general import Inequality, Point, Witnesses
from disting.general import listed, newton
from disting.general.combination import excludes, is_tried
from disting.general.equivalent import spelled
from disting.general.fibre import Extent, solved
from disting.general.inequalities import contradiction, points_against
from disting.general.matrix_model import AnyModel
from disting.general.model import Model
from disting.general.search import STARTS, common_points
from disting.general.target import fibre_equations, rational_values, target
from disting.model.question import Domain

SPREADS = (9, 30, 3)  # numerators and denominators: values within a factor of about 9, 30, 3 of 1
REMEMBERED = 64  # pairs of which a common point was looked for: several searches ask

Found = tuple[bool, Point, Point]
"""Left given, a point of it, and the rounded equivalent (nothing where there is none)."""


def points(model: AnyModel, domain: Domain, seed: str) -> Iterator[dict[str, Fraction]]:
    """Yield random rational parameters of a domain, without end, determined by the seed and the
    model.
    """
    label = ":".join(map(str, (seed, *model.content)))
    n, k = len(model.parameters), 0
    while True:
        spread = SPREADS[k % len(SPREADS)]
        tops, bottoms, signs = (
            residues(f"{what}:{label}:{k}", n, below)
            for what, below in (("p", spread + 1), ("q", spread + 1), ("sign", 3))
        )
        values = (Fraction(p, q) for p, q in zip(tops, bottoms, strict=True))
        signed = (
            x if s == 1 or domain is Domain.POSITIVE else -x
            for x, s in zip(values, signs, strict=True)
        )
        yield dict(zip(model.parameters, signed, strict=True))
        k += 1


def by_lists(left: AnyModel, right: AnyModel, seed: str, count: int) -> Witnesses | None:
    """A point with and one without a positive equivalent, among so many of either model, by lists
    of all.
    """
    having, lacking = list[Found](), list[Found]()
    drawn = [
        zip(repeat(side), islice(points(one, Domain.POSITIVE, seed), count))
        for side, one in ((True, left), (False, right))
    ]
    for left_given, values in (x for both in zip(*drawn, strict=True) for x in both):
        given, other = (left, right) if left_given else (right, left)
        found = listed.having(given, values, other)
        if found:
            having.append((left_given, written(values), rounded(other, found)))
        elif listed.lacking(given, values, other):
            lacking.append((left_given, written(values), ()))
        if having and lacking:
            return witnesses(left, right, having[0], lacking[0], Domain.POSITIVE)
    return None


def by_inequalities(left: AnyModel, right: AnyModel, starts: int = STARTS) -> Finding | None:
    """What inequalities that all values of one of them satisfy tell: no values of the other one do,
    or some do not and some have an equivalent.
    """
    if not (isinstance(left, Model) and isinstance(right, Model)):
        return None
    ways = [(True, left, right), (False, right, left)]
    for left_given, given, other in ways:
        form = contradiction(given, other)
        if form:
            evidence = Inequality(Domain.POSITIVE.value, left_given, form)
            return Finding(ADMISSIBLE, Outcome.FAILS, Certainty.PROVEN, evidence=evidence)
    for left_given, given, other in ways:
        values = next(points_against(given, other), None)
        having = values and common_point(left, right, starts)
        if values and having:
            lacking = left_given, written(values), ()
            return sometimes(witnesses(left, right, having, lacking, Domain.POSITIVE))
    return None


def by_numbers(
    left: AnyModel,
    right: AnyModel,
    seed: str,
    count: int,
    degree: int,
    having: Found | None = None,
) -> Witnesses | None:
    """A point that has a positive equivalent, found by a search in rounded numbers and shown by
    intervals, and one, among so many of either model, that has none by a combination of the
    equations.
    """
    if not (isinstance(left, Model) and isinstance(right, Model) and newton.are_alike(left, right)):
        return None
    if not any(map(is_tried, (left, right))):
        return None
    having = having or common_point(left, right)
    if having is None:
        return None
    drawn = [
        zip(repeat(side), islice(points(one, Domain.POSITIVE, seed), count))
        for side, one in ((True, left), (False, right))
    ]
    for left_given, values in (x for both in zip(*drawn, strict=True) for x in both):
        given, other = (left, right) if left_given else (right, left)
        if not is_tried(other) or newton.having(given, values, other):
            continue
        if excludes(given, values, other, degree):
            lacking = left_given, written(values), ()
            return witnesses(left, right, having, lacking, Domain.POSITIVE)
    return None


@lru_cache(maxsize=REMEMBERED)
def common_point(left: AnyModel, right: AnyModel, starts: int = STARTS) -> Found | None:
    """A point with a positive equivalent, where a search finds one."""
    if not (isinstance(left, Model) and isinstance(right, Model) and newton.are_alike(left, right)):
        return None
    for left_given, values, near in common_points(left, right, starts):
        given, other = (left, right) if left_given else (right, left)
        found = newton.having(given, values, other, near)
        if found:
            return left_given, written(values), rounded(other, found)
    return None


def sometimes(evidence: Witnesses) -> Finding:
    """What two points tell."""
    return Finding(ADMISSIBLE, Outcome.SOMETIMES, Certainty.PROVEN, evidence=evidence)


def witnesses(
    left: AnyModel, right: AnyModel, having: Found, lacking: Found, domain: Domain
) -> Witnesses:
    """Both points, with how many complex equivalents the one without has."""
    sides = (left, right) if lacking[0] else (right, left)
    return Witnesses(domain.value, *having, *lacking[:2], _count(*sides, lacking[1]))


def _count(given: AnyModel, other: AnyModel, point: Point) -> int:
    """How many complex equivalents there are, -1 for infinitely many, -2 where that is not seen
    at once.
    """
    if not (isinstance(given, Model) and isinstance(other, Model)):
        return -2
    goal = target(given, rational_values(given, dict(point)))
    try:
        found = solved(fibre_equations(goal, other), other.parameters, "count", Bounds())
    except TooLarge:
        return -2
    return {Extent.FAMILY: -1, Extent.UNKNOWN: -2}.get(found.extent, len(found.equivalents))


def written(values: dict[str, Fraction]) -> Point:
    """Exact values as evidence keeps them."""
    return tuple((name, str(x)) for name, x in values.items())


def rounded(model: AnyModel, values: tuple[float, ...]) -> Point:
    """Those of an equivalent."""
    return tuple((name, spelled(x)) for name, x in zip(model.parameters, values, strict=True))
