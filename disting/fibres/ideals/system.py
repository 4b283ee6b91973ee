"""Parametric models as maps from parameters to the coefficients of a transfer function.

A model with one input and one output is the map Phi: parameters -> coefficients of numerator and
denominator, polynomials with integer coefficients. For chains there are two: `coefficient_map` in
the parameters themselves, and `normalise` in fewer and better ones. There row i of M s^2 + D s +
K is divided by m_i; with c_i, d_i for spring and damper between masses i and i+1

    u_i = c_i/m_i,  e_i = d_i/m_i,  r_i = m_i/m_(i+1),  u_0 = c_0/m_1,  e_0 = d_0/m_1,
    f_i = b_i/m_i,  g = 1/m_b

with one gain g for each row, b its right port. A joint enters row i as u_i + e_i s and row i+1 as
r_i (u_i + e_i s), so every determinant is monic in s and linear in each single unknown, and the
receptance of a row is

    H = g * prod_(a <= i < b) (u_i + e_i s) * theta_(a-1) * phi_(b+1) / D

(theta, phi, D: leading, trailing and all principal minors). A lag becomes 1/(s + f), f = 1/T1, and
its f is taken into the gains. For non-zero masses (and T1) the new unknowns are quotients and
products of the old ones and the old ones of the new ones: a birational map. Both maps have the
same closure of their image, which alone matters for generic models; parameters of rows without a
port, which the transfer function does not contain, are left out.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache, reduce
from operator import mul
from typing import Protocol

from flint import fmpz, fmpz_mpoly, fmpz_mpoly_ctx

from disting.algebra.certainty import digest
from disting.algebra.symbols import rename_symbols, symbols
from disting.behaviour.transfer import expand
from disting.errors import InputError
from disting.model.chain import Structure
from disting.model.row import Row, rows_of

REMEMBERED = 256  # structures whose maps are kept: each is asked for in many pairs
SCALE = "scale"  # the unknown common factor of numerator and denominator
Term = tuple[tuple[int, ...], int]  # exponents and coefficient
Terms = tuple[Term, ...]


class PolynomialMap(Protocol):
    """Parameters -> coordinates, polynomials with integer coefficients: equal behaviours are equal
    coordinates.
    """

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the parameters."""

    @property
    def coordinates(self) -> tuple[Terms, ...]:
        """Terms of the polynomials in them."""

    @property
    def content(self) -> str:
        """A digest of all that distinguishes two maps, for the labels of their points and
        primes.
        """

    def __hash__(self) -> int:
        """Of the content."""


@dataclass(frozen=True)
class CoefficientMap:
    """Transfer function sum b_i s^i / sum a_i s^i: polynomials b_i, a_i in `parameters`,
    ascending, in lowest terms.

    Lowest terms means for generic parameters; the caller answers for it. Raises InputError where a
    polynomial has other symbols than the parameters, or the denominator has no leading
    coefficient.
    """

    parameters: tuple[str, ...]
    numerator: tuple[fmpz_mpoly, ...]
    denominator: tuple[fmpz_mpoly, ...]

    def __post_init__(self) -> None:
        if any(
            tuple(p.context().names()) != self.parameters
            for p in (*self.numerator, *self.denominator)
        ):
            raise InputError(
                "the coefficients of a model are polynomials in exactly its parameters"
            )
        if not self.denominator or self.denominator[-1].is_zero() or not self.numerator:
            raise InputError(
                "a transfer function has a numerator and a leading denominator coefficient that is"
                " not zero"
            )

    @property
    def is_monic(self) -> bool:
        """True if the leading coefficient of the denominator is 1, so that equal functions have
        equal coefficients.
        """
        return bool(self.denominator[-1].is_one())

    @property
    def degrees(self) -> tuple[int, int]:
        """Degrees in s of numerator and denominator."""
        tops = [i for i, b in enumerate(self.numerator) if not b.is_zero()]
        return max(tops, default=0), len(self.denominator) - 1

    @cached_property
    def coordinates(self) -> tuple[Terms, ...]:
        """Terms of b_0, b_1, .. and a_0, a_1, .., the last a left out where it is 1."""
        kept = self.denominator[:-1] if self.is_monic else self.denominator
        return tuple(terms(p) for p in (*self.numerator, *kept))

    @cached_property
    def content(self) -> str:
        """A digest of all that distinguishes two maps, for the labels of their points and
        primes.
        """
        return digest(self.parameters, self.degrees, self.coordinates)

    def __hash__(self) -> int:
        return hash(self.content)

    def with_scale(self) -> "CoefficientMap":
        """All coefficients times one more parameter: then equal functions have equal
        coefficients, monic or not.
        """
        ring = symbols([*self.parameters, SCALE])

        def lifted(polynomials: Sequence[fmpz_mpoly]) -> tuple[fmpz_mpoly, ...]:
            """In the larger ring, times the new parameter."""
            return tuple(rename_symbols(p, ring, {}) * ring[SCALE] for p in polynomials)

        return CoefficientMap(
            (*self.parameters, SCALE), lifted(self.numerator), lifted(self.denominator)
        )


def coefficient_map(structure: Structure) -> CoefficientMap:
    """The map of a chain in its own parameters; a dead time, a factor exp(-Td s), is no part of it.

    >>> from disting.model.chain import Chain
    >>> [str(a) for a in coefficient_map(Chain(1, damped=False).structure).denominator]
    ['m1']
    """
    names = tuple(p for p in structure.parameters if p != "Td")
    return separate(names, *expand(structure))


@lru_cache(maxsize=REMEMBERED)
def normalise(structure: Structure) -> CoefficientMap:
    """The map of a chain in the unknowns of this module's text: monic and linear in each of them.

    >>> from disting.model.chain import Chain
    >>> m = normalise(Chain(2, damped=True).structure)
    >>> m.parameters, [str(a) for a in m.denominator]
    (('u1', 'e1', 'r1', 'g1'), ['u1*r1 + u1', 'e1*r1 + e1', '1'])
    """
    rows = rows_of(structure)
    names = (*(name for row in rows for name in unknowns(row)), *(["lag"] if structure.lag else []))
    ring = symbols(["s", *names])
    fractions = [receptance_of_row(row, ring) for row in rows]
    num, den = reduce(lambda x, y: (x[0] * y[1] + y[0] * x[1], x[1] * y[1]), fractions)
    if structure.lag:
        den = den * (ring["s"] + ring["lag"])
    num = num * ring["s"] ** structure.sensor_order
    power = min(min(e[0] for e in p.monoms()) for p in (num, den))
    return separate(names, num // ring["s"] ** power, den // ring["s"] ** power)


def match_maps(
    model: CoefficientMap, other: CoefficientMap
) -> tuple[CoefficientMap, CoefficientMap]:
    """Both maps in a form in which equal transfer functions are equal coefficients, as many in
    both, zeros included.

    Of equally many poles all functions have their coefficients in one space, whatever the degrees
    of the numerators. Raises InputError for denominators of unequal degrees.
    """
    if model.degrees[1] != other.degrees[1]:
        raise InputError(
            f"transfer functions of equally many poles are compared, not {model.degrees} and"
            f" {other.degrees}"
        )
    top = max(model.degrees[0], other.degrees[0]) + 1
    model, other = _pad_map(model, top), _pad_map(other, top)
    if model.is_monic and other.is_monic:
        return model, other
    return model.with_scale(), other.with_scale()


def _pad_map(model: CoefficientMap, count: int) -> CoefficientMap:
    """The map with that many numerator coefficients; those left out are zero."""
    zero = model.denominator[-1] - model.denominator[-1]
    numerator = (*model.numerator, *[zero] * count)[:count]
    return model if numerator == model.numerator else replace(model, numerator=numerator)


def separate(names: tuple[str, ...], num: fmpz_mpoly, den: fmpz_mpoly) -> CoefficientMap:
    """The map of a fraction of polynomials in s, the first symbol, and the names."""
    context = next(iter(symbols(names).values())).context()
    return CoefficientMap(names, *(_powers_of_s(p, context) for p in (num, den)))


def _powers_of_s(polynomial: fmpz_mpoly, context: fmpz_mpoly_ctx) -> tuple[fmpz_mpoly, ...]:
    """The coefficients of the powers 0, 1, .. of the first symbol, without it."""
    parts: list[dict[tuple[int, ...], fmpz]] = [{} for _ in range(polynomial.degrees()[0] + 1)]
    for powers, number in polynomial.to_dict().items():
        parts[powers[0]][powers[1:]] = number
    return tuple(map(context.from_dict, parts))


def terms(polynomial: fmpz_mpoly) -> Terms:
    """Exponents and coefficients of a polynomial."""
    return tuple((tuple(map(int, e)), int(c)) for e, c in polynomial.to_dict().items())


def unknowns(row: Row) -> tuple[str, ...]:
    """Names of the unknowns of a row, numbered as in the chain.

    >>> unknowns(Row(2, True, 1, 2, damped=True))
    ('u0', 'e0', 'u1', 'e1', 'r1', 'g1')
    """
    first = row.before + 1
    kinds = "ue" if row.damped else "u"
    names = [
        f"{kind}{i + row.before}"
        for i in range(row.n_masses)
        for kind in (kinds if i in row.joints else "") + ("r" if i > 0 else "")
    ]
    return (*names, *(f"f{i + row.before}" for i in row.ground_dampers), f"g{first}")


def receptance_of_row(row: Row, ring: dict[str, fmpz_mpoly]) -> tuple[fmpz_mpoly, fmpz_mpoly]:
    """Receptance (numerator, denominator) of a row; `ring` has s and the row's unknowns."""
    first, last = row.before + 1, row.before + row.n_masses
    s, zero = ring["s"], ring["s"] - ring["s"]
    joints = [ring.get(f"u{i}", zero) + ring.get(f"e{i}", zero) * s for i in range(first - 1, last)]
    theta, phi, den = determinants(row, with_ratios(row, joints, ring), ring)
    between = reduce(mul, joints[row.a : row.b], ring[f"g{first}"])
    return between * theta * phi, den


def with_ratios(
    row: Row, joints: Sequence[fmpz_mpoly], ring: dict[str, fmpz_mpoly]
) -> list[tuple[fmpz_mpoly, fmpz_mpoly]]:
    """Terms of the joints 0, 1, .. left of each mass for the masses on their left and right: c_i
    and r_i c_i.
    """
    unit = ring["s"] ** 0
    ratios = [ring.get(f"r{i + row.before}", unit) for i in range(row.n_masses)]
    return [(c, ratio * c) for c, ratio in zip(joints, ratios, strict=True)]


def determinants(
    row: Row, added: Sequence[tuple[fmpz_mpoly, fmpz_mpoly]], ring: dict[str, fmpz_mpoly]
) -> tuple[fmpz_mpoly, fmpz_mpoly, fmpz_mpoly]:
    """theta_(a-1), phi_(b+1) and D of a row by the three-term recurrences; `added`: what the joint
    left of each mass adds to the masses on its left and right.
    """
    s, zero = ring["s"], ring["s"] - ring["s"]
    below = [*(left for left, _ in added[1:]), zero]
    diagonal = [
        s * s + right + left + ring.get(f"f{i + row.before}", zero) * s
        for i, ((_, right), left) in enumerate(zip(added, below, strict=True), 1)
    ]
    squares = [left * right for left, right in added[1:]]
    leading, trailing = (
        _minors(d, q, s**0) for d, q in ((diagonal, squares), (diagonal[::-1], squares[::-1]))
    )
    return leading[row.a - 1], trailing[row.n_masses - row.b], leading[-1]


def receptance_map(row: Row) -> CoefficientMap:
    """The receptance of a row as a map of its unknowns."""
    names = unknowns(row)
    return separate(names, *receptance_of_row(row, symbols(["s", *names])))


def _minors(
    diagonal: list[fmpz_mpoly], squares: list[fmpz_mpoly], unit: fmpz_mpoly
) -> list[fmpz_mpoly]:
    """1, d_1, d_1 d_2 - q_1, ..: the leading principal minors of a tridiagonal matrix."""
    minors = [unit, diagonal[0]]
    for d, q in zip(diagonal[1:], squares, strict=True):
        minors.append(d * minors[-1] - q * minors[-2])
    return minors
