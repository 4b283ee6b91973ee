"""A family with sets of dampers to the ground as one HTML page that needs nothing else, be it of
thousands of models.

The page holds the classes, not the pairs (see `damper_payload`); its script looks up what a field
shows.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from disting.catalogs.damper_family import DamperFamily, Name
from disting.catalogs.dampers import spell
from disting.catalogs.files import name_of as chains_name
from disting.conditions.rule import EXACT, RULES
from disting.model.chain import Chain
from disting.report.damper_payload import ClassNumbers, number_classes, open_classes, payload, rules
from disting.report.drawing import draw
from disting.report.environment import render
from disting.report.page import decides
from disting.report.page_drawing import (
    Drawing,
    ground_dampers,
    height_with_dampers,
    share,
)
from disting.report.search import Families, families
from disting.report.words import plural
from disting.verdict.result import Relation

LISTED = 24  # undecided pairs of classes up to this number are listed
SHOWN_AT_ONCE = 12  # classes; more are folded away


@dataclass(frozen=True, slots=True)
class Group:
    """A class of indistinguishable models: structures, and the sets of ground dampers that each
    of them has in the class.
    """

    number: int
    size: int
    members: tuple[tuple[tuple[int, ...], str], ...]


@dataclass(frozen=True, slots=True)
class Structure:
    """A chain with all its sets of ground dampers: into how many classes they fall, and how
    many pairs of those are open.
    """

    drawing: Drawing
    classes: int
    undecided: int


@dataclass(frozen=True, slots=True)
class Count:
    """A row of the table of counts."""

    sign: str
    title: str
    text: str
    relation: Relation
    number: int


@dataclass(frozen=True, slots=True)
class Open:
    """Two classes that nothing decides: their first models, and how many pairs of models that
    is.
    """

    left: str
    right: str
    pairs: int


def damper_page(the_family: DamperFamily, *, beside: Families | None = None) -> str:
    """HTML of a family with sets of ground dampers; `beside`: the pages of pairs beside it (see
    `families`).

    >>> from disting.catalogs.damper_family import damper_catalog
    >>> damper_page(damper_catalog(3, damped=True))[:15]
    '<!DOCTYPE html>'
    """
    pages = families([], [the_family]) | dict(beside or {})
    catalog = chains_name(the_family.family.n_masses, the_family.family.damped) in pages
    family, by_size, totals = (
        the_family.family,
        number_classes(the_family.found),
        the_family.found.counts(),
    )
    drawings = [Drawing(number, draw(chain)) for number, chain in enumerate(family, 1)]
    sample = Chain(3, 1, 1, 3, 1, 2, damped=family.damped, ground_dampers=(2,))
    example = Drawing(0, draw(sample))
    undecided = list(open_pairs(the_family, by_size))
    return render(
        "dampers.html",
        family=family,
        kind="damped" if family.damped else "undamped",
        models=len(the_family),
        sets=len(the_family.sets),
        compared=sum(totals.values()),
        totals=totals,
        groups=[_group(the_family, by_size, number) for number in range(by_size.several)],
        at_once=SHOWN_AT_ONCE,
        structures=list(structures(the_family, by_size, drawings)),
        counts=counts(the_family),
        undecided=undecided[:LISTED],
        more=len(undecided) - LISTED,
        held=share((*drawings, example), ground_dampers(family.n_masses)),
        sample=example,
        payload=payload(
            the_family,
            catalog=catalog,
            families=pages,
            tall=height_with_dampers(family.n_masses),
        ),
        catalog=catalog,
        plural=plural,
    )


def family_title(n_masses: int, damped: bool) -> str:
    """Such as "3 masses, damped"."""
    return f"{plural(n_masses, 'mass', 'masses')}, {'damped' if damped else 'undamped'}"


def structures(
    family: DamperFamily, by_size: ClassNumbers, drawings: Sequence[Drawing]
) -> Iterator[Structure]:
    """The family's chains."""
    rows = by_size.group.reshape(len(family.family), len(family.sets)).tolist()
    undecided = open_classes(family.found, by_size)
    for drawing, row in zip(drawings, map(set, rows), strict=True):
        yield Structure(drawing, len(row), sum(a in row and b in row for a, b in undecided))


def counts(family: DamperFamily) -> list[Count]:
    """Pairs by deciding rule: those that prove distinguishable, those that prove
    indistinguishable, the undecided ones.
    """
    number, same = family.found.counts_by_rule(), family.found.counts()[Relation.INDISTINGUISHABLE]
    said, exact = rules(), EXACT.name
    parts = {rule: (decides(RULES[rule]), number.get(rule, 0)) for rule in said if rule != exact}
    by_exact = same - sum(
        n for relation, n in parts.values() if relation is Relation.INDISTINGUISHABLE
    )
    rows = [(rule, relation, n) for rule, (relation, n) in parts.items()]
    rows += [
        (exact, Relation.DISTINGUISHABLE, number.get(exact, 0) - by_exact),
        (exact, Relation.INDISTINGUISHABLE, by_exact),
    ]
    own_counts = [
        Count(said[rule][0], _title(said[rule][1]), said[rule][2], relation, n)
        for rule, relation, n in rows
    ]
    return [*own_counts, Count("", "undecided", "nothing decides", Relation.UNDECIDED, number[""])]


def open_pairs(family: DamperFamily, by_size: ClassNumbers) -> Iterator[Open]:
    """The pairs of classes that stay open, in the order of the classes."""
    for a, b in open_classes(family.found, by_size):
        left, right = (_short(family.name(int(by_size.first[g]))) for g in (a, b))
        yield Open(left, right, int(by_size.sizes[a] * by_size.sizes[b]))


def _group(family: DamperFamily, by_size: ClassNumbers, number: int) -> Group:
    names = [family.name(i) for i in by_size.members(number)]
    sets: dict[str, list[int]] = {}
    for structure, of in groupby(names, key=lambda name: name[0]):
        sets.setdefault(", ".join(spell(masses) for _, masses in of), []).append(structure)
    return Group(number + 1, len(names), tuple((tuple(of), text) for text, of in sets.items()))


def _short(name: Name) -> str:
    """A model as deep links name it, such as 17+b1+b3."""
    return "+".join([str(name[0]), *(f"b{mass}" for mass in name[1])])


def _title(words: str) -> str:
    """Without the number, which stands beside it."""
    return words.partition(", ")[2] or words.removeprefix("the ")
