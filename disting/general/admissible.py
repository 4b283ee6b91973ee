"""Whether models that agree over complex parameters agree over real or positive ones: always,
never or for some.

What is known each way (see `ways`) is put together: INDISTINGUISHABLE if all generic parameters of
either model have an equivalent in the other one; DISTINGUISHABLE if those of one have none, and so
no admissible parameters agree, but for thin sets; SOMETIMES if in an open set there is an
equivalent, and in another one, of either model, there is none. All of it is proven. Points are
drawn to be looked at only; what is said of them is said of all points around them (see `robust`).
"""

from collections.abc import Iterator
from fractions import Fraction
from functools import lru_cache
from itertools import islice, repeat

from disting.algebra.certainty import Certainty, residues
from disting.algebra.groebner.rational import Bounds, TooLarge
from disting.conditions.finding import Finding, Outcome
from disting.conditions.rule import ADMISSIBLE
from disting.errors import ContradictionError
from disting.evidence.decision import Theorem
from disting.evidence.general import Explicit, Inequality, NoEquivalent, Point, Witnesses
from disting.general import listed, newton
from disting.general.combination import excludes, is_tried
from disting.general.equivalent import spelled
from disting.general.fibre import Extent, solved
from disting.general.formulas import explicit, fit
from disting.general.inequalities import contradiction, points_against
from disting.general.matrix_model import AnyModel
from disting.general.model import Model
from disting.general.one_ports import same_one_ports
from disting.general.orthant import THOROUGH, Effort
from disting.general.search import STARTS, common_points
from disting.general.target import fibre_equations, rational_values, target
from disting.general.which_models import Way, way
from disting.model.question import Domain

FIRST = 3  # of either model, whose equivalents are all listed or excluded
SMALL = 5  # parameters: formulas for so few come before searches in rounded numbers
MANY = 9  # parameters: elimination of more unknowns seldom ends, so inequalities come before
FEW = 3  # starts of searches for a common point of so many: most find one at once
GUARDS = 4  # of either model, where no equivalents are to be found
SPREADS = (9, 30, 3)  # numerators and denominators: values within a factor of about 9, 30, 3 of 1
REMEMBERED = 64  # pairs of which a common point was looked for: several searches ask
TOO_LARGE = "the search for all equivalents grew too large"

Ways = tuple[Way | None, Way | None]
Found = tuple[bool, Point, Point]
"""Left given, a point of it, and the rounded equivalent (nothing where there is none)."""


def admissible_finding(
    left: AnyModel, right: AnyModel, domain: Domain, seed: str, effort: Effort = THOROUGH
) -> Finding:
    """HOLDS, FAILS or SOMETIMES with its evidence, or ABANDONED with what was seen. Lists of all
    equivalents of points cost milliseconds, so a few come first.
    """
    size = max(len(m.parameters) for m in (left, right))
    if domain is Domain.POSITIVE:
        by_signs = _by_inequalities(left, right, FEW) if size > MANY else None
        if by_signs is not None:
            return by_signs
        found = _by_lists(left, right, seed, FIRST)
        if found is None and size > SMALL:
            found = _by_numbers(left, right, seed, FIRST, effort.degree)
        if found:
            return _sometimes(found)
    first = way(left, right, domain, effort)
    second = None if first and first.never else way(right, left, domain, effort)
    finding = of_ways(left, right, (first, second), domain, seed, effort)
    if domain is not Domain.POSITIVE or finding.outcome is not Outcome.ABANDONED:
        return finding
    was_brief = effort.unknowns is not None and size > effort.unknowns
    by_signs = None if was_brief else _by_inequalities(left, right)
    return finding if by_signs is None else by_signs


def of_ways(
    left: AnyModel,
    right: AnyModel,
    ways: Ways,
    domain: Domain,
    seed: str,
    effort: Effort = THOROUGH,
) -> Finding:
    """The finding from what is known each way; raises ContradictionError where that cannot all
    be true.
    """
    never = next((i for i, one in enumerate(ways) if one and one.never), None)
    if never is not None:
        _refuse_equivalents(ways, domain, seed)
        return _never(ways, never, domain)
    if all(one and one.covering for one in ways):
        return _always(explicit(ways, left, right, domain, effort), left, right)
    if domain is Domain.POSITIVE and are_one_ports(left, right):
        return Finding(
            ADMISSIBLE, Outcome.HOLDS, Certainty.THEOREM, evidence=Theorem("Foster and Cauer")
        )
    having, lacking, shares = _seen(ways, domain, seed, effort.points)
    if lacking and not having and domain is Domain.POSITIVE:
        having = _common(left, right)
    if lacking and (one := ways[0 if lacking[0] else 1]) and one.path():
        raise ContradictionError(
            f"a root gives equivalents of all {one.given.name}, and {dict(lacking[1])} has none"
        )
    if having and lacking:
        return _sometimes(_witnesses(left, right, having, lacking, domain))
    if not lacking and (formulas := explicit(ways, left, right, domain, effort)):
        return _always(formulas, left, right)
    if domain is Domain.POSITIVE:
        found = _by_lists(left, right, seed, effort.listed) or _by_numbers(
            left, right, seed, effort.listed, effort.degree, having
        )
        if found:
            return _sometimes(found)
    note = (
        f"an equivalent with {domain} parameters was found {shares}, which proves nothing of the"
        " others"
    )
    return Finding(ADMISSIBLE, Outcome.ABANDONED, note=note)


def are_one_ports(left: AnyModel, right: AnyModel) -> bool:
    """Whether both are one-ports that give any impedance of their kind, one input and output each
    (see `one_ports`).
    """
    if isinstance(left, Model) and isinstance(right, Model):
        return same_one_ports(left, right)
    return False


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


def _never(ways: Ways, at: int, domain: Domain) -> Finding:
    """No generic parameters have an equivalent, as the way at this place shows."""
    one = ways[at]
    closed = tuple(dict.fromkeys(one.parted.search.closed)) if one else ()
    evidence = NoEquivalent(domain.value, at == 0, closed)
    return Finding(ADMISSIBLE, Outcome.FAILS, Certainty.PROVEN, evidence=evidence)


def _refuse_equivalents(ways: Ways, domain: Domain, seed: str) -> None:
    """Raise ContradictionError if one model has equivalents although the other has none: they
    would be equivalents of it.
    """
    for one in ways:
        if one and (
            one.covering
            or one.path()
            or any(map(one.having, islice(points(one.given, domain, seed), GUARDS)))
        ):
            raise ContradictionError(
                f"{one.given.name} has equivalents in {one.other.name}, which has none in it"
            )


def _always(evidence: Explicit | None, left: AnyModel, right: AnyModel) -> Finding:
    if evidence is None or not fit(evidence, left, right):
        raise ContradictionError(
            f"a formula for {left.name} and {right.name} gives another transfer function"
        )
    return Finding(ADMISSIBLE, Outcome.HOLDS, Certainty.PROVEN, evidence=evidence)


def _seen(
    ways: Ways, domain: Domain, seed: str, count_of: int
) -> tuple[Found | None, Found | None, str]:
    """A point with and one without an equivalent, of either model, and the shares of those with
    one.
    """
    having, lacking, shares = list[Found](), list[Found](), list[str]()
    for left_given, one in zip((True, False), ways, strict=True):
        if one is None:
            shares.append(
                f"at no points of the {'left' if left_given else 'right'} model ({TOO_LARGE})"
            )
            continue
        count, always = 0, bool(one.covering)
        for values in islice(points(one.given, domain, seed), count_of):
            found = one.having(values)
            count += bool(found)
            if found:
                having.append((left_given, _written(values), _rounded(one.other, found)))
            elif not always and one.lacking(values):
                lacking.append((left_given, _written(values), ()))
            if having and lacking:
                return having[0], lacking[0], ""
        share = f"{count} of {count_of} random" if one.looked_at else "no"
        lost = one.not_looked_at
        shares.append(f"at {share} points of {one.given.name}{lost and f' ({lost})'}")
    return next(iter(having), None), next(iter(lacking), None), " and ".join(shares)


def _by_lists(left: AnyModel, right: AnyModel, seed: str, count: int) -> Witnesses | None:
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
            having.append((left_given, _written(values), _rounded(other, found)))
        elif listed.lacking(given, values, other):
            lacking.append((left_given, _written(values), ()))
        if having and lacking:
            return _witnesses(left, right, having[0], lacking[0], Domain.POSITIVE)
    return None


def _by_inequalities(left: AnyModel, right: AnyModel, starts: int = STARTS) -> Finding | None:
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
        having = values and _common(left, right, starts)
        if values and having:
            lacking = left_given, _written(values), ()
            return _sometimes(_witnesses(left, right, having, lacking, Domain.POSITIVE))
    return None


def _by_numbers(
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
    having = having or _common(left, right)
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
            lacking = left_given, _written(values), ()
            return _witnesses(left, right, having, lacking, Domain.POSITIVE)
    return None


@lru_cache(maxsize=REMEMBERED)
def _common(left: AnyModel, right: AnyModel, starts: int = STARTS) -> Found | None:
    """A point with a positive equivalent, where a search finds one."""
    if not (isinstance(left, Model) and isinstance(right, Model) and newton.are_alike(left, right)):
        return None
    for left_given, values, near in common_points(left, right, starts):
        given, other = (left, right) if left_given else (right, left)
        found = newton.having(given, values, other, near)
        if found:
            return left_given, _written(values), _rounded(other, found)
    return None


def _sometimes(evidence: Witnesses) -> Finding:
    return Finding(ADMISSIBLE, Outcome.SOMETIMES, Certainty.PROVEN, evidence=evidence)


def _witnesses(
    left: AnyModel, right: AnyModel, having: Found, lacking: Found, domain: Domain
) -> Witnesses:
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


def _written(values: dict[str, Fraction]) -> Point:
    return tuple((name, str(x)) for name, x in values.items())


def _rounded(model: AnyModel, values: tuple[float, ...]) -> Point:
    return tuple((name, spelled(x)) for name, x in zip(model.parameters, values, strict=True))
