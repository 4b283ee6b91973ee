"""Scalings: integer weights by which parameters can change together unseen.

A scaling leaves the behaviour as it is: p_i -> t^w_i p_i for all t, with integer weights w.
Numerator and denominator written out are sums of monomials p^a with non-zero coefficients. If all
monomials of both have one weight w.a, the quotient does not change: an exact proof. The weights
are the integer kernel of the differences of exponents. As w_i p_i is in the kernel of the Jacobian
at every point, a few points prove that there are none, without writing anything out.
"""

from collections.abc import Sequence

from flint import fmpz_mat, nmod_mat

from disting.behaviour.expanded import expanded
from disting.model.structure import Structure
from disting.questions.identifiability.parts import Scaling
from disting.questions.identifiability.tangent import Tangent, search_tangents, short_vectors

POINTS = 4


def scalings(structure: Structure, seed: str = "disting") -> tuple[Scaling, ...]:
    """A basis of the scaling symmetries, few parameters first.

    >>> from disting.model.chain import Chain
    >>> [s.text for s in scalings(Chain(3, 2, 1, 3, 2, 3, damped=False).structure)]
    []
    """
    if not maybe_scaled(list(search_tangents(structure, seed, POINTS))):
        return ()
    powers = [p[1:] for part in expanded(structure) for p in part.monoms()]
    differences = [[a - b for a, b in zip(p, powers[0], strict=True)] for p in powers[1:]]
    names = [p for p in structure.parameters if p != "Td"]
    vectors = [_signed(v) for v in short_vectors(integer_kernel(differences, len(names)))]
    shown = sorted(vectors, key=lambda v: (sum(map(bool, v)), [-x for x in v]))
    return tuple(Scaling(tuple((n, w) for n, w in zip(names, v, strict=True) if w)) for v in shown)


def _signed(vector: list[int]) -> list[int]:
    first = next(x for x in vector if x)
    return vector if first > 0 else [-x for x in vector]


def maybe_scaled(seen: Sequence[Tangent]) -> bool:
    """Whether some weights w have w_i p_i in the kernel at all points seen; False is a proof that
    no scaling exists.

    J diag(p) w = 0 at all points, which a full rank of these matrices on top of each other rules
    out, modulo a prime too.
    """
    modulus, size = seen[0].modulus, len(seen[0].values)
    rows = [
        [g * x % modulus for g, x in zip(row, t.values.values(), strict=True)]
        for t in seen
        for row in t.rows
    ]
    return int(nmod_mat(len(rows), size, [x for row in rows for x in row], modulus).rank()) < size


def integer_kernel(rows: Sequence[Sequence[int]], columns: int) -> list[list[int]]:
    """A basis of the integer vectors v with row . v = 0 for all rows.

    >>> short_vectors(integer_kernel([[1, -1, 0]], 3))
    [[0, 0, 1], [1, 1, 0]]
    """
    # the transforming matrix of the Hermite form of the transpose has them below the rank: append
    # the identity
    size = len(rows)
    appended = [
        [row[j] for row in rows] + [int(i == j) for i in range(columns)] for j in range(columns)
    ]
    reduced = fmpz_mat(appended).hnf().tolist()
    return [[int(x) for x in row[size:]] for row in reduced if not any(row[:size])]
