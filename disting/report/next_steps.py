"""What to measure next, as pages say it: of a model, of a pair and of a whole group.

What is told is what `disting next` tells, with its default costs.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations

from disting.catalogs import Catalog
from disting.catalogs.files import SHIPPED_SIZES as CATALOGUES
from disting.catalogs.next_files import SHIPPED_SIZES, NextCatalog, name_of, next_catalog
from disting.experiments.menu import Item, Kind
from disting.verdict import View
from disting.verdict.further import Further
from disting.verdict.further_words import anywhere, conclusion, in_words, left_over

TITLES = {
    Kind.SENSOR: "sensor there, one more or moved",
    Kind.FORCE: "force moved there",
    Kind.INERTIA: "known inertia added there",
    Kind.LOCK: "mass locked",
}


@dataclass(frozen=True, slots=True)
class Cell:
    """One experiment at one mass: whether it surely tells the structure apart, and in words."""

    sure: bool
    text: str


@dataclass(frozen=True, slots=True)
class Advice:
    """What to measure next if it is this structure: a row a kind with its cost and a cell a
    mass, the structures it is to be told from, what is surely enough anywhere, and the least sets.
    """

    number: int
    others: tuple[int, ...]
    rows: tuple[tuple[str, str, tuple[Cell, ...]], ...]
    anywhere: str
    conclusion: str


def found_for(catalog: Catalog) -> NextCatalog | None:
    """What is shipped for a catalogue; None where its groups are not those of the shipped one."""
    if catalog.n_masses not in SHIPPED_SIZES or catalog.n_masses not in CATALOGUES:
        return None
    found = next_catalog(catalog.n_masses, damped=catalog.damped)
    return found if found.groups == catalog.classes(View.EXACT) else None


def page_of(catalog: Catalog) -> str:
    """Name of a catalogue's page, as seen from the catalogue's page.

    >>> from disting.catalogs import catalog
    >>> page_of(catalog(3, damped=True))
    'next-3-damped.html'
    """
    return f"{name_of(catalog.n_masses, catalog.damped)}.html"


def advice(found: NextCatalog | None, number: int) -> Advice | None:
    """For a model that is in a group."""
    group = found.group(number) if found else ()
    if found is None or len(group) < 2:
        return None
    return advice_of(named(found, group), group.index(number), group)


def for_pairs(found: NextCatalog | None) -> dict[str, str]:
    """A sentence for each pair of a group, by the pair's address, such as 2-5."""
    return dict(_sentences(found)) if found else {}


def named(found: NextCatalog, members: tuple[int, ...]) -> Further:
    """What to measure next for structures of one group, called as pages call them."""
    whole = found.further(members)
    assert whole is not None  # members of one group
    return replace(whole, names=tuple(f"A{m}" for m in members))


def _sentences(found: NextCatalog) -> Iterator[tuple[str, str]]:
    for members in found.groups:
        for low, high in combinations(members, 2):
            pair = named(found, (low, high))
            told = anywhere(pair)
            each = [f"If it is {name}, {conclusion(pair, k)}." for k, name in enumerate(pair.names)]
            yield f"{low}-{high}", f"{told[0].upper()}{told[1:]}." if told else " ".join(each)


def advice_of(found: Further, structure: int, members: tuple[int, ...]) -> Advice:
    """For a structure of a group, counted from 0; `members`: the numbers of all."""
    masses = range(1, found.n_masses + 1)
    rows = tuple(
        (
            TITLES[kind],
            f"{found.costs.cost(kind):g}",
            tuple(_cell(found, structure, Item(kind, at)) for at in masses),
        )
        for kind in found.kinds
    )
    others = tuple(m for m in members if m != members[structure])
    return Advice(members[structure], others, rows, anywhere(found), conclusion(found, structure))


def _cell(found: Further, structure: int, item: Item) -> Cell:
    sure = item in found.items(structure) and not left_over(found, structure, item)
    return Cell(sure, "surely" if sure else in_words(found, structure, item))
