"""Chains as networks, and networks that are chains: in the chain's own names, or in others."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from disting.errors import ConstraintViolation, InputError
from disting.model.chain import Chain, Damper, GroundDamper, Mass, Quantity, Sort, Spring, Structure
from disting.model.names import name_of
from disting.model.presentation import AS_CHAIN
from disting.network.network import Element, Network, Port


def of_chain(chain: Chain, name: str = "network") -> Network:
    """A chain as a network; raises InputError for a lag or a dead time, which are no elements.

    >>> print(*of_chain(Chain(2, damped=False)).elements, sep=", ")
    m1 1, m2 2, k12 2 1
    """
    if chain.lag or chain.dead_time:
        raise InputError("networks do not support lag and dead time: remove them")
    force, sensor = ports_of(chain.structure)
    elements = elements_of(chain.structure)
    return Network(elements, (force,), (sensor,), chain.quantity.order, name)


def elements_of(structure: Structure) -> tuple[Element, ...]:
    """The elements of a structure as those of a network."""
    elements = []
    for e in structure.elements:
        nodes = (e.at,) if isinstance(e, Mass) else (e.at, 0)
        if isinstance(e, Spring | Damper):
            nodes = (e.at + 1, e.at)
        elements.append(Element(e.parameter, "d" if e.kind == "b" else e.kind, nodes))
    return tuple(elements)


def ports_of(structure: Structure) -> tuple[Port, Port]:
    """Where its force and its sensor are."""
    at = structure.ports
    return Port(at.act_plus, at.act_minus), Port(at.meas_plus, at.meas_minus)


def as_chain(network: Network) -> Chain | None:
    """The chain that a network is, in the chain's own names; None if it is none of the class.

    >>> as_chain(of_chain(Chain(3))) == Chain(3)
    True
    """
    if network.sort is not Sort.MACHINE or network.shape != (1, 1):
        return None
    n = len(network.nodes)
    joints = {max(e.nodes) - 1 for e in network.elements if e.value[:1] == "k"}
    gaps = sorted(set(range(n)) - joints)
    force, sensor = network.ports
    dampers = tuple(e.nodes[0] for e in network.elements if e.value[:1] == "b")
    damped = not joints or any(e.value[:1] == "d" for e in network.elements)
    if len(gaps) != 1:
        return None
    try:
        chain = Chain(
            n, gaps[0], force.minus, force.plus, sensor.minus, sensor.plus,
            list(Quantity)[network.order], damped, dampers,
        )  # fmt: skip
    except (ConstraintViolation, InputError):
        return None
    return chain if _content(of_chain(chain)) == _content(network) else None


def _content(network: Network) -> tuple[object, ...]:
    """All but the order of elements and of the ends of joints."""
    elements = {(e.value, e.letter, frozenset(e.nodes), e.ratio) for e in network.elements}
    return elements, network.ports, network.order


@dataclass(frozen=True, slots=True)
class RenamedChain:
    """A chain, and what its parameters are called in a network, by their names in the chain."""

    chain: Chain
    names: dict[str, str]

    def note(self, name: str) -> str:
        """Note of a verdict on the network of that name on its parameters, "" where the chain has
        the same names.
        """
        pairs = [f"{own} is {other}" for own, other in self.names.items() if own != other]
        chain = name_of(self.chain)
        return f"{AS_CHAIN} {chain}: {', '.join(pairs)} of {name}" if pairs else ""


def as_renamed_chain(network: Network) -> RenamedChain | None:
    """Return the chain that a network is, whatever its masses and parameters are called; None if it
    is none of the class.

    >>> from disting.network import network_of
    >>> found = as_renamed_chain(network_of("3=1=2; F3; S1"))
    >>> name_of(found.chain), found.names["k12"], found.names["m1"]
    ('3:2', 'k13', 'm3')
    """
    if network.sort is not Sort.MACHINE or network.shape != (1, 1):
        return None
    if any(e.letter not in "mdk" or e.known_ratio != 1 for e in network.elements):
        return None
    found = [_read_as_chain(network, places) for places in _numberings(network)]
    chains = [renamed for renamed in found if renamed]
    # of both directions the one that the catalogue has
    return min(chains, key=lambda renamed: name_of(renamed.chain).startswith("("), default=None)


def _numberings(network: Network) -> Iterator[dict[int, int]]:
    """Yield the numberings under which the springs join neighbours: first the masses from the
    ground on, then the free ones from either end.
    """
    near: dict[int, list[int]] = {i: [] for i in (0, *network.nodes)}
    for element in network.elements:
        if element.letter == "k":
            a, b = element.nodes
            near[a].append(b)
            near[b].append(a)
    grounded = _walk(near, 0)
    free = [i for i in near if i not in grounded]
    ends = [i for i in free if len(near[i]) <= 1]
    for path in [_walk(near, end) for end in ends] or [[]]:
        order = [*grounded, *path]
        if sorted(order) == sorted(near):
            yield {old: new for new, old in enumerate(order)}


def _walk(near: dict[int, list[int]], start: int) -> list[int]:
    path = [start]
    while more := [i for i in near[path[-1]] if i not in path]:
        path.append(more[0])
    return path


def _read_as_chain(network: Network, places: dict[int, int]) -> RenamedChain | None:
    """Return the chain that it is in these numbers, if it is one."""
    moved = [replace(e, nodes=tuple(places[i] for i in e.nodes)) for e in network.elements]
    joints = {frozenset(e.nodes) for e in moved if e.letter == "k"}
    own = [_own_name(e, joints) for e in moved]
    if not all(own) or len(set(own)) < len(own) or len({e.value for e in moved}) < len(own):
        return None
    elements = tuple(replace(e, value=name) for e, name in zip(moved, own, strict=True))
    force, sensor = (Port(places[p.plus], places[p.minus]) for p in network.ports)
    chain = as_chain(Network(elements, (force,), (sensor,), network.order, network.name))
    names = {name: e.value for name, e in zip(own, moved, strict=True)}
    return None if chain is None else RenamedChain(chain, names)


def _own_name(element: Element, joints: set[frozenset[int]]) -> str:
    """Return what a chain calls the element at this place, "" where it has none."""
    at, *others = sorted(element.nodes)
    if element.letter == "m":
        return Mass(at).parameter
    if element.letter == "k":
        return Spring(at).parameter
    if frozenset(element.nodes) in joints:
        return Damper(at).parameter
    return "" if at else GroundDamper(others[0]).parameter
