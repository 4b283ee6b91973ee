"""A chain as a model of the general kind: its transfer function at a point, the size of the
polynomials behind it, and, known exactly, its degrees and what vanishes identically.

Coefficients of a chain's numerator and denominator are sums of products of parameters with
positive signs (all-minors matrix-tree theorem; force and sensor cross the gap in the same sense).
Terms that all have one sign do not cancel, so a coefficient vanishes identically exactly if it is
zero at all parameters = 1, where it is an integer. Of structures in which a row holds a plus and a
minus port together, some terms of the numerator are subtracted; there the polynomials are written
out.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType
from typing import ClassVar

from flint import fmpz_poly

from disting.algebra.certainty import Size
from disting.algebra.quotient import Quotient, constant, lowest_terms, variable
from disting.algebra.symbols import coefficients
from disting.behaviour.sample import at_point, coefficient_columns
from disting.behaviour.transfer import (
    Arrangement,
    numerator_and_denominator,
    plain_receptance,
    receptance,
    values_at,
)
from disting.model.chain import Structure
from disting.model.protocol import Columns, Degrees

REMEMBERED = 4096
Powers = tuple[frozenset[int], frozenset[int]]
"""The powers of s in numerator and denominator, common ones cancelled."""


def powers(structure: Structure) -> Powers:
    """The powers of s whose coefficients do not vanish identically, of the transfer function
    without dead time.

    >>> from disting.model.chain import Chain
    >>> [sorted(p) for p in powers(Chain(2, meas_plus=2, damped=False).structure)]
    [[0], [0, 2]]
    """
    return _powers(structure)[0]


def common_power(structure: Structure) -> int:
    """The power of s that numerator (times that of the sensor) and denominator have in common
    before it is cancelled.
    """
    return _powers(structure)[1]


@lru_cache(maxsize=REMEMBERED)
def _powers(structure: Structure) -> tuple[Powers, int]:
    sides = _at_ones(structure) if is_sign_free(structure) else _written_out(structure)
    num, den = ({i for i, is_there in enumerate(side) if is_there} for side in sides)
    common = min(num | den)
    return (frozenset(i - common for i in num), frozenset(i - common for i in den)), common


def degrees(structure: Structure) -> tuple[int, int]:
    """Degrees of numerator and denominator once common powers of s are cancelled."""
    num, den = powers(structure)
    return max(num), max(den)


def zeros(structure: Structure) -> frozenset[str]:
    """Labels of the coefficients (25) up to the degrees that vanish identically."""
    sides = zip("ba", powers(structure), strict=True)
    return frozenset(
        f"{letter}{i}" for letter, side in sides for i in range(max(side)) if i not in side
    )


def is_sign_free(structure: Structure) -> bool:
    """No row holds a plus and a minus port together, so no term of the numerator is
    subtracted.
    """
    p = structure.ports
    rows = [range(first, last + 1) for first, last in structure.row_ends]
    return not any(
        (p.act_plus in s or p.meas_plus in s) and (p.act_minus in s or p.meas_minus in s)
        for s in rows
    )


def _at_ones(structure: Structure) -> tuple[list[bool], list[bool]]:
    """Flags of the coefficients that are nonzero at all parameters = 1, over the integers."""
    ones = {name: fmpz_poly([1]) for name in structure.parameters}
    num, den = plain_receptance(structure, ones, fmpz_poly([0, 1]), fmpz_poly([1]))
    return [False] * structure.sensor_order + [bool(c) for c in num.coeffs()], [
        bool(c) for c in den.coeffs()
    ]


def _written_out(structure: Structure) -> tuple[list[bool], list[bool]]:
    """Flags of the coefficients that are not the zero polynomial."""
    num, den = (
        [not c.is_zero() for c in coefficients(p, "s")]
        for p in numerator_and_denominator(structure)
    )
    return num, den


UNBOUNDED = 1 << 60  # subsets: the settings bound the search


@dataclass(frozen=True, slots=True)
class ChainModel:
    """One transfer function of masses, springs and dampers."""

    structure: Structure
    is_numbered: ClassVar[bool] = False
    lost_bits: ClassVar[int] = 0
    most_subsets: ClassVar[int] = UNBOUNDED

    @property
    def parameters(self) -> tuple[str, ...]:
        """Those of the structure."""
        return self.structure.parameters

    @property
    def dead_time(self) -> bool:
        """True if the chain has a dead time."""
        return self.structure.dead_time

    @property
    def n_states(self) -> int:
        """Order of the transfer function."""
        return self.structure.n_states

    @property
    def content(self) -> tuple[object, ...]:
        """The structure."""
        return (self.structure,)

    @property
    def degrees(self) -> tuple[Degrees, ...]:
        """Those of the transfer function."""
        return (degrees(self.structure),)

    def quotients(self, point: Sequence[int], modulus: int) -> tuple[Quotient, ...]:
        """The transfer function."""
        return (quotient(self.structure, point, modulus),)

    def columns(self, point: Sequence[int], modulus: int) -> Columns:
        """Those of the coefficients."""
        return coefficient_columns(at_point(self, point, modulus))

    def minor_size(self, markov: int | None) -> Size:
        """Bounds for the cleared minors of the Jacobian.

        Numerator and denominator before normalisation have degree N + 1 at most in the parameters
        and, being sums of spanning forests with coefficient 1 (matrix-tree theorem), coefficients
        that sum to 6^N at most for each of the four port pairs. Entry i of the summary is such a
        polynomial over power w of the leading coefficient: w = 1 for (25), i + 1 for (30).
        """
        n = self.structure.n_masses
        power = 2 if markov is None else markov + 2
        return size_of_minors(power, n + 1, 3 * n + 4, len(self.parameters))

    def constants(self, markov: int | None) -> Mapping[str, str]:
        """Those that are the constant 0: the coefficients given by `powers`; a Markov parameter
        below the relative degree and, in undamped chains, where its parity differs.
        """
        if markov is None:
            return dict.fromkeys(zeros(self.structure), "0")
        return dict.fromkeys(vanishing_series(*powers(self.structure), markov), "0")


def quotient(
    structure: Arrangement,
    point: Sequence[int],
    modulus: int,
    constants: Mapping[str, int] = MappingProxyType({}),
) -> Quotient:
    """The transfer function (24), without dead time, in lowest terms at a point given in the
    order of the parameters; `constants` are residues of what has a known size, by name.
    """
    values = values_at(structure, point, lambda number: constant(number, modulus))
    values |= {name: constant(number, modulus) for name, number in constants.items()}
    rational = receptance(structure, values, variable(modulus), constant(1, modulus))
    order, names = structure.sensor_order, [p for p in structure.parameters if p != "Td"]
    return lowest_terms(
        rational.num.left_shift(order),
        rational.den,
        [rational.num_gradient[p].left_shift(order) for p in names],
        [rational.den_gradient[p] for p in names],
    )


def size_of_minors(power: int, degree: int, bits: int, rank: int) -> Size:
    """Of `rank` rows, each entry a derivative that `power` coefficients clear, which have this
    degree in the parameters and numbers of so many bits.
    """
    whole = power * degree
    entry_bits = power * (bits + 1) + max(whole - 1, 0).bit_length() + 1
    return Size(rank * whole, rank * (entry_bits + rank.bit_length()))


def vanishing_series(num: frozenset[int], den: frozenset[int], count: int) -> tuple[str, ...]:
    """Labels of the Markov parameters that vanish by the powers of s alone: below the relative
    degree, and by parity of even and odd functions of s.
    """
    relative = max(den) - max(num)
    even = all((max(side) - i) % 2 == 0 for side in (num, den) for i in side)
    return tuple(f"G{i}" for i in range(count + 1) if i < relative or (even and (i - relative) % 2))
