"""Drive trains as openTorsion writes them: components of disks, shafts and gears, and which element
of one component the next one is joined to. Force and sensor, which it lacks, are given separately.

    {"components": [{"name": "Motor", "elements": [
       {"name": "Rotor", "type": "Disk", "inertia": 2, "damping": 0},
       {"name": "Shaft", "type": "ShaftDiscrete", "stiffness": 500, "damping": 1},
       {"name": "Wheel", "type": "GearElement", "inertia": 1, "teeth": 20}]}, ..],
     "structure": [["Motor.Wheel", "Load.Pinion"]], "force": "Motor.Rotor", "sensor": "Load.Table"}

Elements of a component follow one another. A disk turns with the node where it sits, its damping is
against the ground; a shaft leads to a new node; a gear behind a gear, or whose "parent" another one
is, meshes with it, and turns the other way. Teeth, diameter or radius give the ratio.

Gears that mesh are rigid: of their nodes one remains, x = f x_root for the others. So inertias
behind a gear belong to the root, times f^2, and a shaft feels x_i - f x_j, as a joint with a gear.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from disting.errors import InputError, enumeration, of_type, short
from disting.model.chain import Sensor, as_sensor
from disting.network.network import Element, Network, Port, parts
from disting.network.notation.machine import joint_name

TYPES = ("Disk", "ShaftDiscrete", "GearElement")
SIZES = ("teeth", "diameter", "radius")  # of a gear: one of them
Entry = Mapping[str, Any]
Factor = tuple[int, Fraction]
"""A root, and x over x_root: negative behind one gear."""
Key = tuple[str, int, int, Fraction]
"""Letter, nodes, ratio."""
ONE = Fraction(1)
LARGEST = 1e30
LONGEST = 30  # characters of a number


@dataclass(frozen=True, slots=True)
class DriveTrain:
    """Content of a file: the machine, and the values of its elements."""

    network: Network
    values: dict[str, float]


@dataclass(frozen=True, slots=True)
class _Part:
    """A disk, a shaft or a gear between two places, which are one for disks and gears."""

    given: Entry
    start: int
    end: int

    @property
    def is_gear(self) -> bool:
        return bool(self.given["type"] == "GearElement")


@dataclass(slots=True)
class _Places:
    """State of the parser while components are read: parts by name, and places that are one."""

    named: dict[str, _Part] = field(default_factory=dict)
    parts: list[_Part] = field(default_factory=list)
    joined: list[tuple[int, int]] = field(default_factory=list)
    meshing: list[tuple[_Part, _Part]] = field(default_factory=list)
    count: int = 0

    def new(self) -> int:
        """A place that nothing is at yet."""
        self.count += 1
        return self.count


def drive_train(data: Entry, name: str) -> DriveTrain:
    """The machine of a file; raises InputError.

    >>> rotor, load = ({"name": n, "type": "Disk", "inertia": 2} for n in ("Rotor", "Load"))
    >>> shaft = {"type": "ShaftDiscrete", "stiffness": 500}
    >>> axis = {"name": "Axis", "elements": [rotor, shaft, load]}
    >>> ports = {"force": "Axis.Rotor", "sensor": "Axis.Load"}
    >>> found = drive_train({"components": [axis], **ports}, "")
    >>> print(*found.network.elements, found.values, sep=", ")
    m1 1, m2 2, k12 1 2, {'m1': 2.0, 'm2': 2.0, 'k12': 500.0}
    """
    built = _Places()
    components: Any = data.get("components")
    for component in of_type(components, list, '"components" is a list'):
        _read(component, built)
    for pair in of_type(data.get("structure", []), list, '"structure" is a list of pairs'):
        _connect(pair, built)
    nodes = parts(range(1, built.count + 1), built.joined)
    force, sensor = (nodes[_at(data.get(side), side, built).start] for side in ("force", "sensor"))
    factors = _factors(nodes, built, (force, sensor))
    senses = _senses(nodes, built, factors)
    roots = (factors[nodes[place]][0] for part in built.parts for place in (part.start, part.end))
    numbers = {root: at for at, root in enumerate(dict.fromkeys(roots), 1)}
    sizes = _sizes(built, nodes, factors, numbers)
    elements = _elements(sizes)
    ports = []
    for root, f in (factors[force], factors[sensor]):
        ends = (numbers[root], 0)
        ports.append((Port(*(ends if f * senses[root] > 0 else ends[::-1])),))
    order = as_sensor(data.get("quantity", Sensor.ACCELERATION.value)).order
    values = {e.value: float(size) for e, size in zip(elements, sizes.values(), strict=True)}
    return DriveTrain(Network(tuple(elements), ports[0], ports[1], order, name), values)


def _read(component: Any, built: _Places) -> None:
    """Add the elements of a component, one behind the other."""
    value = of_type(component, dict, "a component is an object with a name and elements")
    name, elements = value.get("name"), value.get("elements")
    place, before = built.new(), list[_Part]()
    for at, entry in enumerate(of_type(elements, list, '"elements" is a list'), 1):
        called = f"{name}.{entry.get('name', at)}" if isinstance(entry, dict) else f"{name}.{at}"
        if not isinstance(entry, dict) or entry.get("type") not in TYPES:
            raise InputError(_foreign(called, entry))
        parent = entry.get("parent")
        meshes = before[-1] if before and before[-1].is_gear else None
        if parent is not None:
            meshes = _look_up(f"{name}.{parent}", built)
        is_gear = entry["type"] == "GearElement"
        start = built.new() if is_gear and meshes is not None else place
        place = built.new() if entry["type"] == "ShaftDiscrete" else start
        part = _Part({**entry, "called": called}, start, place)
        if is_gear and meshes is not None:
            built.meshing.append((meshes, part))
        if called in built.named:
            raise InputError(f"{called} is the name of two elements: give each its own name")
        built.named[called] = part
        built.parts.append(part)
        before.append(part)


def _foreign(called: str, entry: object) -> str:
    kind = entry.get("type") if isinstance(entry, dict) else entry
    if kind == "ShaftContinuous":
        return f"{called} has its inertia along the shaft: describe it by disks and ShaftDiscrete"
    return f"{called} is of type {short(kind)}: types are {enumeration(TYPES)}"


def _connect(pair: object, built: _Places) -> None:
    """Join the end of one element with the start of another one; two gears mesh."""
    if not isinstance(pair, list) or len(pair) != 2 or not all(isinstance(x, str) for x in pair):
        raise InputError(
            f'a connection is a pair such as ["Motor.Rotor", "Load.Disk"], not {short(pair)}'
        )
    first, second = (_look_up(name, built) for name in pair)
    if first.is_gear and second.is_gear:
        built.meshing.append((first, second))
    else:
        built.joined.append((first.end, second.start))


def _look_up(name: str, built: _Places) -> _Part:
    if name not in built.named:
        raise InputError(f"{short(name)} is no element; there are {enumeration(built.named)}")
    return built.named[name]


def _at(name: object, side: str, built: _Places) -> _Part:
    """The disk or gear where force or sensor is."""
    turning = [n for n, part in built.named.items() if part.given["type"] != "ShaftDiscrete"]
    if not isinstance(name, str) or name not in turning:
        instead = "" if name is None else f", not {short(name)}"
        raise InputError(
            f'say where the {side} is, as "{side}": one of {enumeration(turning)}{instead}'
        )
    return built.named[name]


def _factors(nodes: Mapping[int, int], built: _Places, wanted: Sequence[int]) -> dict[int, Factor]:
    """For every node the root of the gears that mesh there, one with a port if there is any, and
    its motion over that of the root.
    """
    near: dict[int, list[tuple[int, Fraction]]] = {node: [] for node in nodes.values()}
    for parent, child in built.meshing:
        a, b, ratio = nodes[parent.start], nodes[child.start], -_size(parent) / _size(child)
        near[a].append((b, ratio))
        near[b].append((a, 1 / ratio))
    entries = dict[int, Factor]()
    for root in (*wanted, *list(near)):
        todo = [] if root in entries else [(root, Fraction(1))]
        while todo:
            at, f = todo.pop()
            if entries.setdefault(at, (root, f)) != (root, f):
                raise InputError("gears that mesh in a ring do not turn: open the ring")
            todo += [(other, f * ratio) for other, ratio in near.pop(at, ())]
    if any(abs(entries[node][1]) != 1 for node in wanted):
        raise InputError(
            "force and sensor are at two gears that mesh, so that one moves as the other one: name"
            " one of them for both"
        )
    return entries


def _senses(
    nodes: Mapping[int, int], built: _Places, factors: Mapping[int, Factor]
) -> dict[int, int]:
    """For every root the sense, 1 or -1, in which its motion counts, so that both ends of a shaft
    count alike.
    """
    near: dict[int, list[tuple[int, int]]] = {root: [] for root, _ in factors.values()}
    for part in built.parts:
        (a, f), (b, g) = (factors[nodes[place]] for place in (part.start, part.end))
        turned = 1 if f * g > 0 else -1
        if a != b:
            near[a].append((b, turned))
            near[b].append((a, turned))
    senses = dict[int, int]()
    for first in list(near):
        todo = [] if first in senses else [(first, 1)]
        while todo:
            at, sense = todo.pop()
            if senses.setdefault(at, sense) != sense:
                raise InputError("shafts and gears close a ring that cannot turn: open the ring")
            todo += [(other, sense * turned) for other, turned in near.pop(at, ())]
    return senses


def _size(gear: _Part) -> Fraction:
    name = next((key for key in SIZES if key in gear.given), "")
    if not name:
        raise InputError(f"{gear.given['called']} is a gear: give its {' or '.join(SIZES)}")
    return _number(gear, name, positive=True)


def _number(part: _Part, key: str, *, positive: bool = False) -> Fraction:
    """A size as it is written; 0 where it is missing."""
    value = part.given.get(key, 0)
    try:
        size = -1.0 if isinstance(value, bool) else float(value)
    except (TypeError, ValueError):
        size = -1.0
    # of longer texts and farther powers the fraction would have too many digits
    is_number = size == 0 or (1 / LARGEST < size < LARGEST and len(str(value)) <= LONGEST)
    if not is_number or (positive and not size):
        wanted = "a positive number" if positive else "a number, zero or positive"
        raise InputError(f"{key} of {part.given['called']} is {wanted}, not {short(value)}")
    return Fraction(str(value)) if size else Fraction(0)


def _sizes(
    built: _Places, nodes: Mapping[int, int], factors: Mapping[int, Factor], at: Mapping[int, int]
) -> dict[Key, Fraction]:
    """Of all elements of the network, by letter, nodes and ratio: side by side they are one; masses
    come first.
    """
    values = dict[Key, Fraction]()
    for part in built.parts:
        (a, f), (b, g) = (factors[nodes[place]] for place in (part.start, part.end))
        damping, inertia = _number(part, "damping"), _number(part, "inertia")
        if part.given["type"] != "ShaftDiscrete":
            sizes = {("m", at[a], 0, ONE): inertia * f**2, ("d", at[a], 0, ONE): damping * f**2}
        elif inertia:
            raise InputError(f"{part.given['called']} has an inertia: add half of it to both disks")
        elif a == b:
            raise InputError(f"{part.given['called']} joins two gears that mesh: open the ring")
        else:
            (i, f), (j, g) = sorted(((at[a], f), (at[b], g)))
            stiffness = _number(part, "stiffness", positive=True)
            ends = (i, j, abs(g / f))
            sizes = {("k", *ends): stiffness * f**2, ("d", *ends): damping * f**2}
        for key, size in sizes.items():
            values[key] = values.get(key, Fraction(0)) + size
    ordered = sorted(values, key=lambda key: ("mkd".index(key[0]), *key[1:]))
    return {key: values[key] for key in ordered if values[key]}


def _elements(sizes: Mapping[Key, Fraction]) -> list[Element]:
    made = []
    for letter, a, b, ratio in sizes:
        name = f"{'b' if letter == 'd' else letter}{a}" if not b else joint_name(letter, a, b)
        places = (a,) if letter == "m" else (a, b)
        made.append(Element(name, letter, places, "" if ratio == 1 else str(ratio)))
    return made
