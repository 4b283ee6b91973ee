"""A list of models as pages: the matrix of their verdicts as on a catalogue's page, groups, every
pair in words; and a page for each model, with its drawing, which others are the same, with their
values as formulas, its transfer function, what can be determined.
"""

import csv
import io
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from html import unescape
from pathlib import Path

from markupsafe import Markup

from disting.catalogs.export import cell, decisions_csv, decisions_json
from disting.equivalence.duplicates import duplicate, model_of
from disting.errors import InputError, of_type
from disting.files import as_path, write_whole
from disting.general import AnyModel, Model, ModelList
from disting.general.any_model import measurand
from disting.model.chain import Sort
from disting.model.presentation import plural
from disting.network.network import Network
from disting.report.drawing import share
from disting.report.environment import render, source
from disting.report.formulas import (
    Conditions,
    TransferFunction,
    Values,
    typeset,
    written_conditions,
    written_model,
    written_values,
)
from disting.report.listing import Card, Listing, judge
from disting.report.model import reasons_apart
from disting.report.motion import motion_page_of, page_of_motion
from disting.report.payload import VIEWS, payload
from disting.report.words import SAID, VIEW_TITLES
from disting.verdict.engine import Engine
from disting.verdict.meaning import meaning_sentence as shows
from disting.verdict.result import Relation, Verdict, View
from disting.verdict.sides import Named, refuse_ports

MOST_TWINS = 12  # of which formulas are written
FEW = 24  # of which are seen at once
RANKS = (Relation.INDISTINGUISHABLE, Relation.SOMETIMES, Relation.UNDECIDED)
FUNCTIONS, LETTERS = {Sort.CIRCUIT: "impedance"}, {Sort.CIRCUIT: "Z"}
SEEN = {
    Sort.MACHINE: "experiment with this force and sensor",
    Sort.CIRCUIT: "measurement at this port",
    Sort.COMPARTMENTS: "experiment with this input and output",
}


@dataclass(frozen=True, slots=True)
class Twin:
    """A model that is not distinguishable from this one for all positive parameters: `said`: the
    sentence, its `values` in those of this one where formulas are known, and the `command` that
    gives numbers. `parts`: of the two models, this one first, where they have equivalents in the
    other one. `special`: the statement on special values, and the equations of these.
    """

    card: Card
    relation: Relation
    pair: str
    said: str
    values: tuple[Values, ...]
    command: str
    parts: tuple["Part", ...]
    special: str
    equations: tuple[Markup, ...]


@dataclass(frozen=True, slots=True)
class Part:
    """Values of a model, called by its `label`, that have equivalents in the `other` one: all, or
    those where any of the `conditions` hold.
    """

    label: str
    other: str
    everything: bool
    conditions: tuple[Conditions, ...]


def listed_model_page(shown: Listing, number: int, *, site: bool = False) -> str:
    """HTML of one model; in the same folder the style sheet that `write_model_list` writes is
    expected. `site`: whether the pages of the site exist around it.
    """
    listing, card = shown.found, shown.cards[number - 1]
    verdicts = {
        other: listing.verdict(min(number, other), max(number, other), View.POSITIVE)
        for other in range(1, len(shown.cards) + 1)
        if other != number
    }
    twins = [
        _twin(shown, number, other, v)
        for other, v in verdicts.items()
        if v.relation is not Relation.DISTINGUISHABLE
    ]
    twins.sort(key=lambda twin: RANKS.index(twin.relation))
    complex_same = [
        shown.cards[o - 1]
        for o in verdicts
        if listing.relation(number, o, View.EXACT) is Relation.INDISTINGUISHABLE
        and verdicts[o].relation is not Relation.INDISTINGUISHABLE
    ]
    network = card.model.network
    sort = _sort(network)
    return render(
        "listed-model.html",
        shown=shown,
        card=card,
        twins=twins,
        few=FEW,
        aside=any(v.has_exceptions for v in verdicts.values()),
        complex_same=complex_same,
        told_apart=reasons_apart(verdicts),
        held=share(c.drawing for c in (card, *(t.card for t in twins)) if c.drawing),
        transfers=_transfers(card.model, LETTERS.get(sort, "G")),
        unseen=network.unseen if network else (),
        function=FUNCTIONS.get(sort, "transfer function"),
        seen=SEEN[sort],
        last=len(shown.cards),
        site=site,
        plural=plural,
    )


def _sort(network: Network | None) -> Sort:
    """Physical domain whose words describe it; those of compartments suit any model."""
    if network is None:
        return Sort.COMPARTMENTS
    is_filter = network.sort is Sort.CIRCUIT and network.inputs != network.outputs
    return Sort.COMPARTMENTS if is_filter else network.sort


def _twin(shown: Listing, number: int, other: int, verdict: Verdict) -> Twin:
    low, high = sorted((number, other))
    named = replace(verdict, left=shown.label(low), right=shown.label(high))
    both = [shown.found.family[n - 1] for n in (low, high)]
    sentence = shows(named, measurand(both))
    names = shown.cards[number - 1].model.name, shown.cards[other - 1].model.name
    command = ""
    if shown.numbered:
        values = ",".join(f"{p}=.." for p in shown.cards[number - 1].model.parameters)
        command = f'disting equivalents "{names[0]}" --to "{names[1]}" --set {values}'
    special, equations = _special(shown, number, other)
    return Twin(
        shown.cards[other - 1],
        verdict.relation,
        f"{low}-{high}",
        sentence,
        _values(shown, number, other) if verdict.relation is Relation.INDISTINGUISHABLE else (),
        command,
        tuple(_parts(shown, number, other)),
        special,
        equations,
    )


def _special(shown: Listing, number: int, other: int) -> tuple[str, tuple[Markup, ...]]:
    special_values = shown.found.at_special_values(number, other)
    if special_values is None:
        return "", ()
    names = shown.label(number), shown.label(other)
    equations = tuple(typeset(s.polynomial) for s in special_values.lower)
    outer = names[1] if special_values.left_in_right else names[0]
    few = f" {outer} has fewer poles where" if equations else ""
    return f"{special_values.in_short(*names)}{few}", equations


def _parts(shown: Listing, number: int, other: int) -> Iterator[Part]:
    for pair in ((number, other), (other, number)):
        reach = shown.found.reached(*pair)
        if reach and reach.pieces:
            pieces = () if reach.is_everything else reach.pieces
            conditions = tuple(map(written_conditions, pieces))
            names = shown.label(pair[0]), shown.label(pair[1])
            yield Part(*names, reach.is_everything, conditions)


def _values(shown: Listing, number: int, other: int) -> tuple[Values, ...]:
    """Formulas for the values of another model, where it has finitely many."""
    listing, card = shown.found, shown.cards[other - 1]
    size = len(card.model.parameters)
    group = shown.cards[number - 1].groups[0]
    members = shown.domains[0].groups[group - 1] if group else ()
    if card.known.local.rank < size or len(members) > MOST_TWINS:
        return ()
    own_duplicate = duplicate(
        listing.decisions[View.POSITIVE], listing.family, number - 1, other - 1
    )
    return tuple(map(written_values, own_duplicate.formulas))


def _transfers(model: AnyModel, letter: str) -> list[tuple[str, TransferFunction]]:
    """The transfer functions that are not zero, each with what it leads from and to."""
    if isinstance(model, Model):
        return [("", written_model(model, letter))]
    return [
        (f"from input {k} to output {i}", written_model(entry, letter))
        for i, row in enumerate(model.rows, 1)
        for k, entry in enumerate(row, 1)
        if entry is not None
    ]


HEADING = re.compile(r"<h1>(.*?)</h1>", re.DOTALL)
LISTED_PAIRS = 1000  # told one by one below the matrix
COLUMNS = (
    "number", "name", "parameters", "inputs", "outputs", "determinable", "sets", "group",
    "complex_group",
)  # fmt: skip


def write_model_list(shown: Listing, out: Path, *, site: bool = False) -> list[Path]:
    """Write the page of the list, a page for each model, the verdicts over positive parameters as
    CSV and JSON, the models as CSV, and the page on which two of them move, into a folder; `site`:
    the pages around it, which are written too, are in the same folder. Returns the paths.
    """
    out.mkdir(parents=True, exist_ok=True)
    site, guide = (site or (out / page).is_file() for page in ("index.html", "guide/index.html"))
    (out / shown.folder).mkdir(parents=True, exist_ok=True)
    return [write_whole(out / name, [text]) for name, text in _files(shown, site, guide)]


def _files(shown: Listing, site: bool, guide: bool) -> Iterator[tuple[str, str]]:
    """Yield addresses and texts: together they take more memory than all verdicts."""
    decided = shown.found.decisions[View.POSITIVE]
    yield f"{shown.name}.html", model_list_page(shown, site=site, guide=guide)
    yield f"{shown.name}.csv", decisions_csv(decided)
    yield f"{shown.name}.json", decisions_json(decided)
    yield f"{shown.name}-models.csv", models_csv(shown)
    yield "models/style.css", "".join(map(source, ("style.css", "model.css", "next.css")))
    if page_of_motion(shown):
        yield page_of_motion(shown), motion_page_of(shown, site=site and guide)
    for card in shown.cards:
        page = listed_model_page(shown, card.number, site=site and guide)
        yield f"{shown.folder}/{card.number}.html", page


def write_family(
    models: Iterable[Named], title: str, out: Path | str, *, engine: Engine | None = None
) -> list[Path]:
    """Decide all pairs of some models over positive and complex parameters, and write their pages
    into a folder: chains, networks or texts for them, general models; a function of one's own that
    yields networks, for one. Returns the paths, the page of the matrix first. Raises InputError.

    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     pages = write_family(["R0-p(R1,C1)", "p(R0,R1-C1)"], "Two cells", folder)
    ...     [page.name for page in pages][:2], len(pages)
    (['list-two-cells.html', 'list-two-cells.csv'], 7)
    """
    engine = Engine() if engine is None else of_type(engine, Engine, "engine is an Engine")
    listed = of_type(models, Iterable, "the models are a list of models, or what yields them")
    called = of_type(title, str, "the title is a text")
    made = ModelList(tuple(map(model_of, listed)), called)
    if len(made) < 2:
        raise InputError("there is nothing to compare: a family has two models at least")
    refuse_ports(made.models)
    shown = Listing(judge(made, engine), called, page_name(Path(called)))
    return write_model_list(shown, as_path(out))


def page_name(path: Path) -> str:
    """Name of the page of a file, of letters, digits and - only; raises InputError for none.

    >>> page_name(Path("my models/Two vessels (1).json"))
    'list-two-vessels-1'
    """
    name = re.sub(r"[^a-z0-9]+", "-", path.stem.lower()).strip("-")[:60]
    if not name:
        raise InputError(f"{path.name} has no letter of the alphabet; rename the file")
    return f"list-{name}"


def model_list_page(shown: Listing, *, site: bool = False, guide: bool = False) -> str:
    """HTML of the page; `site`, `guide`: whether these pages are in the same folder."""
    listing, count = shown.found, len(shown.cards)
    n_pairs = count * (count - 1) // 2
    data = payload(
        listing,
        shown.domains,
        VIEWS,
        what=measurand(listing.family),
        aside=listing.said_of,
        names=[model.name for model in listing.family],
        numbered=shown.numbered,
        folder=shown.folder,
        next={},
        sketches={},
    )
    return render(
        "models.html",
        shown=shown,
        compared=n_pairs,
        views=[(view, VIEW_TITLES[view]) for view in VIEWS],
        told=list(_rows_of_pairs(shown)) if n_pairs <= LISTED_PAIRS else [],
        held=share(card.drawing for card in shown.cards if card.drawing),
        payload=data,
        site=site,
        guide=guide,
        motion=page_of_motion(shown),
        plural=plural,
    )


def models_csv(shown: Listing) -> str:
    """The models as CSV: number, name, parameters, size, how many combinations of the parameters
    are determinable, how many sets of them fit, and the groups over positive and complex parameters
    (0: alone).
    """
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    for card in shown.cards:
        outputs, inputs = (1, 1) if isinstance(card.model, Model) else card.model.shape
        names = " ".join(card.model.parameters)
        rest = (inputs, outputs, card.known.local.rank, card.sets, *card.groups)
        writer.writerow((card.number, cell(card.model.name), names, *rest))
    return out.getvalue()


def _rows_of_pairs(shown: Listing) -> Iterator[tuple[str, str, Verdict, str, str]]:
    """Every pair over positive parameters, with its relation there and over complex ones."""
    for left, right, verdict in shown.found.pairs(View.POSITIVE):
        other = shown.found.relation(left, right, View.EXACT)
        names = shown.label(left), shown.label(right)
        yield *names, verdict, SAID[verdict.relation], SAID[other]


Link = tuple[str, str, str]
"""Address, title and what is found there."""


def list_pages(out: Path) -> Iterator[tuple[Link, list[Link]]]:
    """Yield the pages of lists that lie in a folder, each with those of its models."""
    for page in sorted(out.glob("list-*.html")):
        name, table = page.stem, page.with_name(f"{page.stem}-models.csv")
        heading = HEADING.search(page.read_text(encoding="utf-8", errors="replace"))
        if heading is None or not table.is_file():
            continue
        title = unescape(heading[1])
        with table.open(encoding="utf-8", newline="", errors="replace") as rows:
            read = [row[:2] for row in csv.reader(rows) if len(row) == len(COLUMNS)]
        numbered = [
            (number, called)
            for number, called in read
            if (out / f"models/{name}/{number}.html").is_file()
        ]
        models = [
            (f"models/{name}/{number}.html", called, f"A{number} of {title}")
            for number, called in numbered
        ]
        text = f"{plural(len(models), 'model')}: verdicts, drawings, formulas"
        yield (page.name, title, text), models
