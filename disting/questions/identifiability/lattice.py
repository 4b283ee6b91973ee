"""Lattices of integer vectors: kernels, and short bases."""

from collections.abc import Sequence

from flint import fmpz_mat


def short_vectors(vectors: Sequence[Sequence[int]]) -> list[list[int]]:
    """A reduced basis (A. Lenstra, H. Lenstra, L. Lovasz 1982) of the lattice of independent
    integer vectors.

    >>> short_vectors([[1, 0], [7, 1]])
    [[1, 0], [0, 1]]
    """
    return (
        [[int(x) for x in row] for row in fmpz_mat([list(v) for v in vectors]).lll().tolist()]
        if vectors
        else []
    )


def integer_kernel(rows: Sequence[Sequence[int]], columns: int) -> list[list[int]]:
    """A basis of the integer vectors v with row . v = 0 for all rows.

    >>> short_vectors(integer_kernel([[1, -1, 0]], 3))
    [[0, 0, 1], [1, 1, 0]]
    """
    # the transforming matrix of the Hermite form of the transpose has them below the rank: append
    # the identity
    size = len(rows)
    appended = [
        [row[j] for row in rows] + [int(i == j) for i in range(columns)] for j in range(columns)
    ]
    reduced = fmpz_mat(appended).hnf().tolist()
    return [[int(x) for x in row[size:]] for row in reduced if not any(row[:size])]
