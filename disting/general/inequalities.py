"""Inequalities between the coefficients of a transfer function that all positive values of a model
satisfy: by one of them that another model breaks the two are distinguished, around a point or
wholly.

Let c_i(q) be the coefficients of numerator and denominator of the searched model, those left out
that are always zero, g_i(p) the same ones of the given model, and f = sum f_ij x_i x_j a quadratic
form such that f(c(q)), as a polynomial in q, has no negative coefficient.
THEOREM. If numerator and denominator are coprime and of full degree at p, and f(g(p)) < 0, no p
near by has a positive equivalent. If f(g(p)), as a polynomial in p, has no positive coefficient and
is not zero, no positive p has one but such as have common roots.
Proof. At an equivalent q of such a p all c(q) are g(p) times one number, t. So f(c(q)) = t^2
f(g(p)) < 0, but it is not negative for q > 0. Near p the same is true.

Products c_i c_j that share no monomials, nor share some with others in between, do not influence
each other: each group of them has its own forms. They are a cone, sum f_ij m_ij >= 0 for each
monomial m, and all of its forms are sums of those on its edges, which are listed exactly (double
description method, Motzkin 1953). Forms that are zero at all q are left aside: they are zero at the
given model too, if both have the same functions over complex values.
"""

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import combinations_with_replacement, product
from math import gcd, lcm
from operator import mul
from typing import Any

from flint import Ordering, fmpq_mat, fmpz_mat, fmpz_mpoly, fmpz_mpoly_ctx

from disting.algebra.certainty import residues
from disting.general.fibre_lists import is_regular
from disting.general.matrix_model import Model
from disting.general.newton import are_alike
from disting.general.relations import coefficients
from disting.general.target import Values, value_at

REMEMBERED = 256
MOST = 400  # edges of a cone, while they are listed
SPREADS = (4, 8, 12)  # values are powers of two below 2^4, 2^8, 2^12
POINTS = 48  # of each
CoefficientPair = tuple[int, int]
Exponents = tuple[int, ...]
Form = tuple[tuple[CoefficientPair, int], ...]
"""Numbers f_ij by pairs of coefficients, in the order of `relations.coefficients`."""
Labelled = tuple[tuple[int, str, str], ...]
"""Numbers f_ij with the names of both coefficients."""


@lru_cache(maxsize=REMEMBERED)
def inequalities(model: Model) -> tuple[Form, ...]:
    """Forms that are not negative at positive values of the model: all, but for sums and where they
    are too many.

    >>> pole, poles = (
    ...     Model.from_transfer_function(["1"], ["1", "a + b", c]) for c in ("a*b", "a*b + b*c")
    ... )
    >>> len(inequalities(pole)), len(inequalities(poles))
    (6, 6)
    """
    products = _products(model)
    forms = list[Form]()
    for group in _groups(products):
        monomials = sorted({m for pair in group for m in products[pair]})
        rows = {tuple(products[pair].get(m, 0) for pair in group) for m in monomials}
        for edge in _edges(sorted(map(_shortest, rows))):
            forms.append(tuple((x, n) for x, n in zip(group, edge, strict=True) if n))
    return tuple(forms)


def excludes_around(model: Model, values: Values, other: Model) -> bool:
    """Return True if no point around this one has a positive equivalent in the other model, as far
    as an inequality proves it.
    """
    if not (are_alike(model, other) and is_regular(model, values)):
        return False
    point = [values[name] for name in model.parameters]
    at = [value_at(terms, point) for terms in coefficients(model) if terms]
    return any(_value(form, at) < 0 for form in inequalities(other))


def points_against(model: Model, other: Model) -> Iterator[Values]:
    """Yield points of the given model around which none has a positive equivalent."""
    if not are_alike(model, other):
        return
    forms = inequalities(other)
    for values, at in _points(model):
        if any(_value(form, at) < 0 for form in forms) and is_regular(model, values):
            yield values


def contradiction(model: Model, other: Model) -> Labelled | None:
    """An inequality of the other model that no positive values of the given one satisfy."""
    if not are_alike(model, other):
        return None
    names, points = _labels(other), [at for _, at in _points(model)]
    for form in inequalities(other):
        if all(_value(form, at) < 0 for at in points):
            labelled = tuple((number, names[i], names[j]) for (i, j), number in form)
            if is_contradiction(labelled, model, other):
                return labelled
    return None


def is_contradiction(form: Labelled, model: Model, other: Model) -> bool:
    """Return True if it distinguishes two models: decided by the signs of all coefficients; almost
    all points are regular if one is.
    """
    names = _labels(other)
    is_known = all(name in names for _, *pair in form for name in pair)
    if not is_known or not are_alike(model, other):
        return False
    if not any(is_regular(model, values) for values, _ in _points(model)):
        return False
    at = [((names.index(i), names.index(j)), number) for number, i, j in form]
    own_value, other_value = (_value(at, _polynomials(m)).coeffs() for m in (model, other))
    return bool(own_value) and all(c < 0 for c in own_value) and all(c > 0 for c in other_value)


def _labels(model: Model) -> list[str]:
    """Of the coefficients: a0, a1, .. of the denominator, b0, b1, .. of the numerator."""
    sides = model.numerator_terms, model.denominator_terms
    above, below = ([i for i, t in enumerate(side) if t] for side in sides)
    return [*(f"a{i}" for i in reversed(below)), *(f"b{i}" for i in above)]


@lru_cache(maxsize=REMEMBERED)
def _points(model: Model) -> tuple[tuple[Values, list[int]], ...]:
    """Points of it, with all coefficients there: determined by the model."""
    points = list[tuple[Values, list[int]]]()
    for bits, k in product(SPREADS, range(POINTS)):
        label = ":".join(map(str, ("inequalities", *model.content, bits, k)))
        powers = residues(label, len(model.parameters), bits)
        values = {
            name: Fraction(1 << int(x)) for name, x in zip(model.parameters, powers, strict=True)
        }
        at = [
            sum(int(c) << sum(map(mul, e, powers)) for e, c in terms)
            for terms in coefficients(model)
            if terms
        ]
        points.append((values, at))
    return tuple(points)


def _polynomials(model: Model) -> list[fmpz_mpoly]:
    context = fmpz_mpoly_ctx.get(model.parameters, Ordering.degrevlex)
    return [context.from_dict(dict(terms)) for terms in coefficients(model) if terms]


def _products(model: Model) -> dict[CoefficientPair, dict[Exponents, int]]:
    """All c_i c_j by their monomials."""
    every = _polynomials(model)
    pairs = combinations_with_replacement(range(len(every)), 2)
    return {
        (i, j): {tuple(map(int, e)): int(c) for e, c in (every[i] * every[j]).to_dict().items()}
        for i, j in pairs
    }


def _groups(products: dict[CoefficientPair, dict[Exponents, int]]) -> list[list[CoefficientPair]]:
    """Those of the products that are joined by monomials."""
    groups = list[tuple[list[CoefficientPair], set[Exponents]]]()
    for pair, terms in products.items():
        joined = [group for group in groups if not group[1].isdisjoint(terms)]
        pairs = [pair, *(other for group in joined for other in group[0])]
        monomials = {*terms}.union(*(group[1] for group in joined))
        groups = [*(g for g in groups if g not in joined), (pairs, monomials)]
    return [sorted(pairs) for pairs, _ in groups]


def _edges(rows: Sequence[Exponents]) -> Iterator[Exponents]:
    """Yield the edges of the cone of all x at which no row is negative; none of what contains
    lines, and none where there are too many. What does not show in the rows is 0 in x.
    """
    width, pivots = len(rows[0]), _pivots(rows)
    rows = list(dict.fromkeys(_shortest([row[j] for j in pivots]) for row in rows))
    base = [rows[i] for i in _pivots([*zip(*rows, strict=True)])]
    inverse = fmpq_mat(fmpz_mat(base)).inv()
    faces = list(base)
    edges = {
        _whole([inverse[i, j] for i in range(len(base))]): sum(
            1 << i for i in range(len(base)) if i != j
        )
        for j in range(len(base))
    }
    for row in rows:
        if row not in base:
            edges = _cut(edges, row, len(faces), len(base) - 2)
            faces.append(row)
        if len(edges) > MOST:
            return
    for edge in sorted(edges):
        numbers = dict(zip(pivots, edge, strict=True))
        yield tuple(numbers.get(j, 0) for j in range(width))


def _cut(edges: dict[Exponents, int], row: Exponents, at: int, common: int) -> dict[Exponents, int]:
    """The edges of what is left of a cone where a further row is not negative; of each edge the
    rows that are zero there, as bits. Two edges that share a face have `common` rows at least, and
    no third edge has all of those.
    """
    value = {e: sum(a * b for a, b in zip(row, e, strict=True)) for e in edges}
    left = {e: rows | (not value[e]) << at for e, rows in edges.items() if value[e] >= 0}
    above, below = ([e for e in edges if sign * value[e] > 0] for sign in (1, -1))
    for higher, lower in product(above, below):
        both = edges[higher] & edges[lower]
        if both.bit_count() < common:
            continue
        if any(both & rows == both for e, rows in edges.items() if e not in (higher, lower)):
            continue
        pairs = zip(higher, lower, strict=True)
        left[_shortest([value[higher] * b - value[lower] * a for a, b in pairs])] = both | 1 << at
    return left


def _pivots(rows: Sequence[Exponents]) -> list[int]:
    """Columns on which all others depend."""
    reduced, rank = fmpq_mat(fmpz_mat([list(row) for row in rows])).rref()
    return [next(j for j in range(len(rows[0])) if reduced[i, j]) for i in range(rank)]


def _shortest(numbers: Iterable[int]) -> Exponents:
    """In the same direction, without a common factor."""
    row = tuple(numbers)
    common = gcd(*row)
    return tuple(x // common for x in row)


def _whole(numbers: Sequence[object]) -> Exponents:
    fractions = [Fraction(str(x)) for x in numbers]
    common = lcm(*(x.denominator for x in fractions))
    return _shortest(int(x * common) for x in fractions)


def _value(form: Iterable[tuple[CoefficientPair, int]], at: Sequence[Any]) -> Any:
    """A quadratic form at numbers or polynomials."""
    return sum((number * at[i] * at[j] for (i, j), number in form), at[0] * 0)
