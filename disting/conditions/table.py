"""The ordered table of conditions: it is the programme, and it prints itself into help texts,
legends and pages.

A new condition is a rule, which gives its name and what its outcome proves, and a row here, which
gives its function.
"""

from collections.abc import Callable, Hashable
from dataclasses import dataclass

from disting.algebra.certainty import Grade
from disting.behaviour.profile import Profile
from disting.behaviour.sample import Representation
from disting.conditions import necessary, sufficient
from disting.conditions.rule import (
    DEGREES,
    DEPENDENCES,
    FORM,
    FREE_CHOICE,
    INVARIANTS,
    RANK,
    RENAMING,
    SUBMODEL,
    SUPERMODEL,
    Finding,
    Rule,
)
from disting.conditions.side import AnySide
from disting.model.presentation import summary


@dataclass(frozen=True, slots=True)
class Condition:
    """A row of the table: a rule, and the function that evaluates it."""

    rule: Rule

    def __repr__(self) -> str:
        return summary(self, f"{self.rule.in_words()}, {self.rule.title}")


@dataclass(frozen=True, slots=True, repr=False)
class Necessary(Condition):
    """A condition on a property of profiles.

    `key` is the property of one model that must agree, `grade` the certainty of a failure, `check`
    the finding with evidence; `of_degrees`: it looks at polynomial degrees, which Markov
    parameters do not have.
    """

    key: Callable[[Profile], Hashable]
    grade: Callable[[Profile, Profile], Grade]
    check: Callable[[Profile, Profile], Finding]
    of_degrees: bool = False
    of_dependences: bool = False


@dataclass(frozen=True, slots=True, repr=False)
class Sufficient(Condition):
    """A condition on the exhaustive summaries of two sides, in a representation, with so
    many Markov parameters.
    """

    check: Callable[[AnySide, AnySide, Representation, int], Finding]


@dataclass(frozen=True, slots=True, repr=False)
class Structural(Condition):
    """A sufficient condition on the model structure, in no representation."""

    check: Callable[[AnySide, AnySide], Finding]


def _renaming(left: AnySide, right: AnySide, representation: Representation, count: int) -> Finding:
    whole = left.profile(representation, count).describes_all(right.profile(representation, count))
    return sufficient.condition_6(left, right, whole)


def _free_choice(
    left: AnySide, right: AnySide, representation: Representation, count: int
) -> Finding:
    return sufficient.condition_7(
        left.profile(representation, count), right.profile(representation, count)
    )


_n = necessary
NECESSARY = (
    Necessary(
        INVARIANTS, _n.number_of_invariants, _n.degree_grade, _n.condition_1, of_degrees=True
    ),
    Necessary(
        DEGREES, _n.numbers_of_coefficients, _n.degree_grade, _n.condition_2, of_degrees=True
    ),
    Necessary(FORM, _n.symbolic_form, _n.form_grade, _n.condition_3),
    Necessary(RANK, _n.generic_rank, _n.rank_grade, _n.condition_4),
    Necessary(
        DEPENDENCES, _n.dependences, _n.dependence_grade, _n.condition_5, of_dependences=True
    ),
)
SUFFICIENT = (
    Sufficient(RENAMING, _renaming),
    Sufficient(FREE_CHOICE, _free_choice),
)
STRUCTURAL = (
    Structural(SUBMODEL, sufficient.condition_8),
    Structural(SUPERMODEL, sufficient.condition_9),
)
CONDITIONS: tuple[Necessary | Sufficient | Structural, ...] = (*NECESSARY, *SUFFICIENT, *STRUCTURAL)
