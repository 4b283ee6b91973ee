"""The profile of one model in one representation: all that conditions 1 to 5 and 7 ask of it, computed once.

A profile is small, hashable data. Pairs are compared through profiles, so a family costs one profile a model, and models with
equal profiles form buckets.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import ceil, log2

from flint import fmpz_poly

from disting.algebra.matroid import Matroid, SearchTooLargeError, matroid
from disting.algebra.quotient import rational
from disting.algebra.sampling import PROOF_BITS, SEARCH_BITS, Size, prime, residues, safety
from disting.invariants.sample import Representation, Sample, sample
from disting.invariants.transfer import receptance
from disting.model.structure import Structure
from disting.settings import Settings


@dataclass(frozen=True, slots=True)
class Unsearched:
    """A matroid that was not computed, and why."""

    reason: str


@dataclass(frozen=True, slots=True)
class Profile:
    """What one model reveals in one representation.

    `labels` of the moment invariants; `free` marks the non-constant ones; `constants` holds the values of the others ("" where
    free); `degrees` (numerator, denominator) of (25); `count` of Markov parameters (0 for transfer functions);
    `rank` = number of determinable parameters. That the invariants in `proven_zeros` vanish, that free ones are free and, with
    `rank_proven`, the rank hold without any error probability; all else is wrong with a probability of at most 2**-safety,
    over the choice of the random points.
    """

    representation: Representation
    labels: tuple[str, ...]
    free: tuple[bool, ...]
    constants: tuple[str, ...]
    degrees: tuple[int, int]
    count: int
    n_states: int
    n_parameters: int
    rank: int
    matroid: Matroid | Unsearched
    proven_zeros: frozenset[str]
    rank_proven: bool
    safety: int

    @property
    def form(self) -> frozenset[str]:
        """Symbolic form: the labels of the non-constant invariants."""
        return frozenset(label for label, free in zip(self.labels, self.free, strict=True) if free)

    def describes_all(self, other: "Profile") -> bool:
        """Whether both summaries together are exhaustive: N_S1 + N_S2 Markov parameters (section 4.3), or any coefficients."""
        return self.representation is Representation.TF or self.count >= self.n_states + other.n_states


def profile(structure: Structure, representation: Representation, count: int, settings: Settings) -> Profile:
    """Profile from `settings.points` random points with large primes and one search point with a small prime."""
    seen = list(samples(structure, representation, count, settings.points, settings.seed))
    size = minor_size(structure, representation, count)
    degrees = _degrees(seen[0])
    zeros = _proven_zeros(structure, representation, degrees, seen[0].labels)
    search = _sample(structure, representation, count, f"{settings.seed}:search", SEARCH_BITS)
    return from_samples(seen, search, zeros, degrees, count, structure.n_states, size, settings)


def from_samples(
    seen: Sequence[Sample],
    search: Sample,
    zeros: frozenset[str],
    degrees: tuple[int, int],
    count: int,
    n_states: int,
    size: Size,
    settings: Settings,
) -> Profile:
    """Profile of a summary known through samples; `zeros` are the labels that are proven to vanish."""
    labels = seen[0].labels
    free = tuple(any(any(s.rows[i]) for s in seen) for i in range(len(labels)))
    constants = tuple("" if free[i] else rational(seen[0].values[i], seen[0].modulus) for i in range(len(labels)))
    everything = tuple(range(len(labels)))
    rank = max(s.rank(everything) for s in seen)
    shape, claims = _matroid(seen, search, rank, settings.subset_limit)
    return Profile(
        representation=Representation.TF if labels[0].startswith("b") else Representation.MARKOV,
        labels=labels,
        free=free,
        constants=constants,
        degrees=degrees,
        count=count,
        n_states=n_states,
        n_parameters=seen[0].n_parameters,
        rank=rank,
        matroid=shape,
        proven_zeros=zeros,
        rank_proven=rank == min(sum(free), seen[0].n_parameters),
        safety=safety(size, len(seen)) - ceil(log2(claims + len(labels) + 1)),
    )


def samples(structure: Structure, representation: Representation, count: int, points: int, seed: str) -> Iterator[Sample]:
    """Yield samples at independent points, each with its own large prime."""
    return (_sample(structure, representation, count, f"{seed}:{k}", PROOF_BITS) for k in range(points))


def minor_size(structure: Structure, representation: Representation, count: int) -> Size:
    """Bounds for the cleared minors of the Jacobian.

    Numerator and denominator before normalisation have degree N + 1 at most in the parameters and, being sums of spanning
    forests with coefficient 1 (matrix-tree theorem), coefficients that sum to 6^N at most for each of the four port pairs.
    Entry i of the summary is such a polynomial over power w of the leading coefficient: w = 1 for (25), i + 1 for (30).
    """
    degree, bits = structure.n_masses + 1, 3 * structure.n_masses + 4
    power = 2 if representation is Representation.TF else count + 2
    entry = Size(power * degree, power * (bits + 1) + ceil(log2(power * degree)) + 1)
    rank = len(structure.parameters)
    return Size(rank * entry.degree, rank * (entry.bits + ceil(log2(rank + 1))))


def _sample(structure: Structure, representation: Representation, count: int, label: str, bits: int) -> Sample:
    modulus = prime(label, bits)
    point = residues(f"{label}:{structure}", len(structure.parameters), modulus)
    return sample(structure, representation, count, point, modulus)


def _degrees(s: Sample) -> tuple[int, int]:
    numerator = sum(label.startswith("b") for label in s.labels)
    return numerator - 1, sum(label.startswith("a") for label in s.labels)


def _matroid(seen: Sequence[Sample], search: Sample, rank: int, limit: int) -> tuple[Matroid | Unsearched, int]:
    """Matroid at the search point with each dependence confirmed at all points, and the number of these statements."""
    if len(search.labels) > 64:
        return Unsearched("more than 64 invariants"), 0
    try:
        shape = matroid(search.jacobian, limit)
    except SearchTooLargeError as reason:
        return Unsearched(f"more than {limit} subsets: {reason}"), 0
    statements = list(shape.dependences())
    if shape.rank != rank or any(s.rank(rows) > bound for s in seen for rows, bound in statements):
        return Unsearched("the search point was special; choose another seed"), 0
    return shape, len(statements)


def _proven_zeros(
    structure: Structure, representation: Representation, degrees: tuple[int, int], labels: Sequence[str]
) -> frozenset[str]:
    """Labels of invariants that vanish identically, by an argument without chance.

    Coefficients of a chain's numerator and denominator are sums of products of parameters with positive signs (all-minors
    matrix-tree theorem; force and sensor cross the gap in the same sense), so one that is zero at all parameters = 1 is zero.
    A Markov parameter is zero below the relative degree and, in undamped chains, where its parity differs from it.
    """
    if not _sign_free(structure):
        return frozenset()
    num, den = _at_ones(structure)
    coefficients = {f"b{i}": c for i, c in enumerate(num)} | {f"a{i}": c for i, c in enumerate(den)}
    tf_zeros = frozenset(label for label, c in coefficients.items() if c == 0)
    if representation is Representation.TF:
        return tf_zeros
    relative = len(den) - len(num)
    even = all(
        label in tf_zeros for label in coefficients if int(label[1:]) % 2 != (len(num if label[0] == "b" else den) - 1) % 2
    )
    vanishing = (i for i in range(len(labels)) if i < relative or (even and (i - relative) % 2))
    return frozenset(f"G{i}" for i in vanishing)


def _sign_free(structure: Structure) -> bool:
    """No block holds a plus and a minus port together, so no term of the numerator is subtracted."""
    p = structure.ports
    spans = [range(first, last + 1) for first, last in structure.blocks]
    return not any((p.act_plus in s or p.meas_plus in s) and (p.act_minus in s or p.meas_minus in s) for s in spans)


def _at_ones(structure: Structure) -> tuple[list[int], list[int]]:
    """Numerator and denominator coefficients over the integers at all parameters = 1, common powers of s cancelled."""
    ones = {name: fmpz_poly([1]) for name in structure.parameters}
    r = receptance(structure, ones, fmpz_poly([0, 1]), fmpz_poly([1]))
    num = [0] * structure.sensor_order + [int(c) for c in r.num.coeffs()]
    den = [int(c) for c in r.den.coeffs()]
    power = next(i for i, pair in enumerate(zip(num, den, strict=False)) if any(pair))
    return num[power:], den[power:]
