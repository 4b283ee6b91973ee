"""All dependences of at most k elements of a vector configuration of rank k, by vectorised elimination.

All independent prefixes of columns are extended level by level, grouped by their last column, so that one array operation
reduces a whole group modulo one more pivot; a column that has become zero closes a dependent set. What is kept of a circuit
(a smallest dependent set) is the flat that it spans: one flat of 13 columns and rank 4 stands for 1287 circuits. Cost: about
C(n, k) entries of 10 to 20 ns. Fraction-free steps need no inverse, and residues below 2^31 keep every product in 64 bits.
"""

from math import comb

import numpy as np
from numpy.typing import NDArray

Words = NDArray[np.uint64]


def dependent_flats(matrix: Words, modulus: int) -> list[tuple[int, int]]:
    """(bit mask of columns, rank) of the closures of all circuits of size <= k of a k x n matrix of rank k, sorted.

    A set S of columns is dependent exactly if |S & F| > rank(F) for one of these flats F, or if |S| > k.
    `modulus` < 2^31, n <= 64. What is found independent is so; a dependence may be by chance of the point.
    """
    k, n = matrix.shape
    flats: list[tuple[int, int]] = []
    groups: dict[int, tuple[Words, Words]] = {-1: (np.zeros(1, np.uint64), matrix[None].astype(np.uint64))}
    for size in range(k):
        closed, groups = _extended(groups, n, modulus)
        for flat in flats:
            closed = _unexplained(closed, *flat)
        while closed.size:
            flats.append((_closure(matrix, int(closed[0]), modulus), size))
            closed = _unexplained(closed, *flats[-1])
    return sorted(flats)


def search_size(k: int, n: int) -> int:
    """Number of k-subsets, the measure of the work of `dependent_flats`."""
    return comb(n, k)


def _extended(groups: dict[int, tuple[Words, Words]], n: int, modulus: int) -> tuple[Words, dict[int, tuple[Words, Words]]]:
    """One more column for every prefix: the sets that close, and the groups of the longer independent prefixes.

    A group of last column t holds the prefixes' masks (b,) and their reduced columns t+1.. (b, rows, n-t-1).
    """
    closed: list[Words] = []
    longer: dict[int, list[tuple[Words, Words]]] = {}
    for last, (masks, reduced) in groups.items():
        for column in range(n - last - 1):
            pivots = reduced[:, :, column]
            zero = ~pivots.any(axis=1)
            bit = np.uint64(1 << (last + 1 + column))
            closed.append(masks[zero] | bit)
            keep = ~zero
            if reduced.shape[1] > 1 and keep.any():
                child = _eliminated(reduced[keep][:, :, column:], modulus)
                longer.setdefault(last + 1 + column, []).append((masks[keep] | bit, child))
    merged = {t: (np.concatenate([m for m, _ in parts]), np.concatenate([r for _, r in parts])) for t, parts in longer.items()}
    return np.concatenate(closed) if closed else np.zeros(0, np.uint64), merged


def _eliminated(block: Words, modulus: int) -> Words:
    """Quotient of each (rows, columns) matrix of the block by its first column: one row and one column less."""
    block = _pivot_first(block)
    lead, below = block[:, :1, :1], block[:, 1:, :1]
    q = np.uint64(modulus)
    product = lead * block[:, 1:, 1:] + (q * q - below * block[:, :1, 1:])
    return np.remainder(product, q)


def _pivot_first(block: Words) -> Words:
    """Exchange rows so that the first entry of the first column is not zero."""
    wrong = np.flatnonzero(block[:, 0, 0] == 0)
    if wrong.size:
        source = (block[wrong, :, 0] != 0).argmax(axis=1)
        block = block.copy()
        block[wrong, 0], block[wrong, source] = block[wrong, source], block[wrong, 0]
    return block


def _unexplained(closed: Words, flat: int, rank: int) -> Words:
    """The sets that have at most `rank` columns in the flat, so that their dependence is another one."""
    few: NDArray[np.bool_] = np.bitwise_count(closed & np.uint64(flat)) <= rank
    return closed[few]


def _closure(matrix: Words, mask: int, modulus: int) -> int:
    """The columns in the span of the masked ones."""
    block = matrix[None].astype(np.uint64)
    order = sorted(range(matrix.shape[1]), key=lambda column: not mask >> column & 1)
    block = block[:, :, order]
    for _ in range(mask.bit_count()):
        block = _eliminated(block, modulus) if block[0, :, 0].any() else block[:, :, 1:]
    return mask | sum(
        1 << column for column, free in zip(order[mask.bit_count() :], block[0].any(axis=0), strict=True) if not free
    )
