"""Points of two models that show what is true of them around those points: one with an equivalent
in the other model, and one without.

Points are drawn as examples only; every statement on them is one on all points around them (see
`robust`). Lists of all equivalents of a point cost milliseconds, where they end; inequalities
between coefficients (see `inequalities`) less; searches in rounded numbers find equivalents.
"""

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import islice
from typing import TypeVar

from disting.algebra.certainty import residues
from disting.algebra.groebner.rational import Bounds, TooLarge
from disting.evidence.general import MANY, UNCOUNTED, Inequality, Witnesses
from disting.evidence.kind import PointText
from disting.general import fibre_lists, newton
from disting.general.combination import excludes, is_tried
from disting.general.fibre import Extent, solve
from disting.general.inequalities import contradiction, points_against
from disting.general.matrix_model import AnyModel, Model
from disting.general.rounded import written
from disting.general.search import STARTS, common_points
from disting.general.target import Values, fibre_equations
from disting.model.question import Domain

SPREADS = (9, 30, 3)  # numerators and denominators: values within a factor of about 9, 30, 3 of 1

REMEMBERED = 64  # pairs of which a common point was looked for: several searches ask
M = TypeVar("M", bound=AnyModel)
Example = tuple[bool, PointText, PointText]
"""Left given, a point of it, and the rounded equivalent (nothing where there is none)."""


def points(model: AnyModel, domain: Domain, seed: str) -> Iterator[Values]:
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


def _in_turn(left: M, right: M, seed: str, count: int) -> Iterator[tuple[bool, M, M, Values]]:
    """Yield so many positive points of either model, one of each after the other."""
    for number in range(count):
        for left_given, model, other in ((True, left, right), (False, right, left)):
            values = next(islice(points(model, Domain.POSITIVE, seed), number, None))
            yield left_given, model, other, values


def by_lists(left: AnyModel, right: AnyModel, seed: str, count: int) -> Witnesses | None:
    """A point with and one without a positive equivalent, among so many of either model, by lists
    of all.
    """
    having, lacking = list[Example](), list[Example]()
    for left_given, model, other, values in _in_turn(left, right, seed, count):
        the_values = fibre_lists.find_equivalent(model, values, other)
        if the_values:
            having += with_equivalent(left_given, model, values, other, the_values)
        elif fibre_lists.has_no_equivalent(model, values, other):
            lacking.append(without_equivalent(left_given, values))
        if having and lacking:
            return witnesses_of(left, right, having[0], lacking[0], Domain.POSITIVE)
    return None


def by_inequalities(
    left: AnyModel, right: AnyModel, starts: int = STARTS
) -> Inequality | Witnesses | None:
    """Decide by inequalities that all values of one model satisfy: no values of the other one do,
    or some do not and some have an equivalent.
    """
    if not (isinstance(left, Model) and isinstance(right, Model)):
        return None
    ways = [(True, left, right), (False, right, left)]
    for left_given, model, other in ways:
        form = contradiction(model, other)
        if form:
            return Inequality(Domain.POSITIVE.value, left_given, form)
    for left_given, model, other in ways:
        values = next(points_against(model, other), None)
        having = values and common_point(left, right, starts)
        if values and having:
            lacking = without_equivalent(left_given, values)
            return witnesses_of(left, right, having, lacking, Domain.POSITIVE)
    return None


def by_numbers(
    left: AnyModel,
    right: AnyModel,
    seed: str,
    count: int,
    degree: int,
    having: Example | None = None,
) -> Witnesses | None:
    """A point that has a positive equivalent, found by a search in rounded numbers and shown by
    intervals, and one, among so many of either model, that has none by a combination of the
    equations.
    """
    if not (isinstance(left, Model) and isinstance(right, Model) and newton.are_alike(left, right)):
        return None
    having = having or common_point(left, right)
    if having is None:
        return None
    for left_given, model, other, values in _in_turn(left, right, seed, count):
        if not is_tried(other) or newton.find_equivalent(model, values, other):
            continue
        if excludes(model, values, other, degree):
            lacking = without_equivalent(left_given, values)
            return witnesses_of(left, right, having, lacking, Domain.POSITIVE)
    return None


@lru_cache(maxsize=REMEMBERED)
def common_point(left: AnyModel, right: AnyModel, starts: int = STARTS) -> Example | None:
    """A point with a positive equivalent, where a search finds one."""
    if not (isinstance(left, Model) and isinstance(right, Model) and newton.are_alike(left, right)):
        return None
    for left_given, values, near in common_points(left, right, starts):
        model, other = (left, right) if left_given else (right, left)
        the_values = newton.find_equivalent(model, values, other, near)
        found = the_values and with_equivalent(left_given, model, values, other, the_values)
        if found:
            return found[0]
    return None


def witnesses_of(
    left: AnyModel, right: AnyModel, having: Example, lacking: Example, domain: Domain
) -> Witnesses:
    """Both points as evidence, and how many complex equivalents the one without has."""
    sides = (left, right) if lacking[0] else (right, left)
    return Witnesses(domain.value, *having, *lacking[:2], solutions_at(*sides, lacking[1]))


def solutions_at(model: AnyModel, other: AnyModel, point: PointText) -> int:
    """Number of complex equivalents, MANY or UNCOUNTED where that is not found at once."""
    if not (isinstance(model, Model) and isinstance(other, Model)):
        return UNCOUNTED
    goal = fibre_lists.goal_of(model, {name: Fraction(x) for name, x in point})
    if goal is None:
        return UNCOUNTED
    try:
        fibre = solve(fibre_equations(goal, other), other.parameters, "count", Bounds())
    except TooLarge:
        return UNCOUNTED
    return {Extent.FAMILY: MANY, Extent.UNKNOWN: UNCOUNTED}.get(
        fibre.extent, len(fibre.equivalents)
    )


def without_equivalent(left_given: bool, values: Values) -> Example:
    """A point of the left model or the right one."""
    return left_given, _text(values), ()


def with_equivalent(
    left_given: bool, model: AnyModel, values: Values, other: AnyModel, equivalent: Sequence[float]
) -> list[Example]:
    """The same with its equivalent in the other one; nothing where that cannot be written down with
    digits that give the response.
    """
    near = written(model, values, other, equivalent)
    return [] if near is None else [(left_given, _text(values), near)]


def _text(values: Values) -> PointText:
    return tuple((name, str(x)) for name, x in values.items())
