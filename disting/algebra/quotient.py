"""Quotients of polynomials modulo a prime, in lowest terms with a monic denominator, with their
derivatives.

The derivatives of num/den are carried through the cancellation: with g = gcd(num, den), n = num/g,
d = den/g (monic) and W = (num' den - num den')/g^2 = n' d - n d', the derivative of the monic d is
the one polynomial of lower degree with d' = -W/n modulo d, and then n' = (W + n d')/d. So no
knowledge of the cancelled factor is needed, only that it is generic.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from flint import nmod_mat, nmod_poly


@dataclass(frozen=True, slots=True)
class Quotient:
    """num/den in lowest terms, den monic, and their derivatives by each parameter."""

    num: nmod_poly
    den: nmod_poly
    num_derivatives: tuple[nmod_poly, ...]
    den_derivatives: tuple[nmod_poly, ...]


def variable(modulus: int) -> nmod_poly:
    """The polynomial s."""
    return nmod_poly([0, 1], modulus)


def constant(value: int, modulus: int) -> nmod_poly:
    """A constant polynomial."""
    return nmod_poly([value], modulus)


def lowest_terms(
    num: nmod_poly,
    den: nmod_poly,
    num_derivatives: Sequence[nmod_poly],
    den_derivatives: Sequence[nmod_poly],
) -> Quotient:
    """Cancel common factors and make the denominator monic, derivatives included."""
    # the common power of s is by far the most frequent factor
    power = min(_valuation(num), _valuation(den))
    num, den = num.right_shift(power), den.right_shift(power)
    numerators = [d.right_shift(power) for d in num_derivatives]
    denominators = [d.right_shift(power) for d in den_derivatives]
    common = num.gcd(den)
    if common.degree() > 0:
        return _cancel(num, den, numerators, denominators, common)
    return _monic(num, den, numerators, denominators)


def coefficient_rows(
    polynomial: nmod_poly, derivatives: Sequence[nmod_poly], count: int
) -> tuple[list[int], list[list[int]]]:
    """The first `count` coefficients, and for each the row of its derivatives (count x number
    of derivatives).
    """
    columns = [_pad_coefficients(d, count) for d in derivatives]
    return _pad_coefficients(polynomial, count), (
        [list(row) for row in zip(*columns, strict=True)] if columns else [[]] * count
    )


def series_rows(quotient: Quotient, count: int) -> tuple[list[int], list[list[int]]]:
    """Coefficients G_0..G_count of the expansion in 1/s (30), and the rows of their derivatives;
    before them G_-1, .. of the powers of s, if the degree of the numerator is larger.

    num/den = G_0 + G_1/s + ..., so the polynomial part of s^count num/den has them as its
    coefficients; likewise for the derivative (num' den - num den')/den^2.
    """
    values = quotient.num.left_shift(count) // quotient.den
    square = quotient.den * quotient.den
    slopes = [
        (dn * quotient.den - quotient.num * dd).left_shift(count) // square
        for dn, dd in zip(quotient.num_derivatives, quotient.den_derivatives, strict=True)
    ]
    above = max(0, quotient.num.degree() - quotient.den.degree())
    numbers, rows = coefficient_rows(values, slopes, count + 1 + above)
    return numbers[::-1], rows[::-1]


def matrix(rows: Sequence[Sequence[int]], columns: int, modulus: int) -> nmod_mat:
    """Matrix modulo a prime from rows of residues."""
    return nmod_mat(len(rows), columns, [entry for row in rows for entry in row], modulus)


def rational(residue: int, modulus: int) -> str:
    """The fraction of small numerator and denominator that the residue represents, as text (Wang's
    reconstruction).

    >>> rational(pow(3, -1, 2**61 - 1) * 2, 2**61 - 1)
    '2/3'
    """
    before, after = (modulus, 0), (residue % modulus, 1)
    while after[0] * after[0] * 2 > modulus:
        step = before[0] // after[0]
        before, after = after, (before[0] - step * after[0], before[1] - step * after[1])
    return str(Fraction(after[0], after[1]))


def _monic(
    num: nmod_poly, den: nmod_poly, numerators: list[nmod_poly], denominators: list[nmod_poly]
) -> Quotient:
    top = den.degree()
    inverse = 1 / den[top]
    num, den = num * inverse, den * inverse
    slopes = [d[top] * inverse for d in denominators]
    return Quotient(
        num,
        den,
        tuple(d * inverse - num * slope for d, slope in zip(numerators, slopes, strict=True)),
        tuple(d * inverse - den * slope for d, slope in zip(denominators, slopes, strict=True)),
    )


def _cancel(
    num: nmod_poly,
    den: nmod_poly,
    numerators: list[nmod_poly],
    denominators: list[nmod_poly],
    common: nmod_poly,
) -> Quotient:
    scale = common * (den[den.degree()] / common[common.degree()])
    n, d = num // scale, den // scale
    inverse = n.xgcd(d)[1] if d.degree() > 0 else n * 0
    square = scale * scale
    tops, bottoms = [], []
    for dn, dd in zip(numerators, denominators, strict=True):
        wronskian = (dn * den - num * dd) // square
        bottoms.append((-wronskian * inverse) % d if d.degree() > 0 else n * 0)
        tops.append((wronskian + n * bottoms[-1]) // d)
    return Quotient(n, d, tuple(tops), tuple(bottoms))


def _valuation(polynomial: nmod_poly) -> int:
    return next((i for i in range(polynomial.length()) if int(polynomial[i])), polynomial.length())


def _pad_coefficients(polynomial: nmod_poly, count: int) -> list[int]:
    numbers = [int(c) for c in polynomial.coeffs()]
    return numbers[:count] + [0] * (count - len(numbers))
