"""Whether the poles of each row of a generic chain are inseparable: conditions 1 and 2 of the
theorem in `splits`, proven.

Galois groups are seen modulo primes: where a monic polynomial with coefficients in Z[p] is
squarefree at a point p0 modulo a prime, its group over Q(p) holds an element whose cycles are as
long as its irreducible factors there (Dedekind; B. L. van der Waerden, Algebra I, section 61). One
irreducible value shows that the group is transitive, and one with a linear factor and another
irreducible one that what fixes a root is transitive on the others: doubly transitive. Residues
that are not all equal at a point are not all equal. So what is found holds without any chance; if
nothing is found, nothing is claimed.
"""

from functools import cache

from flint import nmod_mat, nmod_poly

from disting.algebra.sampling import about, prime, residues
from disting.fibres.ideals.fibre_ideal import sides_at
from disting.fibres.ideals.splits import power, receptances
from disting.fibres.ideals.system import CoefficientMap
from disting.model.structure import Structure

DRAWS = 400  # a degree m needs about 2 m of them


@cache
def poles_are_inseparable(structure: Structure, label: str) -> bool:
    """Whether both conditions are proven for both rows of a plain chain, at points that the label
    stands for.

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
