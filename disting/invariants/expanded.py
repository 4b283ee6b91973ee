"""The transfer function of a chain written out in its parameters: where a person reads it or an identity is proven."""

from dataclasses import dataclass

from flint import fmpz_mpoly

from disting.algebra.symbols import coefficients, renamed, symbols
from disting.invariants.transfer import plain_receptance
from disting.model.chain import Chain
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
    num, den = written_out(structure)
    s = num.context().gens()[0]
    power = min(_valuation(num), _valuation(den))
    return Expanded(num // s**power, den // s**power)


def written_out(structure: Structure) -> tuple[fmpz_mpoly, fmpz_mpoly]:
    """Numerator (times s to the sensor's order) and denominator, common powers of s not cancelled; s is the first symbol."""
    ring = symbols(["s", *structure.parameters])
    num, den = plain_receptance(structure, ring, ring["s"], ring["s"] ** 0)
    return num * ring["s"] ** structure.sensor_order, den


def transfer_function(chain: Chain) -> Expanded:
    """Transfer function of a chain in its parameters, to be read; a dead time is a factor exp(-Td s) beside it.

    >>> from disting.model.family import Family
    >>> transfer_function(Family(2)[1]).table()
    {'b0': 'k12', 'b1': '0', 'b2': 'm2', 'a0': 'm1*k12 + m2*k12', 'a1': '0', 'a2': 'm1*m2'}
    """
    return expanded(chain.structure)


def is_renaming(left: Structure, right: Structure, renaming: dict[str, str]) -> bool:
    """Whether renaming the left parameters turns the left transfer function into the right one: an exact identity.

    A dead time is a factor of its own, so it can only become the other's dead time.
    """
    if left.dead_time != right.dead_time or (left.dead_time and renaming["Td"] != "Td"):
        return False
    a, b = expanded(left), expanded(right)
    ring = dict(zip((str(g) for g in b.den.context().gens()), b.den.context().gens(), strict=True))
    num, den = (renamed(p, ring, renaming) for p in (a.num, a.den))
    return bool(num * b.den == b.num * den) if (num, den) != (b.num, b.den) else True


def _valuation(polynomial: fmpz_mpoly) -> int:
    return min((powers[0] for powers in polynomial.monoms()), default=0)
