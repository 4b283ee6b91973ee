"""Compartments as arrows: `1>2, 2>1, 2>0; in 1; out 1`, 0 being the outside, or as paths of them,
`1<>2>0; in 1; out 1`; and as the lists of StructuralIdentifiability.jl: `linear_compartment_model(
[[2], [1]], inputs=[1], outputs=[1], leaks=[2])`, where entry i has the compartments to which i
flows.

The flow from i to j is a_ij times what is in i. Inputs enter compartments, outputs show what is in
them.
"""

import re
from ast import literal_eval
from collections import Counter

from disting.errors import InputError, short
from disting.network.network import Element, Network, Port

CALL = re.compile(r"\s*linear_compartment_model\s*\((.*)\)\s*;?\s*", re.DOTALL)
LISTS = (
    "linear_compartment_model has a list of lists such as [[2], [1]], then inputs=[..],"
    " outputs=[..], leaks=[..]"
)
LIST = re.compile(r"(inputs|outputs|leaks)\s*=\s*(\[[\d\s,]*\])", re.ASCII)
# numbers of up to four digits, as of nodes in files
PORTS = re.compile(r"(in|out)\s+(\d{1,4}(?:\s*,\s*\d{1,4})*)", re.ASCII)
PATH = re.compile(r"\s*\d{1,4}(?:\s*<?>\s*\d{1,4})+\s*", re.ASCII)
ARROW = re.compile(r"(?=(?<!\d)(\d{1,4})\s*(<?>)\s*(\d{1,4}))", re.ASCII)  # each of a path


def compartments(text: str, name: str) -> Network:
    """The network that arrows or lists describe; raises InputError.

    >>> print(*compartments("1>2, 2>1, 2>0; in 1; out 1", "drug").elements, sep=", ")
    v 1, v 2, a12 1 2, a21 2 1, a20 2 0
    >>> path = compartments("1<>2>3>0; in 1; out 3", "")
    >>> path == compartments("1>2, 2>1, 2>3, 3>0; in 1; out 3", "")
    True
    """
    call = CALL.fullmatch(text)
    if call:
        return _of_lists(call[1], name)
    flows, ports = list[tuple[int, int]](), dict[str, list[int]]()
    for part in filter(None, (p.strip() for p in text.split(";"))):
        port = PORTS.fullmatch(part)
        if port:
            ports.setdefault(port[1], []).extend(map(int, port[2].split(",")))
            continue
        for path in part.split(","):
            if not PATH.fullmatch(path):
                raise InputError(
                    f"{short(path.strip())} is no flow: write 1>2, or 2>0 to the outside, then in"
                    " 1; out 1 (out 1, 2 of two)"
                )
            for first, arrow, second in ARROW.findall(path):
                a, b = int(first), int(second)
                flows += [(a, b), (b, a)] if arrow == "<>" else [(a, b)]
    return of_flows(flows, ports.get("in", []), ports.get("out", []), name)


def of_flows(
    flows: list[tuple[int, int]], inputs: list[int], outputs: list[int], name: str
) -> Network:
    """Compartments with these flows (0: the outside), inputs and outputs; raises InputError."""
    for a, b in sorted(flow for flow, times in Counter(flows).items() if times > 1):
        raise InputError(f"the flow from {a} to {b} is there twice: leave one away")
    nodes = sorted({i for flow in flows for i in flow} - {0} | {*inputs, *outputs})
    elements = [Element("", "v", (i,)) for i in nodes]
    elements += [Element(_flow_name(a, b), "a", (a, b)) for a, b in flows]
    ports = [tuple(Port(i) for i in side) for side in (inputs, outputs)]
    return Network(tuple(elements), ports[0], ports[1], name=name)


def space_of_flows(network: Network) -> tuple[list[list[str]], list[list[int]], list[list[int]]]:
    """A, B and C of x' = A x + B u, y = C x, x the contents of the compartments in order.

    >>> space_of_flows(compartments("1>2, 2>0; in 1; out 2", ""))[0]
    [['-a12', '0'], ['+a12', '-a20']]
    """
    nodes = network.nodes
    a = [["" for _ in nodes] for _ in nodes]
    for e in network.elements:
        if e.letter == "a":
            at = nodes.index(e.nodes[0])
            a[at][at] += f"-{e.value}"
            if e.nodes[1]:
                a[nodes.index(e.nodes[1])][at] += f"+{e.value}"
    b = [[int(p.plus == i) for p in network.inputs] for i in nodes]
    c = [[int(p.plus == i) for i in nodes] for p in network.outputs]
    return [[entry or "0" for entry in row] for row in a], b, c


def _flow_name(a: int, b: int) -> str:
    return f"a{a}{b}" if max(a, b) < 10 else f"a{a}_{b}"


def _of_lists(text: str, name: str) -> Network:
    graph = LIST.sub("", text).strip(" ,\n")
    try:
        sides = {key: literal_eval(value) for key, value in LIST.findall(text)}
        lists = literal_eval(graph) if re.fullmatch(r"[][\d\s,]+", graph, re.ASCII) else None
    except (SyntaxError, ValueError):  # two commas, or no comma
        raise InputError(LISTS) from None
    if not isinstance(lists, list) or not all(map(_is_list_of_numbers, lists)):
        raise InputError(LISTS)
    flows = [(i, j) for i, other_value in enumerate(lists, 1) for j in other_value]
    flows += [(i, 0) for i in sides.get("leaks", [])]
    named = {j for _, j in flows}.union(*sides.values())
    if max(named, default=0) > len(lists):
        raise InputError(
            f"{max(named)} is none of the {len(lists)} compartments, which have a list each"
        )
    return of_flows(flows, sides.get("inputs", []), sides.get("outputs", []), name)


def _is_list_of_numbers(value: object) -> bool:
    return isinstance(value, list) and all(isinstance(i, int) for i in value)
