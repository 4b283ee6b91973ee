"""Points that testify: what one generic point of a box proves about an open part of it.

The question. B is a box of positive parameters of `given`: a closed interval a parameter, or all
positive numbers. L is its affine span: a parameter whose interval is one value is a constant
there. C is such a box of `other`. E holds the points of B that have an equivalent in C. E is
semi-algebraic (Tarski, Seidenberg), so but for a proper algebraic subset of L the box B consists
of finitely many open pieces, each inside E or outside of it. "Sometimes" says that there are
pieces of both kinds. A single point is no proof of a piece: it may be a special one. The two
statements below make it one.

A piece with equivalents (exact). At p in B, let f be a map that takes the models of `given` near p
to equivalent ones of `other`, continuous near p: a renaming, duality, or a listed solution of a
chain without tests (see `synthesis.construction`). The last one is continuous, for it is computed
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
generic models at p or the word is not asked.
"""

from collections.abc import Mapping
from math import ceil, log2

from flint import fmpq

from disting.algebra.certainty import LEAST_SAFETY, residues
from disting.model.chain import Chain
from disting.questions.positive.obstacles import Point
from disting.questions.positive.points import Range

DRAWS = 3  # of each kind of witness, at most
_NEAR = fmpq(1, 1024)  # relative distance from the place that the search found


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
    """Whether every coordinate that a range leaves free has LEAST_SAFETY bits: a shorter one
    was not drawn to testify.
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
