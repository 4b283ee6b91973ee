"""The page that leads to the catalogues."""

from collections.abc import Sequence
from dataclasses import dataclass

from markupsafe import Markup

from disting.catalogs import Catalog
from disting.report.environment import render
from disting.report.matrix import thumbnail
from disting.report.scene import PAGE_PALETTE
from disting.report.svg import body, number
from disting.report.words import short_title, totals
from disting.verdict import Relation


@dataclass(frozen=True, slots=True)
class Card:
    """What the index shows of a catalogue."""

    name: str
    title: str
    models: int
    totals: dict[Relation, int]
    box: str
    drawing: Markup

    @property
    def pairs(self) -> int:
        """Number of pairs."""
        return sum(self.totals.values())


def index(catalogs: Sequence[Catalog]) -> str:
    """HTML of the index, in the order given."""
    return render("index.html", cards=[card(c) for c in catalogs])


def card(catalog: Catalog) -> Card:
    """Headline and thumbnail of a catalogue."""
    scene = thumbnail(catalog)
    box = f"0 0 {number(scene.width)} {number(scene.height)}"
    return Card(
        catalog.name, short_title(catalog), len(catalog.family), totals(catalog), box, Markup(body(scene, PAGE_PALETTE))
    )
