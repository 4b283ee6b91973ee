"""The transfer functions of a measured chain as polynomials: their degrees, what vanishes, which
denominators are one and the same, and the proof of a renaming.

Degrees. In an entry in which force and sensor have one end each in every row that both reach, all
terms of a row's numerator have one sign (all-minors matrix-tree theorem; what is added
is positive). Where the rows agree in it nothing cancels, and a coefficient vanishes
exactly if it does at all parameters = 1; numerator and denominator have only powers of s in
common, as for chains. Other entries are written out and their greatest common divisor is divided
out.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import lcm

from flint import fmpz_mpoly, fmpz_poly

from disting.algebra.symbols import coefficients, renamed, symbols
from disting.algebra.tridiagonal import Ring
from disting.behaviour.transfer import plain_receptance, touched
from disting.experiments.experiment import Entry, MeasuredChain
from disting.model.protocol import ZERO, Degrees

REMEMBERED = 1024


@dataclass(frozen=True, slots=True)
class Shape:
    """Powers of s in numerator and denominator in lowest terms, both empty for an entry that is
    zero; `denominator` is equal for entries that have one and the same denominator.
    """

    numerator: frozenset[int]
    denominator_powers: frozenset[int]
    denominator: tuple[object, ...]

    @property
    def degrees(self) -> Degrees:
        """Degrees of numerator and denominator."""
        if not self.numerator:
            return ZERO
        return max(self.numerator), max(self.denominator_powers)

    @property
    def zeros(self) -> frozenset[str]:
        """Labels of the coefficients up to the degrees that vanish identically."""
        sides = (("b", self.numerator), ("a", self.denominator_powers))
        return frozenset(
            f"{letter}{i}"
            for letter, powers in sides
            for i in range(max(powers, default=0))
            if i not in powers
        )


@lru_cache(maxsize=REMEMBERED)
def shape(entry: Entry) -> Shape:
    """What is known exactly of an entry's coefficients."""
    if not touched(entry):
        return Shape(frozenset(), frozenset(), ())
    if not _has_one_sign(entry):
        num, den = expanded(entry)
        top, bottom = (
            frozenset(i for i, c in enumerate(coefficients(p, "s")) if not c.is_zero())
            for p in (num, den)
        )
        return Shape(top, bottom, (entry.experiment.changes, str(den)))
    num, den = _scaled(entry, dict.fromkeys(entry.parameters, fmpz_poly([1])), fmpz_poly([0, 1]))
    sides = [{i for i, c in enumerate(p.coeffs()) if c} for p in (num, den)]
    sides[0] = {i + entry.sensor_order for i in sides[0]}
    common = min(sides[0] | sides[1])
    top, bottom = (frozenset(i - common for i in side) for side in sides)
    return Shape(top, bottom, (entry.experiment.changes, touched(entry), common))


@lru_cache(maxsize=REMEMBERED)
def expanded(entry: Entry) -> tuple[fmpz_mpoly, fmpz_mpoly]:
    """Numerator and denominator in s (the first symbol) and the parameters, integers without a
    common factor.
    """
    ring = symbols(["s", *entry.parameters])
    num, den = _scaled(entry, ring, ring["s"])
    num = num * ring["s"] ** entry.sensor_order
    common = num.gcd(den)
    num, den = num // common, den // common
    return (-num, -den) if int(den.coeffs()[0]) < 0 else (num, den)


def is_renaming(left: MeasuredChain, right: MeasuredChain, renaming: Mapping[str, str]) -> bool:
    """Whether renaming the left parameters turns every transfer function into that of the same
    experiment on the right: an exact identity. A dead time can only become the other's dead time.
    """
    if left.chain.dead_time != right.chain.dead_time:
        return False
    if left.chain.dead_time and renaming["Td"] != "Td":
        return False
    return all(_renames(a, b, renaming) for a, b in zip(left.entries, right.entries, strict=True))


def known_factor(entry: Entry) -> int:
    """The common denominator of what is known."""
    return lcm(*(size.denominator for size in entry.known.values()))


def _renames(left: Entry, right: Entry, renaming: Mapping[str, str]) -> bool:
    if not (touched(left) and touched(right)):
        return not touched(left) and not touched(right)
    a, b = expanded(left), expanded(right)
    ring = symbols([str(g) for g in b[1].context().gens()])
    num, den = (renamed(p, ring, renaming) for p in a)
    return bool(num * b[1] == b[0] * den)


def _has_one_sign(entry: Entry) -> bool:
    """Whether force and sensor have one end each in every row that both reach, and all rows the
    same product of signs.
    """
    p, signs = entry.ports, set[int]()
    for first, last in touched(entry):
        here = [first <= port <= last for port in p]
        act_minus, act_plus, meas_minus, meas_plus = here
        if (act_minus and act_plus) or (meas_minus and meas_plus):
            return False
        signs.add(1 if act_plus == meas_plus else -1)
    return len(signs) == 1


def _scaled(entry: Entry, values: Mapping[str, Ring], s: Ring) -> tuple[Ring, Ring]:
    """Receptance num/den over the integers: A(s) times the common denominator L of what is known
    has integer entries, and its inverse is that of A(s) divided by L. T1 is no part of A(s).
    """
    factor, one = known_factor(entry), s**0
    lifted = {n: v if n in ("T1", "Td") else factor * v for n, v in values.items()}
    lifted |= {n: int(size * factor) * one for n, size in entry.known.items()}
    num, den = plain_receptance(entry, lifted, s, one)
    return factor * num, den


def residues_of(known: Mapping[str, Fraction], modulus: int) -> dict[str, int]:
    """What is known, modulo a prime."""
    return {n: x.numerator * pow(x.denominator, -1, modulus) % modulus for n, x in known.items()}
