"""The classes of a family with ground dampers in a compact form: the page's script looks every
pair up as `Classes` does.

No pair is sent. A class has a bucket number in every column (0: not known), a model its class and
what the rules inside a class go by: which models are renamings of it, its free choice (0: none),
its rank. Classes are numbered from 0, the largest first, so that the classes of several models
come before the others; columns are told class by class, models in the family's order.
"""

from dataclasses import dataclass

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from disting.catalogs.damper_family import DamperFamily
from disting.catalogs.dampers import Masses
from disting.conditions.rule import EXACT, FREE_CHOICE, RENAMING, RULES, SUBMODEL, SUPERMODEL
from disting.errors import InputError
from disting.model.chain import Chain
from disting.report.payload import pack, script_json
from disting.verdict.classes import Classes

Numbers = NDArray[np.int64]
Rule = tuple[str, str, str]
"""Sign in a field, name in words, and what the condition asks for."""
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
        "columns": [_packed(column + 1) for column in classes.columns[by_size.first].T],
        "open": open_classes(classes, by_size),
        "group": _packed(by_size.group),
        "renamed": _packed(_renumbered(classes.renamed)),
        "free": _packed(classes.free + 1),
        "rank": _packed(classes.rank),
    }
    return script_json(data)


def bits(masses: Masses) -> int:
    """A set of masses as a number: bit m stands for mass m.

    >>> bits((1, 3))
    10
    """
    return sum(1 << mass for mass in masses)


def mirror(chain: Chain) -> int:
    """Mass m of the free row may be taken for mass (this number) - m, because force and sensor
    are at its centre; else 0.

    >>> mirror(Chain(3, 0, 0, 2, 0, 2, damped=False)), mirror(Chain(3, damped=False))
    (4, 0)
    """
    fold = chain.gap + 1 + chain.n_masses
    return fold if chain.act_plus == chain.meas_plus == fold - chain.act_plus else 0


def rules() -> dict[str, Rule]:
    """What the page says of every rule."""
    said = {
        rule.name: (rule.sign, f"{rule.in_words()}, {rule.title}", rule.text)
        for rule in RULES.values()
        if rule.is_condition
    }
    return said | {EXACT.name: (EXACT.sign, EXACT.in_words(), "")}


def open_classes(classes: Classes, by_size: ClassNumbers) -> list[tuple[int, int]]:
    """Pairs of classes that nothing decides, in their new numbers."""
    number = dict(zip(map(int, classes.group), map(int, by_size.group), strict=True))
    return sorted(
        (min(p), max(p)) for p in ((number[a], number[b]) for a, b in classes.open_groups)
    )


def _renumbered(values: NDArray[np.int32]) -> Numbers:
    """Numbers in the order of first appearance: smaller ones."""
    _, first, inverse = np.unique(values, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(first))[inverse]


def _packed(values: NDArray[np.integer]) -> list[int]:
    return pack(values.tolist())
