"""Powers of s in the transfer function of a network, and numbers of terms of its coefficients,
exactly and without expanding them.

Every coefficient is a sum of products of values, one for each tree (D) or each forest (N), for
flows too (all minors theorem, Chaiken 1982). No two are made of the same values, so they do not
cancel.

Signs. Force and sensor are differences, between a+ and a-, c+ and c-. With f(A | B) the sum over
forests of two trees, one through A, one through B,

    c^T adj P b = f(a+ c+ | a- c-) - f(a+ c- | a- c+)

Where the ports share a node, one of both is empty: all terms have one sign, and what is not zero
where all values are 1 is not zero. Where they do not, forests are counted (`.trees`). Gears: where
ratios agree (`.gears`) D and N are those of a network without gears at values times products of
ratios, and N is multiplied by one: as many terms, of the same signs but for one that all terms of N
share. Nothing is claimed for others. Ratios that are numbers multiply each term by a number.

The coefficients where all values are 1 are whole numbers, read as the digits of D and N at s = 2^B,
with 2^B above their sum.

LEMMA. Every value enters N and D to the first power. If G at a point, in lowest terms, has the
degrees of N and D less the power of s that they share everywhere, and depends there on every
observable value, then that power is all that N and D have in common, except for ratios of gears.
Proof: any other common factor that holds s would keep its degree at the point, as the leading
coefficients do not vanish, and would be cancelled there. One without s that holds some value p: N
and D being linear in p, what is left of both is free of p, and so is G. One of ratios alone divides
every coefficient, which is a product of ratios, so it is such a product: a ratio that some term of
N or of D lacks is not in it.

Spanning forests of a graph counted by what they connect, with edges of many kinds as weights.

Nodes are taken one after another, the one with fewest neighbours first. Only the connection of the
remaining nodes in a forest is stored: so chains, trees and narrow loops have few states, whatever
their size.
"""

from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache

from flint import fmpz_mat

from disting.algebra.certainty import about, prime, residues
from disting.network.at_points import Assembly, Vector, assembly, quotient_at
from disting.network.gears import without_gears
from disting.network.network import Network

Partition = frozenset[frozenset[int]]
Edge = frozenset[int]
MOST_STATES = 5000
REMEMBERED = 1024
APART = 20  # bits: a network has fewer elements than 2^19
Sides = tuple[tuple[int, ...], tuple[int, ...]]


def forests(weights: Mapping[Edge, int], kept: Iterable[int]) -> Mapping[Partition, int] | None:
    """For each way in which the nodes `kept` can be connected the sum, over the spanning forests
    that connect them so and hold no other tree, of the products of their edges' weights; None of a
    graph that has too many states.

    >>> triangle = {frozenset(edge): 1 for edge in ((0, 1), (1, 2), (0, 2))}
    >>> {len(trees): count for trees, count in forests(triangle, [0, 1]).items()}
    {2: 2, 1: 3}
    """
    held, left = frozenset(kept), dict(weights)
    inner = frozenset().union(*left) - held
    states = Counter({frozenset(frozenset([i]) for i in inner | held): 1})
    while inner or left:
        degree = Counter(i for edge in left for i in edge)
        node = min(inner or degree, key=lambda i: (degree[i], i))
        for edge in [edge for edge in left if node in edge]:
            states = _with_edge(states, edge, left.pop(edge))
        if node in inner:
            states, inner = _without(states, node), inner - {node}
        if len(states) > MOST_STATES:
            return None
    return states


def _with_edge(states: Counter[Partition], edge: Edge, weight: int) -> Counter[Partition]:
    """Without the edge and, where that closes no loop, with it."""
    counter = Counter(states)
    for blocks, total in states.items():
        joined = frozenset(block for block in blocks if block & edge)
        if len(joined) > 1:
            counter[blocks - joined | {frozenset().union(*joined)}] += total * weight
    return counter


def _without(states: Counter[Partition], node: int) -> Counter[Partition]:
    """The node forgotten; a tree that holds no other one would end here."""
    counter = Counter[Partition]()
    for blocks, total in states.items():
        (own,) = (block for block in blocks if node in block)
        if len(own) > 1:
            counter[blocks - {own} | {own - {node}}] += total
    return counter


@dataclass(frozen=True, slots=True)
class Counts:
    """Numbers of terms of the coefficients of s^0, s^1, .. of both sides, where none cancel, and
    the largest degree of a term in the values; `size`: the largest sum of the sizes of the numbers
    of a coefficient's terms, which are 1 without known ratios, and `mean` their mean in the leading
    one of D; `free`: the power of s whose coefficient in N, and in D, is a number (None where none
    is).
    """

    num: tuple[int, ...]
    den: tuple[int, ...]
    degree: int
    size: int
    mean: Fraction
    free: tuple[int | None, int | None] = (None, None)

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
    """Those of a network whose terms can be counted and are in lowest terms, as one point shows;
    None of others.
    """
    of = assembly(network, halves)
    geared = any(e.ratio for e in network.elements)
    if of is None or (geared and (without_gears(network) is None or not _sign(of))):
        return None
    counts = _count_assembly(of)
    if counts is None or not any(counts.num) or not any(counts.den):
        return None
    label = about("lowest terms", network.elements, network.ports, network.order, halves)
    modulus = prime(label)
    q = quotient_at(of, residues(f"point:{label}", of.frame.n_values, modulus), modulus)
    places = (e.place for e in of.frame.entries)
    slopes = [(q.num_derivatives[i], q.den_derivatives[i]) for i in places if i is not None]
    kept = (q.num.degree(), q.den.degree()) == counts.degrees
    return counts if kept and all(a or b for a, b in slopes) else None


def _count_assembly(of: Assembly) -> Counts | None:
    """Those of an assembly whose ratios agree; None of one whose terms are not counted, or where
    both sides share the ratio of a gear.
    """
    powers, whole = [e.power for e in of.frame.entries], of
    of = replace(of, frame=of.frame.ungeared, scale=1)
    sides = _digits(of, powers)
    # twice the values that do not divide, once the s of compartments and the ratios
    weights = [1 if e.place is None else 2 * (not e.divides) for e in of.frame.entries]
    ratios = sorted({e.ratio for e in of.frame.entries if e.ratio is not None})
    sized = _digits(of, weights, ratios)
    if sides is None or sized is None:
        return None
    for ratio in ratios:
        alone = _digits(of, [0] * len(weights), [ratio])
        if alone is None or not any(side and side[0] for side in alone):
            return None
    divide, n = sum(e.divides for e in of.frame.entries), of.frame.size
    # of n factors k do not divide: these are left, and the values that divide but for n - k
    degrees = [
        len(side) - 1 + divide - factors
        for side, factors in zip(sized, (n - 1, n), strict=True)
        if side
    ]
    num, den = sides
    sizes = sides if of == whole else _digits(whole, powers) or sides
    directed = any(e.place is None for e in of.frame.entries)
    free = (n - 1 + of.gained, n) if directed else (None, None)
    size, mean = max(map(max, filter(None, sizes))), Fraction(sizes[1][-1], den[-1])
    return Counts((0,) * of.gained + num if num else (), den, max(degrees), size, mean, free)


def _digits(of: Assembly, powers: Sequence[int], ratios: Collection[int] = ()) -> Sides | None:
    """Coefficients of c^T adj P b and det P, all signs left out, with the number s^power for each
    entry and s for some ratios; None where forests cannot be counted.
    """
    sides = _at_ones(of, [1] * len(powers), [1] * of.frame.n_values)
    bits = max(sides).bit_length() if sides else 0
    point = [1 << bits if i in ratios else 1 for i in range(of.frame.n_values)]
    sides = sides and _at_ones(of, [1 << bits * power for power in powers], point)
    if sides is None:
        return None
    mask = (1 << bits) - 1
    num, den = (
        tuple(side >> at & mask for at in range(0, side.bit_length(), bits)) for side in sides
    )
    return num, den


def _at_ones(of: Assembly, terms: Sequence[int], point: Sequence[int]) -> tuple[int, int] | None:
    """c^T adj P b times `scale`, all signs left out, and det P, over the integers."""
    rows, sign = of.frame.rows(terms, point), _sign(of)
    den = int(fmpz_mat(rows).det())
    if not sign:
        num = _crossing(of, terms)
        return None if num is None else (num, den)
    edges = [[0] * of.frame.size for _ in range(2)]
    for edge, port in zip(edges, (of.force, of.sensor), strict=True):
        for i, x in port:
            edge[i] = x
    above = [[*row, x] for row, x in zip(rows, edges[0], strict=True)]
    bordered = fmpz_mat([*above, [*(-x for x in edges[1]), 0]])
    return of.scale * abs(int(bordered.det())), den


def _sign(of: Assembly) -> int:
    """That of all terms of N, where the ports share a node; else 0."""
    (above, below), (plus, minus) = _ends(of.force), _ends(of.sensor)
    if above == plus or below == minus:
        return 1
    return -1 if above == minus or below == plus else 0


def _ends(port: Vector) -> tuple[int, int]:
    """Its nodes, counted from 1, + and -; 0 is the ground."""
    nodes = {x: i + 1 for i, x in port}
    return nodes.get(1, 0), nodes.get(-1, 0)


def _crossing(of: Assembly, terms: Sequence[int]) -> int | None:
    """f(a+ c+ | a- c-) + f(a+ c- | a- c+) of ports that share no node."""
    weights = Counter[Edge]()
    for e, term in zip(of.frame.entries, terms, strict=True):
        weights[frozenset([0, *(i + 1 for i, _ in e.feels)][-2:])] += term
    (above, below), (plus, minus) = _ends(of.force), _ends(of.sensor)
    weight_of = forests(weights, (above, below, plus, minus))
    if weight_of is None:
        return None
    ways = (((above, plus), (below, minus)), ((above, minus), (below, plus)))
    return sum(weight_of.get(frozenset(map(frozenset, way)), 0) for way in ways)
