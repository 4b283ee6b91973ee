"""A star of three elements of one kind as a triangle, and a triangle as a star: bridges and loops
become series and parallel.

With p what each of them adds to P(s) (see `disting.network.network`), and each element of the star
opposite to the one of the triangle that has its name,

    triangle from star: p_a' = p_b p_c / (p_a + p_b + p_c)
    star from triangle: p_a = (p_a' p_b' + p_b' p_c' + p_c' p_a') / p_a'

(A. E. Kennelly, Electrical World 34, 1899): all positive values of the one are those of the other.
"""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

from disting.general.field import Arithmetic
from disting.network.network import Element, Network, join

THREE = 3


@dataclass(frozen=True, slots=True)
class Exchange:
    """The names of three elements, whether 1/p is what each of them adds, and whether a star became
    a triangle.
    """

    names: tuple[str, str, str]
    divides: bool
    was_star: bool

    def widened(self, names: tuple[str, ...]) -> tuple[str, ...]:
        """These names, and all three if one of them is among these."""
        return tuple(sorted({*names, *self.names})) if {*names} & {*self.names} else names

    def back(self, field: Arithmetic, values: Mapping[str, Any]) -> dict[str, Any]:
        """All values before, of those after the exchange."""
        return self._exchange_values(field, values, not self.was_star)

    def forth(self, field: Arithmetic, values: Mapping[str, Any]) -> dict[str, Any]:
        """All values after, of those before the exchange."""
        return self._exchange_values(field, values, self.was_star)

    def _exchange_values(
        self, field: Arithmetic, values: Mapping[str, Any], is_star: bool
    ) -> dict[str, Any]:
        """Of the dual pair, 1/p of triangle and star, the formulas are the same."""
        a, b, c = (values[n] for n in self.names)
        if is_star is self.divides:  # the sum of products over each of them
            whole = field.short(a * b + b * c + c * a)
            new = [whole / x for x in (a, b, c)]
        else:
            whole = field.short(a + b + c)
            new = [x * y / whole for x, y in ((b, c), (c, a), (a, b))]
        return {**values, **dict(zip(self.names, map(field.short, new), strict=True))}


def without_bridges(network: Network) -> tuple[Network, tuple[Exchange, ...]]:
    """The network when each exchange is made that leaves fewer edges once those in series and
    parallel are joined, and the exchanges.

    >>> from disting.network.notation import network_of
    >>> plain, (made,) = without_bridges(network_of("C1 1 2; C2 1 3; R1 2 3; R2 2 0; R3 3 0"))
    >>> made.names, made.was_star, [e.nodes for e in plain.elements[2:]]
    (('R1', 'R2', 'R3'), False, [(4, 0), (4, 3), (4, 2)])
    """
    best = min(_exchange_parts(network), key=lambda made: _edges_left(made[0]), default=None)
    if best is None or _edges_left(best[0]) >= _edges_left(network):
        return network, ()
    plain, more = without_bridges(best[0])
    return plain, (best[1], *more)


def _edges_left(network: Network) -> int:
    held = {i for p in network.ports for i in (p.plus, p.minus)}
    return len(join([(e.nodes, 1) for e in network.elements], held, sum, sum))


def _exchange_parts(network: Network) -> Iterator[tuple[Network, Exchange]]:
    held = {0, *(i for p in network.ports for i in (p.plus, p.minus))}
    at = defaultdict[int, list[Element]](list)
    for e in network.elements:
        for node in _ends(e):
            at[node].append(e)
    for node, star in at.items():
        outer = [i for e in star for i in _ends(e) if i != node]
        if node not in held and len(star) == len(set(outer)) == THREE and _alike(star):
            yield _with(network, star, [tuple(j for j in outer if j != i) for i in outer], True)
    centre = 1 + max(at)
    for three in combinations(network.elements, THREE):
        corners = {i for e in three for i in _ends(e)}
        if len(corners) == THREE == len({_ends(e) for e in three}) and _alike(three):
            new = [(centre, *corners.difference(_ends(e))) for e in three]
            yield _with(network, three, new, False)


def _ends(element: Element) -> frozenset[int]:
    return frozenset((*element.nodes, 0)[:2])


def _alike(three: Sequence[Element]) -> bool:
    """Of one kind, and without gears."""
    return len({(e.power, e.kind.ends, e.ratio) for e in three} | {(three[0].power, 2, "")}) == 1


def _with(
    network: Network, old: Sequence[Element], nodes: Sequence[tuple[int, ...]], was_star: bool
) -> tuple[Network, Exchange]:
    new = {
        e.value: replace(e, nodes=ends if ends[0] else ends[::-1])
        for e, ends in zip(old, nodes, strict=True)
    }
    elements = tuple(new.get(e.value, e) for e in network.elements)
    first, second, third = new
    made = Exchange((first, second, third), old[0].kind.divides, was_star)
    return replace(network, elements=elements), made
