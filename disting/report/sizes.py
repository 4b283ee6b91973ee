"""Models of several sizes in one triangle of fields: what condition decides, and which smaller
models lie in which larger ones.

A field of two sizes shows ⊂ where the smaller model is, over complex parameters, a limit of the
larger one; else the condition by which the two are distinguishable. Verdicts are over positive
parameters.
"""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, groupby
from pathlib import Path

from markupsafe import Markup

from disting.files import write_whole
from disting.questions.inclusion import Inclusion, Sense
from disting.report.environment import render
from disting.report.fields import CORNERS, LETTERS, corner, field
from disting.report.scene import PAGE_PALETTE, Anchor, Ink, Layer, Rect, Scene, Text
from disting.report.svg import body, number
from disting.report.words import probability, sign
from disting.verdict import Decisions, Verdict

CELL = 24.0
LEFT, TOP = 44.0, 8.0
LETTER = 11.0
# the column's model in the row's, or the reverse
INSIDE = {Inclusion.LEFT_IN_RIGHT: "⊂", Inclusion.RIGHT_IN_LEFT: "⊃"}
Pair = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Between:
    """Pairs of two sizes: how many smaller models lie in a larger one, how many do not, how
    many are not known.
    """

    small: int
    large: int
    inside: int
    outside: int
    unknown: int


@dataclass(frozen=True, slots=True)
class Outside:
    """A smaller model that does not lie in a larger one, and why."""

    left: str
    right: str
    why: str


def name_of(damped: bool) -> str:
    """Name of the page."""
    return f"sizes-{'damped' if damped else 'undamped'}"


def write_sizes(decided: Decisions, out: Path) -> Path:
    """Write the page of models of several sizes, decided with inclusions, into a folder;
    returns its path.
    """
    out.mkdir(parents=True, exist_ok=True)
    return write_whole(out / f"{name_of(decided.chains[0].damped)}.html", [sizes_page(decided)])


def sizes_page(decided: Decisions) -> str:
    """HTML of models of several sizes, in the order of sizes, decided with inclusions."""
    scene, found = figure(decided), list(between(decided))
    return render(
        "sizes.html",
        damped=decided.chains[0].damped,
        sizes=sorted(set(decided.sizes)),
        models=len(decided.subjects),
        box=f"0 0 {number(scene.width)} {number(scene.height)}",
        width=number(scene.width),
        title=scene.title,
        drawing=Markup(body(scene, PAGE_PALETTE)),
        between=found,
        inside=sum(b.inside for b in found),
        pairs=sum(b.inside + b.outside + b.unknown for b in found),
        unknown=sum(b.unknown for b in found),
        outside=list(outside(decided)),
    )


def between(decided: Decisions) -> Iterator[Between]:
    """Counts for every two sizes."""
    sizes = decided.sizes
    for small, large in combinations(sorted(set(sizes)), 2):
        pairs = (
            (i, j)
            for i, j in combinations(range(len(sizes)), 2)
            if (sizes[i], sizes[j]) == (small, large)
        )
        count = Counter(decided.inclusion(i, j, Sense.CLOSURE) for i, j in pairs)
        inside, unknown = count[Inclusion.LEFT_IN_RIGHT], count[Inclusion.UNKNOWN]
        yield Between(
            small=small,
            large=large,
            inside=inside,
            outside=count.total() - inside - unknown,
            unknown=unknown,
        )


def outside(decided: Decisions) -> Iterator[Outside]:
    """The smaller models that do not lie in a larger one."""
    for i, j in _across(decided):
        if decided.inclusion(i, j, Sense.CLOSURE) is Inclusion.NEITHER:
            names = decided.subjects[i].name, decided.subjects[j].name
            yield Outside(*names, _why(decided.verdict(i, j), *names))


def _why(verdict: Verdict, left: str, right: str) -> str:
    """The finding's reason; models of equal rank have none of their own, because limits with
    fewer poles have a smaller one.
    """
    found = None if verdict.inclusions is None else verdict.inclusions.closure
    if found is None or found.evidence is None:
        return (
            f"Both have equally many determinable parameters; limits of {right} with fewer poles"
            " have fewer."
        )
    bound = (
        f" (wrong with a probability of at most {probability(f'2^-{found.safety}')})"
        if found.safety
        else ""
    )
    return found.evidence.sentence(left, right) + bound


def figure(decided: Decisions) -> Scene:
    """The triangle; sizes are told apart by gaps between them."""
    subjects, n = decided.subjects, len(decided.subjects)
    pairs = [(j, i) for i in range(n) for j in range(i)]
    fields = tuple(s for j, i in pairs for s in field(*_at(j, i), decided.relation(j, i), CELL))
    corners = tuple(
        corner(*_at(j, i), r, CELL) for j, i in pairs if (r := decided.relation(j, i)) in CORNERS
    )
    signs = tuple(_sign(decided, j, i) for j, i in pairs)
    labels = tuple(_labels([s.name for s in subjects]))
    frames = tuple(_frames(decided.sizes))
    layers = (
        Layer("fields", fields),
        Layer("corners", corners),
        Layer("signs", signs),
        Layer("labels", labels),
    )
    said = "Verdicts and inclusions of models of different sizes"
    return Scene(LEFT + n * CELL + 28, TOP + n * CELL + 4, (*layers, Layer("sizes", frames)), said)


def _across(decided: Decisions) -> Iterator[Pair]:
    """Pairs of different size, the smaller model first."""
    sizes = decided.sizes
    return ((i, j) for i, j in combinations(range(len(sizes)), 2) if sizes[i] != sizes[j])


def _at(column: int, row: int) -> tuple[float, float]:
    return LEFT + column * CELL, TOP + row * CELL


def _sign(decided: Decisions, column: int, row: int) -> Text:
    """⊂ or the sign of the deciding rule."""
    x, y = _at(column, row)
    inside = INSIDE.get(decided.inclusion(column, row, Sense.CLOSURE), "")
    half = (CELL - 1) / 2
    ink = LETTERS.get(decided.relation(column, row), Ink.LINE)
    return Text(
        x + half,
        y + half,
        inside or sign(decided.rule(column, row)),
        0.58 * CELL,
        ink,
        bold=bool(inside),
    )


def _labels(names: list[str]) -> Iterator[Text]:
    for i, name in enumerate(names):
        x, y = _at(i, i)
        if i:
            yield Text(LEFT - 6, y + CELL / 2, name, LETTER, Ink.MUTED, Anchor.END)
        yield Text(x + 2, y + CELL / 2, name, LETTER, Ink.MUTED, Anchor.START)


def _frames(sizes: list[int]) -> Iterator[Rect]:
    """A frame around the fields of every two sizes."""
    spans = [
        (size, [i for i, _ in run])
        for size, run in groupby(enumerate(sizes), key=lambda pair: pair[1])
    ]
    for (_, columns), (_, rows) in combinations(spans, 2):
        x, y = _at(columns[0], rows[0])
        yield Rect(
            x - 1.5, y - 1.5, len(columns) * CELL + 2, len(rows) * CELL + 2, stroke=Ink.LINE, line=2
        )
