"""A chain as a model of the general kind: its transfer function at a point, the size of the
polynomials behind it, and what vanishes identically.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import ClassVar

from disting.algebra.quotient import Quotient, constant, lowest_terms, variable
from disting.algebra.sampling import Size
from disting.behaviour.powers import degrees, powers, zeros
from disting.behaviour.sample import at_point, coefficient_columns
from disting.behaviour.transfer import Arrangement, receptance, values_at
from disting.model.protocol import Columns, Degrees
from disting.model.structure import Structure

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
        """Whether the chain has one."""
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
        """Those that are the constant 0: of the coefficients those that `powers` tells; a Markov
        parameter below the relative degree and, in undamped chains, where its parity differs.
        """
        if markov is None:
            return dict.fromkeys(zeros(self.structure), "0")
        return dict.fromkeys(vanishing_series(*powers(self.structure), markov), "0")


def quotient(
    structure: Arrangement,
    point: Sequence[int],
    modulus: int,
    known: Mapping[str, int] = MappingProxyType({}),
) -> Quotient:
    """The transfer function (24), without dead time, in lowest terms at a point given in the
    order of the parameters; `known` are residues of what has a known size, by name.
    """
    values = values_at(structure, point, lambda number: constant(number, modulus))
    values |= {name: constant(number, modulus) for name, number in known.items()}
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
