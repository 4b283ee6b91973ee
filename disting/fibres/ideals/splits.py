"""The receptance of a chain with a gap as the sum R + F of those of its rows, and the few ways in
which another chain can split it.

R is the receptance of the grounded row between the minus ports (0 without a gap), F of the free
row between the plus ports; x = s for damped chains, q = 2, and x = s^2 for undamped ones, q = 1.
With monic denominators R = N_R/D_R and F = N_F/(x^q E), deg D_R = q g, deg E = q (N - 1 - g). Let
the first chain be generic and let a second chain of as many masses, with a gap h, have the same
receptance H. The poles of H that are not zero are simple, so the second chain takes q h of them,
S, for its grounded row, and its rows are the partial fractions of H over S and over the rest.

Theorem. Suppose 1. the Galois groups of D_R over Q(p_R) and of E over Q(p_F) are doubly
transitive, 2. not all residues of R are equal, nor those of F at the roots of E (a single one is
not zero), 3. a row of the second chain has a receptance O(x^-2). Then S holds all roots of D_R or
none, and all roots of E or none.

Proof. By 3 the residues of H over S sum to 0 (grounded row), or to lim x H (free row). Let T be
the roots of D_R in S. Sum of the residues over T, minus lim x R in the second case, is an
algebraic function of p_R only, and the negative of one of p_F only: a constant; multiplying all
elements of R by a number divides it by that number, so it is 0. Hence the sum over T lies in
Q(p_R). The vectors v for which sum v_j r_j does are a representation of the group, and hold (1,
.., 1). If T is neither empty nor everything, they hold all vectors, because the representation by
permutations is the constant vectors plus an irreducible one (J.-P. Serre, Linear representations
of finite groups, section 2.3). Then every r_j lies in Q(p_R), and by transitivity they are all
equal, against 2. The same with E and F.

So there are three splits at most: (R, F); (F - c/x^q, R + c/x^q), c the residue of F at the double
zero; (H - c/x^q, c/x^q).
"""

from dataclasses import dataclass
from functools import lru_cache

from disting.algebra.symbols import coefficients, renamed, symbols
from disting.fibres.ideals.system import (
    REMEMBERED,
    CoefficientMap,
    receptance_map,
    receptance_of_row,
    separated,
    unknowns,
)
from disting.model.row import rows_of
from disting.model.structure import Structure

SAME = "same"  # the split of a chain into its own rows


@dataclass(frozen=True, slots=True)
class Receptances:
    """Receptances of the grounded (None without a gap) and of the free row, as maps in
    normalised parameters.
    """

    grounded: CoefficientMap | None
    free: CoefficientMap

    @property
    def named(self) -> tuple[tuple[str, CoefficientMap], ...]:
        """Those that there are, by the name of the row."""
        grounded = () if self.grounded is None else (("grounded", self.grounded),)
        return (*grounded, ("free", self.free))


@dataclass(frozen=True, slots=True)
class Split:
    """What the two rows of another chain have to be: one of the three ways by its name, with
    both receptances.
    """

    name: str
    receptances: Receptances


def is_plain(structure: Structure) -> bool:
    """Whether there are no dampers to the ground, no lag and no dead time."""
    return not (
        structure.lag or structure.dead_time or any(e.kind == "b" for e in structure.elements)
    )


def power(structure: Structure) -> int:
    """q: 1 for a chain without any damper, else 2."""
    return 2 if any(e.kind in "db" for e in structure.elements) else 1


def gap(structure: Structure) -> int:
    """Number of masses of the grounded row; 0 for a chain without a gap."""
    return structure.row_ends[0][1] if len(structure.row_ends) == 2 else 0


@lru_cache(maxsize=REMEMBERED)
def receptances(structure: Structure) -> Receptances:
    """The receptances of the rows of a plain chain.

    >>> from disting.model.chain import Chain
    >>> p = receptances(Chain(2, 1, 1, 2, 1, 2, damped=False).structure)
    >>> [[str(a) for a in m.denominator] for _, m in p.named]
    [['u0', '0', '1'], ['0', '0', '1']]
    """
    maps = [receptance_map(row) for row in rows_of(structure)]
    return Receptances(maps[0] if len(maps) == 2 else None, maps[-1])


def has_relation(other: Receptances, q: int) -> bool:
    """Condition 3: a receptance that falls at least as x^-2."""
    return any(relative_degree(m) * q >= 4 for _, m in other.named)


def relative_degree(model: CoefficientMap) -> int:
    """Degree in s of the denominator minus that of the numerator."""
    numerator, denominator = model.degrees
    return denominator - numerator


@lru_cache(maxsize=REMEMBERED)
def splits(given: Structure, h: int) -> tuple[Split, ...]:
    """The splits of a generic receptance of `given` for a chain of as many masses with a gap h
    > 0, if the theorem applies.
    """
    n, g = given.n_masses, gap(given)
    every = list[Split]()
    if h == g:
        every.append(Split(SAME, receptances(given)))
    if g and h == n - 1 - g:
        every.append(
            Split("exchanged", Receptances(_without_rigid_body(given), _with_rigid_body(given)))
        )
    if h == n - 1 and h != g:
        every.append(
            Split("rigid", Receptances(_without_rigid_body(given, whole=True), _rigid_body()))
        )
    return tuple(every)


def _without_rigid_body(structure: Structure, whole: bool = False) -> CoefficientMap:
    """F - c/s^2, or with `whole` R + F - c/s^2: c = N_F(0)/E(0), F = N_F/(s^2 E)."""
    *grounded, free = rows_of(structure)
    names = tuple(name for row in (*grounded * whole, free) for name in unknowns(row))
    ring = symbols(["s", *names])
    num, den = receptance_of_row(free, ring)
    rest = den // ring["s"] ** 2
    at_zero = [renamed(coefficients(p, "s")[0], ring, {}) for p in (num, rest)]
    num, den = (num * at_zero[1] - rest * at_zero[0]) // ring["s"] ** 2, rest * at_zero[1]
    for row in grounded * whole:
        other_num, other_den = receptance_of_row(row, ring)
        num, den = num * other_den + other_num * den, den * other_den
    return separated(names, num, den)


def _with_rigid_body(structure: Structure) -> CoefficientMap:
    """R + c/s^2 with a free c: for generic parameters c depends on those of F alone, and is not
    constant.
    """
    grounded, names = rows_of(structure)[0], unknowns(rows_of(structure)[0])
    ring = symbols(["s", *names, "c"])
    num, den = receptance_of_row(grounded, ring)
    return separated((*names, "c"), num * ring["s"] ** 2 + ring["c"] * den, den * ring["s"] ** 2)


def _rigid_body() -> CoefficientMap:
    ring = symbols(["s", "c"])
    return separated(("c",), ring["c"], ring["s"] ** 2)
