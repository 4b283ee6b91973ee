"""What may be used to decide a pair: representations, conditions, Markov parameters, and the
values of the parameters.

Asked without more, it is about positive parameters: masses, springs and dampers of a machine are
positive. The paper's views speak of generic complex parameters.
"""

from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

from disting.conditions.rule import RULES, Rule, Stage
from disting.errors import InputError
from disting.model.question import Domain

ALL_CONDITIONS = tuple(name for name, rule in RULES.items() if rule.is_condition)


class View(StrEnum):
    """Which representations may decide: `combined` is the paper's, all conditions; `exact` adds
    the exact decision.

    All of them are over complex parameters. `real` and `positive` are `exact`, and then look
    whether equivalents with such parameters exist; `positive` is what is meant where nothing is
    said.

    >>> View.POSITIVE.domain.value, View.MARKOV.domain.value
    ('positive', 'complex')
    """

    TF = "tf"
    MARKOV = "markov"
    COMBINED = "combined"
    EXACT = "exact"
    REAL = "real"
    POSITIVE = "positive"

    @cached_property
    def domain(self) -> Domain:
        """Parameter values that this view speaks of."""
        return Domain(self.value) if self in (View.REAL, View.POSITIVE) else Domain.COMPLEX

    @cached_property
    def representations(self) -> tuple[Stage, ...]:
        """The representations of this view, in order."""
        if self in (View.TF, View.MARKOV):
            return (Stage(self.value),)
        conditions = (Stage.TF, Stage.MARKOV, Stage.STRUCTURE)
        return conditions if self is View.COMBINED else (*conditions, Stage.FIBRE)


@dataclass(frozen=True, slots=True)
class Query:
    """What may be used to decide: the view, the conditions' names, the number of Markov parameters
    (0 = all).

    `inclusion`: after the exact decision, say also whose models lie in the other's closure and
    which positive models have positive equivalents; this is most of the work.

    >>> from disting import compare
    >>> compare("3:1", "3:4", query=Query(View.COMBINED, ("1", "4", "5"))).decided_by
    '5'
    """

    view: View = View.POSITIVE
    conditions: tuple[str, ...] = ALL_CONDITIONS
    markov: int = 0
    inclusion: bool = True

    def __post_init__(self) -> None:
        # numbers do as well as names
        object.__setattr__(self, "conditions", tuple(map(str, self.conditions)))
        unknown = [name for name in self.conditions if name not in ALL_CONDITIONS]
        if unknown:
            raise InputError(
                f"conditions are {', '.join(ALL_CONDITIONS)}, not {', '.join(unknown)}"
            )
        if self.markov < 0:
            raise InputError(
                f"the number of Markov parameters is 1 or more, or 0 for all, not {self.markov}"
            )

    def __repr__(self) -> str:
        options = [] if self.view is View.POSITIVE else [f"View.{self.view.name}"]
        options += [f"conditions={self.conditions}"] if self.conditions != ALL_CONDITIONS else []
        options += [f"markov={self.markov}"] if self.markov else []
        options += [] if self.inclusion else ["inclusion=False"]
        return f"Query({', '.join(options)})"

    def asks(self, rule: Rule) -> bool:
        """Whether this condition may decide."""
        return rule.name in self.conditions

    @property
    def tells_inclusion(self) -> bool:
        """Whether verdicts say whose models have equivalents on the other side: not in the
        paper's views.
        """
        return self.inclusion and Stage.FIBRE in self.view.representations

    def count(self, n_states: int) -> int:
        """Number of Markov parameters after G_0: as asked, or the N_S1 + N_S2 = `n_states` of both
        models, which are exhaustive.
        """
        return self.markov or n_states
