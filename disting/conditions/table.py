"""The ordered table of conditions: it is the programme, and it prints itself into help texts, legends and the README."""

from collections.abc import Callable, Hashable
from dataclasses import dataclass

from disting.certainty import Grade
from disting.conditions import necessary, structural, sufficient
from disting.conditions.finding import Finding
from disting.conditions.subject import Subject
from disting.invariants.profile import Profile
from disting.invariants.sample import Representation

STRUCTURE = "structure"  # the representation of conditions 8 and 9


@dataclass(frozen=True, slots=True)
class Necessary:
    """A condition whose failure proves a pair distinguishable.

    `key` is the property of one model that must agree, `grade` the certainty of a failure, `check` the finding with evidence.
    """

    number: int
    title: str
    text: str
    key: Callable[[Profile], Hashable]
    grade: Callable[[Profile, Profile], Grade]
    check: Callable[[Profile, Profile], Finding]


@dataclass(frozen=True, slots=True)
class Sufficient:
    """A condition that, where it holds, proves a pair indistinguishable; `exhaustive` tells it that the summaries are."""

    number: int
    title: str
    text: str
    check: Callable[[Subject, Subject, Representation, int], Finding]


@dataclass(frozen=True, slots=True)
class Structural:
    """A sufficient condition on the model structure, in no representation."""

    number: int
    title: str
    text: str
    check: Callable[[Subject, Subject], Finding]


def _condition_6(left: Subject, right: Subject, representation: Representation, count: int) -> Finding:
    whole = left.profile(representation, count).describes_all(right.profile(representation, count))
    return sufficient.condition_6(left, right, whole)


def _condition_7(left: Subject, right: Subject, representation: Representation, count: int) -> Finding:
    return sufficient.condition_7(left.profile(representation, count), right.profile(representation, count))


_n = necessary
NECESSARY = (
    Necessary(
        1,
        "number of invariants",
        "equally many moment invariants",
        _n.number_of_invariants,
        _n.degree_grade,
        _n.condition_1,
    ),
    Necessary(
        2,
        "degrees",
        "equally many numerator and denominator coefficients",
        _n.numbers_of_coefficients,
        _n.degree_grade,
        _n.condition_2,
    ),
    Necessary(3, "symbolic form", "the same invariants are constant", _n.symbolic_form, _n.form_grade, _n.condition_3),
    Necessary(4, "generic rank", "equally many determinable parameters", _n.generic_rank, _n.rank_grade, _n.condition_4),
    Necessary(
        5,
        "dependences",
        "the same sets of invariants are independent",
        _n.dependences,
        _n.dependence_grade,
        _n.condition_5,
    ),
)
SUFFICIENT = (
    Sufficient(6, "renaming", "a renaming of the parameters makes the invariants identical", _condition_6),
    Sufficient(7, "free choice", "as many determinable parameters as non-constant invariants", _condition_7),
)
STRUCTURAL = (
    Structural(8, "submodel", "one model is a part of the other, with equal rank", structural.condition_8),
    Structural(9, "supermodel", "both are parts of a third model, with equal rank", structural.condition_9),
)
CONDITIONS: tuple[Necessary | Sufficient | Structural, ...] = (*NECESSARY, *SUFFICIENT, *STRUCTURAL)
