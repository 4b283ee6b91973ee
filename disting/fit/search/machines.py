"""Machines that compete in one fit: chains and networks, with a ground damper at the force."""

from collections.abc import Iterable
from dataclasses import replace

from disting.model.chain import Chain, Sort
from disting.network.chains import of_chain
from disting.network.isomorphism import is_same_network
from disting.network.network import Element, Network


def as_machine(chain: Chain) -> Network:
    """A chain as a network that is called as a machine is written. Raises InputError for a lag or a
    dead time, which are no elements.

    >>> as_machine(Chain(3, ground_dampers=(1,))).name
    '1=2=3, 1-#; F1; S1'
    >>> as_machine(Chain(3, 1, 1, 2, 1, 2, damped=False)).name
    '#~1, 2~3; F2:1; S2:1'
    """
    joint = "=" if chain.damped else "~"
    nodes = ["#", *(str(i) for i in range(1, chain.n_masses + 1))]
    rows = (nodes[: chain.gap + 1], nodes[chain.gap + 1 :])
    joints = [joint.join(row) for row in rows if len(row) > 1]
    joints += [f"{i}-#" for i in chain.ground_dampers]
    force = _port("F", chain.act_plus, chain.act_minus)
    sensor = _port("S", chain.meas_plus, chain.meas_minus)
    parts = [", ".join(joints), force, sensor]
    return of_chain(chain, "; ".join(filter(None, parts)))


def _port(letter: str, plus: int, minus: int) -> str:
    return f"{letter}{plus or '#'}" + (f":{minus}" if minus else "")


def with_ground_damper(networks: Iterable[Network]) -> list[Network]:
    """The networks, and behind each machine whose one force acts on one mass the same with a damper
    from this mass to the ground, unless it has one.

    >>> from disting.network import network_of
    >>> texts = ("F1; S1", "1=2; F2; S1", "1=2; F2:1; S2")
    >>> [n.name for n in with_ground_damper(map(network_of, texts))]
    ['F1; S1', '1-#; F1; S1', '1=2; F2; S1', '1=2, 2-#; F2; S1', '1=2; F2:1; S2']
    """
    whole = list[Network]()
    for network in networks:
        whole.append(network)
        force, *others = network.inputs
        at, name = force.plus, f"b{force.plus}"
        has_one = any(e.letter == "d" and set(e.nodes) == {at, 0} for e in network.elements)
        if network.sort is Sort.MACHINE and at and not (force.minus or others or has_one):
            damper = Element(name, "d", (at, 0))
            text = _with_joint(network.name, f"{at}-#")
            whole.append(replace(network, elements=(*network.elements, damper), name=text))
    return whole


def _with_joint(name: str, joint: str) -> str:
    """The text of a machine with a further joint; of another name with the joint behind it."""
    if name.startswith("F"):
        return f"{joint}; {name}"
    joints, end, ports = name.partition("; F")
    return f"{joints}, {joint}{end}{ports}"


def each_once(networks: Iterable[Network]) -> list[Network]:
    """The networks without those that are an earlier one, up to numbering, with its quantity.

    >>> from disting.network import network_of
    >>> [n.name for n in each_once(map(network_of, ("1=2=3; F1; S1", "1=3, 3=2; F1; S1")))]
    ['1=2=3; F1; S1']
    """
    kept = list[Network]()
    for network in networks:
        if not any(is_same_network(replace(network, order=n.order), n) for n in kept):
            kept.append(network)
    return kept
