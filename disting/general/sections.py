"""Unknowns that are free, chosen by formulas: from inequalities in p and q to inequalities in the
p alone.

In a case without equations an unknown x is eliminated where all inequalities are products of
factors linear in it (Fourier and Motzkin). The signs of the factors of each product are tried in
all ways; a x + b > 0 is x > -b/a or x < -b/a by the sign of a, tried in both ways unless it is
known. Then x exists exactly if some lower bound L (0 is one) is the largest, some upper bound U the
smallest and L < U, and each x = (L + w U)/(1 + w), w = 1, 2, .., will do, or x = L + w if there is
no upper bound: the first w is taken at which no `nonzero` polynomial of the case and no a becomes
0, as a polynomial does at finitely many w only. A factor of two inequalities gives one bound, not
two: factors are irreducible and primitive, so equal bounds are those of one factor, but for its
sign, and with both signs no x is between them. (Taken twice, a bound would have to be larger than
itself.) A solution of strict inequalities stays one if the unknowns move a little, so those at
which bounds are equal or a factor a is zero may be left out, unless a contains the p alone: then it
is listed as not zero. What is found is a list of sections q = q(p), each with polynomials `where`:

* where all of them are positive (and no value q_j(p) or lead(q(p)) zero), q(p) is an equivalent of
  p;
* a generic p with an equivalent in the case has a section with all its polynomials positive or
  zero.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from itertools import product

from flint import fmpz_mpoly

from disting.algebra.symbols import RationalFunction
from disting.general.cases import Search
from disting.general.elimination import (
    Case,
    choose,
    fix_free,
    inequalities,
    put_positive,
    unknown_factors,
)
from disting.general.orthant import Orthant, TooMuch

SECTIONS = 200  # of one case
SMOOTH = 8  # polynomials in sections that cover everything: so many signs are tried in all ways

Bound = tuple[fmpz_mpoly, fmpz_mpoly]
"""(a, b), a positive: the bound b/a."""


@dataclass(frozen=True, slots=True)
class Section:
    """An equivalent as fractions in the p, one for each unknown, wherever all polynomials of
    `where` are positive.
    """

    where: tuple[fmpz_mpoly, ...]
    values: tuple[RationalFunction, ...]


def sections(search: Search, case: Case) -> tuple[list[Section], list[Case]]:
    """Sections of a case without equations, and what could not be written as sections; raises
    TooMuch.
    """
    the_sections, left, todo = list[Section](), list[Case](), [case]
    while todo:
        this_case = todo.pop()
        at = _eliminable(search.ring, this_case)
        if not search.ring.occurring(this_case.positive):
            the_sections.append(_section(search.ring, this_case))
        elif at is None:
            left.append(this_case)
        else:
            todo += _eliminate_unknown(search, this_case, at)
        if len(the_sections) + len(left) + len(todo) > SECTIONS:
            raise TooMuch(f"more than {SECTIONS} sections")
    if not the_sections and not left:
        search.closed.append(" and ".join(f"{g} > 0" for g in case.positive))
    return the_sections, left


def cover(ring: Orthant, the_sections: list[Section]) -> bool:
    """Return True if every generic p lies in a section, whatever the signs of the irreducible
    factors of their polynomials are.
    """
    signed = [[ring.parts(g, odd=True) for g in s.where] for s in the_sections]
    factors: list[fmpz_mpoly] = []
    for _, parts in (x for s in signed for x in s):
        factors += [f for f in parts if f not in factors]
    if not the_sections or len(factors) > SMOOTH:
        return any(not s.where for s in the_sections)
    wanted = [[(sign, [factors.index(f) for f in parts]) for sign, parts in s] for s in signed]
    return all(
        any(all(_sign(x, signs) > 0 for x in s) for s in wanted)
        for signs in product((1, -1), repeat=len(factors))
    )


def _sign(part: tuple[int, list[int]], signs: tuple[int, ...]) -> int:
    sign, used = part
    for i in used:
        sign *= signs[i]
    return sign


def _section(ring: Orthant, case: Case) -> Section:
    solved = dict(fix_free(ring, case).solved)
    return Section(case.positive, tuple(solved[i] for i in ring.unknowns))


def _eliminable(ring: Orthant, case: Case) -> int | None:
    """The unknown in the fewest inequalities among those in which all factors are linear."""
    pairs = []
    for at in ring.occurring(case.positive):
        inside = [g for g in case.positive if g.degrees()[at]]
        if all(f.degrees()[at] <= 1 for g in inside for f in ring.parts(g, odd=True)[1]):
            pairs.append((len(inside), sum(map(len, inside)), at))
    return min(pairs)[2] if pairs else None


def _eliminate_unknown(search: Search, case: Case, at: int) -> Iterator[Case]:
    """The cases without this unknown that have the same solutions together."""
    ring = search.ring
    rest = [g for g in case.positive if not g.degrees()[at]]
    for linear, others in _signs(ring, [g for g in case.positive if g.degrees()[at]], at):
        split = [_bound_of(ring, f, at) for i, f in enumerate(linear) if f not in linear[:i]]
        unseen = [a for a, _, sign in split if not sign]
        search.generic += [a for a in unseen if not ring.occurring([a])]
        for signs in product((1, -1), repeat=len(unseen)):
            guessed = iter(signs)
            bounds = [(a, b, sign or next(guessed)) for a, b, sign in split]
            polynomials = [s * a for s, a in zip(signs, unseen, strict=True)]
            lower = [(ring.number(1), ring.number(0)), *((a, b) for a, b, s in bounds if s > 0)]
            upper = [(-a, -b) for a, b, s in bounds if s < 0]
            nonzero = (*case.nonzero, *unknown_factors(ring, (a for a, _, _ in bounds)))
            reduced = Case((), (*rest, *others, *polynomials), case.solved, nonzero)
            yield from _between(ring, reduced, at, lower, upper)


def _signs(
    ring: Orthant, polynomials: list[fmpz_mpoly], at: int
) -> Iterator[tuple[list[fmpz_mpoly], list[fmpz_mpoly]]]:
    """All ways to give factors signs so that the products are positive: factors linear in the
    unknown, and the others.
    """
    ways = []
    for g in polynomials:
        sign, factors = ring.parts(g, odd=True)
        inside, outside = (
            [f for f in factors if bool(f.degrees()[at]) is way] for way in (True, False)
        )
        rest = sign * ring.product(outside)
        ways.append([_way(inside, rest, signs) for signs in product((1, -1), repeat=len(inside))])
    for choice in product(*ways):
        yield [f for linear, _ in choice for f in linear], [g for _, g in choice]


def _way(
    inside: list[fmpz_mpoly], rest: fmpz_mpoly, signs: tuple[int, ...]
) -> tuple[list[fmpz_mpoly], fmpz_mpoly]:
    negative = signs.count(-1) % 2
    return [s * f for s, f in zip(signs, inside, strict=True)], -rest if negative else rest


def _bound_of(ring: Orthant, linear: fmpz_mpoly, at: int) -> tuple[fmpz_mpoly, fmpz_mpoly, int]:
    """(a, b, sign of a) of a x - b > 0."""
    rest, factor = ring.coefficients(linear, at)
    return factor, -rest, ring.sign(factor)


def _between(
    ring: Orthant, case: Case, at: int, lower: list[Bound], upper: list[Bound]
) -> Iterator[Case]:
    """One case for each choice of the largest lower and the smallest upper bound."""
    for i, low in enumerate(lower):
        above = [_difference(low, x) for j, x in enumerate(lower) if j != i]
        for k, high in enumerate(upper) if upper else [(0, None)]:
            below = [_difference(x, high) for j, x in enumerate(upper) if j != k] if high else []
            gap = [_difference(high, low)] if high else []
            positive, failing = inequalities(ring, [*case.positive, *above, *below, *gap])
            if failing is None:
                between = replace(case, positive=positive)
                yield choose(ring, between, at, partial(_inside, ring, low, high))


def _difference(greater: Bound, smaller: Bound) -> fmpz_mpoly:
    """Positive where the one bound is greater than the other: both denominators are positive."""
    return greater[1] * smaller[0] - smaller[1] * greater[0]


def _inside(ring: Orthant, low: Bound, high: Bound | None, weight: int) -> RationalFunction:
    """(L + w U)/(1 + w), or L + w."""
    least, w = RationalFunction(low[1], low[0]), ring.number(weight)
    if high is None:
        return least + RationalFunction(w, ring.number(1))
    return (least + RationalFunction(w * high[1], high[0])) / RationalFunction(
        w + 1, ring.number(1)
    )


def sign_on(ring: Orthant, polynomial: fmpz_mpoly, section: Section) -> fmpz_mpoly:
    """A polynomial in the p with the sign of a polynomial in p and q on a section."""
    values = dict(zip(ring.unknowns, section.values, strict=True))
    for at, value in values.items():
        polynomial = put_positive(ring, polynomial, at, value)
    return polynomial
