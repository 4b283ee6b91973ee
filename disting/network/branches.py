"""One-ports made of branches in series and parallel, and what remains of them when elements are
removed, in any order they are drawn.

The function measured at two nodes is a quotient of sums over spanning trees, with and without an
edge between them, so branches in series may change places: such a one-port is known by its kinds
alone. That what remains is a limit is the theorem of `disting.network.minors`.
"""

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations
from math import comb

from disting.network.network import Element, Network, edges, join, parts

TRIED = 20_000  # ways to take elements away
REMEMBERED = 512
Names = tuple[str, ...]
Join = Callable[[Iterable["Branch"]], "Branch"]


@dataclass(frozen=True, slots=True, order=True)
class Branch:
    """Branches in series ("S") or parallel ("P"), sorted, or an element, by the letter of its
    kind.
    """

    form: str
    inside: tuple["Branch", ...] = ()


def branches(network: Network) -> Branch | None:
    """One-port as measured, as branches in series and parallel in no order; None if it is not
    series-parallel. Equal branches give equal transfer functions, but for the sign of the sensor
    and its derivative, if values are exchanged.

    >>> from disting.network import network_of
    >>> branches(network_of("R0-p(R1,C1)")) == branches(network_of("p(C1,R1)-R0"))
    True
    """
    return _branches(network.grounded.elements, network.grounded, ())


def rest_of(whole: Network, missing: Iterable[str], rigid: Iterable[str]) -> Branch | None:
    """The branches of what is left of a one-port."""
    plain, gone = whole.grounded, {*missing, *rigid}
    by_name = {e.value: e for e in plain.elements}
    if not gone <= by_name.keys():
        return None
    kept = [e for e in plain.elements if e.value not in gone]
    return _branches(kept, plain, [by_name[name] for name in rigid])


def remainder(part: Network, whole: Network) -> tuple[Names, Names] | None:
    """Values of a one-port, missing and rigid, without which it is the part, whatever the order of
    branches in series; None where none are found with bounded work.

    >>> from disting.network import network_of
    >>> remainder(network_of("p(R1,C1)-R0"), network_of("R0-p(R1,C1)-p(R2,C2)"))
    (('R2',), ('C2',))
    """
    own_kind, other_kind = ((n.sort, n.order, n.sign_of_one_port) for n in (part, whole))
    if own_kind != other_kind or not part.sign_of_one_port:
        return None
    form, size = branches(part), len(part.grounded.elements)
    return None if form is None else _rests(whole.grounded, size).get(form)


@lru_cache(maxsize=REMEMBERED)
def _rests(whole: Network, size: int) -> dict[Branch, tuple[Names, Names]]:
    """Construction of each one-port of this number of elements."""
    # the last ones are taken away first
    elements, entries = whole.elements[::-1], dict[Branch, tuple[Names, Names]]()
    less = len(elements) - size
    if less < 1 or comb(len(elements), size) << less > TRIED:
        return entries
    for gone in combinations([e for e in elements if e.value], less):
        kept = [e for e in elements if e not in gone]
        for count in range(less + 1):
            for rigid in combinations(gone, count):
                form = _branches(kept, whole, rigid)
                missing = (e.value for e in gone if e not in rigid)
                if form is not None:
                    entries.setdefault(
                        form, (tuple(sorted(missing)), tuple(sorted(e.value for e in rigid)))
                    )
    return entries


def _branches(
    elements: Iterable[Element], network: Network, rigid: Iterable[Element]
) -> Branch | None:
    """The branches of these elements between the ends of the force, others being rigid; None where
    it is open or shorted, an element has no effect, or two constant phase elements share an
    exponent.
    """
    elements = tuple(elements)
    shared = Counter(e.exponent for e in elements if e.exponent)
    if any(count > 1 for count in shared.values()):
        return None
    roots = parts({0, *network.nodes}, [edge for e in rigid for edge in edges(e)])
    force = network.inputs[0]
    port = frozenset(roots[i] for i in (force.plus, force.minus))
    labelled = [(tuple(roots[i] for i in (*e.nodes, 0)[:2]), Branch(e.letter)) for e in elements]
    if len(port) < 2 or any(i == j for (i, j), _ in labelled):
        return None
    left = join(labelled, port, _in("S"), _in("P"))
    return left[port] if left.keys() == {port} else None


def _in(form: str) -> Join:
    """Branches joined in this form; those inside that are of it already are taken apart."""

    def made(groups: Iterable[Branch]) -> Branch:
        """One of them, or all together."""
        flat = [b for g in groups for b in (g.inside if g.form == form else (g,))]
        return flat[0] if len(flat) == 1 else Branch(form, tuple(sorted(flat)))

    return made
