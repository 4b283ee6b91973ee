"""A network as a model of the one kind that samples, profiles and comparisons know: its transfer
function at points, without polynomials in its values.

Powers of s that occur, degrees and numbers of terms are known exactly (`disting.network.forests`).

LEMMA. Without flows a coefficient of N and of D over the leading one of D is the constant 0 or not
constant, that leading one itself aside. Proof: times a number, all admittances take G over that
number, so b_i/a_m is homogeneous of degree -1 in them; p_e -> p_e h^-r_e takes G(s) to G(s/h), so
a_i/a_m is homogeneous of degree m - i in h. Of flows D has the leading coefficient 1, and all terms
of a coefficient have as many values as its power of s lacks: it is a number where that are none.

The same numbers, so the same bounds of errors, follow as from the polynomials written out. Where
they are not known, the polynomials are written out (`disting.general.behaviour`).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import ClassVar

from disting.algebra.certainty import Size
from disting.algebra.quotient import Quotient, coefficient_rows
from disting.behaviour.chain_model import UNBOUNDED
from disting.behaviour.sample import label, shared_poles
from disting.general.any_model import without_names
from disting.general.behaviour import (
    GeneralModel,
    KnownValue,
    known_invariants,
    summary_size,
    times_lead,
)
from disting.general.matrix_model import AnyModel
from disting.model.protocol import ZERO, Columns, Degrees
from disting.network.at_points import Assembly, Sides, assembly, quotient_at, sides_at
from disting.network.forests import Counts, counts_of
from disting.network.network import Network


@dataclass(frozen=True, slots=True)
class NetworkModel:
    """The transfer functions of a network whose terms are counted, in powers of s or of s^(1/2).

    `cells`: the network between each output and each input, row by row; None where no way leads.
    """

    parameters: tuple[str, ...]
    cells: tuple[Network | None, ...]
    halves: bool
    dead_time: ClassVar[bool] = False
    most_subsets: ClassVar[int] = UNBOUNDED
    lost_bits: ClassVar[int] = 1

    @property
    def n_states(self) -> int:
        """The largest degree of a numerator or a denominator."""
        return max(max(d) for d in self.degrees)

    @property
    def content(self) -> tuple[object, ...]:
        """The networks, whatever they are called."""
        return *self.cells, self.halves

    @property
    def is_numbered(self) -> bool:
        """True if there are several transfer functions."""
        return len(self.cells) > 1

    @property
    def degrees(self) -> tuple[Degrees, ...]:
        """Those of all transfer functions."""
        return tuple(ZERO if counts is None else counts.degrees for counts in self._counts)

    def quotients(self, point: Sequence[int], modulus: int) -> tuple[Quotient | None, ...]:
        """The transfer functions, at a point without zeros."""
        return tuple(
            None if of is None else quotient_at(of, point, modulus) for of in self._assemblies
        )

    def columns(self, point: Sequence[int], modulus: int) -> Columns:
        """Those of the functions c_i a_m of all, at a point without zeros; none at one of the few
        where too few numbers s show them.
        """
        rows = list[tuple[int, list[int]]]()
        for of, counts in zip(self._assemblies, self._counts, strict=True):
            if of is None or counts is None:
                continue
            sides = sides_at(of, point, modulus)
            if sides is None:
                return (), [()] * len(point)
            rows += _products(sides, counts, modulus)
        return tuple(value for value, _ in rows), list(zip(*(g for _, g in rows), strict=True))

    def minor_size(self, markov: int | None) -> Size:
        """Bounds for the cleared minors of the Jacobian: the sizes of a coefficient's numbers, all
        1, sum to the number of its terms.
        """
        largest = [
            (counts.degree, counts.size.bit_length())
            for counts in self._counts
            if counts is not None
        ]
        return summary_size(self.degrees, largest, len(self.parameters), markov)

    def constants(self, markov: int | None) -> Mapping[str, str]:
        """Those that are proven constant: 0, or the number of their terms."""
        texts: dict[str, str] = {}
        for i, counts in enumerate(self._counts):
            if counts is None:
                continue
            named = known_invariants(*_ratios(counts), markov)
            shared = shared_poles(self.degrees, i) if markov is None else None
            if shared is not None:
                zeros = {f"a{k}": Fraction(0) for k in range(counts.degrees[1])}
                named = {n: v for n, v in named.items() if n[0] == "b"} | zeros
            labels = (label(n, i, shared) if self.is_numbered else n for n in named)
            texts |= dict(zip(labels, map(str, named.values()), strict=True))
        return texts

    @property
    def _assemblies(self) -> tuple[Assembly | None, ...]:
        return tuple(None if c is None else assembly(c, self.halves) for c in self.cells)

    @property
    def _counts(self) -> tuple[Counts | None, ...]:
        return tuple(None if c is None else counts_of(c, self.halves) for c in self.cells)


def behaviour_of(model: AnyModel) -> GeneralModel | NetworkModel:
    """Behaviour of a model: of a network at points where its terms are counted and transfer
    functions with the same number of poles have all of them in common, of others by its
    polynomials.
    """
    network, halves = model.network, model.powers.halves
    if network is not None and network.parameters == model.parameters:
        plain = replace(network, name="network")
        cells = tuple(c if c.seen else None for row in plain.cells for c in row)
        is_known = all(c is None or counts_of(c, halves) for c in cells)
        network_model = NetworkModel(plain.parameters, cells, halves)
        if is_known and _shares_poles(network_model):
            return network_model
    return GeneralModel(without_names(model))


def _shares_poles(model: NetworkModel) -> bool:
    """Return True if transfer functions with the same number of poles have one denominator: that of
    one graph.
    """
    firsts = (shared_poles(model.degrees, i) for i in range(len(model.cells)))
    return all(
        first is None or _elements(model.cells[first]) == _elements(cell)
        for first, cell in zip(firsts, model.cells, strict=True)
        if cell is not None
    )


def _elements(cell: Network | None) -> frozenset[str]:
    return frozenset() if cell is None else frozenset(map(str, cell.seen))


def _products(sides: Sides, counts: Counts, modulus: int) -> list[tuple[int, list[int]]]:
    """Values and gradients of the functions c_i a_m."""
    rows = [
        row
        for side, slopes, size in (
            (sides.num, sides.num_derivatives, len(counts.num)),
            (sides.den, sides.den_derivatives, len(counts.den)),
        )
        for row in list(zip(*coefficient_rows(side, slopes, size), strict=True))[counts.lost :]
    ]
    return times_lead(rows, counts.mean, modulus)


def _ratios(counts: Counts) -> tuple[list[KnownValue], list[KnownValue]]:
    """Known values of the coefficients divided by the leading one."""
    lost = counts.lost
    top, bottom = (
        [Fraction(c) if i == free or not c else None for i, c in enumerate(side)][lost:]
        for side, free in zip((counts.num, counts.den), counts.free, strict=True)
    )
    return top, [*bottom[:-1], Fraction(1)]
