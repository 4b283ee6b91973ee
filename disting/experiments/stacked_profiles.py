"""The exhaustive summary of a measured chain and its profile.

It is that of `behaviour.stacked`, whatever is done to the machine; a dead time that all share adds
itself.
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from math import ceil, log2

from disting.algebra.quotient import Quotient, matrix
from disting.algebra.sampling import PROOF_BITS, SEARCH_BITS, Size, about, enough, prime, residues
from disting.behaviour.profile import Profile, from_samples, search_labels
from disting.behaviour.sample import DRAWS, Representation, Sample, quotient
from disting.behaviour.stacked import label, seen_degrees, shared_poles, stacked_rows
from disting.errors import InputError
from disting.experiments.experiment import Entry, MeasuredChain
from disting.experiments.polynomials import known_factor, residues_of, shape
from disting.model.settings import Settings

# of one component of the matroid: stacked summaries have many more rows than parameters, and what
# condition 5 would say after seconds a list of one fibre says in tenths of them
MOST_SUBSETS = 300_000
REMEMBERED = 64  # points: of a few verdicts, for a sketch and the profile that may follow it


@dataclass(frozen=True, slots=True)
class Drawn:
    """A random point of a measured chain modulo a random prime, and all transfer functions there
    in lowest terms, None for those that are zero.
    """

    measured: MeasuredChain
    point: tuple[int, ...]
    modulus: int
    quotients: tuple[Quotient | None, ...]


def profile(
    measured: MeasuredChain, representation: Representation, count: int, settings: Settings
) -> Profile:
    """Profile of the stacked summary, as `behaviour.profile.profile` of one transfer function."""
    size = minor_size(measured, representation, count)
    points = enough(size, settings.points)
    seen = [
        seen_at(drawn(measured, f"{settings.seed}:{k}", PROOF_BITS), representation, count)
        for k in range(points)
    ]
    searches = (
        seen_at(drawn(measured, label, SEARCH_BITS), representation, count)
        for label in search_labels(settings.seed)
    )
    known = frozenset(_proven_zeros(measured, representation, count))
    n_states = measured.chain.structure.n_states
    settings = replace(settings, subset_limit=min(settings.subset_limit, MOST_SUBSETS))
    found = from_samples(seen, searches, known, degrees(measured), count, n_states, size, settings)
    # several entries may have been special at a point that was drawn again: a bit for each
    return replace(found, representation=representation, safety=found.safety - points)


def degrees(measured: MeasuredChain) -> tuple[int, ...]:
    """Degrees of numerator and denominator of every transfer function, one pair after the
    other.
    """
    return tuple(d for pair in _pairs(measured) for d in pair)


def _pairs(measured: MeasuredChain) -> list[tuple[int, int]]:
    return [shape(entry).degrees for entry in measured.entries]


@lru_cache(maxsize=REMEMBERED)
def drawn(measured: MeasuredChain, label: str, bits: int) -> Drawn:
    """The point and the prime that the label stands for; points at which a degree is smaller are
    drawn again (see `behaviour.sample`).
    """
    whole = about(label, measured)
    for again in (f"{whole}:{attempt}" for attempt in range(DRAWS)):
        modulus = prime(again, bits)
        point = residues(f"point:{again}", len(measured.chain.parameters), modulus)
        found = drawn_at(measured, point, modulus)
        if seen_degrees(found.quotients) == degrees(measured):
            return found
    raise InputError("numerator and denominator have a common factor for all parameters")


def drawn_at(measured: MeasuredChain, point: list[int], modulus: int) -> Drawn:
    """All transfer functions at a point that is given."""
    found = (
        quotient(e, point, modulus, residues_of(e.known, modulus)) if shape(e).numerator else None
        for e in measured.entries
    )
    return Drawn(measured, tuple(point), modulus, tuple(found))


def seen_at(where: Drawn, representation: Representation, count: int) -> Sample:
    """The summary with its derivatives by the parameters; a dead time that all share adds
    itself.
    """
    measured = where.measured
    found = stacked_rows(where.quotients, _pairs(measured), representation, count)
    if measured.chain.dead_time and found:
        n = len(where.point) - 1
        found = {name: (v, [*row, 0]) for name, (v, row) in found.items()}
        found["Td"] = (where.point[-1], [0] * n + [1])
    values = tuple(v for v, _ in found.values())
    jacobian = tuple(tuple(row) for _, row in found.values())
    return Sample(tuple(found), values, jacobian, len(where.point), where.modulus)


def rank_by(measured: MeasuredChain, names: Sequence[str], label: str) -> int:
    """Rank of the Jacobian of all coefficients by these parameters, at a random point modulo a
    random prime: never above that at generic parameters.
    """
    parameters, modulus = measured.chain.parameters, prime(label)
    point = residues(f"{label}:point", len(parameters), modulus)
    seen = seen_at(drawn_at(measured, point, modulus), Representation.TF, 0)
    at = [parameters.index(name) for name in names]
    return int(matrix([[row[i] for i in at] for row in seen.rows], len(at), modulus).rank())


def minor_size(measured: MeasuredChain, representation: Representation, count: int) -> Size:
    """Bounds for the cleared minors of the Jacobian, as in `behaviour.profile.minor_size`.

    What is known makes numbers of h bits larger at most, h those of the integers that A(s) has in
    the place of 1 or of a known size; each of N rows brings one, and a row has a term more for each
    thing that is added to its mass, beside 6. A difference of two denominators has both leading
    coefficients below it, so twice the power.
    """
    n = measured.chain.n_masses
    degree = n + 1
    bits = max(_term_bits(entry) + _height(entry) for entry in measured.entries) * n + 4
    power = 2 if representation is Representation.TF else count + 2
    power *= 1 + (len(measured.entries) > 1)
    entry = Size(power * degree, power * (bits + 1) + ceil(log2(power * degree)) + 1)
    rank = len(measured.chain.parameters)
    return Size(rank * entry.degree, rank * (entry.bits + ceil(log2(rank + 1))))


def _term_bits(entry: Entry) -> int:
    """Of the number of terms that a row of A(s) sums: 3 where two things are added at most."""
    added = Counter(change.place for change in entry.experiment.changes if change.kind.takes_size)
    return max(3, (5 + max(added.values(), default=0)).bit_length())


def _height(entry: Entry) -> int:
    factor = known_factor(entry)
    largest = max(int(x * factor) for x in (Fraction(1), *entry.known.values()))
    return (largest - 1).bit_length()


def _proven_zeros(
    measured: MeasuredChain, representation: Representation, count: int
) -> Iterator[str]:
    """Labels of invariants that are proven to be the constant 0."""
    for i, entry in enumerate(measured.entries):
        found, shared = shape(entry), shared_poles(_pairs(measured), i)
        if not found.numerator:
            continue
        if representation is Representation.MARKOV:
            yield from (label(name, i, None) for name in _zero_series(entry, count))
            continue
        first = None if shared is None else shape(measured.entries[shared])
        same = first is not None and first.denominator == found.denominator
        for name in (f"b{k}" for k in range(found.degrees[0] + 1)):
            if name in found.zeros:
                yield label(name, i, None)
        for name in (f"a{k}" for k in range(found.degrees[1])):
            zero = name in found.zeros and (first is None or name in first.zeros)
            if same or zero:
                yield label(name, i, shared)


def _zero_series(entry: Entry, count: int) -> Iterator[str]:
    """Below the relative degree, and by parity of even and odd functions of s."""
    found = shape(entry)
    sides = (found.numerator, found.denominator_powers)
    relative = found.degrees[1] - found.degrees[0]
    even = all((max(side) - k) % 2 == 0 for side in sides for k in side)
    for k in range(count + 1):
        if k < relative or (even and (k - relative) % 2):
            yield f"G{k}"
