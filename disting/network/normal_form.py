"""Networks that give the same transfer functions for all positive values, special ones aside, as
they are made of parts that can replace each other.

Parts. A part is a one-port: elements between two nodes that nothing else touches inside. An element
has the compliance (a circuit's: the impedance) 1/(p s^r). Let a part be of two kinds, A with the
smaller r, B with the larger one (of constant phase elements in any order: with A and B exchanged
x becomes 1/x, and K(n, c, z) K(n, z, c)), in series and parallel in any order. With x = s^(r_B -
r_A) its compliance is s^(-r_A) F(x), F made of constants k (A) and of k/x (B) by sums and H -> 1/(x
H).

THEOREM (Foster, Cauer). K(n, c, z) is the set of F = [k] + [k_0/x] + sum of n terms k_i/(x + a_i),
positive, a_i distinct, the first term there if c, the second one if z. All parts with the same n,
c, z give all of K(n, c, z), and for generic values nothing else. Proof, by the number of elements.
An element is K(0, 1, 0) or K(0, 0, 1). In series F is the sum over the branches: generic branches
share no a_i, so their n add up, and c, z are there if a branch has them. Conversely give of F in K
each branch as many terms as its n, any ones, and a share of k and of k_0 to each branch that has
such a term: each share is all that a branch can be, by the induction. In parallel the same holds
for 1/(x F), which is in K(n + c + z - 1, not c, not z): F falls strictly between its poles, so it
has one zero there, one more left of all poles if c, and none else; at a zero -b the residue of 1/(x
F) is 1/(-b F'(-b)) > 0.

Replacement. Values of different parts are chosen independently. So networks give the same transfer
functions if they are the same graph with the same sets of compliances at its edges, whatever the
rest is. A series of parts of three kinds is known by its single elements (several ones of a kind
are one), by how many terms k/(x + a) of each two kinds it has, and by the parts of three kinds in
it; in parallel likewise. Potentials enter as differences, so that the ground is a node like any
other; parts in series can be exchanged; a reciprocal network may exchange force and sensor.

Compartments. A compartment b with flows to and from i only, and perhaps to the outside, hangs at i,
and so does a tree of such ones. It adds a (1 - Q) to the diagonal of P at i: a the flow from i, Q
the share that has come back, Q = sum q_j/(s + l_j) of as many terms as there are compartments, q_j
and l_j positive, Q(0) = 1 without an outflow, Q(0) < 1 with some.
THEOREM. All trees with as many compartments, with or without outflows, give all such a (1 - Q), and
several that hang at i, and an outflow of i, together are one. Proof. Q = C G with C = sum q_j, and
1/G = s + e - H with e > 0 and H = sum h_j/(s + m_j) of one term less, positive, by the theorem
above. Share the terms of H among the branches by their sizes; so on: this gives a symmetric matrix
S on the tree, G = ((s - S)^-1)_bb. Its eigenvalues are -l_j < 0, its entries at edges are positive,
so all entries of (-S)^-1 are. Let t be C at b, positive at compartments with an outflow, 0
elsewhere, and w = (-S)^-1 t, with sizes such that w_b = G(0) C + .. = Q(0) + .. = 1: then A = W S
W^-1, W = diag(w), has the same G, positive flows at the edges, and what leaves i of the column sums
is -t_i/w_i: the flow C from b back to i, and the outflows. For several trees at i split a Q into
groups of terms; one without outflow takes a_b = a times the value of its group at 0, what is left
of a goes to those with an outflow, or to the outflow of i.
"""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import lru_cache

from disting.network.network import Network, join
from disting.network.outflows import simplest_outflows

REMEMBERED = 4096  # networks
Power = tuple[int, str]
"""Of s: 2 r, and the exponent of a constant phase element, which is added to r."""
Count = tuple[tuple[tuple[Power, Power], int], ...]
"""Number of terms and their two kinds, in order."""


@dataclass(frozen=True, slots=True, order=True)
class Part:
    """A part in series ("S") or parallel ("P"): the powers r of its single elements, its terms of
    two kinds, and parts of three kinds or more, written out. `spare`: how many of the terms may be
    missing at special values, where they fall together with others.
    """

    form: str
    single: tuple[Power, ...]
    terms: Count = ()
    others: tuple["Part", ...] = ()
    spare: Count = ()

    @property
    def kinds(self) -> set[Power]:
        """Powers of all that is in it."""
        inside = {r for pair, _ in self.terms for r in pair}
        return {*self.single, *inside, *(r for part in self.others for r in part.kinds)}

    @property
    def generic(self) -> "Part":
        """Generic part, without special values."""
        return replace(self, others=tuple(sorted(p.generic for p in self.others)), spare=())


@dataclass(frozen=True, slots=True)
class NormalForm:
    """A graph with parts at its edges, or compartments with what hangs at them."""

    edges: tuple[tuple[int, int, object], ...]
    nodes: tuple[tuple[int, object], ...]


@lru_cache(maxsize=REMEMBERED)
def normal_form(network: Network) -> NormalForm | None:
    """Normal form in which parts and hanging trees are named by the functions they can have; None
    for a network with gears.
    """
    if network.is_directed:
        return _of_compartments(network)
    exact = exact_form(network)
    if exact is None:
        return None
    return NormalForm(tuple((a, b, part.generic) for a, b, part in exact), ())


def exact_form(network: Network) -> tuple[tuple[int, int, Part], ...] | None:
    """The parts between nodes, with what they can be at special values too; None of compartments,
    and of a network with gears.
    """
    if network.is_directed or any(e.ratio for e in network.elements):
        return None
    labelled = [(e.nodes, Part("S", (e.power,))) for e in network.seen]
    kept = {i for p in network.ports for i in (p.plus, p.minus)}
    edges = join(labelled, kept, in_series, in_parallel)
    listed = (tuple(sorted(ends)) for ends in edges)
    return tuple((a, b, edges[frozenset((a, b))]) for a, b in sorted(listed))


def in_series(parts: Iterable[Part]) -> Part:
    """Parts one after the other."""
    return _join_parts("S", parts)


def in_parallel(parts: Iterable[Part]) -> Part:
    """Parts side by side."""
    return _join_parts("P", parts)


def _join_parts(form: str, parts: Iterable[Part]) -> Part:
    single, others = set[Power](), list[Part]()
    most, least = Counter[tuple[Power, Power]](), Counter[tuple[Power, Power]]()
    for part in parts:
        inside = part if part.form == form or len(part.single) == 1 == len(part.kinds) else None
        if inside is None and len(part.kinds) == 2:
            inside = dual(part)
        if inside is None:
            others.append(part)
        else:
            single |= set(inside.single)
            most.update(dict(inside.terms))
            least |= Counter(dict(inside.terms)) - Counter(dict(inside.spare))
            others += inside.others
    terms, spare = (tuple(sorted(count.items())) for count in (most, most - least))
    made = Part(form, tuple(sorted(single)), terms, tuple(sorted(others)), spare)
    return dual(made) if form == "P" and len(made.kinds) == 2 else _single(made)


def _single(part: Part) -> Part:
    """One element is in series and in parallel alike."""
    return Part("S", part.single) if len(part.kinds) == 1 else part


def dual(part: Part) -> Part:
    """A part of two kinds from series to parallel, or back: K(n, c, z) is, of 1/(x F), the set
    K(n + c + z - 1, not c, not z). Of F the constant is the kind of the smaller power, of 1/(x F),
    whose terms are side by side, that of the larger one.
    """
    low, high = sorted(part.kinds)
    count = dict(part.terms).get((low, high), 0) + len(part.single) - 1
    single = [r for r, other in ((low, high), (high, low)) if other not in part.single]
    terms = (((low, high), count),) if count else ()
    return Part("P" if part.form == "S" else "S", tuple(sorted(single)), terms, spare=part.spare)


def _of_compartments(network: Network) -> NormalForm:
    """Trees that hang at a compartment become a number and whether something flows out of them."""
    flows = {(e.nodes[0], e.nodes[1]) for e in network.seen if e.letter == "a"}
    kept = {p.plus for p in network.ports}
    nodes = {e.nodes[0] for e in network.seen}
    hanging = dict.fromkeys(nodes, 0)
    leaky = dict.fromkeys(nodes, False)
    # what flows to compartments that are not seen is lost
    lost = {i for i, j in flows if j not in nodes}
    flows = {(i, j) for i, j in flows if j in nodes}
    enter, leave = ({p.plus for p in ports} for ports in (network.inputs, network.outputs))
    for i in simplest_outflows(flows, lost, enter, leave):
        leaky[i] = True
    while True:
        at = next((i for i in sorted(nodes - kept) if _hangs(i, flows)), None)
        if at is None:
            break
        (near,) = {j for i, j in flows if i == at}
        hanging[near] += hanging.pop(at) + 1
        leaky[near] = leaky[near] or leaky.pop(at)
        nodes, flows = nodes - {at}, flows - {(at, near), (near, at)}
    return NormalForm(
        tuple((i, j, "flow") for i, j in sorted(flows)),
        tuple((i, (hanging[i], leaky[i])) for i in sorted(nodes)),
    )


def _hangs(at: int, flows: set[tuple[int, int]]) -> bool:
    """Return True if it has flows to and from one compartment only."""
    out, back = {j for i, j in flows if i == at}, {i for i, j in flows if j == at}
    return len(out) == 1 and out == back
