"""The exhaustive summary of a model computed at one random point modulo a prime: the moment
invariants and their Jacobian, as numbers.

Degrees. Those of numerators and denominators in lowest terms are known exactly. A point is taken
only if the transfer functions have these degrees there too. So leading coefficients and resultants
are not zero at the point, hence not generically: the degrees of every sample are those of the
model, without any chance. A point at which they are smaller is special and drawn again; with 31
bits that happens with a probability of about 2^-20.

Several transfer functions with one parameter vector are summarised one after the other. Labels:
b0[1], .., a0[1], .., b0[2], .. with the number of the transfer function. Those of one machine share
poles, as a rule. So where two have denominators of one degree, the later one is given by what its
coefficients are more than the first one's, a0[2-1], ..: that is as exhaustive, and where both
denominators are the same these invariants are the constant 0, so that what is free is counted once.
Those that are zero have no coefficients: their degrees show it. So the degrees alone determine
which invariants there are: summaries of equal degrees are compared entry by entry. Condition 7
needs no more: whatever the summary is, of as many free entries as its rank generic values of all of
them are reached.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache

from flint import nmod_mat

from disting.algebra.certainty import PROOF_BITS, about, prime, residues
from disting.algebra.quotient import Quotient, coefficient_rows, matrix, series_rows
from disting.errors import InputError
from disting.model.protocol import ZERO, Columns, Degrees, Model

DRAWS = 20  # of a point
REMEMBERED = 64  # points: of a few verdicts, for a sketch and the profile that may follow it
Derivatives = tuple[int, list[int]]
"""Value and derivatives of an invariant."""


class Representation(StrEnum):
    """Representation of the input-output behaviour."""

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
class DrawnPoint:
    """A point of a model modulo a prime, and its transfer functions there in lowest terms, None for
    those that are zero.
    """

    model: Model
    point: tuple[int, ...]
    modulus: int
    quotients: tuple[Quotient | None, ...]


@lru_cache(maxsize=REMEMBERED)
def draw_point(model: Model, label: str, bits: int = PROOF_BITS) -> DrawnPoint:
    """The random point and the random prime that the label denotes for this model; special points
    are drawn again.
    """
    whole = about(label, *model.content)
    for again in (f"{whole}:{attempt}" for attempt in range(DRAWS)):
        modulus = prime(again, bits)
        point = residues(f"point:{again}", len(model.parameters), modulus)
        where = at_point(model, point, modulus)
        if tuple(map(_degrees, where.quotients)) == model.degrees:
            return where
    raise InputError(f"leading coefficients vanish at {DRAWS} random points")


def at_point(model: Model, point: Sequence[int], modulus: int) -> DrawnPoint:
    """The same at any point, in the order of the parameters."""
    return DrawnPoint(model, tuple(point), modulus, tuple(model.quotients(point, modulus)))


def samples(
    model: Model, representation: Representation, count: int, points: int, seed: str
) -> Iterator[Sample]:
    """Yield samples at independent points, each with its own large prime."""
    return (seen_at(draw_point(model, f"{seed}:{k}"), representation, count) for k in range(points))


def seen_at(where: DrawnPoint, representation: Representation, count: int) -> Sample:
    """Transfer-function coefficients (25), or G_0..G_count (30), with their derivatives by the
    parameters.

    A dead time adds itself as one more invariant: exp(-Td s) is no rational function, so both
    factors are determined.
    """
    rows, model = _rows(where, representation, count), where.model
    n = len(where.point)
    if model.dead_time and rows:
        rows = {name: (value, [*row, 0]) for name, (value, row) in rows.items()}
        rows["Td"] = (where.point[-1], [0] * (n - 1) + [1])
    values = tuple(value for value, _ in rows.values())
    return Sample(tuple(rows), values, tuple(tuple(r) for _, r in rows.values()), n, where.modulus)


def coefficient_columns(where: DrawnPoint) -> Columns:
    """Values and Jacobian columns of all coefficients at a point, each denominator monic."""
    rows = [row for q in where.quotients if q is not None for row in _terms(q).values()]
    columns = [tuple(row[j] for _, row in rows) for j in range(len(rows[0][1]) if rows else 0)]
    still = [(0,) * len(rows)] * (len(where.point) - len(columns))
    return tuple(value for value, _ in rows), columns + still


def label(name: str, at: int, shared: int | None) -> str:
    """That of an invariant of transfer function `at` of several, counted from 0.

    >>> label("a0", 1, 0), label("b0", 1, 0)
    ('a0[2-1]', 'b0[2]')
    """
    less = f"-{shared + 1}" if shared is not None and name[0] == "a" else ""
    return f"{name}[{at + 1}{less}]"


def shared_poles(degrees: Sequence[Degrees], at: int) -> int | None:
    """The first transfer function before this one whose denominator has the same degree."""
    same = (i for i in range(at) if degrees[i] != ZERO and degrees[i][1] == degrees[at][1])
    return next(same, None)


def _rows(where: DrawnPoint, representation: Representation, count: int) -> dict[str, Derivatives]:
    """The invariants of all transfer functions but the dead time."""
    rows: dict[str, Derivatives] = {}
    for i, q in enumerate(where.quotients):
        if q is None:
            continue
        shared = None
        if representation is Representation.MARKOV:
            named = _series(q, count)
        else:
            shared = shared_poles(where.model.degrees, i) if i else None
            first = None if shared is None else where.quotients[shared]
            named = _terms(q) if first is None else _less(_terms(q), _terms(first), where.modulus)
        if not where.model.is_numbered:
            return named
        rows |= {label(name, i, shared): row for name, row in named.items()}
    return rows


def _degrees(q: Quotient | None) -> Degrees:
    return ZERO if q is None else (q.num.degree(), q.den.degree())


def _terms(q: Quotient) -> dict[str, Derivatives]:
    """The coefficients b_i and a_i of (25)."""
    n, m = q.num.degree(), q.den.degree()
    sides = (q.num, q.num_derivatives, n + 1), (q.den, q.den_derivatives, m)
    rows = [zip(*coefficient_rows(*side), strict=True) for side in sides]
    return {
        f"{letter}{i}": row
        for letter, side in zip("ba", rows, strict=True)
        for i, row in enumerate(side)
    }


def _series(q: Quotient, count: int) -> dict[str, Derivatives]:
    rows = list(zip(*series_rows(q, count), strict=True))
    return {f"G{i}": row for i, row in enumerate(rows, count + 1 - len(rows))}


def _less(
    named: dict[str, Derivatives], first: dict[str, Derivatives], modulus: int
) -> dict[str, Derivatives]:
    """The denominator's coefficients less those of the first one."""
    return {
        name: _difference(row, first[name], modulus) if name[0] == "a" else row
        for name, row in named.items()
    }


def _difference(minuend: Derivatives, other: Derivatives, modulus: int) -> Derivatives:
    (value, row), (less, slopes) = minuend, other
    return (value - less) % modulus, [(x - y) % modulus for x, y in zip(row, slopes, strict=True)]
