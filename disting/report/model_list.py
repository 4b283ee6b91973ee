"""A list of general models as one HTML page that needs nothing else: the matrix of their verdicts
as on a catalogue's page, groups, formulas, what can be determined, and every pair in words.
"""

import re
from collections.abc import Iterator, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path

from disting.catalogs.export import decisions_csv, decisions_json
from disting.errors import InputError
from disting.files import write_whole
from disting.general.global_identifiability import IDENTIFIABILITY, GlobalIdentifiability
from disting.general.matrix_model import MatrixModel
from disting.general.model import Model
from disting.general.model_files import ModelList
from disting.report.domains import VIEWS, over
from disting.report.environment import render
from disting.report.formulas import TransferFunction, written_model
from disting.report.payload import payload
from disting.report.words import SAID, VIEW_TITLES, plural
from disting.verdict.decisions import Decisions
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.query import Query, View
from disting.verdict.result import Relation, Verdict

LISTED_PAIRS = 1000  # told one by one below the matrix


@dataclass(frozen=True, slots=True)
class JudgedList:
    """Models with the decisions on all pairs, in each of VIEWS; models are counted from 1."""

    family: tuple[Model, ...]
    decisions: Mapping[View, Decisions]
    identifiabilities: tuple[GlobalIdentifiability, ...]

    def relation(self, left: int, right: int, view: View) -> Relation:
        """Relation of two models."""
        return self.decisions[view].relation(left - 1, right - 1)

    def verdict(self, left: int, right: int, view: View) -> Verdict:
        """The verdict with its evidence."""
        return self.decisions[view].verdict(left - 1, right - 1)

    def pairs(self, view: View) -> Iterator[tuple[int, int, Verdict]]:
        """All pairs, left < right."""
        for left, right in combinations(range(1, len(self.family) + 1), 2):
            yield left, right, self.verdict(left, right, view)

    def classes(self, view: View) -> tuple[tuple[int, ...], ...]:
        """Groups of two or more mutually indistinguishable models."""
        return tuple(tuple(i + 1 for i in g) for g in self.decisions[view].classes())

    def depending(self, view: View) -> tuple[tuple[int, int], ...]:
        """The pairs that are indistinguishable for some parameters only."""
        pairs = combinations(range(1, len(self.family) + 1), 2)
        return tuple(p for p in pairs if self.relation(*p, view) is Relation.SOMETIMES)


@dataclass(frozen=True, slots=True)
class Card:
    """What the page says of a model; `groups`: the number of its group in each of VIEWS, or 0."""

    number: int
    model: Model
    known: GlobalIdentifiability
    transfer: TransferFunction
    groups: tuple[int, ...]

    @property
    def sets(self) -> str:
        """How many parameter vectors have one behaviour."""
        if self.known.is_infinite or self.known.local.rank < len(self.model.parameters):
            return "infinitely many"
        return str(self.known.count or "not known")


def refuse_matrices(found: ModelList, path: str) -> None:
    """Raises InputError for models with several inputs or outputs: a page has one formula each."""
    several = next((m for m in found if isinstance(m, MatrixModel)), None)
    if several is not None:
        outputs, inputs = several.shape
        raise InputError(
            f"{path}: a page shows models with one input and one output, and {several.name} has"
            f" {inputs} and {outputs}: ask 'disting verdicts' and 'disting models' of the file"
        )


def judged(
    found: ModelList,
    engine: Engine,
    *,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> JudgedList:
    """Decide all pairs over positive and over complex parameters, and what is identifiable."""
    models = tuple(model for model in found if isinstance(model, Model))
    subjects = engine.general_subjects(models)
    decided = {
        view: engine.decisions(
            subjects, Query(view, inclusion=False), executor=executor, progress=progress
        )
        for view in VIEWS
    }
    asked = [(subject.model.model,) for subject in subjects]
    engine.answer_all(IDENTIFIABILITY, asked, executor=executor, progress=progress)
    known = tuple(engine.answer(IDENTIFIABILITY, models, engine.settings) for models in asked)
    return JudgedList(models, decided, known)


def write_model_list(
    found: JudgedList, title: str, name: str, out: Path, *, motion: str = ""
) -> list[Path]:
    """Write the page, and the verdicts over positive parameters as CSV and JSON, into a folder;
    `motion`: the page beside it on which two of them move. Returns the paths.
    """
    out.mkdir(parents=True, exist_ok=True)
    site, guide = ((out / page).is_file() for page in ("index.html", "guide/index.html"))
    page = model_list_page(found, title, name, site=site, guide=guide, motion=motion)
    decided = found.decisions[View.POSITIVE]
    texts = {"html": page, "csv": decisions_csv(decided), "json": decisions_json(decided)}
    return [write_whole(out / f"{name}.{kind}", [text]) for kind, text in texts.items()]


def page_name(path: Path) -> str:
    """Name of the page of a file, of letters, digits and - only; raises InputError for none.

    >>> page_name(Path("my models/Two vessels (1).json"))
    'list-two-vessels-1'
    """
    name = re.sub(r"[^a-z0-9]+", "-", path.stem.lower()).strip("-")[:60]
    if not name:
        raise InputError(f"{path.name} has no letter of the alphabet; rename the file")
    return f"list-{name}"


def model_list_page(
    found: JudgedList,
    title: str,
    name: str,
    *,
    site: bool = False,
    guide: bool = False,
    motion: str = "",
) -> str:
    """HTML of the page; `site`, `guide`: whether these pages stand beside it, `motion`: the page on
    which two of the models move.
    """
    domains = [over(found, view) for view in VIEWS]
    cards = [
        Card(
            number=number,
            model=model,
            known=known,
            transfer=written_model(model),
            groups=tuple(
                next((k for k, g in enumerate(of.groups, 1) if number in g), 0) for of in domains
            ),
        )
        for number, (model, known) in enumerate(
            zip(found.family, found.identifiabilities, strict=True), 1
        )
    ]
    n_pairs = len(cards) * (len(cards) - 1) // 2
    names = [model.name for model in found.family]
    return render(
        "models.html",
        title=title,
        name=name,
        cards=cards,
        domains=domains,
        compared=n_pairs,
        views=[(view, VIEW_TITLES[view]) for view in VIEWS],
        told=list(_told(found)) if n_pairs <= LISTED_PAIRS else [],
        payload=payload(found, domains, VIEWS, names=names, next={}, sketches={}),
        site=site,
        guide=guide,
        motion=motion,
        plural=plural,
    )


def _told(found: JudgedList) -> Iterator[tuple[int, int, Verdict, str, str]]:
    """Every pair over positive parameters, with its relation there and over complex ones."""
    for left, right, verdict in found.pairs(View.POSITIVE):
        other = found.relation(left, right, View.EXACT)
        yield left, right, verdict, SAID[verdict.relation], SAID[other]
