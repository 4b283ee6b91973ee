"""Two rows of masses of equal rank told apart by sharing out the roots of the numerator (see
`factored`).

At a point p0 of one row where all roots of N lie in the field, an equivalent of the other row
shares them out among its joints between the ports, its theta and its phi. If every share is
refuted, no point of the other row has this receptance.

Shares of one type suffice. Suppose the closures are equal, and let X be a component of {(p, q):
Phi1(p) = Phi2(q)} that dominates the points p, as in `bounds`, with the roots of N adjoined in the
order in which q's factors share them. Two roots are of one type if they are of one joint, both of
theta(p) or both of phi(p). If the Galois group of theta phi over Q(p) is the full S_m x S_n, the
tuples of distinct roots with given types form one variety W over Q, and it is irreducible; X
dominates it. The tuples over Z[p][1/disc] form a finite etale scheme, which is regular, so its
components are those of W: any tuple at a p0 with distinct roots lies in it, modulo any prime.
Roots are integral over Z[p], theta and phi being monic and the joints' leading coefficients part
of the gain, so lying-over gives a point of X over each tuple at p0, unless A(p0) = 0 modulo the
prime: one tuple of each type is enough, and `safety_of_empty` is the bound of one point. Points
are drawn until one has its roots in the field; as many points as could be drawn may be bad, each
with that probability.

The Galois group is seen modulo primes (Dedekind, see `monodromy`), without any chance. A
transitive group that holds a cycle of m - 1 roots is doubly transitive, so primitive; with a
transposition it is S_m (C. Jordan). If one element is a transposition of phi and trivial on theta,
its conjugates generate 1 x S_n, and the group is S_m x S_n if it projects onto S_m.
"""

from collections.abc import Iterator, Sequence
from itertools import combinations, permutations
from math import ceil, lcm, log2

from flint import fmpz, fmpz_mod_poly

from disting.algebra.groebner.elimination import Basis, TooLarge, basis_steps
from disting.algebra.groebner.modular import long_polynomial
from disting.algebra.sampling import prime, residues
from disting.evidence.ideals import Shared
from disting.fibres.ideals.bounds import safety_of_empty
from disting.fibres.ideals.factored import FactoredMap, Share, Values, shared_fibre, values
from disting.fibres.ideals.fibre_ideal import Polynomial, evaluated
from disting.fibres.ideals.system import Terms, matched

BITS = 192  # of the prime: one point gives more than 100 bits
DRAWS = 1 << 14  # points looked at until the roots lie in the field: one in 720 for six roots
PATTERNS = 400  # points at which the Galois group is looked at
# of one matrix: little is lost where one direction is much dearer than the other
ENTRIES = (40_000, 100_000, 400_000, 4_000_000)


def told_apart(
    left: FactoredMap, right: FactoredMap, seed: str, entries: Sequence[int] = ENTRIES
) -> tuple[Shared, int] | None:
    """Evidence that two rows of equal rank have different closures, and its bits; None where
    nothing is found.

    Both directions are tried, with matrices of so many `entries` at most; one bit is paid for the
    choice.
    """
    if _shape(left) != _shape(right):
        return None
    for most in entries:
        for left_given in (True, False):
            given, other = (left, right) if left_given else (right, left)
            found = _refuted(given, other, f"shares:{seed}:{given.name}:{other.name}", most)
            if found is not None:
                label, shares, degree = found
                safety = (
                    safety_of_empty(*matched(given.whole, other.whole), True, BITS)
                    - ceil(log2(DRAWS))
                    - 1
                )
                return Shared(
                    left_given=left_given, part="", label=label, shares=shares, degree=degree
                ), safety
    return None


def _shape(row: FactoredMap) -> tuple[int, int, int]:
    """Numbers of roots of N, of poles other than zero, of parameters."""
    return len(row.joints) + len(row.left) + len(row.right), len(row.poles), len(row.parameters)


def _refuted(
    given: FactoredMap, other: FactoredMap, label: str, entries: int
) -> tuple[str, int, int] | None:
    """Label, number of shares and largest degree, if all shares are refuted."""
    if not is_symmetric(given, label):
        return None
    modulus = prime(label, BITS)
    drawn = next(_points(given, label, modulus), None)
    if drawn is None:
        return None
    at, types = drawn
    degree, count = 0, 0
    for share in shares_by_type(types, len(other.joints), len(other.left)):
        found = _degree_of_one(*shared_fibre(at, other, share, modulus), modulus, entries)
        if not found:
            return None
        degree, count = max(degree, found), count + 1
    return label, count, degree


def _degree_of_one(
    unknowns: int, equations: Sequence[Polynomial], modulus: int, entries: int
) -> int:
    """The degree in which the equations contradict each other; 0 if they do not or it is not
    found.
    """
    if any(len(g) == 1 and not any(next(iter(g))) for g in equations):
        return 1  # a constant: the linear equations do
    try:
        for step in basis_steps(equations, unknowns, modulus) if unknowns else ():
            if isinstance(step, Basis):
                return step.degree if step.is_one else 0
            if step > entries:
                return 0
    except TooLarge:
        pass
    return 0


def _points(
    given: FactoredMap, label: str, modulus: int
) -> Iterator[tuple[Values, list[tuple[int, str]]]]:
    """Points with all roots of N in the field and distinct, with the roots and their types."""
    for draw in range(DRAWS):
        point = residues(f"{label}:{draw}", len(given.parameters), modulus)
        factors = [_monic(f, point, modulus) for f in (given.left, given.right)]
        # the cheap test of both first
        if not all(test(f, modulus) for test in (_may_split, _splits) for f in factors):
            continue
        at = values(given, point, modulus)
        types = [(z, f"joint {i}") for i, z in enumerate(at.joints)]
        types += [
            (z, kind)
            for kind, factor in zip(("left", "right"), factors, strict=True)
            for z in _roots(factor)
        ]
        if len({z for z, _ in types}) == len(types):
            yield at, types


def shares_by_type(roots: Sequence[tuple[int, str]], joints: int, left: int) -> Iterator[Share]:
    """One way of each type to give roots to the joints, in order, to theta (so many) and to phi
    (the rest).
    """
    seen = set[tuple[tuple[str, ...], tuple[str, ...]]]()
    for first in permutations(roots, joints):
        rest = [r for r in roots if r not in first]
        for chosen in combinations(rest, left):
            key = (tuple(kind for _, kind in first), tuple(sorted(kind for _, kind in chosen)))
            if key not in seen:
                seen.add(key)
                others = [r for r in rest if r not in chosen]
                yield Share(*(tuple(z for z, _ in some) for some in (first, chosen, others)))


def is_symmetric(row: FactoredMap, label: str) -> bool:
    """Whether the Galois group of theta phi over Q(p) is proven to be the product of the full
    symmetric groups.
    """
    modulus = prime(f"{label}:group")
    wanted = {
        (k, cycles)
        for k, factor in enumerate((row.left, row.right))
        for cycles in _wanted(len(factor))
    }
    for draw in range(PATTERNS):
        if not wanted:
            break
        point = residues(f"{label}:group:{draw}", len(row.parameters), modulus)
        theta, phi = (_monic(f, point, modulus) for f in (row.left, row.right))
        if all(e == 1 for _, e in (theta * phi).factor()[1]):
            cycles = _cycles(theta), _cycles(phi)
            wanted -= {(0, cycles[0]), (1, cycles[1])}
            wanted -= {(0, ())} if _transposes(cycles[0], ()) else set()
            wanted -= {(1, ())} if _transposes(cycles[1], cycles[0]) else set()
    return not wanted


def _wanted(degree: int) -> set[tuple[int, ...]]:
    """Cycle types that together make a group of this degree symmetric; () stands for a
    transposition.
    """
    needed = (((degree,), 2), ((1, degree - 1), 3), ((), 2))
    return {cycles for cycles, least in needed if degree >= least}


def _transposes(cycles: tuple[int, ...], beside: tuple[int, ...]) -> bool:
    """Whether a power of a permutation with these cycles is a transposition, and trivial on the
    cycles beside.
    """
    odd = [c for c in cycles if c % 2]
    power = lcm(*odd)
    return sorted(c for c in cycles if not c % 2) == [2] and all(power % c == 0 for c in beside)


def _cycles(factor: fmpz_mod_poly) -> tuple[int, ...]:
    return (
        tuple(sorted(int(f.degree()) for f, _ in factor.factor()[1])) if factor.degree() > 0 else ()
    )


def _may_split(factor: fmpz_mod_poly, modulus: int) -> bool:
    """Whether its discriminant is a square, as of distinct linear factors (L. Stickelberger)."""
    return factor.degree() < 2 or fmpz(int(factor.discriminant())).jacobi(modulus) == 1


def _splits(factor: fmpz_mod_poly, modulus: int) -> bool:
    """Whether it is a product of distinct linear factors: modulo these alone x^p = x."""
    x = long_polynomial([0, 1], modulus)
    return factor.degree() < 2 or x.pow_mod(modulus, factor) == x


def _roots(factor: fmpz_mod_poly) -> list[int]:
    return sorted(int(z) for z, _ in factor.roots()) if factor.degree() > 0 else []


def _monic(coordinates: Sequence[Terms], point: Sequence[int], modulus: int) -> fmpz_mod_poly:
    return long_polynomial([*(evaluated(c, point, modulus) for c in coordinates), 1], modulus)
