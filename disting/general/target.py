"""The fibre of one model over the transfer function of another at rational parameters, as
polynomial equations over Q.

With the target N/D in lowest terms (D monic) and the searched model N2(q)/D2(q), the transfer
functions are the same exactly if N2(q) D - N D2(q) = 0 as a polynomial in s and D2(q) is not zero.
These equations are linear in the coefficients of N2 and D2 and are brought to reduced row echelon
form first. One more unknown t with t lead(D2(q)) = 1 keeps the order of the searched model.
"""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from math import lcm
from operator import add

from flint import Ordering, fmpq, fmpq_mat, fmpq_poly, fmpz_mpoly_ctx

from disting.algebra.groebner.modular import Sparse
from disting.errors import InputError, enumeration, short
from disting.general.expansion import Expansion
from disting.general.expression import names, tree
from disting.general.matrix_model import AnyModel, Model, Terms

Values = dict[str, Fraction]


@dataclass(frozen=True, slots=True)
class Target:
    """Coefficients of s^0, s^1, .. of numerator and denominator: coprime, the leading one of
    the denominator is 1.
    """

    numerator: tuple[Fraction, ...]
    denominator: tuple[Fraction, ...]


def rational_values(
    model: AnyModel, values: Mapping[str, object]
) -> tuple[tuple[str, Fraction], ...]:
    """One exact number for each parameter, in the model's order; raises InputError for missing,
    foreign and inexact ones.

    >>> rational_values(Model.from_transfer_function("k", "s + k"), {"k": "0.1"})
    (('k', Fraction(1, 10)),)
    """
    missing = [name for name in model.parameters if name not in values]
    foreign = [str(name) for name in values if name not in model.parameters]
    if missing or foreign:
        texts = [
            f"{what} {enumeration(which)}"
            for what, which in (("no value for", missing), ("no parameter", foreign))
            if which
        ]
        raise InputError(f"{model.name}: {'; '.join(texts)}")
    return tuple((name, _number(name, values[name])) for name in model.parameters)


def target(model: Model, values: Sequence[tuple[str, Fraction]]) -> Target:
    """The transfer function at these values; raises InputError where its leading denominator
    coefficient vanishes.
    """
    point = [x for _, x in values]
    num, den = (
        fmpq_poly([_fmpq(value_at(c, point)) for c in side])
        for side in (model.numerator_terms, model.denominator_terms)
    )
    if den.degree() < model.degrees[1]:
        raise InputError(
            f"{model.name}: the leading denominator coefficient is zero at these values"
        )
    common = num.gcd(den)
    num, den = num // common, den // common
    lead = den.leading_coefficient()
    return Target(*(tuple(fraction(c / lead) for c in side.coeffs()) for side in (num, den)))


def fibre_equations(goal: Target, other: Model) -> tuple[Sparse, ...]:
    """The equations of this module's text, in t and the parameters of `other`."""
    return joint_equations([goal], [other])


def joint_equations(goals: Sequence[Target], others: Sequence[Model]) -> tuple[Sparse, ...]:
    """The same of several transfer functions in the same parameters, each with its goal: t times
    the product of their different leading coefficients is 1.
    """
    rows = list[Sparse]()
    for goal, other in zip(goals, others, strict=True):
        rows += [row for row in _rows(goal, other) if row not in rows]
    leads = dict.fromkeys(other.denominator_terms[-1] for other in others)
    inverse: Sparse = {(1, *e): c for e, c in reduce(_product, map(dict, leads)).items()}
    inverse[(0,) * (len(others[0].parameters) + 1)] = -1
    return (*rows, inverse)


def _product(entries: Sparse, other: Sparse) -> Sparse:
    total = defaultdict[tuple[int, ...], int](int)
    for e, c in entries.items():
        for f, d in other.items():
            total[tuple(map(add, e, f))] += c * d
    return {e: c for e, c in total.items() if c}


def _rows(goal: Target, other: Model) -> Iterator[Sparse]:
    """Yield combinations of coefficients that are to be zero."""
    coefficients = (*other.numerator_terms, *other.denominator_terms)
    rows, rank = _conditions(goal, len(other.numerator_terms), len(other.denominator_terms)).rref()
    table = [[rows[i, j] for j in range(len(coefficients))] for i in range(rank)]
    yield from (combined for row in table if (combined := _combine(row, coefficients)))


def fraction(number: fmpq) -> Fraction:
    """A rational number of FLINT as one of Python."""
    return Fraction(int(number.p), int(number.q))


def _fmpq(number: Fraction) -> fmpq:
    return fmpq(number.numerator, number.denominator)


def _number(name: str, entry: object) -> Fraction:
    written = tree(entry)
    if any(names(written)):
        raise InputError(f"the value of {name} is a number, not {short(entry)}")
    function = Expansion({}, fmpz_mpoly_ctx.get(("one",), Ordering.lex).constant(1)).value(written)
    return Fraction(
        int(function.num.leading_coefficient()) if not function.num.is_zero() else 0,
        int(function.den.leading_coefficient()),
    )


def value_at(terms: Terms, point: Sequence[Fraction]) -> Fraction:
    """The value of a coefficient."""
    total = Fraction(0)
    for exponents, number in terms:
        term = Fraction(number)
        for x, e in zip(point, exponents, strict=True):
            term *= x**e
        total += term
    return total


def _conditions(goal: Target, above: int, below: int) -> fmpq_mat:
    """Rows: the coefficients of N2 D - N D2; columns: those of N2, then those of D2, whose
    leading one comes last.
    """
    height = max(above + len(goal.denominator), below + len(goal.numerator)) - 1
    shifts = [(goal.denominator, i, 1) for i in range(above)] + [
        (goal.numerator, i, -1) for i in range(below)
    ]
    table = [
        [
            _fmpq(sign * side[k - i]) if 0 <= k - i < len(side) else fmpq(0)
            for side, i, sign in shifts
        ]
        for k in range(height)
    ]
    return fmpq_mat(table)


def _combine(row: Sequence[fmpq], coefficients: Sequence[Terms]) -> Sparse:
    """A combination of coefficients, cleared of denominators."""
    parts = [fraction(factor) for factor in row]
    total: dict[tuple[int, ...], Fraction] = {}
    for factor, terms in zip(parts, coefficients, strict=True):
        if factor:
            for exponents, number in terms:
                total[(0, *exponents)] = total.get((0, *exponents), Fraction(0)) + factor * number
    common = lcm(*(number.denominator for number in total.values()))
    return {e: int(c * common) for e, c in total.items() if c}
