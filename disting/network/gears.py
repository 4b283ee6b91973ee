"""Gears as a change of units: a machine whose ratios agree does what it does without its gears.

THEOREM. Let there be numbers h_i with h_i = g h_j for every element between nodes i and j of ratio
g (1 without a gear), the same for the nodes of all forces, and for those of all sensors. Then the
machine gives the transfer functions that it gives without gears; h_i > 0, as ratios are, so that
positive values go with positive ones. Proof. With x_i = h_i y_i an element feels x_i - g x_j = h_i
(y_i - y_j), one to the ground h_i y_i: so y moves as without gears, with values p_e h_i^2 and
forces times h, and sensors show h y. The product of both h is a number: all values divided by it
remove it.

Ratios agree in a tree, and in loops around which their product is 1. An unknown ratio that agrees
can be any number: these ports do not determine it.
"""

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

from disting.errors import InputError
from disting.network.network import Element, Network

Height = tuple[Fraction, tuple[int, ...]]
"""h_i: a number, times powers of the unknown ratios."""


def without_gears(network: Network) -> Network | None:
    """The machine without its gears, which gives the same transfer functions; None where ratios do
    not agree, ports keep them apart, or the casings of gears are all that holds a part.

    >>> from disting.network.notation import network_of
    >>> [str(e) for e in without_gears(network_of("1~2*5/2, 2~3*i; F1; S3")).elements]
    ['m1 1', 'm2 2', 'm3 3', 'k12 1 2', 'k23 2 3']
    >>> without_gears(network_of("1~2*3, 2~3, 3~1; F1; S3"))
    """
    if not any(e.ratio for e in network.elements):
        return network
    heights = _heights(network)
    if heights is None:
        return None
    for ports in (network.inputs, network.outputs):
        if len({heights[i] for port in ports for i in port.ends}) != 1:
            return None
    try:
        return replace(network, elements=tuple(replace(e, ratio="") for e in network.elements))
    except InputError:
        return None


def units(network: Network) -> dict[str, Height]:
    """By how much the values differ without gears, by name: a number, times powers of the unknown
    ratios in order. Ratios agree.

    >>> from disting.network.notation import network_of
    >>> {n: str(x) for n, (x, _) in units(network_of("1~2*5/2; F1; S2")).items()}
    {'m1': '5/2', 'm2': '2/5', 'k12': '5/2'}
    """
    heights = _heights(network)
    if heights is None or not any(e.ratio for e in network.elements):
        return {}
    ports = network.inputs[0], network.outputs[0]
    (a, m), (b, n) = (heights[next(iter(port.ends))] for port in ports)
    units_of = dict[str, Height]()
    for e in network.elements:
        number, powers = heights[next(filter(None, e.nodes))]
        unit = number**2 / (a * b)
        steps = tuple(2 * k - i - j for k, i, j in zip(powers, m, n, strict=True))
        if e.kind.divides:
            unit, steps = 1 / unit, tuple(-k for k in steps)
        units_of[e.value] = unit, steps
    return units_of


def unknown_ratios(network: Network) -> list[str]:
    """Their names, sorted."""
    return sorted({e.ratio for e in network.elements if e.known_ratio is None})


def _heights(network: Network) -> dict[int, Height] | None:
    """The h_i of all nodes, 1 at one of each part; None where there are none."""
    unknown = unknown_ratios(network)
    links = [link for e in network.seen for link in _links(e, unknown)]
    heights: dict[int, Height] = {}
    for start in network.nodes:
        todo = [] if start in heights else [start]
        heights.setdefault(start, (Fraction(1), (0,) * len(unknown)))
        while todo:
            number, powers = heights[i := todo.pop()]
            for a, b, ratio, steps in links:
                if a == i:
                    other = number * ratio, tuple(map(sum, zip(powers, steps, strict=True)))
                    if b not in heights:
                        todo.append(b)
                    if heights.setdefault(b, other) != other:
                        return None
    return heights


def _links(e: Element, unknown: list[str]) -> Iterator[tuple[int, int, Fraction, tuple[int, ...]]]:
    """Yield how the heights of both its nodes follow from each other."""
    if e.kind.ends == 1 or 0 in e.nodes:
        return
    i, j = e.nodes
    ratio = Fraction(1) if e.known_ratio is None else e.known_ratio
    steps = tuple(int(name == e.ratio) for name in unknown)
    yield j, i, ratio, steps
    yield i, j, 1 / ratio, tuple(-step for step in steps)
