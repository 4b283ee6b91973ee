"""A catalogue as one HTML page that needs nothing else.

The verdicts are drawn by the page's script from a compact payload: below the diagonal one view,
above it another. The content of the drawing is given in text too: by the field under the cursor, by
the panel of a pair, and by the table of groups.

A page with what to measure next for all groups of a catalogue.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from markupsafe import Markup

from disting.catalogs import Catalog
from disting.catalogs.files import damper_name
from disting.catalogs.next_files import NextCatalog
from disting.catalogs.sizes import name_of as sizes_name
from disting.conditions.rule import EXACT, RULES, Role, Rule
from disting.files import __version__
from disting.model.chain import Chain
from disting.report.drawing import Drawing, additions, draw, share
from disting.report.environment import render
from disting.report.matrix import has_slides, slide_name
from disting.report.model import folder_of, model_of, motion_of
from disting.report.motion import start_values
from disting.report.next_steps import (
    Advice,
    advice_of,
    for_pairs,
    found_for,
    menu_of,
    next_for,
    page_of,
    sketches_for_pairs,
)
from disting.report.payload import VIEWS, Over, over, payload
from disting.report.search import Families, families
from disting.report.words import (
    VIEW_TITLES,
    headline,
    plural,
    short_title,
    title,
    totals,
    unknown_parameters,
    with_and,
)
from disting.verdict.next_words import group_in_words
from disting.verdict.result import Relation, View

LISTED_PAIRS = 60  # undecided pairs up to this number are listed one by one
BELOW, ABOVE = VIEWS  # shown first


@dataclass(frozen=True, slots=True)
class Group:
    """A group of structures, drawn, the experiments that distinguish all of them, and the advice
    for each.
    """

    drawings: tuple[Drawing, ...]
    summary: str
    advice: tuple[Advice, ...]


def next_page(catalog: Catalog, the_catalog: NextCatalog) -> str:
    """HTML of the page."""
    groups = []
    for members in the_catalog.groups:
        whole = next_for(the_catalog, members)
        drawings = tuple(model_of(catalog, m).drawing for m in members)
        advices = tuple(advice_of(whole, k, members) for k in range(len(members)))
        groups.append(Group(drawings, group_in_words(whole), advices))
    return render(
        "next.html",
        catalog=catalog,
        family=short_title(catalog),
        folder=folder_of(catalog),
        groups=groups,
        held=share(
            (d for group in groups for d in group.drawings), additions(menu_of(the_catalog))
        ),
        plural=plural,
    )


@dataclass(frozen=True, slots=True)
class ViewSummary:
    """One view: its name, its pairs counted by condition in one sentence, and by relation."""

    view: View
    title: str
    summary: str
    totals: dict[Relation, int]


@dataclass(frozen=True, slots=True)
class DomainGroups:
    """Content of a page over one domain, with the drawings of the groups' members."""

    of: Over
    groups: list[list[Drawing]]


@dataclass(frozen=True, slots=True)
class Count:
    """A row of the table of counts; `relation` is what the condition decides."""

    name: str
    title: str
    text: str
    relation: Relation
    numbers: tuple[int, ...]


def page(catalog: Catalog, *, beside: Families | None = None) -> str:
    """HTML of a catalogue; `beside`: the adjacent pages of pairs (see `families`).

    >>> from disting.catalogs import catalog
    >>> page(catalog(2, damped=True))[:15]
    '<!DOCTYPE html>'
    """
    pages = families([catalog]) | dict(beside or {})
    names = damper_name(catalog.n_masses, catalog.damped), sizes_name(catalog.damped)
    dampers, across = (name if name in pages else "" for name in names)
    models = [model_of(catalog, row.number) for row in catalog.rows]
    domains = [over(catalog, view) for view in VIEWS]
    grouped = [
        DomainGroups(of, [[models[m - 1].drawing for m in members] for members in of.groups])
        for of in domains
    ]
    further, sample = found_for(catalog), example(catalog)
    return render(
        "page.html",
        title=title(catalog),
        family=short_title(catalog),
        headline=headline(catalog),
        catalog=catalog,
        folder=folder_of(catalog),
        domains=grouped,
        compared=sum(domains[0].totals.values()),
        views=_views(catalog),
        below=BELOW,
        above=ABOVE,
        counts=counts(catalog),
        undecided=open_pairs(catalog),
        still_open=domains[1].totals[Relation.UNDECIDED],
        listed_pairs=LISTED_PAIRS,
        models=models,
        held=share([*(m.drawing for m in models), sample], additions(menu_of(further))),
        sample=sample,
        dampers=dampers,
        across=across,
        motion=motion_of(catalog),
        next_name=page_of(catalog) if further else "",
        slides=_slides(catalog) if has_slides(catalog) else [],
        payload=_payload(catalog, domains, further, pages),
        plural=plural,
    )


def _views(catalog: Catalog) -> list[ViewSummary]:
    return [
        ViewSummary(view, name, summary(catalog, view), totals(catalog, view))
        for view, name in VIEW_TITLES.items()
    ]


def _slides(catalog: Catalog) -> list[tuple[str, str]]:
    """Titles of the views, and the files with a slide of each."""
    return [(name, slide_name(catalog, view)) for view, name in VIEW_TITLES.items()]


def _payload(
    catalog: Catalog, domains: Sequence[Over], further: NextCatalog | None, pages: Families
) -> Markup:
    """Data of the pairs for the page's script."""
    return payload(
        catalog,
        domains,
        sizes=[(catalog.n_masses, len(catalog.family))],
        damped=catalog.damped,
        premise=str(catalog.premise),
        version=__version__,
        families=pages,
        motion=motion_of(catalog),
        order=catalog.family[1].sensor.order,
        chains=[chain.indices[1:] for chain in catalog.family],
        values=[start_values(chain) for chain in catalog.family],
        known={row.number: unknown for row in catalog.rows if (unknown := unknown_parameters(row))},
        next=for_pairs(further),
        sketches={
            pair: [[s.box, s.parts, s.label] for s in sketches]
            for pair, sketches in sketches_for_pairs(further).items()
        },
    )


def summary(catalog: Catalog, view: View) -> str:
    """Counts in the paper's words.

    >>> from disting.catalogs import catalog
    >>> summary(catalog(3, damped=False), View.TF)
    '26 pairs by condition 1, 15 by 4, 2 by 5, 2 by 6 and 10 by 7; none left undecided.'
    """
    counts = {name: n for name, n in catalog.counts(view).items() if n}
    left = counts.pop("", 0)
    first = iter(["pairs by condition "])
    by_name = [name for name in counts if RULES[name].role is not Role.DECISION]
    parts = [f"{counts[name]} {next(first, 'by ')}{name}" for name in by_name]
    parts += [
        f"{n} by {RULES[name].in_words(view.domain)}"
        for name, n in counts.items()
        if name not in by_name
    ]
    return f"{with_and(parts) or 'No pair decided'}; {left or 'none'} left undecided."


def counts(catalog: Catalog) -> list[Count]:
    """Pairs by condition and view, every condition named, the undecided ones last."""
    the_rows = [catalog.counts(view) for view in VIEW_TITLES]
    rows = [(rule.name, rule.sign, rule.title, rule.text, decides(rule)) for rule in RULES.values()]
    rows += [("", "", "undecided", "nothing decides", Relation.UNDECIDED)]
    return [
        Count(sign, title, text, relation, tuple(f.get(name, 0) for f in the_rows))
        for name, sign, title, text, relation in rows
    ]


def open_pairs(catalog: Catalog) -> list[tuple[int, int]]:
    """The pairs that stay open after the conditions."""
    return [
        (low, high)
        for low, high, v in catalog.pairs(View.COMBINED)
        if v.relation is Relation.UNDECIDED
    ]


def example(catalog: Catalog) -> Drawing:
    """A chain that shows every sign of the drawings at once."""
    chain = Chain(3, 1, 1, 3, 1, 2, damped=catalog.damped)
    return Drawing(0, draw(chain))


def decides(rule: Rule) -> Relation:
    """Relation that a rule decides; for rules that decide either, the usual one."""
    apart = rule is EXACT or rule.role is Role.NECESSARY
    return Relation.DISTINGUISHABLE if apart else Relation.INDISTINGUISHABLE
