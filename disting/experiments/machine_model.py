"""A measured chain as a model of the general kind, whatever is done to the machine: one transfer
function an experiment, and a dead time that all share.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import ClassVar

from disting.algebra.quotient import Quotient, matrix
from disting.algebra.sampling import Size, prime, residues
from disting.behaviour.chain_model import quotient, size_of_minors, vanishing_series
from disting.behaviour.sample import (
    Representation,
    at_point,
    coefficient_columns,
    label,
    seen_at,
    shared_poles,
)
from disting.experiments.experiment import Entry, MeasuredChain
from disting.experiments.polynomials import known_factor, residues_of, shape
from disting.model.protocol import Columns, Degrees


@dataclass(frozen=True, slots=True)
class MachineModel:
    """All transfer functions of a chain under several experiments."""

    measured: MeasuredChain
    is_numbered: ClassVar[bool] = True
    lost_bits: ClassVar[int] = 1  # several entries may have been special at a point
    # of one component of the matroid: there are many more rows than parameters, and what condition
    # 5 would say after seconds a list of one fibre says in tenths of them
    most_subsets: ClassVar[int] = 300_000

    @property
    def parameters(self) -> tuple[str, ...]:
        """Those of the chain."""
        return self.measured.chain.parameters

    @property
    def dead_time(self) -> bool:
        """Whether the chain has one."""
        return self.measured.chain.dead_time

    @property
    def n_states(self) -> int:
        """Order of each transfer function, at most."""
        return self.measured.chain.structure.n_states

    @property
    def content(self) -> tuple[object, ...]:
        """The chain and its experiments."""
        return (self.measured,)

    @property
    def degrees(self) -> tuple[Degrees, ...]:
        """Those of every transfer function."""
        return tuple(shape(entry).degrees for entry in self.measured.entries)

    def quotients(self, point: Sequence[int], modulus: int) -> tuple[Quotient | None, ...]:
        """All transfer functions."""
        return tuple(
            quotient(e, point, modulus, residues_of(e.known, modulus))
            if shape(e).numerator
            else None
            for e in self.measured.entries
        )

    def columns(self, point: Sequence[int], modulus: int) -> Columns:
        """Those of all coefficients."""
        return coefficient_columns(at_point(self, point, modulus))

    def minor_size(self, markov: int | None) -> Size:
        """Bounds for the cleared minors of the Jacobian, as of one chain.

        What is known makes numbers of h bits larger at most, h those of the integers that A(s) has
        in the place of 1 or of a known size; each of N rows brings one, and a row has a term more
        for each thing that is added to its mass, beside 6. A difference of two denominators has
        both leading coefficients below it, so twice the power.
        """
        n, entries = self.measured.chain.n_masses, self.measured.entries
        bits = max(_term_bits(entry) + _height(entry) for entry in entries) * n + 4
        power = (2 if markov is None else markov + 2) * (1 + (len(entries) > 1))
        return size_of_minors(power, n + 1, bits, len(self.parameters))

    def constants(self, markov: int | None) -> Mapping[str, str]:
        """Those that are proven to be the constant 0."""
        return dict.fromkeys(self._zeros(markov), "0")

    def _zeros(self, markov: int | None) -> Iterator[str]:
        """Yield their labels."""
        for i, entry in enumerate(self.measured.entries):
            found, shared = shape(entry), shared_poles(self.degrees, i)
            if not found.numerator:
                continue
            if markov is not None:
                names = vanishing_series(found.numerator, found.denominator_powers, markov)
                yield from (label(name, i, None) for name in names)
                continue
            first = None if shared is None else shape(self.measured.entries[shared])
            same = first is not None and first.denominator == found.denominator
            for name in (f"b{k}" for k in range(found.degrees[0] + 1)):
                if name in found.zeros:
                    yield label(name, i, None)
            for name in (f"a{k}" for k in range(found.degrees[1])):
                zero = name in found.zeros and (first is None or name in first.zeros)
                if same or zero:
                    yield label(name, i, shared)


def rank_by(measured: MeasuredChain, names: Sequence[str], label: str) -> int:
    """Rank of the Jacobian of all coefficients by these parameters, at a random point modulo a
    random prime: never above that at generic parameters.
    """
    parameters, modulus = measured.chain.parameters, prime(label)
    point = residues(f"{label}:point", len(parameters), modulus)
    seen = seen_at(at_point(MachineModel(measured), point, modulus), Representation.TF, 0)
    at = [parameters.index(name) for name in names]
    return int(matrix([[row[i] for i in at] for row in seen.rows], len(at), modulus).rank())


def _term_bits(entry: Entry) -> int:
    """Of the number of terms that a row of A(s) sums: 3 where two things are added at most."""
    added = Counter(change.place for change in entry.experiment.changes if change.kind.takes_size)
    return max(3, (5 + max(added.values(), default=0)).bit_length())


def _height(entry: Entry) -> int:
    factor = known_factor(entry)
    largest = max(int(x * factor) for x in (Fraction(1), *entry.known.values()))
    return (largest - 1).bit_length()
