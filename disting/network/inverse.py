"""A network at 1/s: springs and inerters, inductors and capacitors are exchanged.

With 1/s for s an element p s^r becomes p s^-r, so P(1/s) = s^-h P'(s), P' of a network whose
elements have the powers h - r: h = 2 of a machine, 0 of a circuit. G(s) = s^q C P^-1 B becomes
s^(h - 2 q) times that of the other network, with the same q. A mass becomes a spring to the ground.
Values are those of the elements, or their inverses (L = 1/C): positive ones remain so. Hence two
networks of one sort and one q have a transfer function in common exactly if those at 1/s have, and
what is true of one pair, of generic values or of all, is true of the other pair.
"""

from collections import Counter

from disting.model.chain import Sort
from disting.network.network import Element, Network
from disting.network.simplest import network_text

TURNED = {
    Sort.MACHINE: {"m": "k", "j": "k", "d": "d", "k": "j"},
    Sort.CIRCUIT: {"R": "R", "L": "C", "C": "L"},
}


def at_inverse(network: Network) -> Network | None:
    """The network whose transfer functions are those of the given one with 1/s for s, but for a
    power of s; None of compartments, and where an element has no counterpart.

    >>> from disting.network.notation import network_of
    >>> at_inverse(network_of("R1-p(L1,C1)")).name
    'R1 1 2, C1 2 0, L1 2 0, in 1 0, out 1 0'
    """
    turned = TURNED.get(network.sort, {})
    if any(e.letter not in turned or e.ratio for e in network.elements):
        return None
    count, elements = Counter[str](), list[Element]()
    for e in network.elements:
        letter = turned[e.letter]
        count[letter] += 1
        elements.append(Element(f"{letter}{count[letter]}", letter, (*e.nodes, 0)[:2]))
    name = network_text(elements, network.inputs, network.outputs)
    return Network(tuple(elements), network.inputs, network.outputs, network.order, name)
