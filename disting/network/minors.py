"""Minors of a network: the networks that remain when elements tend to zero or grow without bound,
as of a graph of which edges are deleted and contracted.

`places` takes nodes of the `whole` to nodes of the `part`, and 0, the ground, to 0. Every element
of the part is met by an element of the whole of its kind, no two by the same one, with its ends
where it has its own, in the same direction where it has a ratio or is a flow. Nodes of the whole at
one node of the part are connected by elements that are not needed. Ports lie at the same places, as
they are or some with both ends exchanged, an even number of times.

Theorem. Then for all parameters of the part, its transfer functions are limits of those of the
whole.

Proof for reciprocal networks. Let elements between nodes at one place grow as 1/e (of a resistor:
fall as e), those that meet an element of the part be it, and all others be e. For real s > 0 every
term p s^r u u^T is positive semidefinite, so the sum C/e of those that grow has the kernel
x_i = y_j for a node i at j, with y_0 = 0: the columns of K. P = P_0 + e P_1 + C/e, and K^T P_0 K is
P(s) of the part, which can be inverted for all but finitely many s. On the orthogonal complement of
the kernel C is positive definite; eliminating the complement shows P^-1 -> K (K^T P_0 K)^-1 K^T.
K^T turns a port at nodes of the whole into one at their places. So for e -> 0 all transfer
functions converge, at infinitely many s.

Proof for flows. Nothing is contracted: `places` gives each compartment of the part one of the
whole. All other flows are e. For e = 0 the matrix P falls apart into that of the part and that of
compartments which no flow connects with it, s for each, and the transfer functions are those of the
part, as they are continuous in e.

Gears of which a ratio is known are elements like others if both have the same ratio; an unknown
ratio of the whole denotes one ratio of the part. Neither is contracted.

An exponent of the whole denotes one exponent of the part, or for 0, 1/2 or 1: a constant phase
element then is a resistor, a Warburg element or a capacitor, P(s) being continuous in it.
"""

from collections import Counter
from collections.abc import Iterator, Mapping
from itertools import islice

from disting.network.network import PHASE, Element, Network, parts

Places = Mapping[int, int]
SPECIAL = {"R": "0", "W": "1/2", "C": "1"}  # exponents with which a P is another element
TRIED = 20_000  # places of a node, in all


def is_minor(part: Network, whole: Network, places: Places) -> bool:
    """Return True if these places make the part a minor of the whole.

    >>> from disting.network import network_of
    >>> is_minor(network_of("R0-C1"), network_of("R0-p(C1,R1)"), {0: 0, 1: 1, 2: 2})
    True
    """
    named = {0, *whole.nodes} == set(places) and {0, *part.nodes} == set(places.values())
    if not named or places.get(0) != 0 or (part.sort, part.order) != (whole.sort, whole.order):
        return False
    return (
        _has_ports(part, whole, places)
        and _meets(part, whole, places) is not None
        and _is_connected(part, whole, places)
    )


def omitted_values(
    part: Network, whole: Network, places: Places
) -> tuple[tuple[str, ...], tuple[str, ...], tuple[tuple[str, str], ...]]:
    """The values of the whole whose elements are missing, those in whose place nodes are connected
    directly, and those of constant phase elements with the exponents that make them others.

    >>> from disting.network import network_of
    >>> one, other = network_of("R0-C1"), network_of("R0-p(C1,R1)-L1")
    >>> omitted_values(one, other, {0: 0, 1: 1, 2: 2, 3: 0})
    (('R1',), ('L1',), ())
    >>> omitted_values(network_of("R0-C1"), network_of("R0-P1"), {0: 0, 1: 1, 2: 2})
    ((), (), (('P1', '1'),))
    """
    met = _meets(part, whole, places) or {}
    kept = {e.value for e in met.values()}
    others = [e for e in whole.elements if e.value and e.value not in kept]
    rigid = [e for e in others if len({places[i] for i in (*e.nodes, 0)[:2]}) == 1]
    rigid = [] if whole.is_directed else rigid
    missing = tuple(sorted(e.value for e in others if e not in rigid))
    letters = {e.value or str(e.nodes): e.letter for e in part.elements}
    special = {e.value: SPECIAL[letters[n]] for n, e in met.items() if _is_special(letters[n], e)}
    return missing, tuple(sorted(e.value for e in rigid)), tuple(sorted(special.items()))


def _is_special(letter: str, met: Element) -> bool:
    return met.letter == PHASE != letter


def minors(part: Network, whole: Network) -> Iterator[dict[int, int]]:
    """Yield places that make the part of the whole, as far as they are found with bounded work."""
    fewer = len(whole.elements) - len(part.elements)
    less = fewer > 0 or (fewer == 0 and len(part.exponents) < len(whole.exponents))
    if not less or part.shape != whole.shape:
        return
    for start in _port_places(part, whole):
        order = sorted(set(whole.nodes) - start.keys())
        for places in islice(_extend_places(part, whole, start, order), TRIED):
            if is_minor(part, whole, places):
                yield places


def _port_places(part: Network, whole: Network) -> Iterator[dict[int, int]]:
    """Yield the places of the nodes of ports, port by port, with their ends either way."""
    rows: list[dict[int, int]] = [{0: 0}]
    for mine, port in zip(whole.ports, part.ports, strict=True):
        ways = [((mine.plus, port.plus), (mine.minus, port.minus))]
        ways.append(((mine.plus, port.minus), (mine.minus, port.plus)))
        rows = [
            places | dict(way)
            for places in rows
            for way in ways
            if all(places.get(i, at) == at for i, at in way)
        ]
    yield from rows


def _has_ports(part: Network, whole: Network, places: Places) -> bool:
    """Return True if ports lie at those of the part, with an even number of exchanges on every path
    from an input to an output.
    """
    signs = []
    for mine, port in zip(whole.ports, part.ports, strict=True):
        at = places[mine.plus], places[mine.minus]
        if at not in ((port.plus, port.minus), (port.minus, port.plus)):
            return False
        signs.append(at == (port.plus, port.minus))
    return len(set(signs)) == 1


def _extend_places(
    part: Network, whole: Network, places: dict[int, int], order: list[int]
) -> Iterator[dict[int, int]]:
    """Yield all ways to place the nodes that have none."""
    if not order:
        yield places
        return
    node, *rest = order
    lacking = {*part.nodes} - set(places.values())
    if len(lacking) > len(order):
        return
    used = set(places.values()) if whole.is_directed else set()
    near = {
        places[j]
        for e in whole.elements
        if node in e.nodes
        for j in (e.nodes if len(e.nodes) > 1 else (node, 0))
        if j != node and j in places
    }
    later = set(order)
    tied = any(node in e.nodes and set(e.nodes) & later - {node} for e in whole.elements)
    choices = {*lacking, *(set(places.values()) if tied else near)} - used
    if whole.is_directed:
        choices |= {0}
    for at in sorted(choices):
        yield from _extend_places(part, whole, places | {node: at}, rest)


def _meets(part: Network, whole: Network, places: Places) -> dict[str, Element] | None:
    """For each element of the part one of the whole, by name; None if there are too few."""
    free: dict[tuple[object, ...], list[Element]] = {}
    for e in whole.elements:
        free.setdefault(_mark(e, places), []).append(e)
    chosen, named, own = dict[str, Element](), dict[str, str](), {i: i for i in (0, *part.nodes)}
    for e in part.elements:
        letter, *ends = _mark(e, own)
        phase = free.get((PHASE, *ends), []) if letter in SPECIAL else []
        for mine in (*free.get((letter, *ends), []), *phase):
            if _agree(e, mine, named):
                free[_mark(mine, places)].remove(mine)
                chosen[e.value or str(e.nodes)] = mine
                break
        else:
            return None
    return chosen


def _agree(e: Element, mine: Element, named: dict[str, str]) -> bool:
    """Return True if a ratio or an exponent of the whole, which is one number, can be that of the
    part; `named` records the assignment.
    """
    wanted = {mine.ratio: e.ratio} if e.known_ratio is None else {}
    if mine.exponent:
        wanted |= {mine.exponent: e.exponent or SPECIAL[e.letter]}
    return all(named.setdefault(name, value) == value for name, value in wanted.items())


def _mark(e: Element, places: Places) -> tuple[object, ...]:
    """Key that elements must share to be matched: kind, ends, whether there is a ratio."""
    at = tuple(places[i] for i in e.nodes)
    plain = not e.ratio and e.letter != "a"
    return e.letter, tuple(sorted(at)) if plain else at, e.known_ratio


def _is_connected(part: Network, whole: Network, places: Places) -> bool:
    """Return True if the nodes at each place are one body; a compartment is alone, except those
    outside, which are not checked.
    """
    if whole.is_directed:
        alone = Counter(at for at in places.values() if at)
        return all(count == 1 for count in alone.values())
    inside = [
        (i, j)
        for e in whole.elements
        if not e.ratio
        for i, j in [(e.nodes[0], e.nodes[1] if len(e.nodes) > 1 else 0)]
        if places[i] == places[j]
    ]
    roots = parts(places, inside)
    return all(roots[i] == roots[j] for i in places for j in places if places[i] == places[j])
