"""What one kind of further experiment leaves together of structures that one measurement cannot
tell apart, as it is found (`placement`), shipped and looked up.
"""

from collections.abc import Sequence, Set
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

from disting.algebra.certainty import Certainty, Grade
from disting.conditions.rule import EXACT
from disting.conditions.table import NECESSARY
from disting.experiments.menu import Gain
from disting.model.kinds import Kind
from disting.model.presentation import plural, summary
from disting.verdict.buckets import NOT_KNOWN
from disting.verdict.placement_verdicts import Answer
from disting.verdict.result import Relation

Spot = tuple[int, int]
"""(structure, counted from 0; mass)."""
REPEATS = "repeats"  # beside the rules: the experiment shows what the first one showed
TESTS = (REPEATS, *(c.rule.name for c in NECESSARY))
CERTAIN = (REPEATS, *(c.rule.name for c in NECESSARY if c.of_degrees))  # nothing left to chance


class Table(Protocol):
    """What one kind of experiment leaves together, spot against spot."""

    def only(self, structures: Sequence[int]) -> "Table":
        """Some of the structures, counted from 0, in this order."""

    def gain(self, spot: Spot) -> Gain:
        """What is gained there."""

    def look_up(self, left: Spot, right: Spot) -> tuple[Relation, str]:
        """Relation and deciding rule of two spots, "" if undecided."""

    def grade(self, left: Spot, right: Spot) -> Grade | tuple[str, int]:
        """How sure that is: the certainty, and e where what is said is wrong with a probability of
        2**-e at most; "" and 0 of what is undecided.
        """

    def alike(self, spot: Spot, other: int) -> tuple[int, ...]:
        """Places in another structure at which it is not told from this one at this spot; what is
        undecided included.
        """

    def answer(self, spot: Spot, other: int) -> Answer:
        """Whether the experiment at a spot tells its structure from another one, wherever the
        place is in that.
        """


def answer_of(relations: Set[Relation]) -> Answer:
    """What the relations to all places of another structure come to."""
    if relations <= {Relation.DISTINGUISHABLE}:
        return Answer.SURELY
    if relations == {Relation.INDISTINGUISHABLE}:
        return Answer.NEVER
    if {Relation.DISTINGUISHABLE, Relation.INDISTINGUISHABLE} <= relations:
        return Answer.DEPENDS
    return Answer.UNKNOWN


@dataclass(frozen=True)
class Placement:
    """What one kind of experiment leaves together.

    `gains[s]`: what is gained at spot s, in the order of `spots`; `columns[s][t]`: its bucket in
    test TESTS[t], -1 where it is not known; `classes[s]`; `links[s]`: spots of equal links, such as
    "6/3", are the same by that rule, others of a class by the exact decision; `open`: pairs of
    classes that nothing decides; all that is said is wrong with a probability of at most
    2**-safety, 0: nothing is left to chance.
    """

    kind: Kind
    n_masses: int
    gains: tuple[Gain, ...]
    columns: tuple[tuple[int, ...], ...]
    classes: tuple[int, ...]
    links: tuple[str, ...]
    open: frozenset[tuple[int, int]]
    safety: int

    def __repr__(self) -> str:
        return summary(self, f"{self.kind.name}, {plural(len(self.gains), 'place')}")

    @cached_property
    def _alike(self) -> dict[tuple[Spot, int], tuple[int, ...]]:
        """What was asked for: pairs of experiments ask for each of them again and again."""
        return {}

    @property
    def structures(self) -> int:
        """How many structures there are."""
        return len(self.gains) // self.n_masses

    def only(self, structures: Sequence[int]) -> "Placement":
        """Some of the structures, counted from 0, in this order."""
        at = [self._at((k, i)) for k in structures for i in range(1, self.n_masses + 1)]
        return replace(
            self,
            gains=tuple(self.gains[s] for s in at),
            columns=tuple(self.columns[s] for s in at),
            classes=tuple(self.classes[s] for s in at),
            links=tuple(self.links[s] for s in at),
        )

    def gain(self, spot: Spot) -> Gain:
        """What is gained there."""
        return self.gains[self._at(spot)]

    def look_up(self, left: Spot, right: Spot) -> tuple[Relation, str]:
        """Relation and deciding rule of two spots, "" if undecided."""
        a, b = self._at(left), self._at(right)
        for name, *buckets in zip(TESTS, self.columns[a], self.columns[b], strict=True):
            if NOT_KNOWN not in buckets and buckets[0] != buckets[1]:
                return Relation.DISTINGUISHABLE, name
        low, high = sorted((self.classes[a], self.classes[b]))
        if low == high:
            same = self.links[a] == self.links[b] != ""
            return Relation.INDISTINGUISHABLE, self._rule(a) if same else EXACT.name
        if (low, high) in self.open:
            return Relation.UNDECIDED, ""
        return Relation.DISTINGUISHABLE, EXACT.name

    def grade(self, left: Spot, right: Spot) -> Grade | tuple[str, int]:
        """Certainty and safety of the table, "" of what is undecided."""
        rule = self.look_up(left, right)[1]
        if not rule:
            return "", self.safety
        sure = rule in CERTAIN or not self.safety
        return Certainty.PROVEN if sure else Certainty.BOUNDED, self.safety

    def alike(self, spot: Spot, other: int) -> tuple[int, ...]:
        """Masses of another structure at which it is not told from this one at this spot; what is
        undecided included.
        """
        if (spot, other) not in self._alike:
            masses = range(1, self.n_masses + 1)
            relations = (self.look_up(spot, (other, j))[0] for j in masses)
            apart = Relation.DISTINGUISHABLE
            self._alike[spot, other] = tuple(
                j for j, r in enumerate(relations, 1) if r is not apart
            )
        return self._alike[spot, other]

    def answer(self, spot: Spot, other: int) -> Answer:
        """Whether the experiment at a spot tells its structure from another one, wherever the
        place is in that.
        """
        relations = {self.look_up(spot, (other, j))[0] for j in range(1, self.n_masses + 1)}
        return answer_of(relations)

    def _rule(self, at: int) -> str:
        return self.links[at].partition("/")[0]

    def _at(self, spot: Spot) -> int:
        return spot[0] * self.n_masses + spot[1] - 1
