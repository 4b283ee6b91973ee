"""Circuits as netlists, as SPICE has them: `R1 1 2; L1 2 0; C1 2 0; port 1 0`.

A line is an element with its two nodes; values behind them are of no meaning for a structure. The
port is said by `port 1 0`, or by a source (V or I) between its nodes; else it is from node 1 to 0.
Lines end with a semicolon or where the text does.
"""

import re

from disting.errors import InputError, shown
from disting.network.element import Element, Port
from disting.network.network import Network

LINE = re.compile(r"([RLCWP]\w*)\s+(\w+)\s+(\w+)(?:\s+\S+)*", re.ASCII)
PORT = re.compile(r"(?:port|[VI]\w*)\s+(\w+)\s+(\w+)(?:\s+\S+)*", re.ASCII | re.IGNORECASE)


def netlist(text: str, name: str) -> Network:
    """The one-port of a netlist; raises InputError.

    >>> netlist("R1 in 2; C1 2 0; port in 0", "filter").inputs
    (Port(plus=1, minus=0),)
    """
    elements, ports, numbers = [], [], {"0": 0, "gnd": 0, "GND": 0}
    for line in filter(None, (part.strip() for part in re.split(r"[;\n]", text))):
        if line.startswith("*") or line.lower().startswith(".end"):
            continue
        port, element = PORT.fullmatch(line), LINE.fullmatch(line)
        found = port or element
        if found is None:
            raise InputError(
                f"{shown(line)} is no line of a netlist: write R, L, C, W or P, a number and two"
                " nodes, as in R1 1 2, or port 1 0"
            )
        *_, a, b = (
            numbers.setdefault(node, len(set(numbers.values()))) for node in found.groups()[-2:]
        )
        if port:
            ports.append(Port(a, b))
        else:
            elements.append(Element(found[1], found[1][0], (a, b)))
    if len(set(ports)) > 1:
        raise InputError("a netlist has one port: leave the other port and the sources away")
    if not ports and "1" not in numbers:
        raise InputError("no port is said and there is no node 1: add a line such as port in 0")
    where = (ports[0] if ports else Port(numbers["1"]),)
    return Network(tuple(elements), where, where, name=name)
