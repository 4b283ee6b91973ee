"""Outflows of compartments that give the same functions: the position of the leaks hardly matters.

Let M be the matrix of the flows, x' = M x + b u, y = c x, flows off its diagonal. What leaves the
compartments is -1^T M, and W M W^-1 with a diagonal W > 0 has the same flows in the graph, other
values, and outflows u = -w^T M over w. So all values of a graph with outflows at the set L come
from matrices M with any diagonal for which w^T = l^T N, N = (-M)^-1 >= 0, is positive for an l that
is positive on L and zero elsewhere, and G_ji is that of M times w_j/w_i, for input i and output j.

THEOREM. Let every output have a way to an outflow. For all values the transfer functions stay the
same ones if (1) the outflow of m is moved to c, where all ways from inputs and outputs to m pass
through c; (2) with one input and one output, that both have an outflow, all others are left out;
(3) with input and output at one compartment all flows between compartments are turned round.
Proof. Every compartment that is seen has a way to an output, so to L, also after a move: w > 0.
(1) N_mp = N_mc N_cp/N_cc for all p at ports, as all ways from p to m pass through c. So l_m and l_c
= l_m N_mc/N_cc give the same w at the ports, and with it the same factors w_j/w_i. (2) The factor
is the sum of l_m N_mj over that of l_m N_mi, a mean of the ratios g_m = N_mj/N_mi with positive
weights. N is the inverse of an M-matrix: N_mi N_ij <= N_mj N_ii and N_mj N_ji <= N_mi N_jj, so g_i
<= g_m <= g_j, and the means are all between g_i and g_j, with others or without. (3) M^T has the
same G_ii; after (1) the outflow, if there is one, is at i, and w_i/w_i = 1.
"""

from collections.abc import Collection

Flows = Collection[tuple[int, int]]


def simplest_outflows(
    flows: Flows, leaky: Collection[int], enter: Collection[int], leave: Collection[int]
) -> set[int]:
    """Compartments whose outflows give the same transfer functions as these, by the theorem.

    >>> sorted(simplest_outflows({(1, 2), (2, 1), (2, 3), (3, 1)}, {2, 3}, {1}, {1}))
    [1]
    """
    if not all({*leaky} & reachable({j}, flows) for j in leave):
        return {*leaky}
    ends = {*enter, *leave}
    nodes = {_find_gate(m, flows, ends) for m in leaky}
    return ends if len(enter) == len(leave) == 1 and ends <= nodes else nodes


def reachable(starts: Collection[int], flows: Flows, without: Collection[int] = ()) -> set[int]:
    """Where flows lead to from some compartments, these too, with others left out."""
    nodes = {*starts} - {*without}
    while more := {j for i, j in flows if i in nodes} - nodes - {*without}:
        nodes |= more
    return nodes


def _find_gate(at: int, flows: Flows, ends: Collection[int]) -> int:
    """The first of the compartments that all ways from the ends to this one pass through."""
    nodes = {i for flow in flows for i in flow} | {at}
    passed = {c for c in nodes if at not in reachable(ends, flows, {c})}
    return next(c for c in passed if c in reachable(ends, flows, passed - {c}))
