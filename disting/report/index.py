"""The page that leads to the catalogues."""

from collections.abc import Sequence
from dataclasses import dataclass

from markupsafe import Markup

from disting.catalogs import Catalog
from disting.report.environment import render
from disting.report.matrix import thumbnail
from disting.report.model import Drawing, folder_of, model_of
from disting.report.payload import script_json
from disting.report.scene import PAGE_PALETTE
from disting.report.svg import body, number
from disting.report.words import plural, short_title, totals
from disting.verdict import Relation

Link = tuple[str, str, str]
"""Address, title and what is found there."""


@dataclass(frozen=True, slots=True)
class Card:
    """What the index shows of a catalogue."""

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
    """An indistinguishable pair, drawn."""

    address: str
    family: str
    left: Drawing
    right: Drawing


def index(catalogs: Sequence[Catalog], links: Sequence[Link] = ()) -> str:
    """HTML of the index: the catalogues in the order given, and further pages."""
    sizes = {c.name: {"models": len(c.family), "folder": folder_of(c)} for c in catalogs}
    return render(
        "index.html",
        cards=[card(c) for c in catalogs],
        example=example(catalogs),
        links=links,
        sizes=script_json(sizes),
        plural=plural,
    )


def card(catalog: Catalog) -> Card:
    """Headline and thumbnail of a catalogue."""
    scene = thumbnail(catalog)
    box = f"0 0 {number(scene.width)} {number(scene.height)}"
    drawing = Markup(body(scene, PAGE_PALETTE))
    groups = len(catalog.classes())
    return Card(catalog.name, short_title(catalog), len(catalog.family), groups, totals(catalog), box, drawing)


def example(catalogs: Sequence[Catalog]) -> Example | None:
    """Two chains that look different and cannot be told apart: of three masses where there are any."""
    found = [c for c in catalogs if c.classes()]
    if not found:
        return None
    chosen = min(found, key=lambda c: (abs(c.n_masses - 3), not c.damped))
    low, high = chosen.classes()[0][:2]
    drawings = (model_of(chosen, low).drawing, model_of(chosen, high).drawing)
    return Example(f"{chosen.name}.html#{low}-{high}", short_title(chosen), *drawings)
