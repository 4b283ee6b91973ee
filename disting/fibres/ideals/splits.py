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

Whether the poles of each row of a generic chain are inseparable: conditions 1 and 2 of the
theorem in `splits`, proven.

Galois groups are computed modulo primes: where a monic polynomial with coefficients in Z[p] is
squarefree at a point p0 modulo a prime, its group over Q(p) holds an element whose cycles are as
long as its irreducible factors there (Dedekind; B. L. van der Waerden, Algebra I, section 61). One
irreducible value shows that the group is transitive, and one with a linear factor and another
irreducible one that what fixes a root is transitive on the others: doubly transitive. Residues that
are not all equal at a point are not all equal. So what is found holds without any chance; if
nothing is found, nothing is claimed.
"""

from dataclasses import dataclass
from functools import cache, lru_cache

from flint import nmod_mat, nmod_poly

from disting.algebra.certainty import about, prime, residues
from disting.algebra.symbols import coefficients, rename_symbols, symbols
from disting.fibres.ideals.fibre_ideal import sides_at
from disting.fibres.ideals.system import (
    REMEMBERED,
    CoefficientMap,
    receptance_map,
    receptance_of_row,
    separate,
    unknowns,
)
from disting.model.chain import Structure
from disting.model.row import rows_of

SAME = "same"  # the split of a chain into its own rows
DRAWS = 400  # a degree m needs about 2 m of them


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
    """Requirements on the two rows of another chain: one of the three splits by its name, with both
    receptances.
    """

    name: str
    receptances: Receptances


def is_plain(structure: Structure) -> bool:
    """Return True if there are no dampers to the ground, no lag and no dead time."""
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
def splits(structure: Structure, h: int) -> tuple[Split, ...]:
    """The splits of a generic receptance of `structure` for a chain of as many masses with a gap h
    > 0, if the theorem applies.
    """
    n, g = structure.n_masses, gap(structure)
    every = list[Split]()
    if h == g:
        every.append(Split(SAME, receptances(structure)))
    if g and h == n - 1 - g:
        every.append(
            Split(
                "exchanged",
                Receptances(_without_rigid_body(structure), _with_rigid_body(structure)),
            )
        )
    if h == n - 1 and h != g:
        every.append(
            Split("rigid", Receptances(_without_rigid_body(structure, whole=True), _rigid_body()))
        )
    return tuple(every)


def _without_rigid_body(structure: Structure, whole: bool = False) -> CoefficientMap:
    """F - c/s^2, or with `whole` R + F - c/s^2: c = N_F(0)/E(0), F = N_F/(s^2 E)."""
    *grounded, free = rows_of(structure)
    beside = grounded if whole else []
    names = tuple(name for row in (*beside, free) for name in unknowns(row))
    ring = symbols(["s", *names])
    num, den = receptance_of_row(free, ring)
    rest = den // ring["s"] ** 2
    at_zero = [rename_symbols(coefficients(p, "s")[0], ring, {}) for p in (num, rest)]
    num, den = (num * at_zero[1] - rest * at_zero[0]) // ring["s"] ** 2, rest * at_zero[1]
    for row in beside:
        other_num, other_den = receptance_of_row(row, ring)
        num, den = num * other_den + other_num * den, den * other_den
    return separate(names, num, den)


def _with_rigid_body(structure: Structure) -> CoefficientMap:
    """R + c/s^2 with a free c: for generic parameters c depends on those of F alone, and is not
    constant.
    """
    grounded, names = rows_of(structure)[0], unknowns(rows_of(structure)[0])
    ring = symbols(["s", *names, "c"])
    num, den = receptance_of_row(grounded, ring)
    return separate((*names, "c"), num * ring["s"] ** 2 + ring["c"] * den, den * ring["s"] ** 2)


def _rigid_body() -> CoefficientMap:
    ring = symbols(["s", "c"])
    return separate(("c",), ring["c"], ring["s"] ** 2)


@cache
def poles_are_inseparable(structure: Structure, label: str) -> bool:
    """Return True if both conditions are proven for both rows of a plain chain, at points that the
    label denotes.

    >>> from disting.model.chain import Chain
    >>> poles_are_inseparable(Chain(3, 1, 1, 2, 1, 2, damped=True).structure, "doc")
    True
    """
    step = 2 // power(structure)
    return all(
        _is_inseparable(m, step, f"{label}:{name}") for name, m in receptances(structure).named
    )


def _is_inseparable(row: CoefficientMap, step: int, label: str) -> bool:
    """One row, in x = s^step: its poles that are not zero, with a doubly transitive group and
    unequal residues.
    """
    label = about(label, row.content)
    modulus = prime(label)
    wanted, unequal = set[tuple[int, ...]](), False
    for draw in range(DRAWS):
        point = residues(f"{label}:{draw}", len(row.parameters), modulus)
        num, den = (nmod_poly(c[::step], modulus) for c in sides_at(row, point, modulus))
        zeros = next(i for i in range(den.degree() + 1) if den[i])
        rest = nmod_poly([den[i] for i in range(zeros, den.degree() + 1)], modulus)
        m = rest.degree()
        wanted = (wanted if draw else _cycles(m)) - {_factor_degrees(rest)}
        unequal = unequal or _residues_differ(num, rest, zeros)
        if not wanted and unequal:
            return True
    return False


def _cycles(m: int) -> set[tuple[int, ...]]:
    """Cycle types that together make a group of this degree doubly transitive."""
    return {cycles for cycles, least in (((m,), 2), ((1, m - 1), 3)) if m >= least}


def _factor_degrees(polynomial: nmod_poly) -> tuple[int, ...]:
    """Degrees of the irreducible factors; (0,) if one is multiple."""
    _, factors = polynomial.factor()
    return (
        tuple(sorted(int(f.degree()) for f, _ in factors))
        if all(e == 1 for _, e in factors)
        else (0,)
    )


def _residues_differ(num: nmod_poly, rest: nmod_poly, zeros: int) -> bool:
    """N/(x^k E)' is not the same number at all roots of E: N and x^k E' are independent modulo
    E; no pole cancels.
    """
    x, m = nmod_poly([0, 1], rest.modulus()), rest.degree()
    if not num[0] and zeros:
        return False
    if m < 2:
        return m == 0 or bool((num % rest)[0])
    remainders = (num % rest, (x**zeros * rest.derivative()) % rest)
    return bool(
        nmod_mat(2, m, [int(r[i]) for r in remainders for i in range(m)], rest.modulus()).rank()
        == 2
    )
