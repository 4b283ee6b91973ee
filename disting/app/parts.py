"""A machine as the parts that an editor places: masses, joints, forces, sensors; and as the text
that `network_of` reads.

    {"masses": [1, 2], "joints": [{"from": 1, "to": 2, "kind": "both", "ratio": ""}],
     "forces": [[1, 0]], "sensors": [[2, 0]], "quantity": "acceleration"}

A joint is a "spring", a "damper" or "both", from a mass to another one or to the ground, 0; `ratio`
is that of a gear. A force or a sensor is [plus, minus].
"""

from collections.abc import Iterator, Sequence
from itertools import groupby

from disting.app.interface import Json
from disting.errors import InputError
from disting.model.chain import Quantity, Sort
from disting.network.network import Element, Network

SIGNS = {"spring": "~", "damper": "-", "both": "="}
GROUND = "#"
LETTERS = frozenset("mkd")
NO_MASS = "a machine has masses: add one"


def parts_of(network: Network) -> Json | None:
    """Return the parts of a machine; None for a network of another sort, or with other elements.

    >>> from disting.network import network_of
    >>> parts_of(network_of("1=2, 2~#; F1; S2"))["joints"][1]
    {'from': 2, 'to': 0, 'kind': 'spring', 'ratio': ''}
    """
    masses = [e.nodes[0] for e in network.elements if e.letter == "m"]
    is_machine = network.sort is Sort.MACHINE and sorted(masses) == list(network.nodes)
    if not is_machine or not {e.letter for e in network.elements} <= LETTERS:
        return None
    return {
        "masses": sorted(masses),
        "joints": sorted(_joints(network), key=_place),
        "forces": [[p.plus, p.minus] for p in network.inputs],
        "sensors": [[p.plus, p.minus] for p in network.outputs],
        "quantity": list(Quantity)[network.order].value,
    }


def text_of(parts: Json) -> str:
    """Return the text of a machine; raises InputError for a part that is joined with nothing.

    >>> joint = {"from": 1, "to": 2, "kind": "both", "ratio": "i"}
    >>> text_of({"masses": [1, 2], "joints": [joint], "forces": [[1, 0]], "sensors": [[2, 1]]})
    '1=2*i; F1; S2:1'
    """
    _refuse(parts)
    ports = [
        " ".join(f"{letter}{plus or GROUND}" + f":{minus}" * bool(minus) for plus, minus in ends)
        for letter, ends in (("F", parts["forces"]), ("S", parts["sensors"]))
    ]
    quantity = parts.get("quantity", Quantity.ACCELERATION.value)
    shown = [] if quantity == Quantity.ACCELERATION else [quantity]
    return "; ".join(filter(None, [", ".join(_runs(parts["joints"])), *ports, *shown]))


def _joints(network: Network) -> Iterator[Json]:
    """Joints; a spring and a damper between the same ends are one."""
    elements = [e for e in network.elements if e.kind.ends > 1]
    for (ends, ratio, _), same in groupby(sorted(elements, key=_key), key=_key):
        letters = {e.letter for e in same}
        kind = "both" if len(letters) > 1 else "spring" if letters == {"k"} else "damper"
        yield {"from": ends[0], "to": ends[1], "kind": kind, "ratio": ratio}


def _key(e: Element) -> tuple[tuple[int, int], str, bool]:
    """Ends, ratio, and whether it is the damper b1 of a bearing, which has a name of its own."""
    a, b = e.nodes if e.ratio else sorted(e.nodes, key=lambda i: i or float("inf"))
    return (a, b), e.ratio, e.value.startswith("b")


def _place(joint: Json) -> tuple[float, ...]:
    """Order of the joints: by their ends, those to the ground behind the others."""
    low, high = sorted(i or float("inf") for i in (joint["from"], joint["to"]))
    return low, high, joint["kind"] == "damper"


def _runs(joints: Sequence[Json]) -> Iterator[str]:
    """Joints as texts; those that follow each other are one run, as 1=2=3."""
    run, end = "", 0
    for joint in joints:
        start, stop = joint["from"], joint["to"]
        ratio = f"*{joint['ratio']}" if joint["ratio"] else ""
        step = f"{SIGNS[joint['kind']]}{stop or GROUND}{ratio}"
        if run and end == start and end:
            run += step
        else:
            yield from [run] if run else []
            run = f"{start or GROUND}{step}"
        end = stop
    yield from [run] if run else []


def _refuse(parts: Json) -> None:
    """Raise InputError for parts that no text describes."""
    masses = set(parts["masses"])
    if not masses:
        raise InputError(NO_MASS)
    ends = {i for joint in parts["joints"] for i in (joint["from"], joint["to"])}
    ports = {i for side in ("forces", "sensors") for port in parts[side] for i in port}
    unknown = sorted((ends | ports) - masses - {0})
    if unknown:
        raise InputError(f"there is no mass {unknown[0]}: add it, or remove what is joined with it")
    loose = sorted(masses - ends - ports)
    if loose:
        raise InputError(f"mass {loose[0]} is joined with nothing: join it, or remove it")
    for side, word in (("forces", "force"), ("sensors", "sensor")):
        if not parts[side]:
            raise InputError(f"there is no {word}: place one on a mass")
