"""Two rows of masses of equal rank distinguished by distributing the roots of the numerator (see
`factored_map`).

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

The Galois group is computed modulo primes (Dedekind, see `splits`), without any chance. A
transitive group that holds a cycle of m - 1 roots is doubly transitive, so primitive; with a
transposition it is S_m (C. Jordan). If one element is a transposition of phi and trivial on theta,
its conjugates generate 1 x S_n, and the group is S_m x S_n if it projects onto S_m.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import combinations, permutations
from math import ceil, inf, lcm, log2

from flint import fmpz, fmpz_mod_poly

from disting.algebra.certainty import prime, residues
from disting.algebra.groebner.elimination import Basis, TooLarge, basis_steps
from disting.algebra.groebner.modular import Sparse, long_polynomial
from disting.evidence.ideals import NoShares
from disting.fibres.ideals.bounds import safety_of_empty
from disting.fibres.ideals.factored_map import (
    FactoredMap,
    FactoredValues,
    Share,
    shared_fibre,
    values,
)
from disting.fibres.ideals.fibre_ideal import evaluate
from disting.fibres.ideals.system import Terms, match_maps

BITS = 192  # of the prime: one point gives more than 100 bits
DRAWS = 1 << 14  # points looked at until the roots lie in the field: one in 720 for six roots
PATTERNS = 400  # points at which the Galois group is looked at
MOST = 4_000_000  # entries of one matrix
Try = tuple[bool, int]
"""Direction (True: the left model's point is given), and the largest number of entries of a
matrix.
"""
# little is lost where one direction is much dearer than the other
TRIES = tuple((way, most) for most in (40_000, 100_000, 400_000, MOST) for way in (True, False))


class _SolvableError(Exception):
    pass


def tell_apart(
    left: FactoredMap, right: FactoredMap, seed: str, tries: Sequence[Try] = TRIES
) -> tuple[NoShares, int] | None:
    """Evidence that two rows of equal rank have different closures, and its bits; None where
    nothing is found.

    One bit is paid for the choice of the direction. What one of the `tries` found, that one alone
    finds again. Where a share has solutions, no further try is made: the closures are the same.
    """
    if not may_share(left, right):
        return None
    ways = dict[bool, _Way | None]()
    for left_given, most in tries:
        model, other = (left, right) if left_given else (right, left)
        if left_given not in ways:
            ways[left_given] = _way(model, other, f"shares:{seed}:{model.name}:{other.name}")
        way = ways[left_given]
        try:
            is_refuted = way is not None and way.is_refuted(most)
        except _SolvableError:
            return None
        if way is not None and is_refuted:
            bits = safety_of_empty(*match_maps(model.whole, other.whole), True, BITS)
            shared = NoShares(
                left_given=left_given,
                part="",
                label=way.label,
                shares=len(way.degrees),
                degree=max(way.degrees),
            )
            return shared, bits - ceil(log2(DRAWS)) - 1
    return None


def may_share(left: FactoredMap, right: FactoredMap) -> bool:
    """Return True if both have the same numbers of zeros, nonzero poles and parameters."""
    counts, other_counts = (
        (len(x.joints) + len(x.left) + len(x.right), len(x.poles), len(x.parameters))
        for x in (left, right)
    )
    return counts == other_counts


@dataclass(slots=True)
class _Way:
    """One direction, at the point of its label: the shares that are left, the degrees in which the
    others were refuted, the steps of the one at hand, and the entries of the next of them.
    """

    label: str
    fibres: Iterator[tuple[int, list[Sparse]]]
    modulus: int
    degrees: list[int] = field(default_factory=list)
    steps: Iterator[Basis | int] | None = None
    entries: float = 0

    def is_refuted(self, most: int) -> bool:
        """Return True if all shares are refuted, with matrices of at most this number of entries; a
        larger number continues where a smaller one ended. Raises _SolvableError where a share has
        solutions.
        """
        while self.steps is not None or self._is_next():
            if self.entries > most:
                return False
            self._step()
        return True

    def _is_next(self) -> bool:
        """Take the next share, if there is one, that the linear equations do not refute."""
        for unknowns, equations in self.fibres:
            if not any(len(g) == 1 and not any(next(iter(g))) for g in equations):
                self.steps, self.entries = basis_steps(equations, unknowns, self.modulus), 0
                return True
            self.degrees.append(1)  # a constant
        return False

    def _step(self) -> None:
        assert self.steps is not None
        try:
            step = next(self.steps)
        except TooLarge:
            self.entries = inf
            return
        if not isinstance(step, Basis):
            self.entries = step
        elif step.is_one:
            self.degrees.append(step.degree)
            self.steps = None
        else:
            raise _SolvableError


def _way(model: FactoredMap, other: FactoredMap, label: str) -> _Way | None:
    """A direction; None if no point is found, or the groups of roots are not found to be
    symmetric.
    """
    modulus = prime(label, BITS)
    drawn = next(_points(model, label, modulus), None) if is_symmetric(model, label) else None
    if drawn is None:
        return None
    at, types = drawn
    shares = shares_by_type(types, len(other.joints), len(other.left))
    return _Way(label, (shared_fibre(at, other, s, modulus) for s in shares), modulus)


def _points(
    model: FactoredMap, label: str, modulus: int
) -> Iterator[tuple[FactoredValues, list[tuple[int, str]]]]:
    """Points with all roots of N in the field and distinct, with the roots and their types."""
    for draw in range(DRAWS):
        point = residues(f"{label}:{draw}", len(model.parameters), modulus)
        factors = [_monic(f, point, modulus) for f in (model.left, model.right)]
        # the cheap test of both first
        if not all(test(f, modulus) for test in (_may_split, _splits) for f in factors):
            continue
        at = values(model, point, modulus)
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
    visited = set[tuple[tuple[str, ...], tuple[str, ...]]]()
    for first in permutations(roots, joints):
        rest = [r for r in roots if r not in first]
        for chosen in combinations(rest, left):
            key = (tuple(kind for _, kind in first), tuple(sorted(kind for _, kind in chosen)))
            if key not in visited:
                visited.add(key)
                others = [r for r in rest if r not in chosen]
                yield Share(*(tuple(z for z, _ in some) for some in (first, chosen, others)))


def is_symmetric(row: FactoredMap, label: str) -> bool:
    """Return True if the Galois group of theta phi over Q(p) is proven to be the product of the
    full symmetric groups.
    """
    modulus = prime(f"{label}:group")
    wanted = {
        (k, cycles)
        for k, factor in enumerate((row.left, row.right))
        for cycles in _required_cycles(len(factor))
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


def _required_cycles(degree: int) -> set[tuple[int, ...]]:
    """Cycle types that together make a group of this degree symmetric; () denotes a
    transposition.
    """
    needed = (((degree,), 2), ((1, degree - 1), 3), ((), 2))
    return {cycles for cycles, least in needed if degree >= least}


def _transposes(cycles: tuple[int, ...], beside: tuple[int, ...]) -> bool:
    """Return True if a power of a permutation with these cycles is a transposition, and trivial on
    the other cycles.
    """
    odd = [c for c in cycles if c % 2]
    power = lcm(*odd)
    return sorted(c for c in cycles if not c % 2) == [2] and all(power % c == 0 for c in beside)


def _cycles(factor: fmpz_mod_poly) -> tuple[int, ...]:
    return (
        tuple(sorted(int(f.degree()) for f, _ in factor.factor()[1])) if factor.degree() > 0 else ()
    )


def _may_split(factor: fmpz_mod_poly, modulus: int) -> bool:
    """Return True if its discriminant is a square, as for distinct linear factors (L.
    Stickelberger).
    """
    return factor.degree() < 2 or fmpz(int(factor.discriminant())).jacobi(modulus) == 1


def _splits(factor: fmpz_mod_poly, modulus: int) -> bool:
    """Return True if it is a product of distinct linear factors: modulo these alone x^p = x."""
    x = long_polynomial([0, 1], modulus)
    return factor.degree() < 2 or x.pow_mod(modulus, factor) == x


def _roots(factor: fmpz_mod_poly) -> list[int]:
    return sorted(int(z) for z, _ in factor.roots()) if factor.degree() > 0 else []


def _monic(coordinates: Sequence[Terms], point: Sequence[int], modulus: int) -> fmpz_mod_poly:
    return long_polynomial([*(evaluate(c, point, modulus) for c in coordinates), 1], modulus)
