"""Families of networks: all machines, circuits or graphs of compartments of a kind, each once, by
the text that a person would write for it.

    machines-2, machines-3    springs between any masses and to the ground, one at least at every
                              mass; force and sensor between any two nodes; in lowest terms as many
                              poles as two for each mass
    trees-4                   four masses joined as a tree, with at most one spring to the ground
    circuits-4, circuits-5    one-ports of R, L and C with up to so many elements, at most two of
                              them L or C, no two like ones side by side: series, parallel, bridges
    cells-4                   one-ports of R, C and W with up to four elements, no bridges
    cells-5                   R in series with up to four more of R, C, W and P, no bridges: at most
                              three of them C, W or P, one W, two P
    compartments-2, -3        flows in any direction and to the outside; every compartment is
                              reached from the input and reaches the output

With -damped behind it, machines have a damper beside every spring. Machines are counted up to their
numbering and the exchange of force and sensor (reciprocity), circuits up to the order of what
commutes, compartments up to their numbering.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache, partial
from itertools import combinations, combinations_with_replacement, permutations, product
from operator import mul

from disting.algebra.symbols import symbols
from disting.errors import InputError, enumeration, short
from disting.model.chain import Sensor
from disting.network.expansion import transfer_functions
from disting.network.network import Network
from disting.network.notation import network_of
from disting.network.outflows import reachable

Edge = tuple[int, int]
DAMPED = "-damped"
VALUES = (7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71, 73, 79, 83)


@dataclass(frozen=True, slots=True)
class NetworkFamily:
    """Networks by name, in order; `source` yields the texts.

    >>> family_of("circuits-4").networks[:2]
    (<Network: R1, circuit, 1 node, R1>, <Network: L1, circuit, 1 node, L1>)
    """

    name: str
    title: str
    source: Callable[[], Iterable[str]]

    @property
    def networks(self) -> tuple[Network, ...]:
        """All of them."""
        return _read(self.source)


@cache
def _read(source: Callable[[], Iterable[str]]) -> tuple[Network, ...]:
    return tuple(network_of(text) for text in source())


def family_of(name: str) -> NetworkFamily:
    """The family of that name; raises InputError."""
    if name not in FAMILIES:
        raise InputError(f"families of networks are {enumeration(FAMILIES)}, not {short(name)}")
    return FAMILIES[name]


def machines(
    masses: int, joint: str, edges: Callable[[int], Iterable[Sequence[Edge]]]
) -> list[str]:
    """Texts of all machines with these sets of edges, up to numbering and reciprocity."""
    texts = dict[tuple[object, ...], str]()
    for joints in edges(masses):
        for force, sensor in product(combinations(range(masses + 1), 2), repeat=2):
            form = _form(masses, joints, force, sensor)
            if form not in texts and _is_whole(masses, joints, force, sensor):
                texts[form] = _machine(joints, force, sensor, joint)
    return list(texts.values())


def springs_anywhere(masses: int) -> Iterator[Sequence[Edge]]:
    """Yield the sets of springs between nodes, 0 being the ground, that leave no mass alone."""
    pairs = list(combinations(range(masses + 1), 2))
    for count in range(1, len(pairs) + 1):
        for chosen in combinations(pairs, count):
            if set(range(1, masses + 1)) <= {i for edge in chosen for i in edge}:
                yield chosen


def trees(masses: int) -> Iterator[Sequence[Edge]]:
    """Yield the trees of masses, free and with one spring to the ground."""
    pairs = list(combinations(range(1, masses + 1), 2))
    for chosen in combinations(pairs, masses - 1):
        if len(_connected(1, chosen)) == masses:
            yield chosen
            yield from ((*chosen, (0, i)) for i in range(1, masses + 1))


def _connected(start: int, edges: Sequence[Edge]) -> set[int]:
    nodes = {start}
    while more := {j for e in edges if nodes & set(e) for j in e} - nodes:
        nodes |= more
    return nodes


def _form(masses: int, joints: Sequence[Edge], force: Edge, sensor: Edge) -> tuple[object, ...]:
    """The smallest of what renumbering and exchange of the ports make of it."""
    forms = []
    for order in permutations(range(1, masses + 1)):
        at = (0, *order)
        a, b, *rest = (tuple(sorted((at[i], at[j]))) for i, j in (force, sensor, *joints))
        forms.append((tuple(sorted(rest)), *sorted((a, b))))
    return min(forms)


def _is_whole(masses: int, joints: Sequence[Edge], force: Edge, sensor: Edge) -> bool:
    """Whether the transfer function of positions has two poles for each mass, seen at one choice of
    values: at special ones it can have fewer, never more.
    """
    s = symbols(["s"])["s"]
    try:
        network = network_of(_machine(joints, force, sensor, "~"), quantity=Sensor.POSITION)
        values = {p: s**0 * x for p, x in zip(network.parameters, VALUES, strict=False)}
        (((num, den),),) = transfer_functions(network, {"s": s, **values}, "s", mul)
    except InputError:
        return False
    common = num.gcd(den)
    return not num.is_zero() and den.degrees()[0] - common.degrees()[0] == 2 * masses


def _machine(joints: Sequence[Edge], force: Edge, sensor: Edge, joint: str) -> str:
    runs = [f"{'#' if a == 0 else a}{joint}{b}" for a, b in joints]
    ends = [
        f"{letter}{b}" + (f":{a}" if a else "") for letter, (a, b) in (("F", force), ("S", sensor))
    ]
    return f"{', '.join(runs)}; {'; '.join(ends)}"


Tree = str | tuple[str, tuple["Tree", ...]]
"""A kind of element, or "S" or "P" and the parts in series or parallel."""


def circuits(most: int, kinds: str, most_reactive: int) -> list[str]:
    """Texts of the one-ports with up to so many elements, of which so many are L or C."""
    texts = [_circuit(t) for t in _all_trees(most, kinds) if _of(t, "LC") <= most_reactive]
    return [*texts, *(_bridges(kinds, most_reactive) if most >= len(BRIDGE) else ())]


def cells(most: int) -> list[str]:
    """Texts of what is fitted to the impedance of cells: the resistance of electrolyte and wires,
    in series with what stores charge or lets it diffuse, and the resistances in between.
    """
    bounds = {"CWP": 3, "W": 1, "P": 2}
    return [
        _circuit(tree)
        for tree in _all_trees(most, "RCWP")
        if (tree == "R" or (tree[0] == "S" and "R" in tree[1]))
        and all(_of(tree, kinds) <= count for kinds, count in bounds.items())
    ]


def _all_trees(most: int, kinds: str) -> Iterator[Tree]:
    for count in range(1, most + 1):
        yield from dict.fromkeys((*_trees(count, "S", kinds), *_trees(count, "P", kinds)))


@cache
def _trees(count: int, top: str, kinds: str) -> tuple[Tree, ...]:
    """Circuits of so many elements that are parts in series (or parallel), each once."""
    if count == 1:
        return tuple(kinds)
    other = "P" if top == "S" else "S"
    pairs = []
    for sizes in _partitions(count, count - 1):
        pools = []
        for size, times in sorted(Counter(sizes).items()):
            choose = combinations if size == 1 else combinations_with_replacement
            pools.append(list(choose(_trees(size, other, kinds), times)))
        pairs += [
            (top, tuple(part for group in chosen for part in group)) for chosen in product(*pools)
        ]
    return tuple(pairs)


def _partitions(count: int, most: int) -> Iterator[tuple[int, ...]]:
    if count == 0:
        yield ()
    for first in range(min(count, most), 0, -1):
        yield from ((first, *rest) for rest in _partitions(count - first, first))


def _letters(tree: Tree) -> str:
    return tree if isinstance(tree, str) else "".join(map(_letters, tree[1]))


def _of(tree: Tree, kinds: str) -> int:
    """How many elements are of these kinds."""
    return sum(letter in kinds for letter in _letters(tree))


def _circuit(tree: Tree) -> str:
    count = Counter[str]()

    def written(part: Tree) -> str:
        """A part, its elements numbered as they come."""
        if isinstance(part, str):
            count[part] += 1
            return f"{part}{count[part]}"
        parts = list(map(written, part[1]))
        return "-".join(parts) if part[0] == "S" else f"p({','.join(parts)})"

    return written(tree)


BRIDGE = ((1, 2), (1, 3), (2, 3), (2, 0), (3, 0))  # between the ends 1 and 0 of the port
TWINS = ((0, 1, 2, 3, 4), (1, 0, 2, 4, 3), (3, 4, 2, 0, 1), (4, 3, 2, 1, 0))


def _bridges(kinds: str, most_reactive: int) -> Iterator[str]:
    """Yield the bridges of five elements, each once; one of one kind alone is a single element."""
    names = set[str]()
    for chosen in product(kinds, repeat=len(BRIDGE)):
        form = min("".join(chosen[i] for i in twin) for twin in TWINS)
        if form in names or _of(form, "LC") > most_reactive or len(set(form)) == 1:
            continue
        names.add(form)
        count, lines = Counter[str](), []
        for kind, (a, b) in zip(form, BRIDGE, strict=True):
            count[kind] += 1
            lines.append(f"{kind}{count[kind]} {a} {b}")
        yield "; ".join(lines)


def compartments(count: int) -> list[str]:
    """Texts of the graphs of so many compartments with one input and one output."""
    arrows = [(i, j) for i in range(1, count + 1) for j in range(count + 1) if i != j]
    entries = dict[tuple[object, ...], str]()
    for size in range(len(arrows) + 1):
        for flows in combinations(arrows, size):
            for enter, leave in product(range(1, count + 1), repeat=2):
                form = min(
                    (sorted((at[i], at[j]) for i, j in flows), at[enter], at[leave])
                    for order in permutations(range(1, count + 1))
                    for at in [(0, *order)]
                )
                key = (tuple(form[0]), *form[1:])
                back = [(j, i) for i, j in flows]
                ahead, behind = (reachable({i}, f, {0}) for i, f in ((enter, flows), (leave, back)))
                if key not in entries and len(ahead) == len(behind) == count:
                    phrase = ", ".join(f"{i}>{j}" for i, j in key[0])
                    entries[key] = f"{phrase}; in {key[1]}; out {key[2]}"
    return list(entries.values())


def _families() -> Iterator[NetworkFamily]:
    for n, edges, name in (
        (2, springs_anywhere, "machines"),
        (3, springs_anywhere, "machines"),
        (4, trees, "trees"),
    ):
        for joint, behind, damping in (("~", "", "undamped"), ("=", DAMPED, "damped")):
            what = "springs anywhere" if name == "machines" else "joined as a tree"
            title = f"Machines of {n} masses, {what}, {damping}"
            yield NetworkFamily(f"{name}-{n}{behind}", title, partial(machines, n, joint, edges))
    for most in (4, 5):
        title = f"Circuits of R, L and C with up to {most} elements, at most two of them L or C"
        yield NetworkFamily(f"circuits-{most}", title, partial(circuits, most, "RLC", 2))
    title = "Cells: circuits of R, C and W with up to 4 elements"
    yield NetworkFamily("cells-4", title, partial(circuits, 4, "RCW", 4))
    title = "Cells: R in series with up to 4 of R, C, W and P, at most three of them C, W or P"
    yield NetworkFamily("cells-5", title, partial(cells, 5))
    for n in (2, 3):
        title = f"{n} compartments with one input and one output"
        yield NetworkFamily(f"compartments-{n}", title, partial(compartments, n))


FAMILIES = {family.name: family for family in _families()}
