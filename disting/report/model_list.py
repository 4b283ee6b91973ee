"""A list of models as pages: the matrix of their verdicts as on a catalogue's page, groups, every
pair in words; and a page for each model (`listed_model`).
"""

import csv
import io
import re
from collections.abc import Iterable, Iterator
from html import unescape
from pathlib import Path

from disting.catalogs.decisions_text import decisions_csv, decisions_json
from disting.catalogs.export import cell
from disting.equivalence.duplicates import model_of
from disting.errors import InputError, of_type
from disting.files import as_path, write_whole
from disting.general import Model, ModelList
from disting.general.any_model import measurand
from disting.model.presentation import plural
from disting.report.domains import VIEWS
from disting.report.environment import render, source
from disting.report.listed_model import listed_model_page
from disting.report.listing import Listing, judge
from disting.report.network_motion import motion_page_of, page_of_motion
from disting.report.page_drawing import share
from disting.report.payload import payload
from disting.report.words import SAID, VIEW_TITLES
from disting.verdict.engine import Engine
from disting.verdict.query import View
from disting.verdict.result import Verdict
from disting.verdict.sides import Named, refuse_ports

HEADING = re.compile(r"<h1>(.*?)</h1>", re.DOTALL)
LISTED_PAIRS = 1000  # told one by one below the matrix
COLUMNS = (
    "number", "name", "parameters", "inputs", "outputs", "determinable", "sets", "group",
    "complex_group",
)  # fmt: skip


def write_model_list(shown: Listing, out: Path, *, site: bool = False) -> list[Path]:
    """Write the page of the list, a page for each model, the verdicts over positive parameters as
    CSV and JSON, the models as CSV, and the page on which two of them move, into a folder; `site`:
    the pages around it, which are written too, stand beside it. Returns the paths.
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
    """HTML of the page; `site`, `guide`: whether these pages stand beside it."""
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
        told=list(_told(shown)) if n_pairs <= LISTED_PAIRS else [],
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


def _told(shown: Listing) -> Iterator[tuple[str, str, Verdict, str, str]]:
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
