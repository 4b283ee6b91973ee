"""The page that leads to the catalogues, and from the description of a machine to its model."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from operator import itemgetter

from markupsafe import Markup

from disting.catalogs import Catalog
from disting.catalogs.damper_family import DamperFamily
from disting.catalogs.files import damper_name
from disting.catalogs.sizes_files import SizesCatalog
from disting.quantities import MODELLED
from disting.report.damper_page import family_title
from disting.report.describe_machine import machines, parts
from disting.report.environment import render
from disting.report.matrix import FILLS
from disting.report.model import model_of, motion_of
from disting.report.page_drawing import Drawing, share
from disting.report.payload import script_json
from disting.report.scene import PAGE_PALETTE, Ink, Layer, Path, Rect, Scene
from disting.report.search import families
from disting.report.svg import body, number
from disting.report.words import headline, plural, short_title, title, totals
from disting.verdict.result import Relation

THUMBNAIL = 168.0  # pixels
Run = tuple[Ink, int, int, int]
"""Fields of one colour beside each other: their first column, row, number."""
INKS = {Relation.INDISTINGUISHABLE: Ink.INDISTINGUISHABLE, Relation.UNDECIDED: Ink.OPEN}


def thumbnail(catalog: Catalog) -> Scene:
    """The combined triangle without numbers: a blue staircase with the other fields on it."""
    size = len(catalog.family)
    runs = (run for high in range(2, size + 1) for run in _runs(catalog, high))
    said = f"{title(catalog)}: {headline(catalog)}"
    return staircase(size - 1, sorted(runs, key=itemgetter(0)), said)


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
    """A triangle with its diagonal: a field that is not blue holds pairs that are not told
    apart.
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
        """Of two structures, some of whose sets of dampers are not told apart; of one, two of
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
    """What the index shows of a catalogue, or of a family with ground dampers; groups are those
    of several models.
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
    """Two chains that look different and cannot be told apart: of three masses where there are
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
