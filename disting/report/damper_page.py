"""A family with sets of dampers to the ground as one HTML page that needs nothing else, be it of
thousands of models.

The page holds the classes in a compact form, not the pairs; its script looks every pair up as
`Classes` does. A class has a bucket number in every column (0: not known), a model its class and
what the rules inside a class go by: which models are renamings of it, its free choice (0: none),
its rank. Classes are numbered from 0, the largest first, so that the classes of several models come
before the others; columns are listed class by class, models in the family's order.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from disting.catalogs.dampers import DamperFamily, Masses, Name, spell
from disting.catalogs.files import name_of as chains_name
from disting.conditions.rule import EXACT, FREE_CHOICE, RENAMING, RULES, SUBMODEL, SUPERMODEL
from disting.errors import InputError
from disting.model.chain import Chain
from disting.report.drawing import (
    Drawing,
    draw,
    ground_dampers,
    height_with_dampers,
    share,
)
from disting.report.environment import render
from disting.report.page import decides
from disting.report.payload import pack, script_json
from disting.report.search import Families, families
from disting.report.words import plural
from disting.verdict.classes import Classes
from disting.verdict.result import Relation

Numbers = NDArray[np.int64]
Rule = tuple[str, str, str]
"""Sign in a field, name in words, and the condition."""
LINKS = {
    "renaming": RENAMING,
    "free": FREE_CHOICE,
    "submodel": SUBMODEL,
    "supermodel": SUPERMODEL,
    "exact": EXACT,
}
"""Rules that link the models of one class, as the page's script calls them."""


@dataclass(frozen=True, slots=True)
class ClassNumbers:
    """Classes by size: `group[i]` is the class of model i, `first[g]` the first model of class
    g.
    """

    group: Numbers
    first: Numbers
    sizes: Numbers

    @property
    def several(self) -> int:
        """Number of classes with more than one model."""
        return int((self.sizes > 1).sum())

    def members(self, group: int) -> tuple[int, ...]:
        """Models of a class."""
        return tuple(map(int, np.flatnonzero(self.group == group)))


def number_classes(classes: Classes) -> ClassNumbers:
    """The classes, the largest first, those of one size by their first models.

    Raises InputError where the columns of a class disagree: then no look-up by class is possible.
    """
    _, first, inverse, sizes = np.unique(
        classes.group, return_index=True, return_inverse=True, return_counts=True
    )
    if not np.array_equal(classes.columns, classes.columns[first][inverse]):
        raise InputError("the models of one class have the same buckets")
    order = np.lexsort((first, -sizes))
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    return ClassNumbers(place[inverse], first[order], sizes[order])


def payload(family: DamperFamily, **more: object) -> Markup:
    """JSON text that is safe inside a script element, with what else the page's script is to
    know.
    """
    classes, by_size = family.found, number_classes(family.found)
    data = more | {
        "masses": family.family.n_masses,
        "damped": family.family.damped,
        "sets": [bits(masses) for masses in family.sets],
        "structures": [
            [chain.gap, mirror(chain), len(chain.structure.elements)] for chain in family.family
        ],
        "tests": classes.tests,
        "rules": rules(),
        "links": {name: rule.name for name, rule in LINKS.items()},
        "several": by_size.several,
        "classes": len(by_size.first),
        "columns": [_pack(column + 1) for column in classes.columns[by_size.first].T],
        "open": open_classes(classes, by_size),
        "group": _pack(by_size.group),
        "renamed": _pack(_renumber(classes.renamed)),
        "free": _pack(classes.free + 1),
        "rank": _pack(classes.rank),
    }
    return script_json(data)


def bits(masses: Masses) -> int:
    """A set of masses as a number: bit m denotes mass m.

    >>> bits((1, 3))
    10
    """
    return sum(1 << mass for mass in masses)


def mirror(chain: Chain) -> int:
    """Mass m of the free row is equivalent to mass (this number) - m, because force and sensor are
    at its centre; else 0.

    >>> mirror(Chain(3, 0, 0, 2, 0, 2, damped=False)), mirror(Chain(3, damped=False))
    (4, 0)
    """
    fold = chain.gap + 1 + chain.n_masses
    return fold if chain.act_plus == chain.meas_plus == fold - chain.act_plus else 0


def rules() -> dict[str, Rule]:
    """Texts of the page on every rule."""
    names = {
        rule.name: (rule.sign, f"{rule.in_words()}, {rule.title}", rule.text)
        for rule in RULES.values()
        if rule.is_condition
    }
    return names | {EXACT.name: (EXACT.sign, EXACT.in_words(), "")}


def open_classes(classes: Classes, by_size: ClassNumbers) -> list[tuple[int, int]]:
    """Pairs of classes that nothing decides, in their new numbers."""
    number = dict(zip(map(int, classes.group), map(int, by_size.group), strict=True))
    return sorted(
        (min(p), max(p)) for p in ((number[a], number[b]) for a, b in classes.open_groups)
    )


def _renumber(values: NDArray[np.int32]) -> Numbers:
    """Numbers in the order of first appearance: smaller ones."""
    _, first, inverse = np.unique(values, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(first))[inverse]


def _pack(values: NDArray[np.integer]) -> list[int]:
    return pack(values.tolist())


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
    """HTML of a family with sets of ground dampers; `beside`: the adjacent pages of pairs (see
    `families`).

    >>> from disting.catalogs.dampers import damper_catalog
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
    names, exact = rules(), EXACT.name
    parts = {rule: (decides(RULES[rule]), number.get(rule, 0)) for rule in names if rule != exact}
    by_exact = same - sum(
        n for relation, n in parts.values() if relation is Relation.INDISTINGUISHABLE
    )
    rows = [(rule, relation, n) for rule, (relation, n) in parts.items()]
    rows += [
        (exact, Relation.DISTINGUISHABLE, number.get(exact, 0) - by_exact),
        (exact, Relation.INDISTINGUISHABLE, by_exact),
    ]
    own_counts = [
        Count(names[rule][0], _title(names[rule][1]), names[rule][2], relation, n)
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
    """Without the number, which is next to it."""
    return words.partition(", ")[2] or words.removeprefix("the ")
