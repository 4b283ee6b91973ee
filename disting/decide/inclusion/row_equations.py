"""Polynomial equations between the transfer-function coefficients of a row of masses, found modulo
a random prime.

The pairs (N : D) of a row form an irreducible variety; scaling all elements, scaling time and the
common factor leave it as it is. So its equations are spanned by such of one degree in all
coefficients, one in those of N, and one weight (the sum of the powers of s): a block. With the
monomials of a block as columns and random models as rows, the kernel of the matrix is the space of
equations of this block modulo the prime, reduced from equations over the integers, if the matrix
has its generic rank: if one minor, a polynomial with integer coefficients in the parameters of all
these models, does not vanish. The probability that it does is bounded by
`algebra.certainty.safety`.
"""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations_with_replacement
from math import ceil, comb, log2

import numpy as np
from numpy.typing import NDArray

from disting.algebra.certainty import SEARCH_BITS, Size, prime, residues, safety
from disting.algebra.quotient import constant, matrix, variable
from disting.behaviour.chain_model import common_power, powers
from disting.behaviour.transfer import plain_receptance, values_at
from disting.model.row import Row

DEGREES = range(2, 9)
MONOMIALS = 120  # of a block, at most
ALL_MONOMIALS = 10_000  # of a degree, at most
MORE = 2  # models more than monomials
SEARCH = "row equations"
REMEMBERED = 128
Monomial = tuple[int, ...]  # positions of its coefficients, repeated
Block = tuple[Monomial, ...]


@dataclass(frozen=True, slots=True)
class RowEquation:
    """The sum of numbers times monomials in the coefficients of N, then D, vanishes modulo the
    prime.
    """

    monomials: Block
    numbers: tuple[int, ...]
    modulus: int

    def holds(self, coefficients: tuple[int, ...]) -> bool:
        """Return True if the equation vanishes there."""
        terms = zip(
            self.numbers,
            (_product(m, coefficients, self.modulus) for m in self.monomials),
            strict=True,
        )
        return sum(c * m for c, m in terms) % self.modulus == 0


def row_equation(row: Row, label: str) -> RowEquation | None:
    """An equation of the lowest degree that has one, modulo the prime of the label; None up to
    the largest block.
    """
    block, modulus = _block(row), prime(label)
    equation = (
        _kernel_vector(block, _models(row, len(block), label, modulus), modulus) if block else None
    )
    return None if equation is None else RowEquation(block, equation, modulus)


def label_of(row: Row) -> str:
    """Text of a row in the labels of random points. Such labels are stored with evidence, so this
    text stays as it is, whatever the names of the fields.
    """
    return (
        f"Row(n_masses={row.n_masses}, walled={row.grounded}, act={row.a}, meas={row.b},"
        f" damped={row.damped}, ground_dampers={row.ground_dampers})"
    )


def equation_safety(row: Row) -> int:
    """Largest b with P(what `row_equation` finds is no reduction of an equation over the integers)
    <= 2^-b.

    The block does not depend on the label. A coefficient of a row has degree N at most in its
    parameters, and its own coefficients sum to 6^N at most.
    """
    block, n = _block(row), row.n_masses
    if not block:
        return 0
    degree = len(block[0]) * n
    return safety(
        Size(len(block) * degree, len(block) * ceil(degree * log2(6) + log2(len(block)))), 1
    )


@lru_cache(maxsize=REMEMBERED)
def _block(row: Row) -> Block:
    """The first block with an equation, modulo one short prime; () if there is none."""
    weights = [
        (first, i)
        for first, p in zip((1, 0), powers(row.structure), strict=True)
        for i in sorted(p)
    ]
    modulus = prime(SEARCH, SEARCH_BITS)
    models = np.array(_models(row, MONOMIALS, SEARCH, modulus), dtype=np.uint64)
    degrees = (d for d in DEGREES if comb(len(weights) + d - 1, d) <= ALL_MONOMIALS)
    small = (
        block for degree in degrees for block in _blocks(weights, degree) if len(block) <= MONOMIALS
    )
    kernels = (
        (block, matrix(_values(block, models, modulus), len(block), modulus).nullspace())
        for block in small
    )
    return next((block for block, (_, nullity) in kernels if nullity), ())


def _values(block: Block, models: NDArray[np.uint64], modulus: int) -> list[list[int]]:
    """The monomials (columns) in a few models more than there are of them (rows), modulo a
    prime of SEARCH_BITS.
    """
    factors = models[: len(block) + MORE, np.array(block)]
    values = factors[:, :, 0]
    for k in range(1, factors.shape[2]):
        values = values * factors[:, :, k] % np.uint64(modulus)
    rows: list[list[int]] = values.tolist()
    return rows


def _blocks(weights: list[tuple[int, int]], degree: int) -> list[Block]:
    """The monomials of one degree, sorted into blocks."""
    blocks = defaultdict(list)
    for monomial in combinations_with_replacement(range(len(weights)), degree):
        blocks[sum(weights[i][0] for i in monomial), sum(weights[i][1] for i in monomial)].append(
            monomial
        )
    return [tuple(block) for _, block in sorted(blocks.items())]


def _kernel_vector(
    block: Block, models: list[tuple[int, ...]], modulus: int
) -> tuple[int, ...] | None:
    """Numbers with which the monomials sum to zero in all models; None if there are none."""
    rows = [[_product(m, model, modulus) for m in block] for model in models]
    basis, nullity = matrix(rows, len(block), modulus).nullspace()
    return tuple(int(basis[i, 0]) for i in range(len(block))) if nullity else None


def _models(row: Row, count: int, label: str, modulus: int) -> list[tuple[int, ...]]:
    """More random models than there are monomials."""
    return [_model(row, f"{label}:{k}", modulus) for k in range(count + MORE)]


def _model(row: Row, label: str, modulus: int) -> tuple[int, ...]:
    """The coefficients of a random model, those of N first."""
    return model_at(
        row, residues(f"{label}:{label_of(row)}", len(row.structure.parameters), modulus), modulus
    )


def model_at(row: Row, point: Sequence[int], modulus: int) -> tuple[int, ...]:
    """The coefficients of N, then D, at a point modulo a prime: polynomials in the parameters,
    also where the lowest vanish.
    """
    values = values_at(row.structure, point, lambda number: constant(number, modulus))
    found_num, found_den = plain_receptance(
        row.structure, values, variable(modulus), constant(1, modulus)
    )
    shift = common_power(row.structure)
    num, den = powers(row.structure)
    return (
        *(int(found_num[i + shift]) for i in sorted(num)),
        *(int(found_den[i + shift]) for i in sorted(den)),
    )


def _product(monomial: Monomial, coefficients: tuple[int, ...], modulus: int) -> int:
    product = 1
    for i in monomial:
        product = product * coefficients[i] % modulus
    return product
