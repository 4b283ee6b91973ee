"""Chains as networks, and networks that are chains: same elements, same names, same ports."""

from disting.errors import ConstraintViolation, InputError
from disting.model.chain import Chain, Sensor
from disting.model.structure import Damper, Mass, Sort, Spring, Structure
from disting.network.element import Element, Port
from disting.network.network import Network


def of_chain(chain: Chain, name: str = "network") -> Network:
    """A chain as a network; raises InputError for a lag or a dead time, which are no elements.

    >>> print(*of_chain(Chain(2, damped=False)).elements, sep=", ")
    m1 1, m2 2, k12 2 1
    """
    if chain.lag or chain.dead_time:
        raise InputError("a lag and a dead time are no elements of a network: leave them away")
    force, sensor = ports_of(chain.structure)
    elements = elements_of(chain.structure)
    return Network(elements, (force,), (sensor,), chain.sensor.order, name)


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
            list(Sensor)[network.order], damped, dampers,
        )  # fmt: skip
    except (ConstraintViolation, InputError):
        return None
    return chain if _content(of_chain(chain)) == _content(network) else None


def _content(network: Network) -> tuple[object, ...]:
    """All but the order of elements and of the ends of joints."""
    elements = {(e.value, e.letter, frozenset(e.nodes), e.ratio) for e in network.elements}
    return elements, network.ports, network.order
