"""The matroid of the rows of a generic Jacobian: condition 5's "largest sets of independent rows",
not listed.

Canonical form: drop loops, split into connected components, take of each the primal or the dual of
smaller rank k, and list the flats that its circuits of at most k elements span. They determine the
matroid: a set of k rows is a basis exactly if it has no more than rank(F) rows in any such flat F.
Equal matroids have equal forms, so the form is a key.

Certainty: independence at one point proves independence. Each dependence used is a statement "these
rows have at most this rank"; all of them are checked again at the independent points with large
primes (see `behaviour.profile`).

All dependences of at most k elements of a vector configuration of rank k are found by vectorised
elimination. Only the flat that a circuit (a smallest dependent set) spans is stored: one flat of 13
columns and rank 4 represents 1287 circuits. A circuit never has exactly one element outside a
hyperplane (Oxley, Matroid Theory, 2nd edition, proposition 2.1.11). So with the zeros of one row as
hyperplane those inside are found in a configuration of one row less, and all others start with two
columns outside: where these are few, that is a small part of all sets.

The sets are grown column by column, in the order of their last columns: one array operation takes
the quotients of many sets by each of their later columns, and a column that has become zero closes
a dependent set. Fraction-free steps need no inverse, and residues below 2^31 keep every product in
64 bits.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from math import comb

import numpy as np
from flint import nmod_mat
from numpy.typing import NDArray

from disting.algebra.certainty import residues

Words = NDArray[np.uint64]
Marks = NDArray[np.bool_]
Flat = tuple[int, int]
WIDE = 1 << 15  # sets at which a further level is no longer kept, but searched part by part
CHUNK = 1 << 16  # products at once: few enough to stay in the processor's cache


def dependent_flats(matrix: Words, modulus: int) -> list[Flat]:
    """(bit mask of columns, rank) of the closures of all circuits of size <= k of a k x n matrix
    that contains the unit matrix, sorted.

    A set S of columns is dependent exactly if |S & F| > rank(F) for one of these flats F, or if
    |S| > k. `modulus` < 2^31, n <= 64. What is found independent is so; a dependence may be by
    chance of the point.
    """
    bits = np.uint64(1) << np.arange(matrix.shape[1], dtype=np.uint64)
    return sorted(_flats(matrix.astype(np.uint64), bits, modulus))


def search_size(k: int, n: int) -> int:
    """Number of k-subsets, a bound for the work of `dependent_flats`."""
    return comb(n, k)


def _flats(matrix: Words, bits: Words, modulus: int) -> list[Flat]:
    """The flats; `bits` are those of the columns in the masks.

    A column without zeros closes a circuit with the whole unit matrix of two rows or more.
    """
    k, n = matrix.shape
    if k in (0, n):
        return []
    sparsest = int(np.count_nonzero(matrix, axis=1).argmin())
    inside = matrix[sparsest] == 0
    rest = np.delete(matrix, sparsest, axis=0)[:, inside]
    flats = _flats(rest, bits[inside], modulus)
    if (k > 2 and rest.all(axis=0).any()) or _has_circuit(bits[inside], k, flats):
        flats.append((int(bits[inside].sum()), k - 1))
    outside = int(np.count_nonzero(~inside))
    order = np.argsort(inside, kind="stable")
    matrix, bits = matrix[:, order], bits[order]
    for dependent in _crossing(_mix_rows(matrix, modulus), bits, outside, modulus):
        for flat in flats:
            dependent = _find_other_circuits(dependent, *flat)
        while dependent.size:
            flats.append(_span_circuit(matrix, bits, int(dependent[0]), modulus))
            dependent = _find_other_circuits(dependent, *flats[-1])
    return flats


def _has_circuit(bits: Words, size: int, flats: list[Flat]) -> bool:
    """Return True if columns of rank size - 1 have a circuit of this size, given the flats of all
    smaller sizes.
    """
    sets = np.zeros(1, np.uint64)
    for s in range(size):
        sets = _join_words([sets[: comb(c, s)] | bits[c] for c in range(s, len(bits))])
    for flat in flats:
        sets = _find_other_circuits(sets, *flat)
    return bool(sets.size)


def _crossing(matrix: Words, bits: Words, first: int, modulus: int) -> Iterator[Words]:
    """Yield the masks of all dependent sets of at most k columns with two or more of the `first`
    ones; of some more dependent sets too.

    `reduced` (n, rows, sets) holds the later columns modulo those of each set. The sets are in
    the order of their last columns, and column t extends the first counts[t] of them.
    """
    (k, n), sets, reduced = matrix.shape, np.zeros(1, np.uint64), matrix.T[:, :, None]
    among = np.arange(n) < first
    counts = among.astype(int)
    for size in range(k - 1):
        if len(sets) > WIDE:
            yield from _parts(sets, reduced, counts, bits, modulus)
            return
        starts = np.cumsum(counts) - counts
        grown = np.empty(starts[-1], np.uint64)
        longer = np.empty((n, k - size - 1, starts[-1]), np.uint64)
        closed = []
        for t in np.flatnonzero(counts[:-1]):
            old, new = slice(counts[t]), slice(starts[t], starts[t] + counts[t])
            grown[new], later = sets[old] | bits[t], longer[t + 1 :, :, new]
            later[:] = _quotients(reduced[t, :, old], reduced[t + 1 :, :, old], modulus)
            closed.append(_close_sets(grown[new], later, bits[t + 1 :]))
        yield _join_words(closed)
        sets, reduced, counts = grown, longer, starts if size else starts * among


def _parts(
    sets: Words, reduced: Words, counts: NDArray[np.intp], bits: Words, modulus: int
) -> Iterator[Words]:
    """The same from here on, some sets at a time: what is wide need not be kept."""
    n, rows = reduced.shape[:2]
    for t in range(n - 1):
        step = max(1, CHUNK // (rows * (n - t)))
        for start in range(0, counts[t], step):
            part = slice(start, min(start + step, counts[t]))
            later = _quotients(reduced[t, :, part], reduced[t + 1 :, :, part], modulus)
            yield _join_words(list(_from(sets[part] | bits[t], later, bits[t + 1 :], modulus)))


def _from(sets: Words, reduced: Words, bits: Words, modulus: int) -> Iterator[Words]:
    """Dependent sets that start with these, all of which have the same later columns."""
    yield _close_sets(sets, reduced, bits)
    if reduced.shape[1] > 1:
        for t in range(len(bits) - 1):
            later = _quotients(reduced[t], reduced[t + 1 :], modulus)
            yield from _from(sets | bits[t], later, bits[t + 1 :], modulus)


def _close_sets(sets: Words, reduced: Words, bits: Words) -> Words:
    """The sets (b,) with each column whose (columns, rows, b) has become zero added."""
    column, place = _zero(reduced, 1).nonzero()
    closed: Words = sets[place] | bits[column]
    return closed


def _quotients(row: Words, others: Words, modulus: int) -> Words:
    """The columns `others` (columns, rows, b) modulo `row` (rows, b): a row less."""
    q = np.uint64(modulus)
    if (row[0] == 0).any():
        row, others = _pivot_first(row, others)
    product: Words = row[0] * others[:, 1:]
    product += (q - row[1:]) * others[:, :1]
    product -= product // q * q  # half the time of a remainder
    return product


def _pivot_first(row: Words, others: Words) -> tuple[Words, Words]:
    """Both with rows exchanged so that `row` starts with a number other than zero if it has any."""
    row, others = row.copy(), others.copy()
    place = np.flatnonzero(row[0] == 0)
    source = (row[:, place] != 0).argmax(axis=0)
    for block in (row[None], others):
        block[:, 0, place], block[:, source, place] = (
            block[:, source, place],
            block[:, 0, place],
        )
    return row, others


def _mix_rows(matrix: Words, modulus: int) -> Words:
    """The rows in another basis, by a unit triangular matrix, so that hardly a leading number
    is zero by chance.
    """
    k = len(matrix)
    numbers = np.array(residues("basis of rows", k * k, 1 << 30), np.uint64).reshape(k, k)
    mixed, q = np.zeros_like(matrix), np.uint64(modulus)
    for column, row in zip(
        (np.triu(numbers, 1) + np.eye(k, dtype=np.uint64)).T, matrix, strict=True
    ):
        mixed = (mixed + column[:, None] * row) % q
    return mixed


def _join_words(parts: list[Words]) -> Words:
    return np.concatenate(parts) if parts else np.zeros(0, np.uint64)


def _find_other_circuits(sets: Words, flat: int, rank: int) -> Words:
    """The sets that have at most `rank` columns in the flat, so that their dependence is
    another one.
    """
    few: Marks = np.bitwise_count(sets & np.uint64(flat)) <= rank
    return sets[few]


def _span_circuit(matrix: Words, bits: Words, dependent: int, modulus: int) -> Flat:
    """The flat that a circuit in the dependent set spans."""
    within = (bits & np.uint64(dependent)) != 0
    chosen = [int(c) for c in np.flatnonzero(within)]
    table = _echelon(matrix, chosen, modulus)
    pivots = [int(np.flatnonzero(row)[0]) for row in table]
    free = next(j for j in range(len(chosen)) if j not in pivots)
    circuit = [chosen[p] for p, row in zip(pivots, table, strict=True) if row[free]]
    others = [c for c in range(len(bits)) if c not in circuit]
    rows = _echelon(matrix, circuit + others, modulus)[len(circuit) :]
    inside = np.array(circuit + others)[_zero(rows, 0)]
    return int(bits[inside].sum()), len(circuit)


def _zero(entries: Words, axis: int) -> Marks:
    """Where all entries along the axis are zero."""
    zero: Marks = ~np.any(entries, axis=axis)
    return zero


def _echelon(matrix: Words, columns: list[int], modulus: int) -> Words:
    """The non-zero rows of the reduced row echelon form of these columns."""
    entries = [int(e) for e in matrix[:, columns].ravel()]
    table, rank = nmod_mat(len(matrix), len(columns), entries, modulus).rref()
    return np.array([[int(e) for e in row] for row in table.tolist()[:rank]], np.uint64).reshape(
        rank, len(columns)
    )


MOST_ROWS = 64  # of a component: its sets are bits of one word
Rows = tuple[int, ...]


class SearchTooLargeError(Exception):
    """The component has more subsets than the limit allows."""


@dataclass(frozen=True, slots=True)
class Component:
    """A connected component: its rows, its rank, whether `flats` are the dual's, and these
    dependent flats (rows, rank).
    """

    rows: Rows
    rank: int
    dual: bool
    flats: tuple[tuple[Rows, int], ...]


@dataclass(frozen=True, slots=True)
class Matroid:
    """Matroid on rows 0..size-1; single independent rows (coloops) are components of rank 1,
    loops are in none.
    """

    size: int
    rank: int
    components: tuple[Component, ...]

    def dependences(self) -> Iterator[tuple[Rows, int]]:
        """Yield (rows, rank): "these rows have at most this rank"; with independence they fix
        the matroid.
        """
        ground = frozenset(range(self.size))
        inside = {i for c in self.components for i in c.rows}
        yield tuple(sorted(ground - inside)), 0
        for c in self.components:
            yield c.rows, c.rank
            yield tuple(sorted(inside - set(c.rows))), self.rank - c.rank
            for flat, rank in c.flats:
                rest = tuple(sorted(inside - set(flat)))
                yield (rest, self.rank - len(flat) + rank) if c.dual else (flat, rank)

    def relabelled(self, names: dict[int, int]) -> "Matroid":
        """The matroid on new row numbers; rows without a new number must be loops."""
        components = (
            Component(
                tuple(names[i] for i in c.rows),
                c.rank,
                c.dual,
                tuple((tuple(names[i] for i in flat), rank) for flat, rank in c.flats),
            )
            for c in self.components
        )
        return Matroid(len(names), self.rank, tuple(components))


def matroid(jacobian: nmod_mat, limit: int) -> Matroid:
    """Matroid of the rows of a matrix modulo a prime below 2^31.

    Raises SearchTooLargeError where a component has more than 64 rows, or more than `limit` subsets
    of its (dual) rank.
    """
    reduced, rank = jacobian.transpose().rref()
    size = jacobian.nrows()
    table = np.array(
        [[int(e) for e in row] for row in reduced.tolist()[:rank]], dtype=np.uint64
    ).reshape(rank, size)
    pivots = [int(np.flatnonzero(row)[0]) for row in table]
    parts = _components(table)
    modulus = int(jacobian.modulus())
    return Matroid(
        size, rank, tuple(_component(table, pivots, rows, modulus, limit) for rows in parts)
    )


def separating_rows(left: Matroid, right: Matroid) -> Rows:
    """The smallest of the recorded row sets whose rank differs between two different matroids of
    equal size and rank.

    One exists: were all recorded ranks of both sides equal in both, both would have the same
    dependent sets.
    """
    recorded = {rows for m in (left, right) for rows, _ in m.dependences()}
    return min(
        (r for r in recorded if rank_in(left, r) != rank_in(right, r)), key=lambda r: (len(r), r)
    )


def rank_in(m: Matroid, rows: Rows) -> int:
    """Rank of a set of rows, from the canonical form alone.

    >>> rank_in(Matroid(3, 2, (Component((0, 1, 2), 2, True, ()),)), (0, 1, 2))
    2
    """
    return sum(_rank_within(c, frozenset(rows) & frozenset(c.rows)) for c in m.components)


def _rank_within(c: Component, rows: frozenset[int]) -> int:
    """Greedy rank; in the dual, r(S) = |S| - r* + r*(E - S)."""
    if not c.dual:
        return _greedy(c, rows, c.rank)
    co_rank = len(c.rows) - c.rank
    return len(rows) - co_rank + _greedy(c, frozenset(c.rows) - rows, co_rank)


def _greedy(c: Component, rows: frozenset[int], bound: int) -> int:
    basis: frozenset[int] = frozenset()
    for row in sorted(rows):
        grown = basis | {row}
        if len(basis) < bound and all(
            len(grown.intersection(flat)) <= rank for flat, rank in c.flats
        ):
            basis = grown
    return len(basis)


def _components(table: np.ndarray) -> list[Rows]:
    """Connected components: rows joined where a basis row and another share a non-zero entry
    (fundamental circuits).
    """
    parts: list[set[int]] = []
    for basis_row in table:
        touched = {int(i) for i in np.flatnonzero(basis_row)}
        joined = [p for p in parts if p & touched]
        parts = [p for p in parts if not p & touched] + [touched.union(*joined)]
    return sorted(tuple(sorted(p)) for p in parts)


def _component(
    table: np.ndarray, pivots: list[int], rows: Rows, modulus: int, limit: int
) -> Component:
    inside = [i for i, pivot in enumerate(pivots) if pivot in rows]
    rank, columns = len(inside), list(rows)
    part = table[np.ix_(inside, columns)]
    dual = len(rows) - rank < rank
    if dual:
        part = _dual(part, [columns.index(pivots[i]) for i in inside], modulus)
    if len(rows) > MOST_ROWS or search_size(part.shape[0], len(rows)) > limit:
        raise SearchTooLargeError(f"{len(rows)} rows of rank {rank}")
    masks = dependent_flats(part, modulus) if len(part) else []
    flats = sorted(
        (tuple(row for b, row in enumerate(rows) if mask >> b & 1), flat_rank)
        for mask, flat_rank in masks
    )
    return Component(rows, rank, dual, tuple(flats))


def _dual(part: np.ndarray, pivots: list[int], modulus: int) -> np.ndarray:
    """[I A] on the pivot columns becomes [-A' I]."""
    others = [j for j in range(part.shape[1]) if j not in pivots]
    dual = np.zeros((len(others), part.shape[1]), dtype=np.uint64)
    dual[:, pivots] = (modulus - part[:, others].T) % modulus
    dual[np.arange(len(others)), others] = 1
    return dual
