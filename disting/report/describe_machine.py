"""What the start page's "Describe your machine" knows: the models' indices, what is not told
apart, and the parts of drawings.

What is told apart is told over positive parameters.

A description is any chain under (36) and (37), so one that breaks (38) too: the page finds its
model by the symmetries that (38) breaks (mirrored free row, force and sensor exchanged). Every
layer of a drawing depends on the gap, one port, or one element and whether there are dampers,
never on the number of masses: so each is held once, under a name that the page's script can spell.
"""

from collections.abc import Iterable, Iterator
from itertools import product

from disting.catalogs import Catalog
from disting.model.chain import Chain
from disting.model.structure import Indices, violations
from disting.network.families import family_with
from disting.report.domains import one_sided_pairs, with_exceptions
from disting.report.drawing import draw
from disting.report.graph_drawing import hatching
from disting.report.model import folder_of
from disting.report.network_symbols import Track, draw_symbol, gear
from disting.report.page_drawing import Part, ground_dampers, height_with_dampers
from disting.report.scene import Layer
from disting.report.words import short_title, unknown_parameters
from disting.verdict.query import View
from disting.verdict.result import Relation


def descriptions(n_masses: int, *, damped: bool) -> Iterator[Chain]:
    """Every chain under (36) and (37), in the order of (n_gap, n_act-, n_act+, n_meas-, n_meas+).

    >>> len(list(descriptions(3, damped=True)))
    17
    """
    for gap in range(n_masses):
        low, high = range(gap + 1), range(gap + 1, n_masses + 1)
        for ports in product(low, high, low, high):
            indices = Indices(n_masses, gap, *ports)
            if not any(violations(indices, (36, 37))):
                yield Chain(*indices, damped=damped)


def parts(catalogs: Iterable[Catalog]) -> tuple[Part, ...]:
    """The layers of all descriptions' drawings, each once; dampers to the ground; and signs of
    which the page's script draws machines that are no chains.
    """
    catalogs = tuple(catalogs)
    largest = max((c.n_masses for c in catalogs), default=0)
    bearings = (
        Part(f"part-friction-{p.name.split('-')[1]}", p.layer) for p in ground_dampers(largest)
    )
    return (*chain_parts(catalogs), *(bearings if largest else ()), *_signs())


def _signs() -> Iterator[Part]:
    """A spring, a damper, wheels of a gear and a piece of ground, each at (0, 0), along x."""
    track = Track((-18.0, 0.0), (18.0, 0.0))
    for letter in "kd":
        yield Part(f"part-sign-{letter}", Layer(letter, draw_symbol(letter, track)))
    yield Part("part-sign-gear", Layer("gear", gear(Track((-18.0, 0.0), (9.0, 0.0)))))
    yield Part(
        "part-sign-ground", Layer("ground", tuple(hatching(Track((-9.0, 0.0), (0.0, 0.0)), 13.0)))
    )


def chain_parts(catalogs: Iterable[Catalog]) -> tuple[Part, ...]:
    """The layers of all descriptions' drawings, each once."""
    return parts_of(chain for c in catalogs for chain in descriptions(c.n_masses, damped=c.damped))


def parts_of(chains: Iterable[Chain]) -> tuple[Part, ...]:
    """The layers of some chains' drawings, each once."""
    named = {part_name(chain, layer): layer for chain in chains for layer in draw(chain).layers}
    return tuple(Part(name, layer) for name, layer in named.items())


def part_name(chain: Chain, layer: Layer) -> str:
    """Name of a layer's part: what the layer shows, and what its place depends on.

    >>> two = Chain(2, damped=True)
    >>> [part_name(two, layer) for layer in draw(two).layers][-4:]
    ['part-d12', 'part-gap-0', 'part-sensor-0-1', 'part-force-0-1']
    """
    depends = {
        "ground": (int(chain.gap > 0),),
        "gap": (chain.gap,),
        "force": (chain.act_minus, chain.act_plus),
        "sensor": (chain.meas_minus, chain.meas_plus),
    }
    # a spring makes room for the damper below it
    above = ("damped",) if chain.damped and layer.name.startswith("k") else ()
    return "-".join(map(str, ("part", layer.name, *depends.get(layer.name, ()), *above)))


def machines(catalogs: Iterable[Catalog]) -> list[dict[str, object]]:
    """Of each catalogue: its models' five indices in order, groups, of whose models special values
    are left aside, what depends on the values, how many verdicts are open.
    """
    return [_machine(c) for c in catalogs]


def _machine(c: Catalog) -> dict[str, object]:
    scene = draw(c.family[1])
    return {
        "name": c.name,
        "title": short_title(c),
        "folder": folder_of(c),
        "masses": c.n_masses,
        "damped": c.damped,
        "families": [
            family_with(c.n_masses, damped=c.damped, loops=loops) for loops in (False, True)
        ],
        "size": [scene.width, scene.height],
        "below": height_with_dampers(c.n_masses) - scene.height,
        "models": [chain.indices[1:] for chain in c.family],
        "groups": c.classes(),
        "aside": sorted({m for pair in with_exceptions(c, View.POSITIVE) for m in pair}),
        "depends": _depending(c),
        "open": _undecided(c),
        "known": {row.number: said for row in c.rows if (said := unknown_parameters(row))},
    }


def _depending(c: Catalog) -> dict[int, list[int]]:
    """For each model, those that have equivalents of some of its positive parameters, or the
    reverse, but not of all.
    """
    pairs = [way for low, high in c.depending() for way in ((low, high), (high, low))]
    pairs += [(case.given, case.other) for case in one_sided_pairs(c)]
    return {
        number: sorted(other for first, other in pairs if first == number)
        for number in sorted({p for p, _ in pairs})
    }


def _undecided(c: Catalog) -> dict[int, int]:
    """Number of undecided pairs of each model that has any."""
    numbers = range(1, len(c.family) + 1)
    pairs = [(i, j) for j in numbers for i in range(1, j) if c.relation(i, j) is Relation.UNDECIDED]
    touched = [number for pair in pairs for number in pair]
    return {number: touched.count(number) for number in sorted(set(touched))}
