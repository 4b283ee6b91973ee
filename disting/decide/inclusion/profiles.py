"""Inclusion at low cost: from missing elements, degrees and profiles.

The receptance of a chain with a gap is the sum of those of its rows, each between its own two
ports. By reciprocity it does not matter which of them is the force's, nor which row is which: force
and sensor cross the gap in the same sense. So ports of the whole may be at those of the part in
eight ways.

Lemma. Let functions N_k/D_k with deg N_k <= a, deg D_k <= b tend to n/d, n and d coprime, at
infinitely many s. Then deg n <= a and deg d <= b.

Proof. The pairs (N_k : D_k), up to factors, lie in a projective space, so some subsequence of them
converges, to (N : D). Where n/d is the limit, N d = n D; this holds at infinitely many s, so for
all. If D were 0, so were N, but not both are. As n and d are coprime, N = c n and D = c d with a
polynomial c other than 0; and deg N <= a, deg D <= b, for no limit has a coefficient that is 0 in
all.

Limits. So more zeros or more poles refute them. The relative degree b - a does so only where both
models have equally many poles, where it gives the same result: as poles go to infinity (T1 -> 0, a
spring without bound) D loses its leading coefficients, and the relative degree falls.

Projections. With equally many poles c is constant, and the limit of the leading coefficients is not
0. So the coefficients of N/d and of a monic d converge, which are regular functions of the
parameters, and V1 in V2 gives rank1(S) <= rank2(S) for every set S of them; what is constant in V2
is so in V1. A dead time Td is one more of them: N_k and D_k scaled each for itself converge to
polynomials other than 0, so where t_k exp(-Td_k s) N_k/D_k converges at infinitely many real s to
what is not 0, t_k and Td_k converge too, and a factor exp(-Td s) is rational for Td = 0 only.

Finite elements. With masses and T1 other than 0 and finite, the leading coefficient of D, a product
of them, is not 0, and no special value raises the degree of N: no relative degree is lower than
that of generic elements. The receptance of a row whose ports are l masses apart falls as s^-(2 + l)
with dampers and as s^-(2 + 2 l) without, its leading coefficient a product of springs or dampers
and inverse masses: no elements other than 0 make that higher. Of two rows the slower one leads;
only if both fall alike special values cancel. Dampers to the ground change nothing of that, a lag
adds 1.
"""

from collections.abc import Iterator
from itertools import product
from typing import TypeVar

from disting.algebra.certainty import Certainty
from disting.algebra.matroid import Matroid, rank_in
from disting.behaviour.profile import Profile
from disting.conditions.inclusion import Inclusion, InclusionFinding
from disting.evidence.conditions import Counts
from disting.evidence.kind import Labels
from disting.evidence.limits import FullImage, LargerProjection, MissingElements, RelativeDegrees
from disting.model.chain import Chain
from disting.model.minors import is_minor, minors
from disting.model.row import rows_of

Ports = tuple[tuple[int, int], ...]
"""(node of the whole, node of the part)."""
T = TypeVar("T")
Degrees = tuple[int, ...]
"""Of numerator and denominator."""


def by_elements(small: Chain, large: Chain, left_is_smaller: bool) -> InclusionFinding | None:
    """A chain, of one sensor quantity, of smaller rank in another one; None if elements do not
    decide.
    """
    if small.dead_time and not large.dead_time:
        return without_dead_time(left_is_smaller)
    if len(small.parameters) >= len(large.parameters):
        return None
    elements = (
        places
        for ports in _ways(small, large)
        for places in minors(small.structure, large.structure, dict(ports))
    )
    places = next(elements, None)
    return None if places is None else by_missing_elements(places, left_is_smaller)


def by_missing_elements(places: dict[int, int], left_is_part: bool) -> InclusionFinding:
    """The part is a limit of the whole, its masses at these places."""
    numbering = tuple(sorted((at, i) for i, at in places.items()))
    evidence = MissingElements(left_is_part, numbering)
    inclusion = Inclusion.LEFT_IN_RIGHT if left_is_part else Inclusion.RIGHT_IN_LEFT
    return InclusionFinding(inclusion, Certainty.THEOREM, evidence=evidence)


def without_dead_time(left_is_smaller: bool) -> InclusionFinding:
    """The model of smaller rank alone has a dead time."""
    ranks = (1, 0) if left_is_smaller else (0, 1)
    return InclusionFinding(
        Inclusion.NEITHER, Certainty.PROVEN, evidence=LargerProjection(("Td",), *ranks)
    )


def confirms_missing(evidence: MissingElements, left: Chain, right: Chain) -> bool:
    """Return True if the numbering makes the one a part of the other, ports included."""
    part, whole = (left, right) if evidence.left_is_part else (right, left)
    places = {i: at for at, i in evidence.numbering}
    ways = (all(places.get(i) == at for i, at in ports) for ports in _ways(part, whole))
    whole_numbering = len(places) == len(evidence.numbering)
    return whole_numbering and any(ways) and is_minor(part.structure, whole.structure, places)


def _ways(part: Chain, whole: Chain) -> Iterator[Ports]:
    """Yield the possible places of the four ports of the whole."""
    plus, minus = (part.act_plus, part.meas_plus), (part.act_minus, part.meas_minus)
    mine = (whole.act_plus, whole.meas_plus, whole.act_minus, whole.meas_minus)
    for (first, second), turned, again in product(((plus, minus), (minus, plus)), (1, -1), (1, -1)):
        ports = tuple(zip(mine, (*first[::turned], *second[::again]), strict=True))
        if len(dict(ports)) == len(set(ports)):
            yield ports


def by_profiles(
    small: Profile, large: Profile, *, left_is_smaller: bool
) -> InclusionFinding | None:
    """Inclusion that degrees, ranks of projections and a full image prove; None if they prove
    nothing.
    """
    if exceed(small.degrees, large.degrees):
        counts = Counts(*order(small.degrees, large.degrees, left_is_smaller))
        return InclusionFinding(Inclusion.NEITHER, Certainty.PROVEN, evidence=counts)
    if small.degrees[1::2] != large.degrees[1::2]:
        return None
    safety = min(small.safety, large.safety) - 1
    rows = _larger_rows(small, large)
    if rows is not None:
        ranks = order(_rank(small, rows), _rank(large, rows), left_is_smaller)
        return InclusionFinding(
            Inclusion.NEITHER, Certainty.BOUNDED, safety, LargerProjection(rows, *ranks)
        )
    if (
        large.rank == len(large.form)
        and small.form <= large.form
        and _constants_agree(small, large)
    ):
        free = tuple(x for x in large.labels if x in large.form)
        evidence = FullImage(not left_is_smaller, large.rank, free)
        return InclusionFinding(inside(left_is_smaller), Certainty.BOUNDED, safety, evidence)
    return None


def exceed(small: Degrees, large: Degrees) -> bool:
    """Return True if a numerator or denominator has a larger degree than in any limit of the other
    model; of several transfer functions one pair after the other, (-1, 0) for 0.

    >>> exceed((2, 2), (2, 3)), exceed((3, 3), (2, 4)), exceed((0, 0), (-1, 0))
    (False, True, True)
    """
    return any(own > other for own, other in zip(small, large, strict=True))


def _larger_rows(small: Profile, large: Profile) -> Labels | None:
    """The smallest recorded dependent set of the larger model that is of larger rank in the
    smaller one.
    """
    if not (isinstance(small.matroid, Matroid) and isinstance(large.matroid, Matroid)):
        return None
    constant = tuple(x for x in small.labels if x in small.form - large.form)
    if constant:
        return constant
    named = (
        (tuple(large.labels[i] for i in rows), rank) for rows, rank in large.matroid.dependences()
    )
    return min(
        (rows for rows, rank in named if _rank(small, rows) > rank),
        key=lambda x: (len(x), x),
        default=None,
    )


def _rank(profile: Profile, rows: Labels) -> int:
    """Rank of named invariants; those that the model lacks are zero."""
    assert isinstance(profile.matroid, Matroid)
    return rank_in(
        profile.matroid, tuple(i for i, label in enumerate(profile.labels) if label in rows)
    )


def _constants_agree(small: Profile, large: Profile) -> bool:
    """Return True if each constant of the larger model has the same value in the smaller one;
    missing coefficients are zero.
    """
    values = dict(zip(small.labels, small.constants, strict=True))
    rows = zip(large.labels, large.free, large.constants, strict=True)
    return all(
        free or (value != "" and values.get(label, "0") == value) for label, free, value in rows
    )


def by_relative_degrees(small: Chain, large: Chain) -> InclusionFinding | None:
    """Finite elements: a receptance of the left model that falls faster than any of the larger
    right one does, or slower; None if it need not.
    """
    falls = row_falls(large)
    small_fall, large_fall = min(row_falls(small)), min(falls)
    if small_fall == large_fall or (
        small_fall > large_fall and len(falls) == 2 and falls[0] == falls[1]
    ):
        return None
    evidence = RelativeDegrees(False, small_fall, large_fall)
    return InclusionFinding(Inclusion.NEITHER, Certainty.PROVEN, evidence=evidence)


def row_falls(chain: Chain) -> tuple[int, ...]:
    """Relative degrees of the receptances of the free and, with a gap, of the grounded row, one
    more with a lag.

    >>> row_falls(Chain(4, 2, 1, 3, 1, 4, damped=True))
    (3, 2)
    """
    rows = reversed(rows_of(chain.structure))
    return tuple(row.relative_degree + chain.lag for row in rows)


def inside(left_is_smaller: bool) -> Inclusion:
    """Inclusion of the model of the smaller rank."""
    return Inclusion.LEFT_IN_RIGHT if left_is_smaller else Inclusion.RIGHT_IN_LEFT


def order(small: T, large: T, left_is_smaller: bool) -> tuple[T, T]:
    """Both in the pair's order."""
    return (small, large) if left_is_smaller else (large, small)
