"""A network as a model of the one kind that samples, profiles and comparisons know: its transfer
function at points, without polynomials in its values.

Powers of s that occur, degrees and numbers of terms are known exactly (`disting.network.forests`).

LEMMA. A coefficient of N and of D over the leading one of D is the constant 0 or not constant, that
leading one itself aside. Proof: times a number, all admittances take G over that number, so b_i/a_m
is homogeneous of degree -1 in them; p_e -> p_e h^-r_e takes G(s) to G(s/h), so a_i/a_m is
homogeneous of degree m - i in h.

The same numbers, so the same bounds of errors, follow as from the polynomials written out. Where
they are not known, the polynomials are written out (`disting.general.behaviour`).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import ClassVar

from disting.algebra.quotient import Quotient, coefficient_rows
from disting.algebra.sampling import Size
from disting.behaviour.chain_model import UNBOUNDED
from disting.general.any_model import unnamed
from disting.general.behaviour import GeneralModel, Known, known_invariants, summary_size
from disting.general.matrix_model import AnyModel
from disting.model.protocol import Columns, Degrees
from disting.network.at_points import Assembly, Sides, assembly, quotient_at, sides_at
from disting.network.forests import Counts, counts, counts_of
from disting.network.network import Network


@dataclass(frozen=True, slots=True)
class NetworkModel:
    """The transfer function of a network whose terms are counted, in powers of s or of s^(1/2)."""

    network: Network
    halves: bool
    dead_time: ClassVar[bool] = False
    is_numbered: ClassVar[bool] = False
    most_subsets: ClassVar[int] = UNBOUNDED
    lost_bits: ClassVar[int] = 1

    @property
    def parameters(self) -> tuple[str, ...]:
        """Those of the network."""
        return self.network.parameters

    @property
    def n_states(self) -> int:
        """The larger degree of numerator and denominator."""
        return max(self.degrees[0])

    @property
    def content(self) -> tuple[object, ...]:
        """The network, whatever it is called."""
        return self.network, self.halves

    @property
    def degrees(self) -> tuple[Degrees, ...]:
        """Those of the transfer function."""
        return (self._counts.degrees,)

    def quotients(self, point: Sequence[int], modulus: int) -> tuple[Quotient, ...]:
        """The transfer function, at a point without zeros."""
        return (quotient_at(self._assembly, point, modulus),)

    def columns(self, point: Sequence[int], modulus: int) -> Columns:
        """Those of the functions c_i a_m, at a point without zeros; none at one of the few where
        too few numbers s show them.
        """
        found = sides_at(self._assembly, point, modulus)
        if found is None:
            return (), [()] * len(point)
        rows = _products(found, self._counts, modulus)
        return tuple(value for value, _ in rows), list(zip(*(g for _, g in rows), strict=True))

    def minor_size(self, markov: int | None) -> Size:
        """Bounds for the cleared minors of the Jacobian: the sizes of a coefficient's numbers, all
        1, sum to the number of its terms.
        """
        known = self._counts
        bits = max(*known.num, *known.den).bit_length()
        return summary_size(self.degrees, [(known.degree, bits)], len(self.parameters), markov)

    def constants(self, markov: int | None) -> Mapping[str, str]:
        """Those that are the constant 0."""
        return {
            name: str(x) for name, x in known_invariants(*_ratios(self._counts), markov).items()
        }

    @property
    def _assembly(self) -> Assembly:
        found = assembly(self.network, self.halves)
        assert found is not None
        return found

    @property
    def _counts(self) -> Counts:
        return counts(self._assembly)


def behaviour_of(model: AnyModel) -> GeneralModel | NetworkModel:
    """What a model reveals, whatever it is called: of a network at points where its terms are
    counted, of others by its polynomials.
    """
    network, halves = model.network, model.powers.halves
    if network is not None and network.parameters == model.parameters:
        plain = replace(network, name="network")
        if counts_of(plain, halves) is not None:
            return NetworkModel(plain, halves)
    return GeneralModel(unnamed(model))


def _products(found: Sides, known: Counts, modulus: int) -> list[tuple[int, list[int]]]:
    """Values and gradients of the functions c_i a_m."""
    lost = known.lost
    rows = [
        row
        for side, slopes, size in (
            (found.num, found.num_derivatives, len(known.num)),
            (found.den, found.den_derivatives, len(known.den)),
        )
        for row in list(zip(*coefficient_rows(side, slopes, size), strict=True))[lost:]
    ]
    lead, steps = rows[-1]
    return [
        (
            value * lead % modulus,
            [(g * lead + value * h) % modulus for g, h in zip(gradient, steps, strict=True)],
        )
        for value, gradient in rows
    ]


def _ratios(known: Counts) -> tuple[list[Known], list[Known]]:
    """What is known of the coefficients over the leading one."""
    lost = known.lost
    top, bottom = (
        [None if c else Fraction(0) for c in side[lost:]] for side in (known.num, known.den)
    )
    return top, [*bottom[:-1], Fraction(1)]
