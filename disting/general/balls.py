"""Values of networks in numbers, by synthesis: all positive ones, whatever the degree of the
polynomials whose roots are needed.

Numbers are fractions as long as no root is irrational, then balls that hold them. Of a one-port of
two kinds of elements nothing else is positive: in series a positive branch is of its set K(n, c,
z), so that the constant and the pole at 0 go where one is required, and as F has as many different
poles as all branches have terms, no two of them share one (see `synthesis`). So these are all, but
for exchanges of branches that are alike, unless elements share what only their sum determines. Of
trees of compartments the same holds: d_i, p_ij and all flows follow.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from flint import acb_poly, arb, ctx, fmpq, fmpq_poly, fmpz_mpoly

from disting.general.fibre import Extent
from disting.general.field import Arithmetic, Poly
from disting.general.matrix_model import AnyModel
from disting.general.replacement import set_of
from disting.general.synthesis import NoFormulas
from disting.general.target import Values, fraction, value_at
from disting.general.values_of_parts import values_over

BITS = 600
POSITIVE = "positive"  # how many sets there are: all positive ones are known, others are not


@dataclass
class Balls(Arithmetic):
    """Numbers: fractions, and balls around irrational ones; the values of parameters by name."""

    values: Values
    choices: list[tuple[str, ...]] = field(default_factory=list)
    one: Any = field(default_factory=lambda: fmpq(1))

    def number(self, value: int) -> fmpq:
        """An integer."""
        return fmpq(value)

    def __getitem__(self, name: str) -> fmpq:
        return fmpq(self.values[name].numerator, self.values[name].denominator)

    def lifted(self, polynomial: fmpz_mpoly) -> fmpq:
        """The value of a polynomial in the parameters."""
        terms = tuple((tuple(map(int, e)), int(c)) for e, c in polynomial.to_dict().items())
        point = [self.values[n] for n in polynomial.context().names()]
        number = value_at(terms, point)
        return fmpq(number.numerator, number.denominator)

    def factors(self, polynomial: Poly) -> list[Poly]:
        """All linear: positive networks have real poles."""
        if all(isinstance(c, fmpq) for c in polynomial):
            whole = fmpq_poly(list(polynomial)).numer()
            parts = [(fmpq_poly(f), power) for f, power in whole.factor()[1]]
            return [
                g
                for f, power in parts
                for g in ([tuple(f.coeffs())] if f.degree() == 1 else _linear(f.coeffs()))
                for _ in range(power)
            ]
        return _linear(polynomial)


def _linear(polynomial: Sequence[Any]) -> list[Poly]:
    try:
        roots = acb_poly([arb(c) for c in polynomial]).roots(tol=arb(2) ** -BITS)
    except ValueError as multiple:
        raise NoFormulas("two poles are equal, or nearly so") from multiple
    if not all(r.imag.contains(0) for r in roots):
        raise NoFormulas("a pole is not real")
    return [(-r.real, fmpq(1)) for r in roots]


@dataclass(frozen=True, slots=True)
class Synthesis:
    """Positive values of another network, exact where they are fractions. `complete`: there are no
    other positive ones, but for exchanges of branches that are alike.
    """

    sets: tuple[dict[str, Fraction | float], ...]
    complete: bool
    choices: tuple[tuple[str, ...], ...] = ()

    @property
    def extent(self) -> str:
        """Number of solutions, in words."""
        if self.choices:
            return Extent.FAMILY.value
        return POSITIVE if self.complete else Extent.UNKNOWN.value


def positive_sets(model: AnyModel, values: Values, other: AnyModel) -> Synthesis:
    """The positive values of one network that give the transfer functions of another one at
    positive values; both in powers of one variable. Raises NoFormulas.

    >>> from disting.general.any_model import of_network
    >>> from disting.network import network_of
    >>> one, two = (of_network(network_of(t)) for t in ("R0-p(R1,C1)", "p(R1,R2-C1)"))
    >>> values = {"R0": Fraction(1), "R1": Fraction(2), "C1": Fraction(1, 2)}
    >>> positive_sets(one, values, two).sets[0]["C1"]
    Fraction(2, 9)
    """
    if not all(x > 0 for x in values.values()):
        raise NoFormulas("the given values are not all positive")
    numbers = Balls(values)
    try:
        with ctx.workprec(BITS):
            the_numbers = [
                {n: _number(x) for n, x in sorted(lot.items())}
                for lot in values_over(numbers, model, other)
            ]
    except ZeroDivisionError as special:
        raise NoFormulas("at these values the function is of a smaller set") from special
    full_set, network = set_of(model), other.network
    whole = full_set == set_of(other) if full_set else network is not None and network.is_directed
    complete = whole and not numbers.choices
    return Synthesis(tuple(the_numbers), complete, tuple(numbers.choices))


def _number(value: Any) -> Fraction | float:
    """A fraction, or a number of 15 digits; raises NoFormulas where it may not be positive."""
    if not value > 0:
        raise NoFormulas("a value is not known to be positive")
    if isinstance(value, fmpq):
        return fraction(value)
    if value.rel_accuracy_bits() < 60:
        raise NoFormulas("values are not known to 15 digits")
    return float(value)
