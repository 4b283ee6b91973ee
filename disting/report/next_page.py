"""A page with what to measure next for all groups of a catalogue."""

from dataclasses import dataclass

from disting.catalogs import Catalog
from disting.catalogs.next_files import NextCatalog
from disting.report.environment import render
from disting.report.experiment_drawing import definitions
from disting.report.model import folder_of, model_of
from disting.report.next_steps import Advice, advice_of, menu_of, named
from disting.report.page_drawing import Drawing
from disting.report.words import plural, short_title
from disting.verdict.further_words import anywhere


@dataclass(frozen=True, slots=True)
class Group:
    """A group of structures, drawn, what tells all of them apart, and the advice for each."""

    drawings: tuple[Drawing, ...]
    anywhere: str
    advice: tuple[Advice, ...]


def next_page(catalog: Catalog, found: NextCatalog) -> str:
    """HTML of the page."""
    groups = []
    for members in found.groups:
        whole = named(found, members)
        drawings = tuple(model_of(catalog, m).drawing for m in members)
        told = tuple(advice_of(whole, k, members) for k in range(len(members)))
        groups.append(Group(drawings, anywhere(whole), told))
    return render(
        "next.html",
        catalog=catalog,
        family=short_title(catalog),
        folder=folder_of(catalog),
        groups=groups,
        additions=definitions(menu_of(found)),
        plural=plural,
    )
