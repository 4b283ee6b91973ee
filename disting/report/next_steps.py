"""Next measurements on pages: of a model, of a pair and of a whole group.

The content is that of `disting next`, with its default costs.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import combinations

from disting.catalogs import Catalog
from disting.catalogs.files import SHIPPED_SIZES as CATALOGUES
from disting.catalogs.next_files import SHIPPED_SIZES, NextCatalog, name_of, next_catalog
from disting.experiments.menu import Item
from disting.model.chain import Chain
from disting.report.drawing import Sketch, sketch
from disting.verdict.next_experiments import Menu
from disting.verdict.next_words import anywhere, conclusion, in_words, left_over
from disting.verdict.result import View


@dataclass(frozen=True, slots=True)
class Cell:
    """One experiment at one mass: whether it certainly distinguishes the structure, in words, and a
    drawing where the item gives information.
    """

    sure: bool
    text: str
    sketch: Sketch | None


@dataclass(frozen=True, slots=True)
class Advice:
    """Next measurements if this structure is true: a row for each kind with its cost and a cell for
    each mass, the structures to distinguish it from, the kinds that are certainly enough anywhere,
    and the least sets; `items`: the drawn ones.
    """

    number: int
    chain: Chain
    items: tuple[Item, ...]
    others: tuple[int, ...]
    rows: tuple[tuple[str, str, tuple[Cell, ...]], ...]
    anywhere: str
    conclusion: str


def found_for(catalog: Catalog) -> NextCatalog | None:
    """Shipped file for a catalogue; None where its groups are not those of the shipped one."""
    if catalog.n_masses not in SHIPPED_SIZES or catalog.n_masses not in CATALOGUES:
        return None
    the_catalog = next_catalog(catalog.n_masses, damped=catalog.damped)
    return the_catalog if the_catalog.groups == catalog.classes(View.EXACT) else None


def page_of(catalog: Catalog) -> str:
    """Name of a catalogue's page, as seen from the catalogue's page.

    >>> from disting.catalogs import catalog
    >>> page_of(catalog(3, damped=True))
    'next-3-damped.html'
    """
    return f"{name_of(catalog.n_masses, catalog.damped)}.html"


def advice(catalog: NextCatalog | None, number: int) -> Advice | None:
    """For a model that is in a group."""
    group = catalog.group(number) if catalog else ()
    if catalog is None or len(group) < 2:
        return None
    return advice_of(next_for(catalog, group), group.index(number), group)


def for_pairs(catalog: NextCatalog | None) -> dict[str, str]:
    """A sentence for each pair of a group, by the pair's address, such as 2-5."""
    return dict(_sentences(catalog)) if catalog else {}


def sketches_for_pairs(catalog: NextCatalog | None) -> dict[str, list[Sketch]]:
    """The drawings next to these sentences: for either model the cheapest sets that are surely
    enough, else the one that leaves least.
    """
    sketches: dict[str, list[Sketch]] = {}
    for members in catalog.groups if catalog else ():
        for low, high in combinations(members, 2):
            assert catalog is not None
            pair = next_for(catalog, (low, high))
            sketches[f"{low}-{high}"] = [
                sketch(number, pair.structures[k], option.items)
                for k, number in enumerate((low, high))
                for option in pair.least(k) or filter(None, [pair.best(k)])
            ]
    return sketches


def menu_of(catalog: NextCatalog | None) -> Iterator[tuple[Chain, Item]]:
    """Yield what is worth doing on any model of a group."""
    for members in catalog.groups if catalog else ():
        assert catalog is not None
        whole = next_for(catalog, members)
        for k, chain in enumerate(whole.structures):
            yield from ((chain, item) for item in whole.items(k))


def next_for(catalog: NextCatalog, members: tuple[int, ...]) -> Menu[Chain]:
    """Next measurements for structures of one group, named as pages name them."""
    whole = catalog.further(members)
    assert whole is not None  # members of one group
    return replace(whole, names=tuple(f"A{m}" for m in members))


def _sentences(catalog: NextCatalog) -> Iterator[tuple[str, str]]:
    for members in catalog.groups:
        for low, high in combinations(members, 2):
            pair = next_for(catalog, (low, high))
            phrase = anywhere(pair)
            each = [f"If it is {name}, {conclusion(pair, k)}." for k, name in enumerate(pair.names)]
            yield f"{low}-{high}", f"{phrase[0].upper()}{phrase[1:]}." if phrase else " ".join(each)


def advice_of(advice: Menu[Chain], structure: int, members: tuple[int, ...]) -> Advice:
    """For a structure of a group, counted from 0; `members`: the numbers of all."""
    masses, items = advice.places(structure), tuple(advice.items(structure))
    rows = tuple(
        (
            kind.title,
            f"{advice.costs.cost(kind):g}",
            tuple(_cell(advice, structure, members, Item(kind, at), items) for at in masses),
        )
        for kind in advice.kinds
    )
    others = tuple(m for m in members if m != members[structure])
    return Advice(
        members[structure],
        advice.structures[structure],
        items,
        others,
        rows,
        anywhere(advice),
        conclusion(advice, structure),
    )


def drawings_of(advice: Iterable[Advice]) -> Iterator[tuple[Chain, Item]]:
    """Yield what a page with this advice draws."""
    return ((this_advice.chain, item) for this_advice in advice for item in this_advice.items)


def _cell(
    advice: Menu[Chain],
    structure: int,
    members: tuple[int, ...],
    item: Item,
    items: tuple[Item, ...],
) -> Cell:
    worth = item in items
    sure = worth and not left_over(advice, structure, item)
    text = "surely" if sure else in_words(advice, structure, item)
    chain = advice.structures[structure]
    return Cell(sure, text, sketch(members[structure], chain, (item,)) if worth else None)
