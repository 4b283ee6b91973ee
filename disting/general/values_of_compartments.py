"""Values of compartments that form a tree, with exchange both ways and one outflow at most, from
the transfer function of one of them to itself.

Let d_i be the sum of all flows out of i, and p_ij the product of those from i to j and back. Behind
i, away from the port, 1/G_i = s + d_i - sum p_ij G_j over the compartments j next to it. Let G_i =
N/D with leading coefficients 1: d_i is the difference of the next ones, and the terms of s + d_i -
D/N are shared among the branches by their sizes, as among those in series (see `synthesis`). Then
the flows follow from the ends of the tree towards the compartment with the outflow: all but one out
of a compartment are known, and their sum is d_i. All are positive for positive values (see
`disting.network.normal_form`).
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from typing import Any

from disting.general.field import Arithmetic, Poly
from disting.general.matrix_model import Model
from disting.general.synthesis import FieldValues, NoFormulas, share_terms
from disting.network.network import Network

NO_TREE = "they are not made of parts that replace each other"


@dataclass(frozen=True, slots=True)
class Subtree:
    """A compartment with those behind it."""

    node: int
    inside: tuple["Subtree", ...]

    @property
    def count(self) -> int:
        """Total number of compartments."""
        return 1 + sum(h.count for h in self.inside)

    @property
    def shape(self) -> tuple[object, ...]:
        """No two are alike: the place of the outflow distinguishes them."""
        return (self.node,)


@dataclass(slots=True)
class Sums:
    """Flows out of compartments, and products of flows both ways."""

    out: dict[int, Any]
    both: dict[frozenset[int], Any]


def values_of_tree(field: Arithmetic, model: Model, network: Network) -> Iterator[FieldValues]:
    """Yield the values of all flows, for each way to share terms; raises NoFormulas."""
    flows, leaks = _flows(network)
    (enter,), (show,) = network.inputs, network.outputs
    if enter != show or len(leaks) > 1:
        raise NoFormulas(NO_TREE)
    tree = _hanging(enter.plus, 0, {i: [j for a, j in flows if a == i] for i, _ in flows})
    top, bottom = (
        tuple(field.short(field.lifted(c)) for c in side)
        for side in (model.numerator, model.denominator)
    )
    if len(bottom) - 1 != tree.count or len(top) != tree.count:
        raise NoFormulas("both do not give functions of one set")
    end = next(iter(leaks), enter.plus)
    for sums in _sums(field, tree, top, bottom):
        flow_values = dict[tuple[int, int], Any]()
        left = _flow(field, flow_values, sums, flows, end, 0)
        values = {flows[ends]: x for ends, x in flow_values.items()}
        yield values | ({leaks[end]: left} if leaks else {})


def _flows(network: Network) -> tuple[dict[tuple[int, int], str], dict[int, str]]:
    """Names of flows by their ends, and of outflows; raises NoFormulas where they are no tree."""
    every = [(e.nodes[0], e.nodes[1], e.value) for e in network.elements if e.letter == "a"]
    flows = {(i, j): name for i, j, name in every if j}
    leaks = {i: name for i, j, name in every if not j}
    if len(flows) + len(leaks) < len(every) or any((j, i) not in flows for i, j in flows):
        raise NoFormulas(NO_TREE)
    if len(flows) != 2 * (len(network.nodes) - 1):
        raise NoFormulas(NO_TREE)
    return flows, leaks


def _hanging(at: int, before: int, near: dict[int, list[int]]) -> Subtree:
    return Subtree(at, tuple(_hanging(j, at, near) for j in near.get(at, ()) if j != before))


def _sums(field: Arithmetic, tree: Subtree, top: Poly, bottom: Poly) -> Iterator[Sums]:
    """Yield d_i and p_ij of a compartment and of all behind it, from G_i times any number."""
    above, below = ([field.short(c / side[-1]) for c in side] for side in (top, bottom))
    out = below[-2] - above[-2] if len(above) > 1 else below[-2]
    out = field.short(out)
    rest = field.plus((field.zero, *above), tuple(above), out)  # (s + d) N
    rest = field.plus(rest, tuple(below), -field.one)[: len(above) - 1]
    branches = [(at, h, h.count) for at, h in enumerate(tree.inside)]
    for terms in share_terms(field, branches, rest, tuple(above)):
        inner_sums = [list(_sums(field, h, *terms[at])) for at, h, _ in branches]
        for chosen in product(*inner_sums):
            sums = Sums({tree.node: out}, {})
            for (at, h, _), this_sums in zip(branches, chosen, strict=True):
                high, low = (side[-1] for side in terms[at])
                sums.both[frozenset((tree.node, h.node))] = field.short(high / low)
                sums.out |= this_sums.out
                sums.both |= this_sums.both
            yield sums


def _flow(
    field: Arithmetic,
    entries: dict[tuple[int, int], Any],
    sums: Sums,
    flows: dict[tuple[int, int], str],
    at: int,
    towards: int,
) -> Any:
    """Part of d_i without the flows to all neighbours but one, once these are found."""
    left = sums.out[at]
    for i, j in flows:
        if i == at and j != towards:
            entries[j, at] = _flow(field, entries, sums, flows, j, at)
            entries[at, j] = field.short(sums.both[frozenset((at, j))] / entries[j, at])
            left = left - entries[at, j]
    return field.short(left)
