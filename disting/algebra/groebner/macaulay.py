"""Contradictions by plain Macaulay matrices: slow, simple, and independent of the search for
Gröbner bases.

The span of the generators of degree up to D is multiplied by the variables, as long as a product
of degree up to D is new, elements whose degree fell included. If 1 lies in the span, there are no
common zeros.
"""

from collections.abc import Iterable, Mapping

from disting.algebra.groebner.modular import matrix as modular_matrix

Polynomial = Mapping[tuple[int, ...], int]


def reaches_one(generators: Iterable[Polynomial], size: int, modulus: int, degree: int) -> bool:
    """Whether 1 is found in that degree.

    >>> reaches_one([{(1, 1): 1, (0, 0): -1}, {(1, 0): 1}], 2, 101, 2)
    True
    """
    rows = [dict(g) for g in generators if max(map(sum, g)) <= degree]
    multiplied: set[tuple[int, ...]] = set()
    while True:
        rows = _echelon(rows, modulus)
        fresh = [row for row in rows if _lead(row) not in multiplied and sum(_lead(row)) < degree]
        if any(not any(_lead(row)) for row in rows):
            return True
        if not fresh:
            return False
        multiplied |= {_lead(row) for row in fresh}
        rows += [{_times(e, i): c for e, c in row.items()} for row in fresh for i in range(size)]


def _lead(row: Polynomial) -> tuple[int, ...]:
    return max(row, key=_rank)


def _rank(exponents: tuple[int, ...]) -> tuple[int, tuple[int, ...]]:
    return sum(exponents), exponents


def _times(exponents: tuple[int, ...], at: int) -> tuple[int, ...]:
    return tuple(e + (i == at) for i, e in enumerate(exponents))


def _echelon(
    rows: list[dict[tuple[int, ...], int]], modulus: int
) -> list[dict[tuple[int, ...], int]]:
    columns = sorted({e for row in rows for e in row}, key=_rank, reverse=True)
    table = [row.get(e, 0) % modulus for row in rows for e in columns]
    matrix, rank = modular_matrix(len(rows), len(columns), table, modulus).rref()
    return [
        {e: int(matrix[i, j]) for j, e in enumerate(columns) if int(matrix[i, j])}
        for i in range(rank)
    ]
