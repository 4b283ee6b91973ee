"""Two chains with one gap whose rows at both sides are the same or can have any receptance: they
are the same.

H = R + F, R the receptance of the grounded, F of the free row, of independent parameters; a lag
or a sensor's power of s is a factor that both chains share. A row is full if its rank equals the
number of its coefficients that are not constant (those of the monic denominator and of the
numerator, see `system`). Then the closure of its image is the space of all functions with these
constants. If each row of one chain equals that of the other, or both are full with equal
constants, the closures of {R} and {F} are equal on both sides, and so are those of {R + F}: the
sum is a continuous map wherever no pole is infinite, and generic sums have equal degrees.

The rank at one point modulo a prime is at most the generic rank, which is at most the number of
coefficients that are not constant: where they are equal, fullness is proven, nothing is left to
chance.
"""

from dataclasses import dataclass
from functools import cache

from disting.evidence.ideals import SAME, FullRows
from disting.fibres.ideals.fibre_ideal import generic_rank
from disting.fibres.ideals.system import Terms, receptance_map
from disting.model.chain import Structure
from disting.model.row import Row, rows_of

LABEL = "full rows"


def same_by_full_rows(a: Structure, b: Structure, label: str = LABEL) -> FullRows | None:
    """The proof that two structures have equal closures row by row; None if there is none.
    `label` draws the points.

    >>> from disting.model.chain import Chain
    >>> chains = (Chain(3, 2, m, 3, m, 3, damped=True, ground_dampers=(2,)) for m in (1, 2))
    >>> same_by_full_rows(*(c.structure for c in chains))
    FullRows(free=(7, 0))
    """
    if not _comparable(a, b):
        return None
    pairs = zip(rows_of(a), rows_of(b), strict=True)
    shared = [_compare_rows(row, other, label) for row, other in pairs]
    free = tuple(n for n in shared if n is not None)
    return FullRows(free) if len(free) == len(shared) and any(free) else None


def same_receptances(row: Row, other: Row) -> bool:
    """Return True if the receptances of two rows have equal closures, for one of the two
    reasons.
    """
    return _compare_rows(row.canonical, other.canonical, LABEL) is not None


def _comparable(a: Structure, b: Structure) -> bool:
    """Return True if both have a gap at the same place, the same sensor quantity, and the same
    further factors.
    """
    kinds = [(s.row_ends, s.sensor_order, s.lag, s.dead_time) for s in (a, b)]
    return kinds[0] == kinds[1] and len(a.row_ends) == 2


def _compare_rows(row: Row, other: Row, label: str) -> int | None:
    """SAME for equal rows, the number of coefficients of full ones of one form, None for
    others.
    """
    if row == other:
        return SAME
    mine, theirs = (_full(r, label) for r in (row, other))
    return len(mine.free) if mine is not None and mine == theirs else None


@dataclass(frozen=True, slots=True)
class Form:
    """Numbers of numerator and of all coefficients, which of them vary, and those that do not."""

    sizes: tuple[int, int]
    free: tuple[int, ...]
    constants: tuple[Terms, ...]


@cache
def _full(row: Row, label: str) -> Form | None:
    """The form of a row's coefficients if it is full."""
    entries = receptance_map(row)
    varies = [any(any(exponents) for exponents, _ in terms) for terms in entries.coordinates]
    free = tuple(i for i, v in enumerate(varies) if v)
    constants = tuple(terms for terms, v in zip(entries.coordinates, varies, strict=True) if not v)
    form = Form((len(entries.numerator), len(entries.coordinates)), free, constants)
    return form if generic_rank(entries, label) == len(free) else None
