"""An exhaustive summary seen at one random point modulo a prime: the moment invariants and their
Jacobian, as numbers.

Degrees. Those of numerator and denominator before anything but powers of s is cancelled are known
exactly (`powers`). A point is taken only if the transfer function in lowest terms has these
degrees there too. So leading coefficients and resultant are not zero at the point, hence not
generically: the degrees of every sample are those of the model, without any chance. A point at
which they are smaller is special and drawn again; with 31 bits that happens with a probability of
about 2^-20.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType

from flint import nmod_mat

from disting.algebra.quotient import (
    Quotient,
    coefficient_rows,
    constant,
    lowest_terms,
    matrix,
    series_rows,
    variable,
)
from disting.algebra.sampling import PROOF_BITS, about, prime, residues
from disting.behaviour.powers import degrees
from disting.behaviour.transfer import Arrangement, receptance, values_at
from disting.errors import InputError
from disting.model.structure import Structure

DRAWS = 20  # of a point


class Representation(StrEnum):
    """How the input-output behaviour is written down."""

    TF = "tf"
    MARKOV = "markov"


@dataclass(frozen=True, slots=True)
class Sample:
    """Moment invariants at a point: labels (b0.., a0.. or G0.., Td), values and Jacobian
    (invariants x parameters).
    """

    labels: tuple[str, ...]
    values: tuple[int, ...]
    rows: tuple[tuple[int, ...], ...]
    n_parameters: int
    modulus: int

    @property
    def jacobian(self) -> nmod_mat:
        """The Jacobian as a matrix modulo the prime."""
        return matrix(self.rows, self.n_parameters, self.modulus)

    def rank(self, chosen: tuple[int, ...]) -> int:
        """Rank of the rows with the given positions."""
        return int(matrix([self.rows[i] for i in chosen], self.n_parameters, self.modulus).rank())


@dataclass(frozen=True, slots=True)
class Drawn:
    """A random point of a structure modulo a random prime, and the transfer function there in
    lowest terms.
    """

    structure: Structure
    point: tuple[int, ...]
    modulus: int
    quotient: Quotient


def drawn(structure: Structure, label: str, bits: int = PROOF_BITS) -> Drawn:
    """The point and the prime that the label stands for with this structure; special points are
    drawn again.
    """
    whole, wanted = about(label, structure), degrees(structure)
    for again in (f"{whole}:{attempt}" for attempt in range(DRAWS)):
        modulus = prime(again, bits)
        point = residues(f"point:{again}", len(structure.parameters), modulus)
        q = quotient(structure, point, modulus)
        if (q.num.degree(), q.den.degree()) == wanted:
            return Drawn(structure, tuple(point), modulus, q)
    raise InputError("numerator and denominator have a common factor for all parameters")


def quotient(
    structure: Arrangement,
    point: Sequence[int],
    modulus: int,
    known: Mapping[str, int] = MappingProxyType({}),
) -> Quotient:
    """The transfer function (24), without dead time, in lowest terms at a point given in the
    order of the parameters; `known` are residues of what has a known size, by name.
    """
    values = values_at(structure, point, lambda number: constant(number, modulus))
    values |= {name: constant(number, modulus) for name, number in known.items()}
    rational = receptance(structure, values, variable(modulus), constant(1, modulus))
    order, names = structure.sensor_order, [p for p in structure.parameters if p != "Td"]
    return lowest_terms(
        rational.num.left_shift(order),
        rational.den,
        [rational.num_gradient[p].left_shift(order) for p in names],
        [rational.den_gradient[p] for p in names],
    )


def sample(
    structure: Structure,
    representation: Representation,
    count: int,
    point: Sequence[int],
    modulus: int,
) -> Sample:
    """Transfer-function coefficients (25), or G_0..G_count (30), with their derivatives by the
    parameters, at any point.
    """
    return seen_at(
        Drawn(structure, tuple(point), modulus, quotient(structure, point, modulus)),
        representation,
        count,
    )


def seen_at(where: Drawn, representation: Representation, count: int) -> Sample:
    """The same at a point that was drawn.

    A dead time adds itself as one more invariant: exp(-Td s) is no rational function, so both
    factors are determined.
    """
    if representation is Representation.TF:
        labels, values, rows = coefficients(where.quotient)
    else:
        labels = [f"G{i}" for i in range(count + 1)]
        values, rows = series_rows(where.quotient, count)
    n_parameters = len(where.structure.parameters)
    if where.structure.dead_time:
        labels, values = [*labels, "Td"], [*values, where.point[-1]]
        rows = [[*row, 0] for row in rows] + [[0] * (n_parameters - 1) + [1]]
    return Sample(
        tuple(labels), tuple(values), tuple(map(tuple, rows)), n_parameters, where.modulus
    )


def coefficients(q: Quotient) -> tuple[list[str], list[int], list[list[int]]]:
    """Labels, values and rows of derivatives of the coefficients b_i and a_i of (25)."""
    n, m = q.num.degree(), q.den.degree()
    num_values, num_rows = coefficient_rows(q.num, q.num_derivatives, n + 1)
    den_values, den_rows = coefficient_rows(q.den, q.den_derivatives, m)
    labels = [f"b{i}" for i in range(n + 1)] + [f"a{i}" for i in range(m)]
    return labels, num_values + den_values, num_rows + den_rows
