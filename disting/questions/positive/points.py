"""Random positive rational models, and whether one of them has a positive equivalent in another
chain: proven or not known.
"""

from collections.abc import Iterable, Mapping
from fractions import Fraction
from math import frexp, ldexp

from flint import fmpq

from disting.algebra.certainty import residues
from disting.evidence.positive import Values
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import Answer, Status, Target, fraction, target
from disting.model.chain import Chain
from disting.model.row import Row
from disting.questions.positive.obstacles import Point, distances, receptances, rows
from disting.questions.positive.undamped_rows import word, words

Range = tuple[Fraction, Fraction]
LIKELY = (Fraction(1, 8), Fraction(8))  # where parameters without a range are drawn
_BITS = 25  # of a drawn value


def random_point(chain: Chain, label: str, ranges: Mapping[str, Range] | None = None) -> Point:
    """Independent parameters, log-uniform in their ranges (1/8 to 8 where none is given),
    determined by the label.
    """
    names = chain.parameters
    return {
        name: _drawn(*(ranges or {}).get(name, LIKELY), r / (1 << 40))
        for name, r in zip(names, residues(f"positivity:{label}", len(names), 1 << 40), strict=True)
    }


def spelled(point: Point) -> Values:
    """A point as text."""
    return tuple((name, str(value)) for name, value in point.items())


def read(values: Values) -> Point:
    """Inverse of `spelled`."""
    return {name: fraction(value) for name, value in values}


def equivalent(given: Chain, point: Point, other: Chain) -> Answer:
    """Whether `other` has positive parameters with the receptance of `given` at this positive
    point.

    Undamped, with one gap and decay: row by row, by words. Undamped, `other` without a gap and
    ports apart: by the word of the whole. Damped: NO where all solutions are listed and none is
    positive. UNKNOWN otherwise.
    """
    if other.damped:
        return _damped(target(given.structure, point), other)
    if given.gap == other.gap and distances(given) == distances(other):
        pairs = zip(rows(other), receptances(given, point), strict=True)
        return _all(_row(row, t) for row, t in pairs)
    if not other.gap and distances(other)[1]:
        return _row(rows(other)[-1], target(given.structure, point).folded(1))
    return Answer.UNKNOWN


def _row(row: Row, t: Target) -> Answer:
    """Whether a positive row of this type has this receptance."""
    if row.distance == 0:
        return Answer.YES  # it comes from a collocated row (Foster)
    if t.denominator.degree() != row.n_masses or t.numerator.degree() != row.numerator_degree:
        return Answer.UNKNOWN  # a special point: a pole and a zero coincide
    found, known = word(t), words(row.n_masses, row.a, row.b)
    if found is None:
        return Answer.UNKNOWN
    return (
        Answer.YES
        if found in known.lower
        else Answer.UNKNOWN
        if found in known.upper
        else Answer.NO
    )


def _damped(whole: Target, other: Chain) -> Answer:
    found = fibre(other, whole, confirm=False)
    listed = found.status is Status.COMPLETE and not found.tests.boundary
    none = listed and all(s.positive is Answer.NO for s in found.solutions)
    return Answer.NO if none or found.status is Status.EMPTY else Answer.UNKNOWN


def _all(answers: Iterable[Answer]) -> Answer:
    known = set(answers)
    return next((a for a in (Answer.NO, Answer.UNKNOWN) if a in known), Answer.YES)


def _drawn(low: Fraction, high: Fraction, share: float) -> fmpq:
    """low (high/low)^share, cut to few bits and kept inside; from a range that begins at 0 its
    upper three decades.
    """
    low = low or high / 1000
    mantissa, exponent = frexp(float(low) * (float(high) / float(low)) ** share)
    number, places = round(ldexp(mantissa, _BITS)), _BITS - exponent
    kept = fmpq(number, 1 << places) if places > 0 else fmpq(number << -places)
    bounds = (fmpq(end.numerator, end.denominator) for end in (low, high))
    return max(next(bounds), min(kept, next(bounds)))
