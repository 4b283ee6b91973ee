"""Scalings that leave the behaviour as it is: p_i -> t^w_i p_i for all t, with integer weights w.

Numerator and denominator written out are sums of monomials p^a with non-zero coefficients. If all
monomials of both have one weight w.a, the quotient does not change: an exact proof. The weights
are the integer kernel of the differences of exponents. As w_i p_i is in the kernel of the Jacobian
at every point, a few points prove that there are none, without writing anything out.
"""

from disting.behaviour.expanded import expanded
from disting.model.structure import Structure
from disting.questions.identifiability.lattice import integer_kernel, short_vectors
from disting.questions.identifiability.parts import Scaling
from disting.questions.identifiability.tangent import maybe_scaled, search_tangents

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
    found = [_signed(v) for v in short_vectors(integer_kernel(differences, len(names)))]
    shown = sorted(found, key=lambda v: (sum(map(bool, v)), [-x for x in v]))
    return tuple(Scaling(tuple((n, w) for n, w in zip(names, v, strict=True) if w)) for v in shown)


def _signed(vector: list[int]) -> list[int]:
    first = next(x for x in vector if x)
    return vector if first > 0 else [-x for x in vector]
