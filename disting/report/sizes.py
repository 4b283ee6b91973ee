"""Models of several sizes in one matrix of fields: what condition decides, and which smaller
models lie in which larger ones.

A field shows ⊂ or ⊃ where one model is, over complex parameters, a limit of the other; ? where
that is not known of two sizes; else the condition by which the two are distinguishable. The page
is drawn by the script of a catalogue's page, from the same payload.
"""

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from disting.algebra.certainty import Certainty
from disting.catalogs.sizes import SizesCatalog
from disting.conditions.inclusion import Inclusion, InclusionFinding
from disting.files import __version__
from disting.report.drawing import Drawing, draw, share
from disting.report.environment import render
from disting.report.payload import VIEWS, over, pack, payload
from disting.report.search import Families, families
from disting.report.words import VIEW_TITLES, plural, raise_exponents
from disting.verdict.result import Verdict, View

UNTOLD, LEFT_INSIDE, RIGHT_INSIDE, NO_LIMIT, NOT_KNOWN = range(5)
KINDS = {
    Inclusion.LEFT_IN_RIGHT: LEFT_INSIDE,
    Inclusion.RIGHT_IN_LEFT: RIGHT_INSIDE,
    Inclusion.NEITHER: NO_LIMIT,
    Inclusion.UNKNOWN: NOT_KNOWN,
}
SHORT = (
    "",
    "{L} is a limit of {R}",
    "{R} is a limit of {L}",
    "neither is a limit of the other",
    "whether one is a limit of the other is not known",
)
SENTENCES = {  # of two sizes, the left one smaller
    LEFT_INSIDE: (
        "But over complex parameters {L} is a limit of {R}: {R} comes as close to its curve as one"
        " likes. Whether positive parameters do is not asked here."
    ),
    NO_LIMIT: (
        "Neither is a limit of the other, over complex parameters or positive ones: fitted to a"
        " machine of the other kind, each leaves an error however well it is measured, special"
        " values aside."
    ),
    NOT_KNOWN: "Whether {L} is a limit of {R}, approached as closely as one likes, is not known.",
}


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
    """Reason why smaller models are not contained in larger ones, or why that is unknown, and its
    pairs.
    """

    why: str
    pairs: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Size:
    """The models of one size with their drawings; `folder` of their pages, "" where there are
    none.
    """

    masses: int
    folder: str
    drawings: tuple[Drawing, ...]


def sizes_page(catalog: SizesCatalog, *, beside: Families | None = None) -> str:
    """HTML of models of several sizes; `beside`: the adjacent pages of pairs (see `families`)."""
    pages = families([], across=[catalog]) | dict(beside or {})
    counts, domains = list(between(catalog)), [over(catalog, view) for view in VIEWS]
    drawings = [Drawing(number, draw(chain)) for number, chain in enumerate(catalog.family, 1)]
    return render(
        "sizes.html",
        damped=catalog.damped,
        sizes=list(_sizes(catalog, pages, drawings)),
        models=len(catalog.family),
        views=[(view, VIEW_TITLES[view]) for view in VIEWS],
        between=counts,
        inside=sum(b.inside for b in counts),
        pairs=sum(b.inside + b.outside + b.unknown for b in counts),
        unknown=sum(b.unknown for b in counts),
        limits=True,  # the panel has room for them
        outside=list(_by_reason(catalog, NO_LIMIT)),
        open=list(_by_reason(catalog, NOT_KNOWN)),
        held=share(drawings),
        payload=payload(
            catalog,
            domains,
            VIEWS,
            sizes=[[c.n_masses, len(c.family)] for c in catalog.catalogs],
            damped=catalog.damped,
            premise=str(catalog.premise),
            version=__version__,
            families=pages,
            limits=limits(catalog),
            next={},
            sketches={},
        ),
        plural=plural,
    )


def limits(catalog: SizesCatalog) -> dict[str, object]:
    """For the page's script: of each pair, in the order of the payload, its entry; an entry is a
    kind, a sentence and a reason.
    """
    entries: dict[tuple[int, str, str], int] = {}
    places = [
        entries.setdefault(_entry(catalog.verdict(low, high, View.EXACT)), len(entries))
        for high in range(2, len(catalog.family) + 1)
        for low in range(1, high)
    ]
    return {
        "short": SHORT,
        "signs": ["", "⊂", "⊃", "", "?"],
        "entries": list(entries),
        "of": pack(places),
    }


def limit(verdict: Verdict) -> int:
    """Number of the model that is a limit of the other one; UNTOLD for models that are equivalent
    over complex parameters.
    """
    return KINDS.get(verdict.closure, UNTOLD)


def _entry(verdict: Verdict) -> tuple[int, str, str]:
    sentence = SENTENCES.get(limit(verdict), "")
    if _masses(verdict.left) == _masses(verdict.right):
        inclusions = verdict.inclusions
        sentence = (
            ""
            if inclusions is None
            else f"Over complex parameters: {inclusions.sentence('{L}', '{R}')}"
        )
    return limit(verdict), sentence, _reason(verdict)


def between(catalog: SizesCatalog) -> Iterator[Between]:
    """Counts for every two sizes."""
    number: defaultdict[tuple[int, int], Counter[int]] = defaultdict(Counter)
    for v in _across(catalog):
        number[_masses(v.left), _masses(v.right)][limit(v)] += 1
    for (small, large), count in sorted(number.items()):
        yield Between(small, large, count[LEFT_INSIDE], count[NO_LIMIT], count[NOT_KNOWN])


def _by_reason(catalog: SizesCatalog, wanted: int) -> Iterator[Outside]:
    """The pairs of two sizes of one kind, those with one reason together."""
    pairs: defaultdict[str, list[tuple[str, str]]] = defaultdict(list)
    for v in _across(catalog):
        if limit(v) == wanted:
            why = _reason(v).format(L="the smaller one", R="the larger one")
            pairs[why[:1].upper() + why[1:]].append((v.left, v.right))
    for why, of in pairs.items():
        yield Outside(why, tuple(of))


def _across(catalog: SizesCatalog) -> Iterator[Verdict]:
    """Pairs of different size, the smaller model first."""
    numbers = range(1, len(catalog.family) + 1)
    return (
        catalog.verdict(i, j, View.EXACT)
        for i, j in combinations(numbers, 2)
        if catalog.size(i) != catalog.size(j)
    )


def _masses(name: str) -> int:
    return int(name.partition(":")[0])


def _reason(verdict: Verdict) -> str:
    """Why one is a limit of the other, why neither is, or why it is not known; {L} and {R} denote
    the names. "" where there is no statement.

    Models of equal rank have no evidence of their own, because limits with fewer poles have a
    smaller one.
    """
    of_two_sizes = _masses(verdict.left) != _masses(verdict.right)
    if verdict.inclusions is None:
        return (
            "Both have equally many determinable parameters; limits of {R} with fewer poles have"
            " fewer."
            if of_two_sizes
            else ""
        )
    finding = verdict.inclusions.closure
    return (
        finding.evidence.sentence("{L}", "{R}") + _error_bound(finding)
        if finding.evidence
        else _open(finding)
    )


def _error_bound(finding: InclusionFinding) -> str:
    if finding.certainty is not Certainty.BOUNDED:
        return ""
    return f" ({raise_exponents(finding.certainty.in_words(finding.safety))})"


def _open(finding: InclusionFinding) -> str:
    """The reason as a sentence; it may have braces of its own."""
    reason = finding.reason.replace("{", "(").replace("}", ")")
    return f"{reason[:1].upper()}{reason[1:]}." if reason else ""


def _sizes(catalog: SizesCatalog, pages: Families, drawings: Sequence[Drawing]) -> Iterator[Size]:
    rest = iter(drawings)
    for c in catalog.catalogs:
        folder = str(pages.get(c.name, {}).get("folder", ""))
        yield Size(c.n_masses, folder, tuple(next(rest) for _ in c.family))
