"""Interface of every family of models: samples, profiles and comparisons use nothing else of a
model.

The behaviour of a model is its transfer functions, one or several, as they depend on the
parameters; a family gives their values at a point modulo a prime, how large the polynomials behind
them are, and which invariants it proves to be constant.
"""

from collections.abc import Mapping, Sequence
from typing import Protocol

from disting.algebra.certainty import Size
from disting.algebra.quotient import Quotient

Degrees = tuple[int, int]
"""Of numerator and denominator."""
ZERO: Degrees = (-1, 0)  # of a transfer function that is zero
Columns = tuple[tuple[int, ...], list[tuple[int, ...]]]
"""Values of some functions, and for each parameter their derivatives."""


class Model(Protocol):
    """A parametric model: immutable, hashable, and written out by its fields.

    A number of Markov parameters is that after G_0; None denotes the coefficients.
    """

    def __hash__(self) -> int:
        """Equal models have equal numbers."""

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the parameters; the last one is a dead time where there is one."""

    @property
    def dead_time(self) -> bool:
        """True if all transfer functions have a factor exp(-Td s), which `quotients` omit."""

    @property
    def n_states(self) -> int:
        """Order of the transfer functions, at most."""

    @property
    def content(self) -> tuple[object, ...]:
        """All that distinguishes it from other models: labels of random points are made of it."""

    @property
    def degrees(self) -> tuple[Degrees, ...]:
        """Of all transfer functions in lowest terms, exactly; ZERO of one that is zero."""

    @property
    def is_numbered(self) -> bool:
        """True if invariants carry the number of their transfer function, where there are
        several.
        """

    @property
    def lost_bits(self) -> int:
        """Bits of an error bound that each point costs, as it may have been drawn again."""

    @property
    def most_subsets(self) -> int:
        """Largest number of subsets of rows that a search of dependences is worth."""

    def quotients(self, point: Sequence[int], modulus: int) -> Sequence[Quotient | None]:
        """The transfer functions at a point, in lowest terms there; None for one that is zero."""

    def columns(self, point: Sequence[int], modulus: int) -> Columns:
        """Functions that a renaming of the parameters carries into those of the other model."""

    def minor_size(self, markov: int | None) -> Size:
        """Bounds of the cleared minors of the Jacobian of all invariants."""

    def constants(self, markov: int | None) -> Mapping[str, str]:
        """Values of the invariants that are proven constant, by their labels."""
