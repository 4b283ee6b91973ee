"""The exhaustive summary of several transfer functions with one parameter vector: the coefficients
of all of them, one after the other.

Labels: b0[1], .., a0[1], .., b0[2], .. with the number of the transfer function. Those of one
machine share poles, as a rule. So where two have denominators of one degree, the later one is
given by what its coefficients are more than the first one's, a0[2-1], ..: that is as exhaustive,
and where both denominators are one and the same these invariants are the constant 0, so that what
is free is counted once. Those that are zero have no coefficients: their degrees (-1, 0) say so. So
the degrees alone say which invariants there are: summaries of equal degrees are compared entry by
entry.

Condition 7 needs no more: whatever the summary is, of as many free entries as its rank generic
values of all of them are reached.
"""

from collections.abc import Sequence

from disting.algebra.quotient import Quotient, series_rows
from disting.behaviour.sample import Representation, coefficients

ZERO = (-1, 0)  # degrees of a transfer function that is zero
Degrees = tuple[int, int]
Row = tuple[int, list[int]]
"""Value and derivatives of an invariant."""


def seen_degrees(quotients: Sequence[Quotient | None]) -> tuple[int, ...]:
    """Degrees of numerators and denominators, one pair after the other; None is zero."""
    pairs = (ZERO if q is None else (q.num.degree(), q.den.degree()) for q in quotients)
    return tuple(d for pair in pairs for d in pair)


def stacked_rows(
    quotients: Sequence[Quotient | None],
    degrees: Sequence[Degrees],
    representation: Representation,
    count: int,
) -> dict[str, Row]:
    """The invariants of all transfer functions at a point, None for those that are zero."""
    found: dict[str, Row] = {}
    for i, q in enumerate(quotients):
        if q is None:
            continue
        if representation is Representation.MARKOV:
            found |= {label(name, i, None): row for name, row in _series(q, count).items()}
            continue
        shared = shared_poles(degrees, i)
        first = None if shared is None else quotients[shared]
        named = _terms(q) if first is None else _less(_terms(q), _terms(first), q)
        found |= {label(name, i, shared): row for name, row in named.items()}
    return found


def shared_poles(degrees: Sequence[Degrees], at: int) -> int | None:
    """The first transfer function before this one whose denominator has the same degree."""
    same = (i for i in range(at) if degrees[i] != ZERO and degrees[i][1] == degrees[at][1])
    return next(same, None)


def label(name: str, at: int, shared: int | None) -> str:
    """That of an invariant of transfer function `at`, counted from 0.

    >>> label("a0", 1, 0), label("b0", 1, 0)
    ('a0[2-1]', 'b0[2]')
    """
    less = f"-{shared + 1}" if shared is not None and name[0] == "a" else ""
    return f"{name}[{at + 1}{less}]"


def _terms(q: Quotient) -> dict[str, Row]:
    labels, values, rows = coefficients(q)
    return dict(zip(labels, zip(values, rows, strict=True), strict=True))


def _series(q: Quotient, count: int) -> dict[str, Row]:
    values, rows = series_rows(q, count)
    return {f"G{i}": pair for i, pair in enumerate(zip(values, rows, strict=True))}


def _less(named: dict[str, Row], first: dict[str, Row], q: Quotient) -> dict[str, Row]:
    """The denominator's coefficients less those of the first one."""
    modulus = int(q.den.modulus())
    return {
        name: _difference((value, row), first[name], modulus) if name[0] == "a" else (value, row)
        for name, (value, row) in named.items()
    }


def _difference(one: Row, other: Row, modulus: int) -> Row:
    (value, row), (less, slopes) = one, other
    return (value - less) % modulus, [(x - y) % modulus for x, y in zip(row, slopes, strict=True)]
