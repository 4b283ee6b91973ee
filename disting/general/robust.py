"""A rational point of the given model that represents an open set: all points near it have
equivalents, or none of them has.

HAVING. A section whose polynomials are positive at p, with no value, denominator or lead(q) zero
there: all of that stays so near p, so that the section gives equivalents there. A case with one
equation: unknowns are fixed at rational numbers until one, x, is left, and an interval is found at
whose ends the equation has opposite signs, while on all of it the inequalities are strict and no
denominator vanishes (see `boxes`). Near p the same is true, and the equation has a root in the
interval.

LACKING. No `generic` polynomial vanishes at p, so none does near p; every section has a polynomial
that is negative at p, so it is near p; and in all other cases no point of the closed box [0, oo]^n
of the unknowns (or of the sum of two of them and their quotient) solves the equations with all
inequalities >= 0, shown by boxes on each of which one polynomial has a sign, as it then has for all
parameters near p. A p with an equivalent has a section with all polynomials >= 0 or a solution in
one of these boxes (see `cases`, `sections`), so no p near the point has one. Over real numbers the
boxes of all signs of the unknowns are examined.

Nothing is left to chance: the points may be drawn as one likes, and special ones are no danger.
"""

from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import lcm

from flint import fmpz_mpoly

from disting.algebra.symbols import RationalFunction
from disting.general.cases import Search
from disting.general.elimination import Case
from disting.general.orthant import value_at
from disting.general.sections import Section
from disting.general.signs_on_boxes import Box, Grid, is_empty, over_sum, root
from disting.model.question import Domain

UNKNOWNS = 2  # of a case at a point, at most
VALUES = tuple(
    Fraction(n, d)
    for n, d in ((1, 1), (1, 2), (2, 1), (1, 5), (5, 1), (1, 12), (12, 1), (1, 40), (40, 1))
)

ParameterValues = dict[int, Fraction]
"""Numbers by position in the ring."""


@dataclass(frozen=True, slots=True)
class CaseSearch:
    """Result of a search, sections and other cases separated; `lead`: leading denominator
    coefficient of the searched model.
    """

    search: Search
    sections: tuple[Section, ...]
    others: tuple[Case, ...]
    lead: fmpz_mpoly


def find_equivalent(parted: CaseSearch, point: ParameterValues) -> tuple[float, ...] | None:
    """Rounded parameters of an equivalent at a point with equivalents all around it, if one is
    found.
    """
    for section in parted.sections:
        values = _on(parted, section, point)
        if values:
            return values
    for case in parted.others:
        values = _in_case(parted, case, point)
        if values:
            return values
    return None


def searched_cases(parted: CaseSearch) -> int:
    """Number of sections and cases that `find_equivalent` examines: it skips cases of more
    equations or unknowns.
    """
    return len(parted.sections) + sum(_is_searched(parted, case) for case in parted.others)


def has_no_equivalent(parted: CaseSearch, point: ParameterValues) -> bool:
    """Return True if no parameters near the point have an equivalent; False also where that is not
    found.
    """
    if any(not value_at(g, point) for g in parted.search.generic):
        return False
    if not all(any(value_at(g, point) < 0 for g in s.where) for s in parted.sections):
        return False
    return all(_is_void(parted, case, point) for case in parted.others)


def _on(parted: CaseSearch, section: Section, point: ParameterValues) -> tuple[float, ...] | None:
    if any(value_at(g, point) <= 0 for g in section.where):
        return None
    values = _evaluate_values(section.values, point)
    if values is None or not _is_inside(parted, values):
        return None
    full = point | dict(zip(parted.search.ring.unknowns, values, strict=True))
    return tuple(map(float, values)) if value_at(parted.lead, full) else None


def _is_inside(parted: CaseSearch, values: list[Fraction]) -> bool:
    return parted.search.ring.domain is not Domain.POSITIVE or min(values) > 0


def _evaluate_values(
    values: tuple[RationalFunction, ...], point: ParameterValues
) -> list[Fraction] | None:
    below = [value_at(v.den, point) for v in values]
    return (
        [value_at(v.num, point) / d for v, d in zip(values, below, strict=True)]
        if all(below)
        else None
    )


def _in_case(parted: CaseSearch, case: Case, point: ParameterValues) -> tuple[float, ...] | None:
    """An equivalent of a case that is no section: other unknowns at rational values, the last
    one in an interval.
    """
    ring = parted.search.ring
    if not _is_searched(parted, case):
        return None
    free = ring.occurring((*case.equations, *case.positive))
    signs = (1,) if ring.domain is Domain.POSITIVE else (1, -1)
    for at in ring.occurring(case.equations) or free:
        others = [i for i in ring.unknowns if i != at and i not in dict(case.solved)]
        ways = [
            [s * v for s in signs for v in VALUES] if i in free else [Fraction(1)] for i in others
        ]
        for values in product(*ways):
            for sign in signs:
                equivalent = _in_interval(
                    parted, case, point | dict(zip(others, values, strict=True)), at, sign
                )
                if equivalent:
                    return equivalent
    return None


def _is_searched(parted: CaseSearch, case: Case) -> bool:
    free = parted.search.ring.occurring((*case.equations, *case.positive))
    return len(free) <= UNKNOWNS and len(case.equations) <= 1


def _in_interval(
    parted: CaseSearch, case: Case, fixed: ParameterValues, at: int, sign: int
) -> tuple[float, ...] | None:
    """Rounded parameters with the unknown `at` in an interval as described above, all others
    being fixed or solved for.
    """
    ring, solved = parted.search.ring, dict(case.solved)
    lead = parted.lead
    for i, value in case.solved:
        lead = ring.put(lead, i, value.num, value.den)[0]
    fractions = [
        side
        for v in solved.values()
        for side in ((v.num, v.den) if ring.domain is Domain.POSITIVE else (v.den,))
    ]
    sides = (case.equations, case.positive, (lead, *fractions))
    equations, positive, nonzero = (
        tuple(_grid(g, fixed, (at,), (sign,)) for g in side) for side in sides
    )
    interval = root(Box(equations, positive, nonzero))
    if interval is None:
        return None
    full = fixed | {at: sign * (interval[0] + interval[1]) / 2}
    values = full | {i: value_at(v.num, full) / value_at(v.den, full) for i, v in case.solved}
    return tuple(float(values[i]) for i in ring.unknowns)


def _is_void(parted: CaseSearch, case: Case, point: ParameterValues) -> bool:
    ring = parted.search.ring
    free = ring.occurring((*case.equations, *case.positive))
    if not free or len(free) > UNKNOWNS:
        return False
    ways = product((1,) if ring.domain is Domain.POSITIVE else (1, -1), repeat=len(free))
    boxes = (_box(case, point, tuple(free), signs) for signs in ways)
    return all(is_empty(box, len(free)) for box in boxes)


def _box(case: Case, point: ParameterValues, free: tuple[int, ...], signs: tuple[int, ...]) -> Box:
    """In the axes of both unknowns, or of their sum and quotient where no equation excludes that
    both are infinite.
    """
    equations, positive = (
        tuple(_grid(g, point, free, signs) for g in side)
        for side in (case.equations, case.positive)
    )
    if len(free) < UNKNOWNS or not equations or any(grid[-1][-1] for grid in equations):
        return Box(equations, positive)
    equations, positive = (
        tuple(over_sum(grid, _degree(g, free)) for grid, g in zip(*side, strict=True))
        for side in ((equations, case.equations), (positive, case.positive))
    )
    return Box(equations, positive)


def _degree(polynomial: fmpz_mpoly, free: tuple[int, ...]) -> int:
    """The total degree in these unknowns, whatever the given parameters are."""
    return max(sum(int(exponents[i]) for i in free) for exponents in polynomial.monoms())


def _grid(
    polynomial: fmpz_mpoly, point: ParameterValues, free: tuple[int, ...], signs: tuple[int, ...]
) -> Grid:
    """Integer coefficients, up to a positive factor, of one or two unknowns at a point, the
    unknowns times their signs.
    """
    degrees = [int(polynomial.degrees()[i]) for i in free] + [0]
    table = [[Fraction(0)] * (degrees[1] + 1) for _ in range(degrees[0] + 1)]
    for exponents, number in polynomial.to_dict().items():
        term = Fraction(int(number))
        for i, e in enumerate(exponents):
            if e:
                term *= (
                    point[i] if i in point else Fraction(signs[free.index(i)] if i in free else 1)
                ) ** int(e)
        table[int(exponents[free[0]])][int(exponents[free[1]]) if len(free) > 1 else 0] += term
    common = lcm(*(c.denominator for row in table for c in row))
    return [[int(c * common) for c in row] for row in table]
