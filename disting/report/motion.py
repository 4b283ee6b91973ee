"""A page where two machines of a catalogue move side by side under one force.

The page computes everything itself: the parameters of the second machine from those of the first,
both motions and both Bode diagrams (templates motion-*.js). It is given what it cannot work out:
the models, the verdicts over positive parameters, and the parts of the drawings.

Two machines of a list have such a page where all are made of masses, springs and dampers: trees and
loops as chains. Masses move to the left and to the right, and are in columns by their distance from
the force; two of a column that are joined are half a column apart. Their rows are those in which
the fewest joints cross or pass a third mass.
"""

from cmath import phase
from collections.abc import Iterator, Sequence
from itertools import combinations, count, cycle, islice, product
from math import pi

from markupsafe import Markup

from disting.catalogs import Catalog
from disting.evidence.positive import Share
from disting.general.matrix_model import AnyModel
from disting.model.chain import Chain, Sensor, Sort
from disting.network import Element, Network
from disting.network.gears import unknown_ratios, without_gears
from disting.network.network import edges
from disting.report.drawing import JOINT, MASS, PITCH, WALL, draw, parts_of, share
from disting.report.environment import render
from disting.report.listing import JudgedList, Listing
from disting.report.model import folder_of, ways
from disting.report.payload import one_sided_pairs, script_json, with_exceptions
from disting.report.words import short_title
from disting.verdict.result import Relation, View

# of the machine that is shown first [kg, N/m, N s/m]: modes of about 1 Hz, which the eye follows,
# damped by some percent; no two springs have one ratio k/d, which would make more models equivalent
START = {
    "m": (1.0, 2.0, 1.5, 0.8, 1.2),
    "k": (90.0, 150.0, 60.0, 120.0, 75.0, 105.0),
    "d": (0.6, 0.25, 0.9, 0.4, 0.7, 0.5),
    "i": (2.0, 1.5, 3.0),  # ratios of gears
}


def motion_page(catalog: Catalog) -> str:
    """HTML of the page of a catalogue with two models or more."""
    first = first_pair(catalog)
    return render(
        "motion.html",
        family=short_title(catalog),
        back=f"{catalog.name}.html",
        site=True,
        members=[tuple(f"A{i}" for i in group) for group in catalog.classes()],
        parts=share((), parts_of(catalog.family)),
        payload=_payload(catalog, first),
    )


def first_pair(catalog: Catalog) -> tuple[int, int]:
    """The pair that is shown first: two that cannot be distinguished, where there are any.

    >>> from disting.catalogs import catalog
    >>> first_pair(catalog(3, damped=True))
    (1, 11)
    """
    groups = catalog.classes()
    return (groups[0][0], groups[0][1]) if groups else (1, 2)


def start_values(chain: Chain) -> tuple[float, ...]:
    """Positive parameters of a chain as it is shown first, in their order [kg, N/m, N s/m].

    >>> start_values(Chain(2, 1, 1, 2, 1, 2, damped=True))
    (1.0, 2.0, 90.0, 0.6)
    """
    places = {kind: list(islice(cycle(of), chain.n_masses)) for kind, of in START.items()}
    elements = chain.structure.elements
    return tuple(places[e.kind][e.at - (e.kind == "m")] for e in elements)


def _payload(catalog: Catalog, first: tuple[int, int]) -> Markup:
    """JSON of models, start values and verdicts; a pair that is not named is distinguishable."""
    scene = draw(catalog.family[1])
    return script_json(
        {
            "folder": folder_of(catalog),
            "masses": catalog.n_masses,
            "damped": catalog.damped,
            "order": catalog.family[1].sensor.order,
            "drawing": {
                "size": [scene.width, scene.height],
                "wall": WALL,
                "pitch": PITCH,
                "joint": JOINT,
                "mass": MASS,
            },
            "models": [chain.indices[1:] for chain in catalog.family],
            "values": [start_values(chain) for chain in catalog.family],
            "first": first,
            "groups": catalog.classes(),
            "aside": list(with_exceptions(catalog, View.POSITIVE)),
            "able": _able(catalog),
            "open": [
                (low, high)
                for low, high, v in catalog.pairs(View.POSITIVE)
                if v.relation is Relation.UNDECIDED
            ],
        }
    )


def _able(catalog: Catalog) -> list[tuple[int, int, Share]]:
    """(given, other, share): how many positive models of `number` have a positive equivalent in
    `other`, of the pairs that are distinguishable for some parameters only.
    """
    pairs = [(case.given, case.other, case.share) for case in one_sided_pairs(catalog)]
    for low, high in catalog.depending():
        for number, other in ((low, high), (high, low)):
            way = ways(number, other, catalog.verdict(low, high, View.POSITIVE))[0]
            pairs.append((number, other, Share.UNKNOWN if way is None else way.share))
    return pairs


COLUMN, ROW = 116.0, 92.0  # from one mass to the next
MARGINS = (76.0, 52.0, 76.0, 32.0)  # left, above, right, below the masses
ROWS = 3
PASSED, CROSSED = 100.0, 10.0  # what a joint costs that passes a third mass, or crosses another one
MOST = 200  # machines of a page: each can be chosen
# a piece of ground, from its mass
GROUNDS = ((-0.4, 0.65), (0.4, 0.65), (0.0, 0.75), (0.65, 0.35), (-0.65, 0.35), (0.55, -0.45))
Place = tuple[float, float]
"""Column and row."""
Line = tuple[Place, Place]
Joint = tuple[int, int] | tuple[int, int, float | str]
"""Both nodes, 0 for the ground, and the ratio of a gear: a number, or a name."""


def page_of_motion(shown: Listing) -> str:
    """Name of the page of a list, "" where there is none: for fewer than two machines, for models
    that are none, for machines of different numbers of masses or quantities of the sensor.
    """
    machines = list(map(machine_of, shown.found.family))
    sizes = {(len(m.nodes), m.order) for m in machines if m is not None}
    has = None not in machines and len(sizes) == 1 and 2 <= len(machines) <= MOST
    return f"{shown.name}-motion.html" if has else ""


def machine_of(model: AnyModel) -> Network | None:
    """The machine that a model is, one force, one sensor, a mass at every node, a spring, no gears
    but those that are units; None of any other model.
    """
    network = model.network
    if network is None or network.sort is not Sort.MACHINE or network.shape != (1, 1):
        return None
    letters = {e.letter for e in network.elements}
    masses = [e for e in network.elements if e.letter == "m"]
    if not {"m", "k"} <= letters <= set("mkd") or len(masses) != len(network.nodes):
        return None
    # of a gear that is written from both of its sides each side would have a joint
    ways = {(_ends(e), e.nodes if e.ratio else (), e.ratio) for e in network.elements}
    is_known = without_gears(network) is not None and len(ways) == len({ends for ends, *_ in ways})
    return network if is_known else None


def motion_page_of(shown: Listing, *, site: bool = False) -> str:
    """HTML of the page; `site`: whether start page and guide are in the same folder."""
    listing, groups = shown.found, shown.found.classes(View.POSITIVE)
    machines = [m for m in map(machine_of, listing.family) if m is not None]
    payload = {
        "folder": shown.folder,
        "masses": len(machines[0].nodes),
        "damped": any(e.letter == "d" for m in machines for e in m.elements),
        "names": [card.label for card in shown.cards],
        "hints": [card.name for card in shown.cards],
        "machines": list(map(drawing_of, machines)),
        "values": [start_values_of(m) for m in machines],
        "first": groups[0][:2] if groups else (1, 2),
        "groups": groups,
        "aside": list(with_exceptions(listing, View.POSITIVE)),
        "able": _able_of_list(listing),
        "open": [
            (low, high)
            for low, high, v in listing.pairs(View.POSITIVE)
            if v.relation is Relation.UNDECIDED
        ],
        "sided": False,
    }
    return render(
        "motion.html",
        family=shown.title,
        back=f"{shown.name}.html",
        site=site,
        members=[tuple(shown.label(i) for i in group) for group in groups],
        parts="",
        payload=script_json(payload),
    )


def _able_of_list(listing: JudgedList) -> list[tuple[int, int, Share]]:
    """(given, other, share) where it is known."""
    rows = [(case.given, case.other, case.share) for case in one_sided_pairs(listing)]
    for low, high in listing.depending(View.POSITIVE):
        v = listing.verdict(low, high, View.POSITIVE)
        for number, other, side in ((low, high, v.left_positive), (high, low, v.right_positive)):
            rows.append((number, other, Share.UNKNOWN if side is None else side.share))
    return rows


def start_values_of(machine: Network) -> tuple[float, ...]:
    """Positive values as they are shown first, in the order of the page [kg, N/m, N s/m, 1]."""
    sizes = {kind: list(islice(cycle(of), len(machine.elements))) for kind, of in START.items()}
    return tuple(sizes[kind][place] for _, kind, place in _list_values(machine))


def _list_values(machine: Network) -> list[tuple[str, str, int]]:
    """Name, kind and place of the values: masses, springs, dampers, and "i", ratios."""
    rank, joints = "mkd".index, list(_joints(machine))
    ordered = sorted(machine.elements, key=lambda e: rank(e.letter))
    places = [
        machine.nodes.index(e.nodes[0]) if e.kind.ends == 1 else joints.index(_ends(e))
        for e in ordered
    ]
    listed = [(e.value, e.letter, at) for e, at in zip(ordered, places, strict=True)]
    return listed + [(name, "i", at) for at, name in enumerate(unknown_ratios(machine))]


def _joints(machine: Network) -> dict[frozenset[int], Joint]:
    """The joints, each once, by their nodes."""
    joints = dict[frozenset[int], Joint]()
    for e in machine.elements:
        if e.kind.ends > 1:
            (i, j), number = e.nodes if e.ratio else sorted(e.nodes), e.known_ratio
            gear: Joint = (i, j, e.ratio if number is None else float(number))
            joints.setdefault(_ends(e), gear if e.ratio else (i, j))
    return joints


def _ends(e: Element) -> frozenset[int]:
    return frozenset(e.nodes)


def drawing_of(machine: Network) -> dict[str, object]:
    """Data of a machine for the page; nodes are numbered from 1 without gaps."""
    number = dict(zip((0, *machine.nodes), count(), strict=False))
    joints, values = _joints(machine), _list_values(machine)
    placed = places(machine)
    left, above, right, below = MARGINS
    joined, held = _list_joints(machine), [max(ends) for ends in joints if 0 in ends]
    grounds = [_ground(i, placed, joined) for i in held]
    x0, x1, y1 = (
        min(x for x, _ in (*placed.values(), *grounds)),
        max(x for x, _ in (*placed.values(), *grounds)),
        max(y for _, y in (*placed.values(), *grounds)),
    )

    def drawn(at: Place) -> list[float]:
        """In the drawing's units."""
        return [left + COLUMN * (at[0] - x0), above + ROW * at[1]]

    (force,), (sensor,) = machine.inputs, machine.outputs
    return {
        "masses": len(machine.nodes),
        "damped": any(e.letter == "d" for e in machine.elements),
        "order": Sensor.ACCELERATION.order,  # what the page shows; verdicts are those of any
        "joints": [[number[i], number[j], *gear] for (i, j, *gear) in joints.values()],
        "kinds": [kind for _, kind, _ in values],
        "places": [place for *_, place in values],
        "names": [name for name, *_ in values],
        "act": [number[force.minus], number[force.plus]],
        "meas": [number[sensor.minus], number[sensor.plus]],
        "at": [drawn(placed[i]) for i in machine.nodes],
        "grounds": {number[i]: drawn(at) for i, at in zip(held, grounds, strict=True)},
        "size": [left + COLUMN * (x1 - x0) + right, above + ROW * y1 + below],
    }


def places(machine: Network) -> dict[int, Place]:
    """Column and row of each mass.

    >>> from disting.network import network_of
    >>> places(network_of("1~2~3, 2~4; F1; S3"))
    {1: (0.0, 0), 2: (1.0, 0), 3: (2.0, 0), 4: (2.0, 1)}
    """
    columns = _columns(machine)
    choices: Iterator[dict[int, Place]] = (
        {i: (columns[i], y) for i, y in zip(columns, rows, strict=True)}
        for rows in product(range(ROWS), repeat=len(columns))
        if 0 in rows
    )
    apart = (placed for placed in choices if len(set(placed.values())) == len(placed))
    return min(apart, key=lambda placed: _cost(placed, _list_joints(machine)))


def _list_joints(machine: Network) -> list[tuple[int, int]]:
    """Pairs of masses that are joined, each once."""
    every = [edge for e in machine.elements for edge in edges(e) if 0 not in edge]
    return sorted({(min(edge), max(edge)) for edge in every})


def _columns(machine: Network) -> dict[int, float]:
    """By distance from the force; unconnected masses come last."""
    joined, entries = _list_joints(machine), dict[int, float]()
    starts = [i for p in machine.ports for i in (p.plus, p.minus) if i]
    for start in (*starts, *machine.nodes):
        if start in entries:
            continue
        x, column = max(entries.values(), default=-1.0) // 1 + 1, [start]
        while column:
            for i in column:
                beside = [k for k in entries if (min(i, k), max(i, k)) in joined]
                entries[i] = x + 0.5 * sum(entries[k] >= x for k in beside)
            near = [k for pair in joined for k in pair if set(pair) & set(column)]
            column = list(dict.fromkeys(k for k in near if k not in entries))
            x += 1
    return entries


def _cost(placed: dict[int, Place], joined: Sequence[tuple[int, int]]) -> float:
    """Of masses that joints pass, of joints that cross, of what is not level or not above."""
    lines = [(placed[a], placed[b]) for a, b in joined]
    passed = sum(
        _side(*line, at) == 0 and at not in line and _between(*line, at)
        for line in lines
        for at in placed.values()
    )
    crossed = sum(_cross(*pair) for pair in combinations(lines, 2))
    steep = sum(abs(a[1] - b[1]) for a, b in lines)
    return PASSED * passed + CROSSED * crossed + steep + 0.1 * sum(y for _, y in placed.values())


def _ground(node: int, placed: dict[int, Place], joined: Sequence[tuple[int, int]]) -> Place:
    """Where the piece of ground of a mass is: where its joint meets the others least."""
    at = placed[node]
    own = [placed[b if a == node else a] for a, b in joined if node in (a, b)]
    lines = [(placed[a], placed[b]) for a, b in joined if node not in (a, b)]

    def cost(by: Place) -> float:
        """Of joints that cross it, and of the one that is nearest in direction."""
        line = at, (at[0] + by[0], at[1] + by[1])
        angles = [abs(phase(complex(*by) / complex(x - at[0], y - at[1]))) for x, y in own]
        return sum(_cross(line, other) for other in lines) + 1 / (0.3 + min(angles, default=pi))

    by = min(GROUNDS, key=cost)
    return at[0] + by[0], at[1] + by[1]


def _side(a: Place, b: Place, c: Place) -> float:
    """On which side of the line through a and b the place c is; 0: on it."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _between(a: Place, b: Place, c: Place) -> bool:
    """Return True if c, on the line through a and b, is between them."""
    return min(a, b) < c < max(a, b)


def _cross(parts: Line, other: Line) -> bool:
    """Return True if two lines cross or overlap."""
    ends = [_side(*parts, p) for p in other], [_side(*other, p) for p in parts]
    if set(parts) & set(other):
        on = all(x == 0 for side in ends for x in side)
        return on and any(_between(*parts, p) or _between(*other, p) for p in (*parts, *other))
    return all(a * b < 0 for a, b in ends)
