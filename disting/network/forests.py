"""Which powers of s occur in the transfer function of a network, and how many terms its
coefficients have, exactly and without writing them out.

Every coefficient is a sum of products of values, one for each tree (D) or each forest (N), and all
have one sign where both ports are between the same two nodes or end at the ground. So they do not
cancel, and what is not zero where all values are 1 is not zero. There the coefficients are whole
numbers, read as the digits of D and N at s = 2^B, with 2^B above their sum.

LEMMA. Every value enters N and D to the first power. If G at a point, in lowest terms, has the
degrees of N and D less the power of s that they share everywhere, and depends there on every value
that is seen, then that power is all that N and D have in common. Proof: any other common factor
that holds s would keep its degree at the point, as the leading coefficients do not vanish, and
would be cancelled there. One without s holds some value p; N and D being linear in p, what is left
of both is free of p, and so is G.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from flint import fmpz_mat

from disting.algebra.sampling import about, prime, residues
from disting.network.at_points import Assembly, assembly, quotient_at
from disting.network.network import Network

REMEMBERED = 1024


@dataclass(frozen=True, slots=True)
class Counts:
    """How many terms the coefficients of s^0, s^1, .. of both sides have, where none cancel, and
    the largest degree of a term in the values.
    """

    num: tuple[int, ...]
    den: tuple[int, ...]
    degree: int

    @property
    def lost(self) -> int:
        """The power of s that both sides share."""
        return min(next(i for i, c in enumerate(side) if c) for side in (self.num, self.den))

    @property
    def degrees(self) -> tuple[int, int]:
        """Degrees of both sides, that power cancelled."""
        return len(self.num) - 1 - self.lost, len(self.den) - 1 - self.lost


@lru_cache(maxsize=REMEMBERED)
def counts_of(network: Network, halves: bool) -> Counts | None:
    """Those of a network whose coefficients are sums of terms of one sign and in lowest terms, as
    one point shows; None of others.
    """
    of = assembly(network, halves)
    if of is None or not of.sign:
        return None
    known = counts(of)
    if not any(known.num) or not any(known.den):
        return None
    label = about("lowest terms", network.elements, network.ports, network.order, halves)
    modulus = prime(label)
    q = quotient_at(of, residues(f"point:{label}", of.n_values, modulus), modulus)
    slopes = [(q.num_derivatives[e.place], q.den_derivatives[e.place]) for e in of.entries]
    kept = (q.num.degree(), q.den.degree()) == known.degrees
    return known if kept and all(a or b for a, b in slopes) else None


@lru_cache(maxsize=REMEMBERED)
def counts(of: Assembly) -> Counts:
    """Those of an assembly whose `sign` is not 0."""
    num, den = _digits(of, [e.power for e in of.entries])
    divide = sum(e.divides for e in of.entries)
    others = _digits(of, [int(not e.divides) for e in of.entries])
    # of n factors k do not divide: these are left, and the values that divide but for n - k
    degrees = [
        2 * (len(side) - 1) + divide - n
        for side, n in zip(others, (of.size - 1, of.size), strict=True)
        if side
    ]
    return Counts((0,) * of.gained + num if num else (), den, max(degrees))


def _digits(of: Assembly, powers: Sequence[int]) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Coefficients of c^T adj P b and det P, but for a sign, with the number s^power for each
    entry.
    """
    bits = max(_at_ones(of, [1] * len(powers))).bit_length()
    sides = _at_ones(of, [1 << bits * power for power in powers])
    mask = (1 << bits) - 1
    num, den = (
        tuple(side >> at & mask for at in range(0, side.bit_length(), bits)) for side in sides
    )
    return num, den


def _at_ones(of: Assembly, terms: Sequence[int]) -> tuple[int, int]:
    """c^T adj P b times its sign, and det P, over the integers."""
    rows = of.rows(terms)
    edges = [[0] * of.size for _ in range(2)]
    for edge, port in zip(edges, (of.force, of.sensor), strict=True):
        for i, x in port:
            edge[i] = x
    above = [[*row, x] for row, x in zip(rows, edges[0], strict=True)]
    bordered = fmpz_mat([*above, [*(-x for x in edges[1]), 0]])
    return of.sign * int(bordered.det()), int(fmpz_mat(rows).det())
