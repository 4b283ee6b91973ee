"""The page that leads to the catalogues, and from the description of a machine to its model.

The start page's "Describe your machine" knows the models' indices, the pairs that are not
distinguishable over positive parameters, and the parts of drawings. A description is any chain
under (36) and (37), so one that breaks (38) too: the page finds its model by the symmetries that
(38) breaks (mirrored free row, force and sensor exchanged). Every layer of a drawing depends on the
gap, one port, or one element and whether there are dampers, never on the number of masses: so each
is held once, under a name that the page's script can spell.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby, product
from operator import itemgetter

from markupsafe import Markup

from disting.catalogs import Catalog
from disting.catalogs.dampers import DamperFamily
from disting.catalogs.files import damper_name
from disting.catalogs.sizes import SizesCatalog
from disting.model.chain import Chain, Indices, violations
from disting.network.families import family_with
from disting.quantities import MODELLED
from disting.report.damper_page import family_title
from disting.report.drawing import (
    Drawing,
    Part,
    draw,
    ground_dampers,
    height_with_dampers,
    parts_of,
    share,
)
from disting.report.environment import render
from disting.report.matrix import FILLS
from disting.report.model import folder_of, model_of, motion_of
from disting.report.network_drawing import hatching
from disting.report.network_symbols import Track, draw_symbol, gear
from disting.report.payload import one_sided_pairs, script_json, with_exceptions
from disting.report.scene import PAGE_PALETTE, Ink, Layer, Path, Rect, Scene, body, number
from disting.report.search import families
from disting.report.words import headline, plural, short_title, title, totals, unknown_parameters
from disting.verdict.result import Relation, View


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
        "open": _count_undecided(c),
        "known": {row.number: unknown for row in c.rows if (unknown := unknown_parameters(row))},
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


def _count_undecided(c: Catalog) -> dict[int, int]:
    """Number of undecided pairs of each model that has any."""
    numbers = range(1, len(c.family) + 1)
    pairs = [(i, j) for j in numbers for i in range(1, j) if c.relation(i, j) is Relation.UNDECIDED]
    touched = [number for pair in pairs for number in pair]
    return {number: touched.count(number) for number in sorted(set(touched))}


GUIDE = "guide/index.html"
THUMBNAIL = 168.0  # pixels
Run = tuple[Ink, int, int, int]
"""Adjacent fields of one colour: their first column, row, number."""
INKS = {Relation.INDISTINGUISHABLE: Ink.INDISTINGUISHABLE, Relation.UNDECIDED: Ink.OPEN}


def thumbnail(catalog: Catalog) -> Scene:
    """The combined triangle without numbers: a blue staircase with the other fields on it."""
    size = len(catalog.family)
    runs = (run for high in range(2, size + 1) for run in _runs(catalog, high))
    label = f"{title(catalog)}: {headline(catalog)}"
    return staircase(size - 1, sorted(runs, key=itemgetter(0)), label)


def staircase(count: int, others: Iterable[Run], said: str = "") -> Scene:
    """So many steps, as wide as a thumbnail, and fields of other colours on them."""
    cell = THUMBNAIL / max(count, 1)
    steps = [(x * cell, y * cell) for i in range(count) for x, y in ((i, i), (i + 1, i))]
    corners = (*steps, (THUMBNAIL, THUMBNAIL), (0.0, THUMBNAIL))
    stairs = Path(corners, Ink.NONE, Ink.DISTINGUISHABLE)
    fields = tuple(Rect(x * cell, y * cell, n * cell, cell, ink) for ink, x, y, n in others)
    layers = Layer("distinguishable", (stairs,)), Layer("others", fields)
    return Scene(THUMBNAIL, THUMBNAIL, layers, said)


def _runs(catalog: Catalog, high: int) -> Iterator[Run]:
    """Neighbours of one relation in a row; the distinguishable ones are left out."""
    for relation, run in groupby(range(1, high), key=lambda low: catalog.relation(low, high)):
        lows = list(run)
        if relation is not Relation.DISTINGUISHABLE:
            yield FILLS.get(relation, Ink.OPEN), lows[0] - 1, high - 2, len(lows)


def damper_thumbnail(family: DamperFamily) -> Scene:
    """A triangle with its diagonal: a field that is not blue holds pairs that are not
    distinguishable.
    """
    fields = ((INKS[relation], x, y, n) for relation, x, y, n in sorted(runs(family)))
    return staircase(len(family.family), fields)


def runs(family: DamperFamily) -> Iterator[tuple[Relation, int, int, int]]:
    """Neighbours in a row that are not all distinguishable: relation, first column, row, length."""
    rows = family.found.group.reshape(len(family.family), len(family.sets)).tolist()
    groups = [frozenset(row) for row in rows]
    holders = {
        group: [s for s, of in enumerate(groups) if group in of]
        for group in frozenset().union(*groups)
    }
    opened = {
        frozenset((s, t))
        for a, b in family.found.open_groups
        for s in holders[a]
        for t in holders[b]
    }

    def relation(s: int, t: int) -> Relation:
        """Of two structures, some of whose sets of dampers are not distinguishable; of one, two of
        its own sets.
        """
        same = groups[s] & groups[t] if s != t else len(groups[s]) < len(family.sets)
        if same:
            return Relation.INDISTINGUISHABLE
        return Relation.UNDECIDED if frozenset((s, t)) in opened else Relation.DISTINGUISHABLE

    for s in range(len(groups)):
        x = 0
        for kind, run in groupby(relation(s, t) for t in range(s + 1)):
            count = len(list(run))
            if kind in INKS:
                yield kind, x, s, count
            x += count


Link = tuple[str, str, str]
"""Address, title and what is found there."""


@dataclass(frozen=True, slots=True)
class Card:
    """Card of a catalogue, or of a family with ground dampers, on the index; groups are those of
    several models.
    """

    name: str
    title: str
    models: int
    groups: int
    totals: dict[Relation, int]
    box: str
    drawing: Markup

    @property
    def pairs(self) -> int:
        """Number of pairs."""
        return sum(self.totals.values())


@dataclass(frozen=True, slots=True)
class Example:
    """An indistinguishable pair, drawn, and where it moves; `aside`: its verdict leaves special
    values aside.
    """

    aside: bool
    address: str
    motion: str
    family: str
    left: Drawing
    right: Drawing


def index(
    catalogs: Sequence[Catalog],
    links: Sequence[Link] = (),
    dampers: Sequence[DamperFamily] = (),
    across: Sequence[SizesCatalog] = (),
) -> str:
    """HTML of the index: the catalogues in the order given, families with ground dampers, and
    further pages; `across`: the catalogues of several sizes that have a page.

    >>> from disting.catalogs import catalog
    >>> "I have a measurement" in index([catalog(2, damped=True)])
    True
    """
    masses, shown = sorted({c.n_masses for c in catalogs}), example(catalogs)
    return render(
        "index.html",
        cards=[card(c) for c in catalogs],
        damper_cards=[damper_card(f) for f in dampers],
        example=shown,
        links=links,
        guide=any(address == GUIDE for address, *_ in links),
        families=script_json(families(catalogs, dampers, across)),
        across=across,
        machines=script_json(machines(catalogs)),
        held=share((shown.left, shown.right) if shown else (), parts(catalogs)),
        machine_sizes=masses,
        quantities=[sensor.value for sensor in reversed(MODELLED)],
        machine_start=min(masses, key=lambda n: abs(n - 3), default=0),
        plural=plural,
    )


def card(catalog: Catalog) -> Card:
    """Headline and thumbnail of a catalogue."""
    groups = len(catalog.classes())
    return _card(
        catalog.name,
        short_title(catalog),
        len(catalog.family),
        groups,
        totals(catalog),
        thumbnail(catalog),
    )


def damper_card(family: DamperFamily) -> Card:
    """Headline of a family with ground dampers, and a thumbnail of its structures."""
    kind = family.family.n_masses, family.family.damped
    groups, counts = len(family.classes()), family.found.counts()
    return _card(
        damper_name(*kind),
        family_title(*kind),
        len(family),
        groups,
        counts,
        damper_thumbnail(family),
    )


def example(catalogs: Sequence[Catalog]) -> Example | None:
    """Two chains that look different and cannot be distinguished: of three masses where there are
    any.
    """
    the_catalogs = [c for c in catalogs if c.classes()]
    if not the_catalogs:
        return None
    chosen = min(the_catalogs, key=lambda c: (abs(c.n_masses - 3), not c.damped))
    low, high = chosen.classes()[0][:2]
    drawings = (model_of(chosen, low).drawing, model_of(chosen, high).drawing)
    motion = f"{motion_of(chosen)}#A{low}-A{high}"
    aside, address = chosen.verdict(low, high).has_exceptions, f"{chosen.name}.html#{low}-{high}"
    return Example(aside, address, motion, short_title(chosen), *drawings)


def _card(
    name: str, title: str, models: int, groups: int, counts: dict[Relation, int], scene: Scene
) -> Card:
    box = f"0 0 {number(scene.width)} {number(scene.height)}"
    return Card(
        name=name,
        title=title,
        models=models,
        groups=groups,
        totals=counts,
        box=box,
        drawing=Markup(body(scene, PAGE_PALETTE)),
    )
