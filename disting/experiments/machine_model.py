"""A measured chain as a model of the general kind, for any changes of the machine: one transfer
function an experiment, and a dead time that all share; their degrees, what vanishes, which
denominators are equal, and the proof of a renaming.

Degrees. In an entry in which force and sensor have one end each in every row that both reach, all
terms of a row's numerator have one sign (all-minors matrix-tree theorem; what is added
is positive). Where the rows agree in it nothing cancels, and a coefficient vanishes
exactly if it does at all parameters = 1; numerator and denominator have only powers of s in
common, as for chains. Other entries are written out and their greatest common divisor is divided
out.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import lcm
from typing import ClassVar, TypeVar

from flint import fmpz_mpoly, fmpz_poly

from disting.algebra.certainty import Size, prime, residues
from disting.algebra.quotient import Quotient, matrix
from disting.algebra.symbols import coefficients, symbols
from disting.behaviour.chain_model import quotient, size_of_minors, vanishing_series
from disting.behaviour.sample import (
    Representation,
    at_point,
    coefficient_columns,
    label,
    seen_at,
    shared_poles,
)
from disting.behaviour.transfer import become, plain_receptance, touched_rows
from disting.experiments.experiment import Entry, MeasuredChain
from disting.model.protocol import ZERO, Columns, Degrees

Whole = TypeVar("Whole", fmpz_poly, fmpz_mpoly)
REMEMBERED = 1024


@dataclass(frozen=True, slots=True)
class Shape:
    """Powers of s in numerator and denominator in lowest terms, both empty for an entry that is
    zero; `denominator` is equal for entries that have the same denominator.
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
    """Exactly known properties of an entry's coefficients."""
    if not touched_rows(entry):
        return Shape(frozenset(), frozenset(), ())
    if not _has_one_sign(entry):
        parts = expand(entry)
        top, bottom = (
            frozenset(i for i, c in enumerate(coefficients(p, "s")) if not c.is_zero())
            for p in parts
        )
        return Shape(top, bottom, (entry.experiment.changes, str(parts[1])))
    num, den = _scale_to_integers(
        entry, dict.fromkeys(entry.parameters, fmpz_poly([1])), fmpz_poly([0, 1])
    )
    sides = [{i for i, c in enumerate(p.coeffs()) if c} for p in (num, den)]
    sides[0] = {i + entry.sensor_order for i in sides[0]}
    common = min(sides[0] | sides[1])
    top, bottom = (frozenset(i - common for i in side) for side in sides)
    return Shape(top, bottom, (entry.experiment.changes, touched_rows(entry), common))


@lru_cache(maxsize=REMEMBERED)
def expand(entry: Entry) -> tuple[fmpz_mpoly, fmpz_mpoly]:
    """Numerator and denominator in s (the first symbol) and the parameters, integers without a
    common factor.
    """
    ring = symbols(["s", *entry.parameters])
    num, den = _scale_to_integers(entry, ring, ring["s"])
    num = num * ring["s"] ** entry.sensor_order
    common = num.gcd(den)
    num, den = num // common, den // common
    return (-num, -den) if int(den.coeffs()[0]) < 0 else (num, den)


def is_renaming(left: MeasuredChain, right: MeasuredChain, renaming: Mapping[str, str]) -> bool:
    """Return True if renaming the left parameters turns every transfer function into that of the
    same experiment on the right: an exact identity. A dead time can only become the other's dead
    time.
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
    if not (touched_rows(left) and touched_rows(right)):
        return not touched_rows(left) and not touched_rows(right)
    return become(expand(left), expand(right), renaming)


def _has_one_sign(entry: Entry) -> bool:
    """Return True if force and sensor have one end each in every row that both reach, and all rows
    have the same product of signs.
    """
    p, signs = entry.ports, set[int]()
    for first, last in touched_rows(entry):
        inside = [first <= port <= last for port in p]
        act_minus, act_plus, meas_minus, meas_plus = inside
        if (act_minus and act_plus) or (meas_minus and meas_plus):
            return False
        signs.add(1 if act_plus == meas_plus else -1)
    return len(signs) == 1


def _scale_to_integers(entry: Entry, values: Mapping[str, Whole], s: Whole) -> tuple[Whole, Whole]:
    """Receptance num/den over the integers: A(s) times the common denominator L of what is known
    has integer entries, and its inverse is that of A(s) divided by L. T1 is no part of A(s).
    """
    factor, unit = known_factor(entry), s**0
    lifted = {n: v if n in ("T1", "Td") else factor * v for n, v in values.items()}
    lifted |= {n: int(size * factor) * unit for n, size in entry.known.items()}
    num, den = plain_receptance(entry, lifted, s, unit)
    return factor * num, den


def residues_of(sizes: Mapping[str, Fraction], modulus: int) -> dict[str, int]:
    """Known sizes modulo a prime."""
    return {n: x.numerator * pow(x.denominator, -1, modulus) % modulus for n, x in sizes.items()}


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
        """True if the chain has a dead time."""
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
        for each thing that is added to its mass, in addition to 6. A difference of two denominators
        has both leading coefficients below it, so twice the power.
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
            own, shared = shape(entry), shared_poles(self.degrees, i)
            if not own.numerator:
                continue
            if markov is not None:
                names = vanishing_series(own.numerator, own.denominator_powers, markov)
                yield from (label(name, i, None) for name in names)
                continue
            first = None if shared is None else shape(self.measured.entries[shared])
            same = first is not None and first.denominator == own.denominator
            for name in (f"b{k}" for k in range(own.degrees[0] + 1)):
                if name in own.zeros:
                    yield label(name, i, None)
            for name in (f"a{k}" for k in range(own.degrees[1])):
                zero = name in own.zeros and (first is None or name in first.zeros)
                if same or zero:
                    yield label(name, i, shared)


def rank_by(measured: MeasuredChain, names: Sequence[str], label: str) -> int:
    """Rank of the Jacobian of all coefficients by these parameters, at a random point modulo a
    random prime: never above that at generic parameters.
    """
    parameters, modulus = measured.chain.parameters, prime(label)
    point = residues(f"{label}:point", len(parameters), modulus)
    sampled = seen_at(at_point(MachineModel(measured), point, modulus), Representation.TF, 0)
    at = [parameters.index(name) for name in names]
    return int(matrix([[row[i] for i in at] for row in sampled.rows], len(at), modulus).rank())


def _term_bits(entry: Entry) -> int:
    """Of the number of terms that a row of A(s) sums: 3 where two things are added at most."""
    added = Counter(change.place for change in entry.experiment.changes if change.kind.takes_size)
    return max(3, (5 + max(added.values(), default=0)).bit_length())


def _height(entry: Entry) -> int:
    factor = known_factor(entry)
    largest = max(int(x * factor) for x in (Fraction(1), *entry.known.values()))
    return (largest - 1).bit_length()
