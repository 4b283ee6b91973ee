"""The parameter vectors of a model that have one generic transfer function: cases of the model's
equivalents in itself (see `cases`), written as fractions of the parameters p or by the roots of one
irreducible polynomial.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice

from flint import fmpz_mpoly

from disting.algebra.symbols import RationalFunction
from disting.general.cases import Search, orders, search_cases
from disting.general.elimination import Case
from disting.general.matrix_model import AnyModel
from disting.general.orthant import Orthant, TooMuch


@dataclass(frozen=True, slots=True)
class Vector:
    """Values of all unknowns, None for those that are free; the equation of a root among them,
    and its position.
    """

    values: tuple[RationalFunction | None, ...]
    equation: fmpz_mpoly | None
    at: int


def fewest_equations(ring: Orthant, model: AnyModel, tries: int) -> Search | None:
    """The search with the fewest equations left."""
    searches: list[Search] = []
    for order in islice(orders(ring.unknowns), tries):
        try:
            searches.append(search_cases(ring, model, model, order))
        except TooMuch:
            continue
        if not any(case.equations for case in searches[-1].cases):
            break
    return min(
        searches, key=lambda s: sum(len(ring.occurring(c.equations)) for c in s.cases), default=None
    )


def vectors_of(ring: Orthant, model: AnyModel, cases: Sequence[Case]) -> list[Vector]:
    """Those of all cases; none where they grow too large to be written down."""
    try:
        return [v for case in cases if (v := vector_of(ring, model, case))]
    except TooMuch:
        return []


def vector_of(ring: Orthant, model: AnyModel, case: Case) -> Vector | None:
    """The vector of a case, None if the leading coefficient or a denominator vanishes there; raises
    TooMuch.
    """
    solved, vector = dict(case.solved), plain_vector(ring, case)
    equation, lead = vector.equation, ring.lead(model)
    for i, value in case.solved:
        lead = ring.put(lead, i, value.num, value.den)[0]
    for polynomial in (lead, *(v.den for v in solved.values())):
        if polynomial.is_zero() or (equation is not None and (polynomial % equation).is_zero()):
            return None
    return vector


def plain_vector(ring: Orthant, case: Case) -> Vector:
    """The vector of an open case, whose `nonzero` polynomials keep the leading coefficient and the
    denominators from being zero (see `cases`).
    """
    solved, left = dict(case.solved), ring.occurring(case.equations)
    equation = case.equations[0] if case.equations else None
    return Vector(tuple(solved.get(i) for i in ring.unknowns), equation, left[0] if left else -1)


def count_vectors(
    ring: Orthant, cases: Sequence[Case], vectors: Sequence[Vector]
) -> tuple[int | None, bool]:
    """Number of vectors, and whether there are infinitely many."""
    missing = [sum(v is None for v in x.values) for x in vectors]
    equations = [len(c.equations) for c in cases]
    if any(
        m > (x.equation is not None) and max(equations) <= 1
        for m, x in zip(missing, vectors, strict=True)
    ):
        return None, True
    if not vectors or max(equations) > 1 or len({x.at for x in vectors if x.at >= 0}) > 1:
        return None, False
    if any(len(ring.occurring([x.equation])) > 1 for x in vectors if x.equation is not None):
        return None, False
    different = [x for i, x in enumerate(vectors) if not any(are_same(x, y) for y in vectors[:i])]
    return (
        sum(1 if x.equation is None else int(x.equation.degrees()[x.at]) for x in different),
        False,
    )


def are_same(first: Vector, second: Vector) -> bool:
    """Return True if two cases have the same vectors: one equation, except for its sign, and values
    that are equal at all its roots.

    The equation h is irreducible, so what vanishes at one of its roots is divisible by it and
    vanishes at all of them.
    """
    h, k = first.equation, second.equation
    if h is None or k is None:
        return h is None and k is None and first.values == second.values
    if h not in (k, -k):
        return False
    pairs = [(v, w) for v, w in zip(first.values, second.values, strict=True) if v and w]
    return all(((v.num * w.den - w.num * v.den) % h).is_zero() for v, w in pairs)


def is_unique(ring: Orthant, vectors: Sequence[Vector], at: int, search: Search | None) -> bool:
    """Return True if an unknown is p in all cases; all cases are checked, and omitted ones cannot
    make this false.
    """
    p = RationalFunction(ring.generators[at], ring.number(1))
    return search is not None and all(x.values[at] == p for x in vectors)
