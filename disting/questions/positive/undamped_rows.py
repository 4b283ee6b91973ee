"""Undamped rows with force and sensor apart: which receptances belong to positive masses and
springs. A complete answer.

A row of n masses, its left end at the wall or free, its right end free, ports a < b, d = b - a, x
= s^2:

    H = N/D = A k_a .. k_(b-1) B / D,  A = theta_(a-1),  B = phi_(b+1)  (leading, trailing minors)

Let D have n simple real zeros -l_0 > .. > -l_(n-1), l_0 >= 0, none of them a zero of N. The *word*
of H gives how many zeros of N lie in each of the n - 1 gaps between neighbouring poles, from the
slowest on; h_j = j - (number of zeros before l_j).

Necessary. The zeros of the driving-point receptances H_aa, H_bb separate the poles strictly, and
those of A and of B are among them: at most one zero of A and one of B in each gap, so at most two,
both kinds together where there are two. Mode j has j sign changes (F. Gantmacher, M. Krein,
Oscillation Matrices, 1950), of which as many lie left of a as A has zeros before l_j and as many
right of b as B has (Sturm's theorem), so that 0 <= h_j <= d:

    word in {0,1,2}^(n-1),  sum = n - 1 - d,  0 <= h_j <= d,
    number of twos <= min(a - 1, n - b)  (upper)

Sufficient. Share out the poles: a to Theta, n - b + 1 to Phi, one to each of the d - 1 masses
between the ports, such that the zeros of A separate those of Theta and the zeros of B those of
Phi. Take rows with the receptances A/Theta (nodes 1 to a) and B/Phi (nodes b to n, hung up on
spring b - 1), positive by Cauer's continued fraction, the masses between hung up on one spring
each, and multiply the i-th of these pieces by e^i. A and B do not depend on e, and M^-1 K is
polynomial in e, so

    D(e) = Theta w_1 .. w_(d-1) Phi + O(e)

where the factors are coprime: by the implicit function theorem they can be changed by O(e) such
that D(e) is the given D, which leaves them real and separated for a small e > 0. A factor of all
masses and springs sets the gain. (Free left end: the piece with the pole 0 takes the place of the
heaviest, the others hang on it to the left and to the right.)  (lower)

Reversal at the wall. J = M^(-1/2) K M^(-1/2) is a positive definite Jacobi matrix with negative
off-diagonal entries, and each such J belongs to one row but for a factor: masses s_i^2, s = J^(-1)
e_1 > 0 (J is a nonsingular irreducible M-matrix). J read backwards is one too, so ports a, b and n
+ 1 - b, n + 1 - a have the same receptances, as by mirroring a row free at both ends.

So whether H is positive depends on its word alone wherever lower and upper agree. They do for d =
1: h_j is 0 or 1 there; with h_j = 0 the one zero in a gap belongs to whichever of Theta and Phi is
open, with h_j = 1 both are open; so each one can be A's or B's as the numbers demand. They also do
for all n <= 6 (computed, see the tests).

Two rows with the same n and d always have a word in common for certain: d gaps without a zero,
then one zero a gap. Give the first pole to Theta, the next d - 1 to the masses between, pole d + 1
to Phi; then both are open before each zero, which may be A's or B's, and the next pole goes to the
one that it closed. So where a word is lacking, the answer is "some", not "none".
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, cmp_to_key
from itertools import pairwise
from typing import cast

from flint import acb, arb, ctx

from disting.fibres.synthesis.task import Target

Word = tuple[int, ...]
PRECISIONS = (128, 512, 2048)  # of roots that are put in order


@dataclass(frozen=True, slots=True)
class Words:
    """Words that some positive row of this type has for certain (`lower`), and those that none
    is known not to have.
    """

    lower: frozenset[Word]
    upper: frozenset[Word]


@dataclass(frozen=True, slots=True)
class _State:
    """Halfway: whether Theta and Phi have a pole more than A and B have zeros; free masses and
    zeros of A that are left.
    """

    theta: int
    phi: int
    between: int
    zeros_a: int
    zeros_b: int


def words(nodes: int, a: int, b: int) -> Words:
    """Words of rows with ports a < b, at the wall or free.

    >>> sorted(words(4, 2, 3).lower - words(4, 1, 2).lower)
    [(0, 2, 0)]
    """
    return _words(nodes, b - a, min(a - 1, nodes - b))


def word(t: Target) -> Word | None:
    """The word of a receptance in x with two poles at least; None where two of the poles and zeros
    coincide.

    () if no positive row has it: a gain that is not positive, a pole or zero that is not real, a
    zero outside the poles.
    """
    if not t.numerator[t.numerator.degree()] > 0:
        return ()
    for bits in PRECISIONS:
        with ctx.workprec(bits):
            counts = _count_word(t)
        if counts is not None:
            return counts
    return None


@cache
def _words(nodes: int, distance: int, least: int) -> Words:
    upper = tuple(_upper(nodes - 1, distance, least, 0))
    zeros = nodes - 1 - distance
    start = _State(0, 0, distance - 1, least, zeros - least)
    return Words(frozenset(w for w in upper if _sharable(w, frozenset((start,)))), frozenset(upper))


def _upper(gaps: int, distance: int, twos: int, height: int) -> Iterator[Word]:
    """Words with heights between 0 and `distance`, from this height to `distance`."""
    if gaps == 0:
        if height == distance:
            yield ()
        return
    for zeros in range(3 if twos else 2):
        after = height + 1 - zeros
        if 0 <= after <= distance:
            yield from (
                (zeros, *rest) for rest in _upper(gaps - 1, distance, twos - (zeros == 2), after)
            )


def _sharable(counts: Word, states: frozenset[_State]) -> bool:
    """Pole, zeros, pole, .., pole: whether they can be shared out."""
    for zeros in counts:
        states = frozenset(
            after for s in states for taken in _pole(s) for after in _zeros(taken, zeros)
        )
    return _State(1, 1, 0, 0, 0) in {after for s in states for after in _pole(s)}


def _pole(s: _State) -> Iterator[_State]:
    if not s.theta:
        yield _State(1, s.phi, s.between, s.zeros_a, s.zeros_b)
    if not s.phi:
        yield _State(s.theta, 1, s.between, s.zeros_a, s.zeros_b)
    if s.between:
        yield _State(s.theta, s.phi, s.between - 1, s.zeros_a, s.zeros_b)


def _zeros(s: _State, zeros: int) -> Iterator[_State]:
    """No zero, one of A or of B, or one of each."""
    if zeros == 0:
        yield s
    if zeros == 1 and s.theta and s.zeros_a:
        yield _State(0, s.phi, s.between, s.zeros_a - 1, s.zeros_b)
    if zeros == 1 and s.phi and s.zeros_b:
        yield _State(s.theta, 0, s.between, s.zeros_a, s.zeros_b - 1)
    if zeros == 2 and s.theta and s.phi and s.zeros_a and s.zeros_b:
        yield _State(0, 0, s.between, s.zeros_a - 1, s.zeros_b - 1)


def _count_word(t: Target) -> Word | None:
    """The word, if the balls are apart at this precision."""
    points = [
        (z, n, is_pole)
        for p, is_pole in ((t.denominator, True), (t.numerator, False))
        for z, n in cast("list[tuple[acb, int]]", p.complex_roots())  # not as its stub says
    ]
    if any(bool(z.imag != 0) for z, _, _ in points):
        return ()
    if any(n > 1 or not z.imag.is_zero() for z, n, _ in points):
        return None
    ordered = sorted(((z.real, is_pole) for z, _, is_pole in points), key=cmp_to_key(_compare))
    if not all(bool(right[0] > left[0]) for right, left in pairwise(ordered)):
        return None
    poles = [i for i, (_, is_pole) in enumerate(ordered) if is_pole]
    inside = poles[0] == 0 and poles[-1] == len(ordered) - 1
    return tuple(right - left - 1 for left, right in pairwise(poles)) if inside else ()


def _compare(point: tuple[arb, bool], other: tuple[arb, bool]) -> int:
    """From right to left; balls that overlap compare as equal, neighbours in the list will show
    it.
    """
    return -1 if bool(point[0] > other[0]) else int(bool(point[0] < other[0]))
