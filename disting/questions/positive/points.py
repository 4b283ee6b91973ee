"""Points of one model that show whether it has positive equivalents in another one: random ones,
and witnesses for an open part of a box.

The question. B is a box of positive parameters of `chain`: a closed interval a parameter, or all
positive numbers. L is its affine span: a parameter whose interval is one value is a constant there.
C is such a box of `other`. E holds the points of B that have an equivalent in C. E is
semi-algebraic (Tarski, Seidenberg), so but for a proper algebraic subset of L the box B consists of
finitely many open pieces, each inside E or outside of it. "Sometimes" means that there are pieces
of both kinds. A single point is no proof of a piece: it may be a special one. The two statements
below make it one.

A piece with equivalents (exact). At p in B, let f be a map that takes the models of `chain` near p
to equivalent ones of `other`, continuous near p: a renaming, duality, or a listed solution of a
chain without tests (see `synthesis.theorems`). The last one is continuous, for it is computed
from simple roots by operations whose balls leave out every zero divisor, for fixed free choices;
and it stays real, for near p its conjugate belongs to the balls of the conjugate, which meet no
other one. If each element of f(p) lies strictly inside its interval of C, the same holds near p.
An element on the edge is allowed where f is a renaming and the whole interval of the renamed
parameter lies inside: then it never leaves.

A piece without equivalents (but for a probability). Let n be the number of parameters of `other`,
D = max(3 N_B + 2, n + 1), and X the set of all (p, q), p in L, of equal transfer functions with
all elements of q non-zero, complex ones included: n + 1 combinations of its equations, of degree D
at most, have all components of X that dominate L among theirs (putting constants for some of the p
raises no degree), so these have a degree of D^(n+1) at most in all (Bezout). Off a hypersurface S
of L, of no larger degree, their projection to L is proper, and a component with infinite fibres
has one over each point (cut it by planes until its fibres are finite; Z. Jelonek, Testing sets for
properness of polynomial mappings, Math. Ann. 315, 1999). Let p lie off S, and let the list of its
solutions be complete and finite, so that no component has infinite fibres, and let each of them be
not real or have an element that is not in C. Then so it is near p, but for the images of the
components that do not dominate L, which lie in a proper algebraic subset. For otherwise there were
points p_1, p_2, .. with limit p and solutions q_1, q_2, .. over them, in C and on dominating
components. As the projection is proper, some of these converge to a q over p. Its elements are
non-zero, so positive, and lie in the closed intervals: q is a solution over p in C, and there is
none.
    p is drawn at random, each coordinate but the constants one of 2^bits values of an interval
    inside the range: it lies on S
with a probability of at most D^(n+1)/2^bits (Schwartz, Zippel). Small numbers may search for a
place to draw it, never testify.

Words (see `words`) are exact without that: poles and zeros that balls show to be real, simple and
apart, or one that balls show not to be so, stay so near p, and a chain has the degrees of its
generic models at p or the word is not used.
"""

from collections.abc import Iterable, Mapping
from fractions import Fraction
from math import ceil, frexp, ldexp, log2

from flint import fmpq

from disting.algebra.certainty import LEAST_SAFETY, residues
from disting.evidence.kind import PointText
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import Point, Status, Target, fraction, target
from disting.model.chain import Chain
from disting.model.question import Answer
from disting.model.row import Row
from disting.questions.positive.obstacles import distances, receptances, rows
from disting.questions.positive.undamped_rows import word, words

Range = tuple[Fraction, Fraction]
LIKELY = (Fraction(1, 8), Fraction(8))  # where parameters without a range are drawn
_BITS = 25  # of a drawn value
DRAWS = 3  # of each kind of witness, at most
_NEAR = fmpq(1, 1024)  # relative distance from the place that the search found


def random_point(chain: Chain, label: str, ranges: Mapping[str, Range] | None = None) -> Point:
    """Independent parameters, log-uniform in their ranges (1/8 to 8 where none is given),
    determined by the label.
    """
    names = chain.parameters
    return {
        name: _draw_between(*(ranges or {}).get(name, LIKELY), r / (1 << 40))
        for name, r in zip(names, residues(f"positivity:{label}", len(names), 1 << 40), strict=True)
    }


def spell(point: Point) -> PointText:
    """A point as text."""
    return tuple((name, str(value)) for name, value in point.items())


def read(values: PointText) -> Point:
    """Inverse of `spell`."""
    return {name: fraction(value) for name, value in values}


def equivalent(chain: Chain, point: Point, other: Chain) -> Answer:
    """Decide whether `other` has positive parameters with the receptance of `chain` at this
    positive point.

    Undamped, with one gap and decay: row by row, by words. Undamped, `other` without a gap and
    ports apart: by the word of the whole. Damped: NO where all solutions are listed and none is
    positive. UNKNOWN otherwise.
    """
    if other.damped:
        return _decide_damped(target(chain.structure, point), other)
    if chain.gap == other.gap and distances(chain) == distances(other):
        pairs = zip(rows(other), receptances(chain, point), strict=True)
        return _all(_row(row, t) for row, t in pairs)
    if not other.gap and distances(other)[1]:
        return _row(rows(other)[-1], target(chain.structure, point).folded(1))
    return Answer.UNKNOWN


def _row(row: Row, t: Target) -> Answer:
    """Decide whether a positive row of this type has this receptance."""
    if row.distance == 0:
        return Answer.YES  # it comes from a collocated row (Foster)
    if t.denominator.degree() != row.n_masses or t.numerator.degree() != row.numerator_degree:
        return Answer.UNKNOWN  # a special point: a pole and a zero coincide
    signs, possible = word(t), words(row.n_masses, row.a, row.b)
    if signs is None:
        return Answer.UNKNOWN
    return (
        Answer.YES
        if signs in possible.lower
        else Answer.UNKNOWN
        if signs in possible.upper
        else Answer.NO
    )


def _decide_damped(whole: Target, other: Chain) -> Answer:
    whole_fibre = fibre(other, whole, confirm=False)
    listed = whole_fibre.status is Status.COMPLETE and not whole_fibre.tests.boundary
    none = listed and all(s.positive is Answer.NO for s in whole_fibre.solutions)
    return Answer.NO if none or whole_fibre.status is Status.EMPTY else Answer.UNKNOWN


def _all(answers: Iterable[Answer]) -> Answer:
    answered = set(answers)
    return next((a for a in (Answer.NO, Answer.UNKNOWN) if a in answered), Answer.YES)


def _draw_between(low: Fraction, high: Fraction, share: float) -> fmpq:
    """low (high/low)^share, cut to few bits and kept inside; from a range that begins at 0 its
    upper three decades.
    """
    low = low or high / 1000
    mantissa, exponent = frexp(float(low) * (float(high) / float(low)) ** share)
    number, places = round(ldexp(mantissa, _BITS)), _BITS - exponent
    kept = fmpq(number, 1 << places) if places > 0 else fmpq(number << -places)
    bounds = (fmpq(end.numerator, end.denominator) for end in (low, high))
    return max(next(bounds), min(kept, next(bounds)))


def bits(other: Chain) -> int:
    """Bits a coordinate, so that the bound of a piece without equivalents in `other` is
    2^-LEAST_SAFETY over all draws.
    """
    n = len(other.parameters)
    return LEAST_SAFETY + ceil((n + 1) * log2(max(3 * other.n_masses + 2, n + 1)) + log2(DRAWS))


def drawn_near(place: Point, ranges: Mapping[str, Range], length: int, label: str) -> Point:
    """A random point with 2^length values a coordinate near `place`, strictly inside the ranges
    that have an inside.
    """
    numbers = residues(f"witness:{label}", len(place), 1 << length)
    return {
        name: _between(value, ranges.get(name), fmpq(number, 1 << length))
        for (name, value), number in zip(place.items(), numbers, strict=True)
    }


def is_long(point: Point, ranges: Mapping[str, Range]) -> bool:
    """Return True if every coordinate that a range leaves free has LEAST_SAFETY bits: a shorter one
    was not drawn for a proof.
    """
    free = (
        value
        for name, value in point.items()
        if name not in ranges or ranges[name][0] < ranges[name][1]
    )
    return all(max(abs(int(v.p)), int(v.q)).bit_length() >= LEAST_SAFETY for v in free)


def _between(value: fmpq, bounds: Range | None, share: fmpq) -> fmpq:
    low, high = value * (1 - _NEAR), value * (1 + _NEAR)
    if bounds is not None:
        least, most = (fmpq(b.numerator, b.denominator) for b in bounds)
        low, high = max(low, least), min(high, most)
    return low + (high - low) * share
