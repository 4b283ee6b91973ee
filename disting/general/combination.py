"""Points around which no positive values of another model have the same transfer function, by a
combination of the equations all of whose coefficients are positive. Ports, kinds of elements and
the number of unknowns do not matter, nor how many complex equivalents there are.

Let c_i(q) be the coefficients of numerator and denominator of the searched model, those left out
that are always zero, g_i the values of the same coefficients of the given model at p. If numerator
and denominator are coprime at p and of full degree, q is an equivalent of p only if all

    f_ij = c_i(q)/g_i - c_j(q)/g_j

vanish: then c(q) is a multiple of g.
THEOREM. Let x_ijm be numbers such that h = sum x_ijm m f_ij, over i < j and monomials m, has a
positive coefficient at every monomial of any m c_i. Then no p near by has a positive equivalent.
Proof. h(q) > 0 for q > 0, but it is 0 at an equivalent. For p near by the coefficients of h, which
has no other monomials, are still positive, and numerator and denominator are coprime still.

The numbers are found by a linear program, rounded to fractions, and put in exactly: what is found
is proven, whoever finds it. As m the monomials of the c_i serve: if the c_i are positive, their map
extends to the compact space of limits of all monomials of the c_i, where they do not vanish
together. If no limit is a multiple of g, the sum of the f_ij^2 is positive there, and such numbers
exist for products of enough of these monomials (a theorem of Polya); one and two are tried.
"""

from collections import defaultdict
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations, product

from disting.general.fibre_lists import is_in_one_variable, is_regular
from disting.general.matrix_model import Model, Terms
from disting.general.target import Values, value_at

MOST = 3000  # numbers that are looked for
DEGREE = 2  # of the products m of monomials
ROUNDED = 10**9  # largest denominator of one
Exponents = tuple[int, ...]
SparsePolynomial = dict[Exponents, Fraction]


def excludes(model: Model, values: Values, other: Model, degree: int = DEGREE) -> bool:
    """Return True if no point around this one has a positive equivalent in the other model, as far
    as a combination with products of at most this number of monomials proves it.

    >>> from disting.general.any_model import of_network
    >>> from disting.network import network_of
    >>> star, loop = "1~2, 1~3; F1; S2", "1~2, 1~3, 2~3; F1; S2"
    >>> star, loop = (of_network(network_of(text)) for text in (star, loop))
    >>> values = {name: Fraction(1) for name in loop.parameters} | {"k12": Fraction(1, 20)}
    >>> excludes(loop, values, star)
    True
    """
    rows = _scale_terms(model, values, other)
    if rows is None:
        return False
    monomials = _monomials(other)
    factors, is_found = monomials, False
    for _ in range(degree):
        if is_found or len(factors) * len(rows) * (len(rows) - 1) // 2 > MOST:
            return is_found
        is_found = _is_positive(list(_products(rows, factors)))
        factors = sorted(
            {tuple(map(sum, zip(*two, strict=True))) for two in product(factors, monomials)}
        )
    return is_found


def is_tried(other: Model) -> bool:
    """Return True if there are few enough numbers for a search."""
    count = sum(map(bool, _coefficients(other)))
    return len(_monomials(other)) * count * (count - 1) // 2 <= MOST


def _monomials(model: Model) -> list[Exponents]:
    return sorted({e for terms in _coefficients(model) for e, _ in terms})


def _is_positive(products: list[SparsePolynomial]) -> bool:
    """Return True if a combination with only positive coefficients is found."""
    places = {e: at for at, e in enumerate(sorted({e for p in products for e in p}))}
    numbers = _numbers(products, places)
    if numbers is None:
        return False
    total: SparsePolynomial = defaultdict(Fraction)
    for number, terms in zip(numbers, products, strict=True):
        for e, c in terms.items():
            total[e] += number * c
    return all(total[e] > 0 for e in places)


def _scale_terms(model: Model, values: Values, other: Model) -> tuple[SparsePolynomial, ...] | None:
    """All c_i/g_i; None where the models have other coefficients, or at p fewer or common roots."""
    mine, theirs = _coefficients(model), _coefficients(other)
    if [bool(t) for t in mine] != [bool(t) for t in theirs]:
        return None
    if not is_in_one_variable(model.powers, other.powers):
        return None
    if not is_regular(model, values):
        return None
    point = [values[name] for name in model.parameters]
    numbers = [value_at(terms, point) for terms in mine if terms]
    if not all(numbers):
        return None
    return tuple(
        {e: Fraction(int(c)) / g for e, c in terms}
        for terms, g in zip(filter(None, theirs), numbers, strict=True)
    )


def _coefficients(model: Model) -> tuple[Terms, ...]:
    return (*model.numerator_terms, *model.denominator_terms)


def _products(
    rows: Sequence[SparsePolynomial], monomials: Sequence[Exponents]
) -> Iterator[SparsePolynomial]:
    """Yield all m f_ij, over their largest coefficient; those that cancel are kept as 0, as
    they do not near by.
    """
    for first, other in combinations(rows, 2):
        terms: SparsePolynomial = defaultdict(Fraction)
        for row, sign in ((first, 1), (other, -1)):
            for e, c in row.items():
                terms[e] += sign * c
        largest = max(map(abs, terms.values()))
        for m in monomials if largest else ():
            yield {tuple(map(sum, zip(e, m, strict=True))): c / largest for e, c in terms.items()}


def _numbers(
    products: Sequence[SparsePolynomial], places: dict[Exponents, int]
) -> tuple[Fraction, ...] | None:
    """Numbers by which they add up to coefficients of 1 or more, rounded; None without any."""
    import numpy as np  # imported late: all three take longer than most of what is asked
    from scipy.optimize import linprog
    from scipy.sparse import coo_matrix

    entries = [(places[e], at, float(c)) for at, p in enumerate(products) for e, c in p.items()]
    rows, columns, coefficients = zip(*entries, strict=True)
    matrix = coo_matrix((coefficients, (rows, columns)), shape=(len(places), len(products)))
    result = linprog(
        np.zeros(len(products)), A_ub=-matrix, b_ub=-np.ones(len(places)), bounds=(None, None)
    )
    if not result.success:
        return None
    return tuple(Fraction(float(x)).limit_denominator(ROUNDED) for x in result.x)
