"""Undamped machines with force and sensor each at one mass: the places of springs to the ground.

THEOREM. Let springs join all masses, let some springs go to the ground, and let the force and the
sensor be at one mass each, both against the ground. The machine gives the same functions whatever
the masses are at which springs go to the ground.
Proof. With M = D^2, D = diag(d), and L = D^-1 K D^-1 it is G_ij = s^q (s^2 + L)^-1_ij/(d_i d_j). L
is symmetric and positive definite; its entries off the diagonal are negative where springs are
between masses, else 0. The springs to the ground are K 1 = D L d. Conversely let such an L be
given. All entries of its inverse are positive, as springs join all masses (an M-matrix). Choose
any g that is positive at the masses in question and 0 at the others: d = t L^-1 g is positive for
each t > 0. Then M = D^2 and K = D L D are a machine with these L, with springs between the same
masses, and with springs K 1 = t D g to the ground where g is positive. The number t makes d_i d_j
any positive number. So all these machines give the functions c s^q (s^2 + L)^-1_ij of all such L
and all c > 0. No values are excepted.
"""

from itertools import count

from disting.network.network import Element, Network, parts


def is_undamped(network: Network) -> bool:
    """Return True if it is made of a mass at each node, and springs, and all of them are seen."""
    masses = [e.nodes for e in network.elements if e.letter == "m"]
    return (
        sorted(masses) == [(i,) for i in network.nodes]
        and {e.letter for e in network.elements} == {"m", "k"}
        and len(network.elements) == len(network.seen)
        and not any(e.ratio for e in network.elements)
        and network.shape == (1, 1)
    )


def grounded_everywhere(network: Network) -> Network | None:
    """The machine of the theorem with a spring to the ground at each mass; None of any other.

    >>> from disting.network.notation import network_of
    >>> some, other = map(network_of, ("#~1, 1~2, 1~3; F1; S2", "#~2, #~3, 1~2, 1~3; F1; S2"))
    >>> grounded_everywhere(some) == grounded_everywhere(other)
    True
    """
    nodes = network.nodes
    ends = [(*e.nodes, 0)[:2] for e in network.elements if e.letter == "k"]
    inner = sorted({(min(pair), max(pair)) for pair in ends if 0 not in pair})
    if (
        not is_undamped(network)
        or not any(0 in pair for pair in ends)
        or not all(0 in (p.plus, p.minus) for p in network.ports)
        or len(set(parts(nodes, inner).values())) != 1
    ):
        return None
    number = count(1)
    springs = [
        Element(f"k{next(number)}", "k", pair) for pair in (*inner, *((i, 0) for i in nodes))
    ]
    masses = [Element(f"m{i}", "m", (i,)) for i in nodes]
    return Network((*masses, *springs), network.inputs, network.outputs, network.order)
