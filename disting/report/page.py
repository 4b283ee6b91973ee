"""A catalogue as one HTML page that needs nothing else: what is said is in the HTML, the script only adds interaction."""

from dataclasses import dataclass

from markupsafe import Markup

from disting.catalogs import Catalog, ModelRow
from disting.conditions import CONDITIONS
from disting.conditions.admissible import ADMISSIBLE
from disting.conditions.exact import EXACT
from disting.identifiability import Level
from disting.model.chain import Chain
from disting.report.drawing import draw
from disting.report.environment import render
from disting.report.payload import payload
from disting.report.scene import PAGE_PALETTE, Scene
from disting.report.svg import body, number
from disting.report.words import SIGNS, VIEW_TITLES, coefficients, headline, listed, plural, title, totals
from disting.verdict import RULE_NAMES, Relation, View

SIDE_BY_SIDE = 12  # families up to this size show the three views at once
RULES = {RULE_NAMES[EXACT]: "by the exact decision", RULE_NAMES[ADMISSIBLE]: "by their positive equivalents"}
LISTED_PAIRS = 60  # undecided pairs up to this number are listed one by one


@dataclass(frozen=True, slots=True)
class Drawing:
    """A chain's drawing, held once by the page and shown wherever it is referred to."""

    number: int
    scene: Scene

    @property
    def label(self) -> str:
        """What is seen, in words."""
        return f"A{self.number}: {self.scene.title}"

    @property
    def definition(self) -> Markup:
        """The drawing itself."""
        return Markup(f'<g id="chain-{self.number}">{body(self.scene, PAGE_PALETTE)}</g>')

    @property
    def width(self) -> str:
        """Natural width [px]."""
        return number(self.scene.width)

    @property
    def box(self) -> str:
        """viewBox."""
        return f"0 0 {number(self.scene.width)} {number(self.scene.height)}"


@dataclass(frozen=True, slots=True)
class Field:
    """A field of the matrix."""

    relation: str
    decided_by: str


@dataclass(frozen=True, slots=True)
class Matrix:
    """One view: its rows of fields (row of model 2 first), and its pairs counted by condition in one sentence."""

    view: View
    title: str
    summary: str
    rows: tuple[tuple[Field, ...], ...]


@dataclass(frozen=True, slots=True)
class Count:
    """A row of the table of counts; `relation` is what the condition decides."""

    name: str
    title: str
    text: str
    relation: Relation
    numbers: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Model:
    """A row of the table of models."""

    row: ModelRow
    drawing: Drawing
    formula: tuple[str, ...]

    @property
    def sets(self) -> str:
        """How many parameter vectors have one behaviour."""
        found = self.row.identifiability
        if found.level is Level.NOT:
            return "infinitely many"
        if found.most is None:
            return "not known"
        return str(found.most) if found.least == found.most else f"{found.least} to {found.most}"

    @property
    def ports(self) -> tuple[str, str]:
        """Force and sensor in words."""
        c = self.row.chain
        return _port(c.act_plus, c.act_minus), _port(c.meas_plus, c.meas_minus)


def page(catalog: Catalog) -> str:
    """HTML of a catalogue."""
    found = totals(catalog)
    drawings = {r.number: Drawing(r.number, draw(r.chain)) for r in catalog.rows}
    return render(
        "page.html",
        title=title(catalog),
        headline=headline(catalog),
        catalog=catalog,
        totals=found,
        compared=sum(found.values()),
        matrices=[matrix(catalog, view) for view in VIEW_TITLES],
        domains=[view for view in VIEW_TITLES if view in (View.EXACT, View.POSITIVE)],
        side_by_side=len(catalog.family) <= SIDE_BY_SIDE,
        counts=counts(catalog),
        undecided=undecided(catalog),
        still_open=found[Relation.UNDECIDED],
        listed_pairs=LISTED_PAIRS,
        groups=[[drawings[m] for m in members] for members in catalog.classes(View.EXACT)],
        models=[Model(r, drawings[r.number], coefficients(r.chain)) for r in catalog.rows],
        sample=example(catalog),
        payload=payload(catalog),
        plural=plural,
    )


def matrix(catalog: Catalog, view: View) -> Matrix:
    """The fields of one view."""
    numbers = range(2, len(catalog.family) + 1)
    rows = tuple(tuple(_field(catalog, low, high, view) for low in range(1, high)) for high in numbers)
    return Matrix(view, VIEW_TITLES[view], summary(catalog, view), rows)


def summary(catalog: Catalog, view: View) -> str:
    """Counts in the paper's words.

    >>> from disting.catalogs import catalog
    >>> summary(catalog(3), View.TF)
    '26 pairs by condition 1, 15 by 4, 2 by 5, 2 by 6 and 10 by 7; none left undecided.'
    """
    found = {name: n for name, n in catalog.counts(view).items() if n}
    left = found.pop("", 0)
    others = [(found.pop(rule, 0), text) for rule, text in RULES.items()]
    first = iter(["pairs by condition "])
    parts = [f"{n} {next(first, 'by ')}{name}" for name, n in sorted(found.items())]
    parts += [f"{n} {text}" for n, text in others if n]
    return f"{listed(parts) or 'No pair decided'}; {left or 'none'} left undecided."


def counts(catalog: Catalog) -> list[Count]:
    """Pairs by condition and view, every condition named, the undecided ones last."""
    found = [catalog.counts(view) for view in VIEW_TITLES]
    rows = [(str(c.number), c.title, c.text, _decides(c.number)) for c in CONDITIONS]
    rows += [(RULE_NAMES[EXACT], "exact decision", "one fibre, by inverse network synthesis", Relation.DISTINGUISHABLE)]
    grounds = "theorems, order of poles and zeros, certified points"
    rows += [(RULE_NAMES[ADMISSIBLE], "positive equivalents", grounds, Relation.INDISTINGUISHABLE)]
    rows += [("", "undecided", "nothing decides", Relation.UNDECIDED)]
    return [
        Count(SIGNS.get(name, name), title, text, relation, tuple(f.get(name, 0) for f in found))
        for name, title, text, relation in rows
    ]


def undecided(catalog: Catalog) -> list[tuple[int, int]]:
    """The pairs that stay open after the conditions."""
    return [(low, high) for low, high, v in catalog.pairs(View.COMBINED) if v.relation is Relation.UNDECIDED]


def example(catalog: Catalog) -> Drawing:
    """A chain that shows every sign of the drawings at once."""
    chain = Chain(3, 1, 1, 3, 1, 2, damped=catalog.damped)
    return Drawing(0, draw(chain))


def _field(catalog: Catalog, low: int, high: int, view: View) -> Field:
    verdict = catalog.verdict(low, high, view)
    return Field(verdict.relation, SIGNS.get(verdict.decided_by, verdict.decided_by))


def _decides(condition: int) -> Relation:
    return Relation.DISTINGUISHABLE if condition <= 5 else Relation.INDISTINGUISHABLE


def _port(plus: int, minus: int) -> str:
    return f"{plus} against {minus or 'ground'}"
