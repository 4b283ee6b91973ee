"""Positive values at which a transfer function has a lower degree than for almost all others.

G = n/d in lowest terms over the parameters has a lower degree at special values exactly where n and
d get a common root, or both leading or both last coefficients vanish. Where all coefficients are
sums of positive terms none of them vanishes, so a lower degree is a zero of the resultant of n and
d. A factor of it with terms of one sign has no positive zero. A factor that is A x - B for one of
its parameters x, with A and B sums of positive terms without x, has one, x = B/A, whatever
the other values.

Two models that are the same for almost all positive values have different sets of transfer
functions if one of them reaches a lower degree and the other never does.
"""

from collections.abc import Iterable

from flint import fmpz_mpoly

from disting.algebra.symbols import symbols
from disting.general.model import Model


def lower_degree(model: Model) -> tuple[str, ...] | None:
    """Polynomials in the parameters, each of which is zero at some positive values, where the
    transfer function has a lower degree; none if it never has; None if that is not known.

    >>> from disting.general.any_model import of_network
    >>> from disting.network import network_of
    >>> lower_degree(of_network(network_of("p(R1,C1)-p(R2,C2)")))
    ('C1*R1 - C2*R2',)
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
    found = []
    for factor, _ in sides[0].resultant(sides[1], "s").factor()[1]:
        if len({coefficient > 0 for coefficient in factor.coeffs()}) == 1:
            continue
        if not any(_is_solved(factor, i) for i in range(1, len(values) + 1)):
            return None
        found.append(str(factor).replace("^", "**"))
    return tuple(sorted(found))


def _product(values: Iterable[fmpz_mpoly], exponents: Iterable[int], one: fmpz_mpoly) -> fmpz_mpoly:
    for x, e in zip(values, exponents, strict=True):
        one = one * x**e
    return one


def _is_solved(factor: fmpz_mpoly, at: int) -> bool:
    """Whether it is A x - B, or its negative, A and B sums of positive terms without x."""
    signs: dict[int, set[bool]] = {}
    for exponents, coefficient in factor.to_dict().items():
        signs.setdefault(int(exponents[at]), set()).add(coefficient > 0)
    return (
        sorted(signs) == [0, 1]
        and signs[0] != signs[1]
        and all(len(x) == 1 for x in signs.values())
    )
