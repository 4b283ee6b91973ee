"""The transfer function of a chain written out in its parameters: where a person reads it or an identity is proven."""

from dataclasses import dataclass

from flint import fmpz_mpoly

from disting.algebra.symbols import coefficients, renamed, symbols
from disting.invariants.transfer import receptance
from disting.model.structure import Structure


@dataclass(frozen=True)
class Expanded:
    """num/den as polynomials in s and the parameters with integer coefficients, common powers of s cancelled."""

    num: fmpz_mpoly
    den: fmpz_mpoly

    def table(self) -> dict[str, str]:
        """Label -> expression before normalisation: divide all by the last denominator coefficient to make it monic."""
        tops, bottoms = coefficients(self.num, "s"), coefficients(self.den, "s")
        return {f"b{i}": str(c) for i, c in enumerate(tops)} | {f"a{i}": str(c) for i, c in enumerate(bottoms)}


def expanded(structure: Structure) -> Expanded:
    """Transfer function (24) without dead time, in lowest terms for every chain of the class.

    >>> from disting.model.chain import Chain
    >>> r = expanded(Chain(1).structure)
    >>> str(r.num), str(r.den)
    ('1', 'm1')
    """
    ring = symbols(["s", *structure.parameters])
    s, one = ring["s"], ring["s"] ** 0
    r = receptance(structure, ring, s, one)
    num, den = r.num * s**structure.sensor_order, r.den
    power = min(_valuation(num), _valuation(den))
    return Expanded(num // s**power, den // s**power)


def is_renaming(left: Structure, right: Structure, renaming: dict[str, str]) -> bool:
    """Whether renaming the left parameters turns the left transfer function into the right one: an exact identity."""
    a, b = expanded(left), expanded(right)
    ring = dict(zip((str(g) for g in b.den.context().gens()), b.den.context().gens(), strict=True))
    num, den = (renamed(p, ring, renaming) for p in (a.num, a.den))
    return bool(num * b.den == b.num * den) if (num, den) != (b.num, b.den) else True


def _valuation(polynomial: fmpz_mpoly) -> int:
    return min((powers[0] for powers in polynomial.monoms()), default=0)
