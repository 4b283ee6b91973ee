"""The matroid of the rows of a generic Jacobian: condition 5's "largest sets of independent rows",
not listed.

Canonical form: drop loops, split into connected components, take of each the primal or the dual of
smaller rank k, and list the flats that its circuits of at most k elements span. They determine the
matroid: a set of k rows is a basis exactly if it has no more than rank(F) rows in any such flat F.
Equal matroids have equal forms, so the form is a key.

Certainty: independence is seen at one point and so proven. Each dependence used is a statement
"these rows have at most this rank"; all of them are looked at again at the independent points with
large primes (see `behaviour.profile`).
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from flint import nmod_mat

from disting.algebra.matroid_circuits import dependent_flats, search_size

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
    parts = _connected(table)
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


def _connected(table: np.ndarray) -> list[Rows]:
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
