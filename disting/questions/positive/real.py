"""Undamped chains over real parameters: each real model has a real equivalent, or some open set of
them has none.

x = s^2; all elements are real and not zero, of either sign. A real polynomial of degree e has a
real factor of degree f unless e is even, f is odd and no root is real: pairs of conjugates and
pairs of real roots make up any even number.

Rows. A row of n nodes with ports a <= b has N = nu A B, A and B real of degrees a - 1 and n - b.
Conversely let N/D be the receptance of a generic real row of the same n and b - a, and N have a
real factor of degree a - 1. Then there is a real row:
  - b = a: both sides are rational in the coefficients of A, B, D (see `synthesis.driving_point`).
  - b = a + 1: so they are in those of A, B, Theta, Phi and kappa, where D + kappa N = Theta Phi,
    Theta of degree a (see `synthesis.undamped_rows`). Theta needs a real root of D + kappa N at
    most, and kappa = -D(x)/N(x) makes any real x one.
  - b = n: A = N/nu, and real tau_i can be chosen (see `synthesis.undamped_rows`). a = 1: the mirror
    image of that; at the wall the reversed row (see `synthesis.theorems`): its masses t^2 s_i^2 and
    springs are rational, for s_i^2 and s_a s_b J_(a,a+1) .. J_(b-1,b) hold even powers of the
    off-diagonal elements of J alone; t^2 may be any real number.
Each element is a rational function of those polynomials and free choices, which form an
irreducible (rational) variety. It is not identically zero, for positive rows have all of them.
Where it is zero is a proper subvariety, whose image among the pairs (N, D), with the free choices
added, is a proper one too, because there are finitely many factors to each pair. The given rows
fill the closure of these pairs. So for generic given rows and choices no element is zero.

Chains of one gap and equal distances: the rows of `chain` are taken one by one.

Chains with force and sensor at one place in each row: R has any g of the non-zero poles. So D/x,
of degree N - 1, needs a real factor of degree g, then the numerator of R, of degree g - 1, one of
degree a_minus - 1, and that of F, of degree N - g - 1, one of degree a_plus - g - 1; the same
argument on elements. What is known of real factors of `chain` helps: its own gap is the degree of
a real factor of D/x, its own ports those of factors of the numerators.

None. A polynomial of even degree that must have a real factor of odd degree and has no real root
shows that there is no real equivalent. The polynomials: N, if `other` has no gap; with the same gap
and distances, the numerators of the two rows, because generic equivalents have the same rows (own
poles, see `obstacles`; that holds for all parameters but a proper algebraic subset, and an open set
without it still has an open part); with ports together, for each set of g poles that is closed
under conjugation (the poles of R are the roots of a real factor of D/x, and simple), the two
numerators that it gives: if each set fails, or there is none, there is no equivalent. All of this
is decided by balls that exclude something: a root is not real, a leading coefficient is not zero,
two poles differ. So it stays for all models near by: an open set, proven at one point, be it
special or not. The models with a positive equivalent are an open set on the other side.
"""

from collections.abc import Iterator

from flint import acb, ctx

from disting.algebra.certainty import full_text, residues
from disting.evidence.kind import PointText
from disting.fibres.synthesis.branch import Ball, Imprecise, Poly, product, roots, shift, splits
from disting.fibres.synthesis.task import Point, Target, target
from disting.fibres.synthesis.theorems import is_plain
from disting.model.chain import Chain
from disting.model.row import Row
from disting.questions.positive.obstacles import distances, is_collocated, receptances, rows
from disting.questions.positive.points import random_point, read, spell

TRIES = 1000  # points of mixed signs, a millisecond each; seldom are more than a few needed
BITS = 192
# a polynomial, its generic degree, the degree of a real factor that it must have
Factor = tuple[Poly, int, int]


def always_real(chain: Chain, other: Chain) -> bool:
    """Return True if each generic real model of `chain` has a real equivalent in `other`, by real
    factors; False proves nothing.

    >>> middle, end = Chain(3, 0, 0, 2, 0, 2, damped=False), Chain(3, damped=False)
    >>> always_real(middle, end), always_real(end, middle)
    (True, False)
    """
    if not (is_plain(chain) and is_plain(other)) or chain.n_masses != other.n_masses:
        return False
    if is_collocated(chain) and is_collocated(other):
        return _by_any_poles(chain, other)
    if chain.gap != other.gap or distances(chain) != distances(other):
        return False
    return all(_row(*pair) for pair in zip(rows(chain), rows(other), strict=True))


def real_witness(chain: Chain, other: Chain, seed: str) -> PointText:
    """A rational point of `chain` in an open set of real models without real equivalents in
    `other`; () if none is found.
    """
    plain = is_plain(chain) and is_plain(other) and chain.n_masses == other.n_masses
    if not plain or always_real(chain, other):
        return ()
    label = f"real:{seed}:{full_text(chain)}:{full_text(other)}"
    points = (
        _sign_point(random_point(chain, f"{label}:{k}"), f"{label}:{k}") for k in range(TRIES)
    )
    return next((spell(p) for p in points if lacks_real(chain, p, other)), ())


def confirms_real(values: PointText, chain: Chain, other: Chain) -> bool:
    """Return True if a stored point proves an open set of real models without real equivalents."""
    point = read(values)
    whole = sorted(point) == sorted(chain.parameters) and all(v != 0 for v in point.values())
    return whole and lacks_real(chain, point, other)


def lacks_real(chain: Chain, point: Point, other: Chain) -> bool:
    """Return True if real models near this one are proven to have no real equivalents, generic ones
    at least; False proves nothing.
    """
    if not (is_plain(chain) and is_plain(other)) or chain.n_masses != other.n_masses:
        return False
    with ctx.workprec(BITS):
        try:
            candidates = list(_candidates(chain, point, other))
            return all(any(_fails(*factor) for factor in factors) for factors in candidates)
        except Imprecise:
            return False


def _candidates(chain: Chain, point: Point, other: Chain) -> Iterator[list[Factor]]:
    """For each way in which real rows of `other` may share the receptance, the polynomials
    that must have real factors.
    """
    whole = target(chain.structure, point).folded(1)
    searched = rows(other)
    alike = chain.gap == other.gap and distances(chain) == distances(other)
    if whole.denominator.degree() != other.n_masses:
        yield []  # nothing is said
    elif len(searched) == 1:
        yield [_numerator(whole, *searched)]
    elif is_collocated(other):
        yield from _share_poles(whole, *searched)
    elif alike:
        pairs = zip(searched, receptances(chain, point), strict=True)
        yield [_numerator(t, row) for row, t in pairs]
    else:
        yield []  # nothing is said


def _numerator(t: Target, row: Row) -> Factor:
    return t.balls.numerator, row.numerator_degree, row.a - 1


def _share_poles(whole: Target, grounded: Row, free: Row) -> Iterator[list[Factor]]:
    """Both numerators for every set of poles, closed under conjugation, that the grounded row
    may have.
    """
    data = whole.balls
    slope = data.denominator.derivative()
    poles = [
        (z, data.numerator(z) / slope(z))
        for z in roots(shift(data.denominator, -1), whole.denominator.degree() - 1)
    ]
    still = (acb(0), data.numerator[0] / slope[0])
    for mine, others in splits(poles, grounded.n_masses):
        if all(any(z.conjugate().overlaps(w) for w, _ in mine) for z, _ in mine):
            pairs = ((mine, grounded), ([still, *others], free))
            yield [(_sum(some), row.numerator_degree, row.a - 1) for some, row in pairs]


def _sum(poles: list[tuple[Ball, Ball]]) -> Poly:
    """Numerator of the sum of r/(x - z)."""
    terms = [
        residue * product([w for k, (w, _) in enumerate(poles) if k != i])
        for i, (_, residue) in enumerate(poles)
    ]
    return sum(terms[1:], terms[0])


def _fails(polynomial: Poly, degree: int, factor: int) -> bool:
    """Return True if a real polynomial of this degree certainly has no real factor of that one."""
    if degree % 2 or factor % 2 == 0:
        return False
    return all(bool(z.imag != 0) for z in roots(polynomial, degree))


def _by_any_poles(chain: Chain, other: Chain) -> bool:
    """Return True if real factors of all degrees exist, with force and sensor at one place in each
    row.
    """
    mine, searched = rows(chain), rows(other)
    if len(searched) == 1:
        factor_degree = 0 if chain.gap else mine[0].a - 1
        return _splits(searched[0].numerator_degree, searched[0].a - 1, factor_degree)
    same = chain.gap == other.gap
    if same and all(_row(*pair) for pair in zip(mine, searched, strict=True)):
        return True
    poles = _splits(other.n_masses - 1, other.gap, chain.gap)
    return poles and all(_splits(row.numerator_degree, row.a - 1, 0) for row in searched)


def _row(row: Row, other: Row) -> bool:
    """Return True if each generic real row has a real equivalent of the other type."""
    same = sorted((row.a, row.n_masses + 1 - row.b)) == sorted(
        (other.a, other.n_masses + 1 - other.b)
    )
    covered = other.distance <= 1 or other.b == other.n_masses or other.a == 1
    return same or (covered and _splits(other.numerator_degree, other.a - 1, row.a - 1))


def _splits(degree: int, factor: int, factor_degree: int) -> bool:
    """Return True if a real polynomial has a real factor of this degree, if it has one of degree
    `factor_degree`.
    """
    return degree % 2 == 1 or factor % 2 == 0 or factor_degree % 2 == 1


def _sign_point(point: Point, label: str) -> Point:
    """The point with random signs."""
    signs = residues(f"signs:{label}", len(point), 3)
    return {
        name: value if sign == 1 else -value
        for (name, value), sign in zip(point.items(), signs, strict=True)
    }
