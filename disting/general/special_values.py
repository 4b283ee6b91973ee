"""Positive values at which a transfer function has a lower degree than for almost all others.

G = n/d in lowest terms over the parameters has a lower degree at special values exactly where n and
d get a common root, or both leading or both last coefficients vanish. Where all coefficients are
sums of positive terms none of them vanishes, so a lower degree is a zero of the resultant of n and
d. A factor of it with terms of one sign has no positive zero. A factor that is A x - B for one of
its parameters x, with A and B sums of positive terms without x, has one, x = B/A, whatever
the other values.

The discriminants show how this happens: where a factor divides that of d, two poles fall together,
and one of them cancels; where it divides that of n, two zeros do. As functions nothing remains of
either; a comparison of the unreduced numerators and denominators, with the common factor, shows a
double pole or a double zero.

`special_values` decides which of two networks gives all that the other one gives, special values
included (`disting.network.normal_form`).
"""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

from flint import fmpz_mpoly

from disting.algebra.symbols import symbols
from disting.errors import enumeration
from disting.general.matrix_model import AnyModel, Model
from disting.network.exact import within

REMEMBERED = 512
MOST_PARAMETERS = 7  # resultants of more take long


@dataclass(frozen=True, slots=True, order=True)
class Special:
    """A polynomial in the parameters that is zero at some positive values, where the transfer
    function has a lower degree, and whether two poles, or two zeros, fall together there.
    """

    polynomial: str
    poles: bool
    zeros: bool


@lru_cache(maxsize=REMEMBERED)
def lower_degree(model: Model) -> tuple[Special, ...] | None:
    """Where the transfer function has a lower degree; nowhere if it never has; None if that is not
    known.

    >>> from disting.general.any_model import of_network
    >>> from disting.network import network_of
    >>> lower_degree(of_network(network_of("p(R1,C1)-p(R2,C2)")))
    (Special(polynomial='C1*R1 - C2*R2', poles=True, zeros=False),)
    >>> lower_degree(of_network(network_of("p(C1,R1-p(C2,R2))")))
    ()
    """
    ring = symbols(["s", *model.parameters])
    s, *values = ring.values()
    sides = []
    for terms_of in (model.numerator_terms, model.denominator_terms):
        if any(number < 0 for terms in terms_of for _, number in terms):
            return None
        side = s - s
        for power, terms in enumerate(terms_of):
            for exponents, number in terms:
                side += number * _product(values, exponents, s**power)
        sides.append(side)
    if not all(side.degrees()[0] for side in sides):
        return ()
    specials, double = [], [_double_roots(side) for side in sides]
    for factor, _ in sides[0].resultant(sides[1], "s").factor()[1]:
        if len({coefficient > 0 for coefficient in factor.coeffs()}) == 1:
            continue
        if not any(_is_solved(factor, i) for i in range(1, len(values) + 1)):
            return None
        zeros, poles = ((d % factor).is_zero() for d in double)
        specials.append(Special(str(factor).replace("^", "**"), poles, zeros))
    return tuple(sorted(specials))


def _double_roots(side: fmpz_mpoly) -> fmpz_mpoly:
    """A polynomial that is zero where the side has a double root, 1 of one without two roots."""
    return side.discriminant("s") if side.degrees()[0] > 1 else side**0


def _product(
    values: Iterable[fmpz_mpoly], exponents: Iterable[int], polynomial: fmpz_mpoly
) -> fmpz_mpoly:
    for x, e in zip(values, exponents, strict=True):
        polynomial = polynomial * x**e
    return polynomial


def _is_solved(factor: fmpz_mpoly, at: int) -> bool:
    """Return True if it is A x - B, or its negative, A and B sums of positive terms without x."""
    signs: dict[int, set[bool]] = {}
    for exponents, coefficient in factor.to_dict().items():
        signs.setdefault(int(exponents[at]), set()).add(coefficient > 0)
    return (
        sorted(signs) == [0, 1]
        and signs[0] != signs[1]
        and all(len(x) == 1 for x in signs.values())
    )


@dataclass(frozen=True, slots=True)
class SpecialValues:
    """Of two models: whether each gives all transfer functions that the other one gives, special
    values included (None: not known), and where one that is known to give more than the other one
    has a lower degree, as far as that is known.
    """

    left_in_right: bool | None
    right_in_left: bool | None
    lower: tuple[Special, ...] = ()

    @property
    def is_same(self) -> bool:
        """True if each is known to give everything that the other one gives."""
        return bool(self.left_in_right and self.right_in_left)

    @property
    def is_known(self) -> bool:
        """True if one of them is known to give everything that the other one gives."""
        return bool(self.left_in_right or self.right_in_left)

    def in_short(self, left: str, right: str) -> str:
        """Both in words; "" where neither is known to give all that the other one gives."""
        if self.is_same:
            return f"{left} and {right} give the same, for all positive values (proven)."
        if not self.is_known:
            return ""
        inner, outer = (left, right) if self.left_in_right else (right, left)
        sentence = f"For all positive values of {inner}, {outer} can give the same (proven)"
        if None in (self.left_in_right, self.right_in_left):
            return f"{sentence}; the converse is not known."
        return f"{sentence}, but not the other way round."

    def sentence(self, left: str, right: str) -> str:
        """The same, and where the one that gives more has fewer poles."""
        where = enumeration(f"{s.polynomial} = 0" for s in self.lower)
        outer = right if self.left_in_right else left
        few = f" {outer} has fewer poles where {where}." if where else ""
        return f"{self.in_short(left, right)}{few}"


def special_values(left: AnyModel, right: AnyModel) -> SpecialValues:
    """Functions that two models of networks give for all positive values, special ones included.

    >>> from disting.general.any_model import of_network
    >>> from disting.network import network_of
    >>> foster, cauer = "p(R1,C1)-p(R2,C2)", "p(C1,R1-p(C2,R2))"
    >>> found = special_values(of_network(network_of(foster)), of_network(network_of(cauer)))
    >>> found.left_in_right, found.right_in_left
    (False, True)
    >>> found.sentence("A", "B").partition(". ")[2]
    'A has fewer poles where C1*R1 - C2*R2 = 0.'
    """
    network, other = left.network, right.network
    if network is None or other is None:
        return SpecialValues(None, None)
    inside = within(network, other), within(other, network)
    if set(inside) != {True, False}:
        return SpecialValues(*inside)
    outer = right if inside[0] else left
    if not isinstance(outer, Model) or len(outer.parameters) > MOST_PARAMETERS:
        return SpecialValues(*inside)
    return SpecialValues(*inside, lower_degree(outer) or ())
