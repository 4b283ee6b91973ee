"""The profile of one model in one representation: all that conditions 1 to 5 and 7 ask of it,
computed once.

A profile is small, hashable data. Pairs are compared through profiles, so a family costs one
profile a model, and models with equal profiles form buckets.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import ceil, log2

from disting.algebra.matroid import Matroid, SearchTooLargeError, matroid
from disting.algebra.quotient import rational
from disting.algebra.sampling import SEARCH_BITS, Size, enough, safety
from disting.behaviour.powers import degrees, powers, zeros
from disting.behaviour.sample import Representation, Sample, drawn, seen_at
from disting.model.settings import Settings
from disting.model.structure import Structure

SEARCHES = 3  # points modulo 31 bits: with thousands of models one is special now and then


@dataclass(frozen=True, slots=True)
class Unsearched:
    """A matroid that was not computed, and why."""

    reason: str


@dataclass(frozen=True, slots=True)
class Profile:
    """What one model reveals in one representation.

    `labels` of the moment invariants; `free` marks the non-constant ones; `constants` holds the
    values of the others ("" where free); `degrees` (numerator, denominator) of (25), of several
    transfer functions one pair after the other, (-1, 0) for one that is zero; `count` of
    Markov parameters (0 for transfer functions); `rank` = number of determinable parameters. The
    degrees, that the invariants in `proven_zeros` vanish, that free ones are free and, with
    `rank_proven`, the rank hold without any error probability; all else is wrong with a
    probability of at most 2**-safety, over the choice of the random points. A rank seen at a point
    is a lower bound; it is proven where it is the number of parameters, or that of the rows that
    vary, all others being proven constant.
    """

    representation: Representation
    labels: tuple[str, ...]
    free: tuple[bool, ...]
    constants: tuple[str, ...]
    degrees: tuple[int, ...]
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
        """Whether both summaries together are exhaustive: N_S1 + N_S2 Markov parameters
        (section 4.3), or any coefficients.
        """
        return (
            self.representation is Representation.TF or self.count >= self.n_states + other.n_states
        )


def profile(
    structure: Structure, representation: Representation, count: int, settings: Settings
) -> Profile:
    """Profile from `settings.points` random points, or as many as it takes, with large primes,
    and one with a small prime.
    """
    size = minor_size(structure, representation, count)
    seen = list(
        samples(structure, representation, count, enough(size, settings.points), settings.seed)
    )
    drawings = (drawn(structure, label, SEARCH_BITS) for label in search_labels(settings.seed))
    searches = (seen_at(one, representation, count) for one in drawings)
    known = _proven_zeros(structure, representation, count)
    return from_samples(
        seen, searches, known, degrees(structure), count, structure.n_states, size, settings
    )


def search_labels(label: str) -> Iterator[str]:
    """Yield labels of the points at which dependences are searched, one after another while
    they are special.
    """
    for attempt in range(SEARCHES):
        yield f"{label}:search{f':{attempt}' * bool(attempt)}"


def from_samples(
    seen: Sequence[Sample],
    searches: Iterable[Sample],
    proven: frozenset[str],
    degrees: tuple[int, ...],
    count: int,
    n_states: int,
    size: Size,
    settings: Settings,
) -> Profile:
    """Profile of a summary known through samples; `proven` are the labels that are proven to be
    constant.

    Dependences are searched at the first of `searches` that is not special, as `seen` tells; the
    others are not asked for.
    """
    labels = seen[0].labels
    free = tuple(any(any(s.rows[i]) for s in seen) for i in range(len(labels)))
    constants = tuple(
        "" if free[i] else rational(seen[0].values[i], seen[0].modulus) for i in range(len(labels))
    )
    everything = tuple(range(len(labels)))
    rank = max(s.rank(everything) for s in seen)
    shape, claims = _matroid(seen, searches, rank, settings.subset_limit)
    return Profile(
        representation=Representation.MARKOV
        if labels[:1] and labels[0][0] == "G"
        else Representation.TF,
        labels=labels,
        free=free,
        constants=constants,
        degrees=degrees,
        count=count,
        n_states=n_states,
        n_parameters=seen[0].n_parameters,
        rank=rank,
        matroid=shape,
        proven_zeros=proven,
        rank_proven=rank == seen[0].n_parameters
        or (rank == sum(free) and _constants_known(labels, free, proven)),
        safety=safety(size, len(seen)) - ceil(log2(claims + len(labels) + 1)),
    )


def _constants_known(labels: Sequence[str], free: Sequence[bool], proven: frozenset[str]) -> bool:
    """Whether all rows that look constant are proven to be: then no more rows than the free
    ones can be independent.
    """
    return all(known or label in proven for label, known in zip(labels, free, strict=True))


def samples(
    structure: Structure, representation: Representation, count: int, points: int, seed: str
) -> Iterator[Sample]:
    """Yield samples at independent points, each with its own large prime."""
    return (seen_at(drawn(structure, f"{seed}:{k}"), representation, count) for k in range(points))


def minor_size(structure: Structure, representation: Representation, count: int) -> Size:
    """Bounds for the cleared minors of the Jacobian.

    Numerator and denominator before normalisation have degree N + 1 at most in the parameters and,
    being sums of spanning forests with coefficient 1 (matrix-tree theorem), coefficients that sum
    to 6^N at most for each of the four port pairs. Entry i of the summary is such a polynomial
    over power w of the leading coefficient: w = 1 for (25), i + 1 for (30).
    """
    degree, bits = structure.n_masses + 1, 3 * structure.n_masses + 4
    power = 2 if representation is Representation.TF else count + 2
    entry = Size(power * degree, power * (bits + 1) + ceil(log2(power * degree)) + 1)
    rank = len(structure.parameters)
    return Size(rank * entry.degree, rank * (entry.bits + ceil(log2(rank + 1))))


def _matroid(
    seen: Sequence[Sample], searches: Iterable[Sample], rank: int, limit: int
) -> tuple[Matroid | Unsearched, int]:
    """Matroid at a search point with each dependence confirmed at all points, and the number of
    statements that were tried.

    What was refuted counts too: each statement had its chance to be confirmed wrongly.
    """
    if len(seen[0].labels) > 64:
        return Unsearched("more than 64 invariants"), 0
    claims = 0
    for search in searches:
        try:
            shape = matroid(search.jacobian, limit)
        except SearchTooLargeError as reason:
            return Unsearched(f"more than {limit} subsets: {reason}"), 0
        statements = list(shape.dependences())
        claims += len(statements)
        if shape.rank == rank and not any(
            s.rank(rows) > bound for s in seen for rows, bound in statements
        ):
            return shape, claims
    return Unsearched("every search point was special; choose another seed"), 0


def _proven_zeros(
    structure: Structure, representation: Representation, count: int
) -> frozenset[str]:
    """Labels of invariants that vanish identically, by an argument without chance.

    Of the coefficients those that `powers` tells. A Markov parameter is zero below the relative
    degree and, in undamped chains, where its parity differs from it.
    """
    tf_zeros = zeros(structure)
    if representation is Representation.TF:
        return tf_zeros
    num, den = powers(structure)
    relative = max(den) - max(num)
    even = all((max(side) - i) % 2 == 0 for side in (num, den) for i in side)
    return frozenset(
        f"G{i}" for i in range(count + 1) if i < relative or (even and (i - relative) % 2)
    )
