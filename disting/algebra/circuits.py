"""All dependences of at most k elements of a vector configuration of rank k, by vectorised
elimination.

All independent prefixes of columns are extended level by level, grouped by their last column, so
that one array operation takes the quotients of many prefixes by each of their later columns; a
column that has become zero closes a dependent set. What is kept of a circuit (a smallest dependent
set) is the flat that it spans: one flat of 13 columns and rank 4 stands for 1287 circuits.
Fraction-free steps need no inverse, and residues below 2^31 keep every product in 64 bits.
"""

from collections.abc import Iterator
from functools import cache
from math import comb

import numpy as np
from numpy.typing import NDArray

from disting.algebra.sampling import residues

Words = NDArray[np.uint64]
Marks = NDArray[np.bool_]
Group = tuple[Words, Words]
CHUNK = 1 << 15  # products at once: few enough to stay in the processor's cache


def dependent_flats(matrix: Words, modulus: int) -> list[tuple[int, int]]:
    """(bit mask of columns, rank) of the closures of all circuits of size <= k of a k x n matrix
    of rank k, sorted.

    A set S of columns is dependent exactly if |S & F| > rank(F) for one of these flats F, or if
    |S| > k. `modulus` < 2^31, n <= 64. What is found independent is so; a dependence may be by
    chance of the point.
    """
    flats: list[tuple[int, int]] = []
    for size, closed in enumerate(_closed_sets(_mixed(matrix.astype(np.uint64), modulus), modulus)):
        for flat in flats:
            closed = _unexplained(closed, *flat)
        while closed.size:
            flats.append((_closure(matrix, int(closed[0]), modulus), size))
            closed = _unexplained(closed, *flats[-1])
    return sorted(flats)


def search_size(k: int, n: int) -> int:
    """Number of k-subsets, the measure of the work of `dependent_flats`."""
    return comb(n, k)


def _closed_sets(matrix: Words, modulus: int) -> Iterator[Words]:
    """Yield for size = 1..k the dependent sets of this size whose elements but the last are
    independent, as bit masks.

    A group of last column t holds the prefixes' masks (b,) and their reduced columns t+1.. (n-t-1,
    rows, b).
    """
    k, n = matrix.shape
    bits = np.uint64(1) << np.arange(n, dtype=np.uint64)
    groups: dict[int, Group] = {-1: (np.zeros(1, np.uint64), matrix.T[:, :, None])}
    for rows in range(k, 0, -1):
        yield _joined(
            [
                _where(masks, bits[t + 1 :], _zero_columns(reduced))
                for t, (masks, reduced) in groups.items()
            ]
        )
        if rows == 2:
            yield _joined(
                [
                    ends
                    for t, group in groups.items()
                    for ends in _pairs(*group, bits[t + 1 :], modulus)
                ]
            )
            return
        groups = _extended(groups, bits, modulus)


def _pairs(masks: Words, reduced: Words, bits: Words, modulus: int) -> Iterator[Words]:
    """Sets that close with two more columns, where two rows are left: the last level, without
    keeping the one before.
    """
    left, right = _ordered_pairs(len(bits))
    for part, block, zero in _chunks(reduced):
        yield _where(
            masks[part],
            bits[left] | bits[right],
            (_quotients(block, zero, modulus)[:, 0] == 0) & ~zero[left],
        )


def _extended(groups: dict[int, Group], bits: Words, modulus: int) -> dict[int, Group]:
    """The groups of the independent prefixes with one more column."""
    longer: dict[int, list[Group]] = {}
    for last, (masks, reduced) in groups.items():
        for part, block, zero in _chunks(reduced):
            quotients, stop = _quotients(block, zero, modulus), 0
            for t in range(last + 1, len(bits) - 1):
                start, stop = stop, stop + len(bits) - t - 1
                keep, grown, child = (
                    ~zero[t - last - 1],
                    masks[part] | bits[t],
                    quotients[start:stop],
                )
                longer.setdefault(t, []).append(
                    (grown, child) if keep.all() else (grown[keep], child[:, :, keep])
                )
    return {
        t: (_joined([m for m, _ in parts]), np.concatenate([r for _, r in parts], axis=2))
        for t, parts in longer.items()
    }


def _chunks(reduced: Words) -> Iterator[tuple[slice, Words, Marks]]:
    """Parts of a group, and which of their columns are zero (columns, b)."""
    columns, rows, b = reduced.shape
    step = max(1, CHUNK // (rows * columns * columns))
    for part in (slice(start, start + step) for start in range(0, b, step)):
        block = reduced[:, :, part]
        yield part, block, _zero_columns(block)


def _zero_columns(reduced: Words) -> Marks:
    """Which columns of which prefix are zero: (columns, b)."""
    zero: Marks = ~np.any(reduced, axis=1)
    return zero


def _quotients(block: Words, zero: Marks, modulus: int) -> Words:
    """For each column the later columns modulo it, one row less: (pairs of columns, rows - 1,
    b).
    """
    left, right = _ordered_pairs(len(block))
    one, other, q = block[left], block[right], np.uint64(modulus)
    if ((block[:, 0] == 0) & ~zero).any():
        _pivot_first(one, other)
    product = one[:, :1] * other[:, 1:]
    product += q * q - one[:, 1:] * other[:, :1]
    product -= product // q * q  # half the time of a remainder
    return product


@cache
def _ordered_pairs(n: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    left, right = np.triu_indices(n, 1)
    return left, right


def _pivot_first(one: Words, other: Words) -> None:
    """Exchange rows in both, in place, so that `one` (pairs, rows, b) starts with a number
    other than zero if it has any.
    """
    pair, prefix = (one[:, 0] == 0).nonzero()
    source = (one[pair, :, prefix] != 0).argmax(axis=1)
    for block in (one, other):
        block[pair, 0, prefix], block[pair, source, prefix] = (
            block[pair, source, prefix],
            block[pair, 0, prefix],
        )


def _mixed(matrix: Words, modulus: int) -> Words:
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


def _joined(parts: list[Words]) -> Words:
    return np.concatenate(parts) if parts else np.zeros(0, np.uint64)


def _where(masks: Words, bits: Words, dependent: Marks) -> Words:
    """The prefixes' masks (b,) with the bits (columns,) added where (columns, b) says so."""
    column, prefix = dependent.nonzero()
    return masks[prefix] | bits[column]


def _unexplained(closed: Words, flat: int, rank: int) -> Words:
    """The sets that have at most `rank` columns in the flat, so that their dependence is
    another one.
    """
    few: Marks = np.bitwise_count(closed & np.uint64(flat)) <= rank
    return closed[few]


def _closure(matrix: Words, mask: int, modulus: int) -> int:
    """The columns in the span of the masked ones."""
    rows, n = [[int(e) for e in row] for row in matrix], matrix.shape[1]
    for c in (c for c in range(n) if mask >> c & 1):
        pivot = next((row for row in rows if row[c]), None)
        if pivot is not None:
            rest = [row for row in rows if row is not pivot]
            rows = [
                [(pivot[c] * a - row[c] * b) % modulus for a, b in zip(row, pivot, strict=True)]
                for row in rest
            ]
    return sum(1 << c for c in range(n) if not any(row[c] for row in rows))
