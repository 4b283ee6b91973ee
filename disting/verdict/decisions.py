"""Decisions on all pairs of a list of models, as numbers by pair. Evidence is made on request for a
pair.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import combinations
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from disting.algebra.certainty import Certainty, Grade
from disting.behaviour.profile import Profile
from disting.behaviour.sample import Representation
from disting.conditions.inclusion import Inclusion, Inclusions, Sense
from disting.conditions.rule import ADMISSIBLE, RULES, Finding, Stage
from disting.conditions.side import AnySide
from disting.conditions.table import NECESSARY
from disting.evidence.positive import PositiveFinding
from disting.model.chain import Chain
from disting.model.presentation import NotebookTable, plural, summary
from disting.verdict.cascade import decide, verdict_of
from disting.verdict.forest import classes_of
from disting.verdict.result import Query, Relation, Step, Verdict

NAMES = ("", *RULES)  # what the numbers in `decided_by` stand for
NUMBERS = {name: number for number, name in enumerate(NAMES)}
GRADES = {c.rule.name: c for c in NECESSARY}
STAGES = tuple(Stage)
Numbers = NDArray[np.uint8]
Pair = tuple[int, int]
T = TypeVar("T")


@dataclass(frozen=True)
class Part:
    """Decisions on some models of a list among themselves; `places`: their places in the list."""

    decisions: "Decisions"
    places: tuple[int, ...]

    @cached_property
    def numbers(self) -> dict[int, int]:
        """Numbers of the part's models by their places in the list."""
        return {place: number for number, place in enumerate(self.places)}

    def moved(self, values: Mapping[Pair, T]) -> dict[Pair, T]:
        """Values of its pairs, by their places in the list."""
        return {(self.places[i], self.places[j]): x for (i, j), x in values.items()}


@dataclass(frozen=True)
class Decisions(NotebookTable):
    """For subjects i < j: `decided_by[i, j]` indexes NAMES, `representation[i, j]` STAGES.

    `steps` holds the findings of the pairs that a sufficient condition decided, `proven` the pairs
    whose bounded finding by a necessary condition was proven afterwards, `inclusions` the findings
    on pairs of unequal rank. `shares[i, j]` gives, for i before or after j, which positive models i
    have a positive equivalent j: of indistinguishable pairs both ways, of included models in the
    ones that they lie in. `equal` keeps the findings over complex parameters of the pairs that were
    decided again over real or positive ones. `part`: those models of a mixed list that are chains,
    decided as chains; of their pairs all else here is a copy.

    >>> from disting import Engine, Family, Query
    >>> engine = Engine()
    >>> sides = [engine.subject(f"A{i}", chain) for i, chain in enumerate(Family(2), 1)]
    >>> engine.decisions(sides, Query()).verdict(0, 2).relation.value
    'indistinguishable'
    """

    subjects: tuple[AnySide, ...]
    query: Query
    decided_by: Numbers
    representation: Numbers
    steps: dict[tuple[int, int], Step] = field(default_factory=dict)
    proven: frozenset[tuple[int, int]] = frozenset()
    inclusions: dict[tuple[int, int], Inclusions] = field(default_factory=dict)
    shares: dict[tuple[int, int], PositiveFinding] = field(default_factory=dict)
    equal: dict[tuple[int, int], Finding] = field(default_factory=dict)
    part: Part | None = None

    def __repr__(self) -> str:
        size = len(self.subjects)
        pairs = plural(size * (size - 1) // 2, "pair")
        return summary(
            self, f"{plural(size, 'model')}, {pairs}, over {self.query.view.domain} parameters"
        )

    def with_part(self, part: Part) -> "Decisions":
        """The same with what is decided of the pairs of a part in their places."""
        inside = np.ix_(part.places, part.places)
        decided_by, representation = self.decided_by.copy(), self.representation.copy()
        decided_by[inside] = part.decisions.decided_by
        representation[inside] = part.decisions.representation
        inner_part = part.decisions
        own = {pair: x for pair, x in self.inclusions.items() if not part.numbers.keys() >= {*pair}}
        return replace(
            self,
            decided_by=decided_by,
            representation=representation,
            steps=self.steps | part.moved(inner_part.steps),
            inclusions=own | part.moved(inner_part.inclusions),
            shares=self.shares | part.moved(inner_part.shares),
            equal=self.equal | part.moved(inner_part.equal),
            part=part,
        )

    def within(self, i: int, j: int) -> Pair | None:
        """Pair of the part at these places, if there is one."""
        numbers = self.part.numbers if self.part else {}
        return (numbers[i], numbers[j]) if i in numbers and j in numbers else None

    @cached_property
    def chains(self) -> tuple[Chain, ...]:
        """The chains that were compared, none where they are general models."""
        return tuple(s.chain for s in self.subjects if s.chain is s.subject)

    @property
    def sizes(self) -> list[int]:
        """Numbers of masses of the chains."""
        return [chain.n_masses for chain in self.chains]

    def profile(self, representation: Stage, i: int) -> Profile:
        """The profile by which pairs of model i were decided in a representation."""
        r = Representation(representation)
        return self.subjects[i].profile(r, 0 if r is Representation.TF else self._markov)

    @cached_property
    def _markov(self) -> int:
        return markov_count(Representation.MARKOV, self.query, self.subjects)

    def relation(self, i: int, j: int) -> Relation:
        """Relation of subjects i and j (counted from 0, in any order)."""
        i, j = min(i, j), max(i, j)
        if not self.decided_by[i, j]:
            return Relation.UNDECIDED
        return self.steps[i, j].relation if (i, j) in self.steps else Relation.DISTINGUISHABLE

    def rule(self, i: int, j: int) -> str:
        """Name of the rule that decides subjects i and j, "" if none does."""
        return NAMES[int(self.decided_by[min(i, j), max(i, j)])]

    def verdict(self, i: int, j: int) -> Verdict:
        """The verdict with its evidence; only the deciding condition is run."""
        i, j = min(i, j), max(i, j)
        inner = self.within(i, j)
        if self.part and inner:
            return self.part.decisions.verdict(*inner)
        left, right = self.subjects[i], self.subjects[j]
        if (i, j) in self.steps:
            return self._include(
                i, j, verdict_of(left, right, self.steps[i, j], self.query.view.domain)
            )
        rule, where = self.rule(i, j), STAGES[self.representation[i, j]]
        if not rule:
            return decide(left, right, self.query)
        finding = GRADES[rule].check(self.profile(where, i), self.profile(where, j))
        if (i, j) in self.proven:
            finding = replace(finding, certainty=Certainty.PROVEN, safety=0)
        return self._include(
            i, j, verdict_of(left, right, Step(where, finding), self.query.view.domain)
        )

    def _include(self, i: int, j: int, verdict: Verdict) -> Verdict:
        image, closure = (self.inclusion(i, j, sense) for sense in Sense)
        left_share, right_share = self.shares.get((i, j)), self.shares.get((j, i))
        both = self.inclusions.get((i, j))
        return replace(
            verdict,
            image=image,
            closure=closure,
            inclusions=both,
            left_positive=left_share,
            right_positive=right_share,
        )

    def inclusion(self, i: int, j: int, sense: Sense) -> Inclusion:
        """Whose generic models have equivalents (IMAGE), or are limits of models (CLOSURE), on the
        other side, i < j.

        Not given by the paper's views, nor where it is not decided.
        """
        if not self.query.tells_inclusion:
            return Inclusion.UNKNOWN
        if (i, j) in self.inclusions:
            both = self.inclusions[i, j]
            return (both.image if sense is Sense.IMAGE else both.closure).inclusion
        if {(i, j), (j, i)} <= self.shares.keys():
            return Inclusion.EQUAL
        step = self.steps.get((i, j))
        if step and (
            step.finding.rule is ADMISSIBLE or step.relation is Relation.INDISTINGUISHABLE
        ):
            return Inclusion.EQUAL
        return Inclusion.NEITHER if self.decided_by[i, j] else Inclusion.UNKNOWN

    def grades(self) -> Iterator[tuple[int, int, str, str, str, int]]:
        """Yield (i, j, rule, representation, certainty, safety) of all pairs, without evidence."""
        grades = {(g[0], g[1]): g[2:] for g in self.part.decisions.grades()} if self.part else {}
        profiles: dict[tuple[int, int], Profile] = {}

        def profile(where: int, i: int) -> Profile:
            """The profile of model i in the representation of this number, looked up once."""
            if (where, i) not in profiles:
                profiles[where, i] = self.profile(STAGES[where], i)
            return profiles[where, i]

        for i, j in combinations(range(len(self.subjects)), 2):
            inner = self.within(i, j)
            if inner:
                yield i, j, *grades[inner]
                continue
            rule, where = self.rule(i, j), int(self.representation[i, j])
            grade: Grade | tuple[str, int] = ("", 0)
            if (i, j) in self.proven:
                grade = (Certainty.PROVEN, 0)
            elif (i, j) in self.steps:
                grade = (self.steps[i, j].finding.certainty, self.steps[i, j].finding.safety)
            elif rule:
                grade = GRADES[rule].grade(profile(where, i), profile(where, j))
            yield i, j, rule, STAGES[where], str(grade[0]), grade[1]

    def classes(self) -> tuple[tuple[int, ...], ...]:
        """Groups of two or more subjects, counted from 0, that are mutually indistinguishable.

        An undecided pair of one group is none; raises ContradictionError where the verdicts
        contradict each other.
        """
        classes = classes_of([s.name for s in self.subjects], self.relation)
        return tuple(members for members in classes if len(members) > 1)

    def counts(self) -> dict[str, int]:
        """Number of pairs by deciding condition, "exact" for the exact decision, "" for the
        undecided ones.
        """
        counts = np.bincount(self.decided_by[np.triu_indices(len(self.subjects), 1)], minlength=1)
        return {NAMES[number]: int(n) for number, n in enumerate(counts) if n or number == 0}


def markov_count(r: Representation, query: Query, subjects: Sequence[AnySide]) -> int:
    """Markov parameters after G_0: as requested, or twice the number of states of the largest
    model, enough for every pair.
    """
    largest = max((s for s in subjects if s.in_s), key=lambda s: s.n_states, default=None)
    return 0 if r is Representation.TF or largest is None else query.count(2 * largest.n_states)
