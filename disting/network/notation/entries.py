"""Networks as entries of JSON files: as a text, as lists of flows, as lists of elements.

    {"circuit": "R0-p(R1,C1)"}, {"machine": "1=2=3, 2=4; F1; S4"}, {"network": ".."} in any notation
    {"flows": [[1, 2], [2, 1], [1, 0]], "input": 1, "output": 1}
    {"elements": [["m1", 1], ["k12", 1, 2], ["d12", 1, 2, "i"]], "force": [1, 0], "sensor": [2, 0]}
    {"elements": [["R1", 0, 1], ["L1", 0, 2]], "port": [1, 0]}
    {"components": [..], "structure": [..], "force": "Motor.Rotor", "sensor": ..} of openTorsion

The first letter of a name gives the kind of an element, a text after its nodes the ratio of its
gear, or the exponent of a constant phase element (two may share one); a compartment is ["v", 1];
node 0 is the ground, a port is [plus, minus] or a list of such.
"""

from collections.abc import Mapping
from typing import Any

from disting.errors import InputError, enumeration, of_type, short
from disting.model.chain import Quantity, Sort, as_quantity
from disting.network.network import KINDS, Element, Network, Port, kind_of
from disting.network.notation import DIALECTS, NOTATIONS, network_of
from disting.network.notation.compartments import of_flows
from disting.network.notation.torsion import drive_train

FORMS = {
    "circuit": ("circuit", "notation"),
    "machine": ("machine", "quantity"),
    "network": ("network", "notation", "quantity"),
    "flows": ("flows", "input", "output"),
    "elements": ("elements", "force", "sensor", "port", "quantity"),
    "components": ("components", "structure", "force", "sensor", "quantity", "date"),
}  # by the key that an entry of this form always has: all its keys
Entry = Mapping[str, Any]


def network_of_entry(entry: Entry, name: str) -> Network:
    """The network that an entry describes; raises InputError."""
    quantity = as_quantity(entry.get("quantity", Quantity.ACCELERATION.value))
    notation = of_type(entry.get("notation", ""), str, '"notation" is a text')
    for key in ("circuit", "machine", "network"):
        if key in entry:
            text = of_type(entry[key], str, f'"{key}" is a text')
            network = network_of(text, _notation(key, notation), name=name, quantity=quantity)
            if key == "circuit" and network.sort is not Sort.CIRCUIT:
                raise InputError(f'{short(text)} is not a circuit: write it as "network"')
            return network
    if "components" in entry:
        return drive_train(entry, name).network
    return _of_flows(entry, name) if "flows" in entry else _of_elements(entry, name, quantity)


def entry_of(network: Network) -> dict[str, object]:
    """A network as an entry that `network_of_entry` reads back as it was."""
    if network.is_directed:
        flows = [list(e.nodes) for e in network.elements if e.letter == "a"]
        ports = {
            "input": [p.plus for p in network.inputs],
            "output": [p.plus for p in network.outputs],
        }
        made: dict[str, object] = {"flows": flows, **ports}
        if _is_read_back(made, network):
            return made
    elements = [
        [e.value or e.letter, *e.nodes, *(text for text in (e.ratio, e.exponent) if text)]
        for e in network.elements
    ]
    inputs, outputs = ([[p.plus, p.minus] for p in ps] for ps in (network.inputs, network.outputs))
    if network.sort is Sort.CIRCUIT and inputs == outputs:
        return {"elements": elements, "port": inputs}
    quantity = list(Quantity)[network.order].value
    return {"elements": elements, "force": inputs, "sensor": outputs, "quantity": quantity}


def _is_read_back(entry: Entry, network: Network) -> bool:
    """Return True if the entry is this network: a list of flows has no two equal ones, and no names
    for them.
    """
    try:
        return network_of_entry(entry, network.name) == network
    except InputError:
        return False


def _notation(key: str, notation: str) -> str:
    if key == "machine":
        return "machine"
    names = (*DIALECTS, "spice") if key == "circuit" else NOTATIONS
    if notation and notation not in names:
        raise InputError(f'"notation" is one of {enumeration(names)}, not {short(notation)}')
    return notation


def _of_flows(entry: Entry, name: str) -> Network:
    flows = of_type(entry["flows"], list, '"flows" is a list of pairs such as [1, 2]')
    pairs = []
    for flow in flows:
        if not isinstance(flow, list) or len(flow) != 2:
            raise InputError(
                f"a flow is a pair such as [1, 2], or [2, 0] to the outside, not {short(flow)}"
            )
        pairs.append((_node(flow[0]), _node(flow[1])))
    ports = []
    for key in ("input", "output"):
        value = entry.get(key, [])
        ports.append([_node(i) for i in (value if isinstance(value, list) else [value])])
    return of_flows(pairs, ports[0], ports[1], name)


def _of_elements(entry: Entry, name: str, quantity: Quantity) -> Network:
    lists = of_type(entry["elements"], list, '"elements" is a list such as [["m1", 1]]')
    elements = tuple(map(_element, lists))
    if "port" in entry:
        foreign = enumeration(f'"{key}"' for key in ("force", "sensor", "quantity") if key in entry)
        if foreign:
            raise InputError(f'"port" is both input and output: remove {foreign}')
        ports = _ports(entry["port"])
        return Network(elements, ports, ports, name=name)
    sides = [_ports(entry.get(key, [])) for key in ("force", "sensor")]
    machine = bool(elements) and elements[0].kind.sort is Sort.MACHINE
    return Network(elements, sides[0], sides[1], quantity.order if machine else 0, name)


def _element(entry: object) -> Element:
    if not isinstance(entry, list) or len(entry) < 2 or not isinstance(entry[0], str):
        raise InputError(
            'an element is a list of a name and its nodes, such as ["k12", 1, 2], not'
            f" {short(entry)}"
        )
    name, *rest = entry
    kind = KINDS["v"] if name == "v" else kind_of(name)
    more = rest.pop() if len(rest) > kind.ends else ""
    phase = kind.letter == "P"
    if not isinstance(more, str) or len(rest) != kind.ends:
        what = 'its exponent, such as "n"' if phase else 'the ratio of a gear, such as "i"'
        nodes = f"two nodes behind it, then perhaps as a text {what}"
        nodes = "one node behind it" if kind.ends == 1 else nodes
        raise InputError(f"{short(name)} is a {kind.word}: write {nodes}")
    value = "" if kind.letter == "v" else name
    places = tuple(map(_node, rest))
    if phase:
        return Element(value, kind.letter, places, exponent=more)
    return Element(value, kind.letter, places, more)


def _ports(value: object) -> tuple[Port, ...]:
    if not isinstance(value, list):
        value = [value]
    each = value if any(isinstance(p, list) for p in value) else [value] if value else []
    ports = []
    for port in each:
        ends = port if isinstance(port, list) else [port]
        if len(ends) not in (1, 2):
            raise InputError(f"a port is [plus, minus], such as [1, 0], not {short(port)}")
        ports.append(Port(*map(_node, ends)))
    return tuple(ports)


def _node(value: object) -> int:
    """A number as JSON has it, or as the text of one."""
    text = str(value)
    if isinstance(value, bool) or not text.isascii() or not text.isdecimal() or len(text) > 4:
        raise InputError(f"nodes are whole numbers, 0 for the ground, not {short(value)}")
    return int(text)
