"""Classes that one kind of further experiment leaves of structures that one measurement cannot
distinguish: as computed (`placement`), shipped and looked up.
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
from disting.verdict.decisions import Decisions
from disting.verdict.placement_verdicts import Answer
from disting.verdict.result import Relation

Spot = tuple[int, int]
"""(structure, counted from 0; mass or node)."""
REPEATS = "repeats"  # beside the rules: the experiment shows what the first one showed
TESTS = (REPEATS, *(c.rule.name for c in NECESSARY))
CERTAIN = (REPEATS, *(c.rule.name for c in NECESSARY if c.of_degrees))  # nothing left to chance


class Decided(Protocol):
    """Decisions on spots, by their numbers."""

    def only(self, spots: Sequence[int]) -> "Decided":
        """Some of the spots, in this order."""

    def look_up(self, a: int, b: int) -> tuple[Relation, str]:
        """Relation and deciding rule of two spots, "" if undecided."""

    def grade(self, a: int, b: int) -> Grade | tuple[str, int]:
        """Certainty of the relation, and e where it is wrong with a probability of 2**-e at most;
        "" and 0 if it is undecided.
        """


def answer_of(relations: Set[Relation]) -> Answer:
    """Combine the relations to all places of another structure."""
    if relations <= {Relation.DISTINGUISHABLE}:
        return Answer.SURELY
    if relations == {Relation.INDISTINGUISHABLE}:
        return Answer.NEVER
    if {Relation.DISTINGUISHABLE, Relation.INDISTINGUISHABLE} <= relations:
        return Answer.DEPENDS
    return Answer.UNKNOWN


@dataclass(frozen=True)
class SpotClasses:
    """Spots by what is known of each, and in classes by what is known of pairs.

    `columns[s][t]`: bucket of spot s in test TESTS[t], -1 where it is not known; `classes[s]`;
    `links[s]`: spots of equal links, such as "6/3", are the same by that rule, others of a class by
    the exact decision; `open`: pairs of classes that nothing decides; all statements together are
    wrong with a probability of at most 2**-safety, 0: nothing is left to chance.
    """

    columns: tuple[tuple[int, ...], ...]
    classes: tuple[int, ...]
    links: tuple[str, ...]
    open: frozenset[tuple[int, int]]
    safety: int

    def only(self, spots: Sequence[int]) -> "SpotClasses":
        """Some of the spots, in this order."""
        return replace(
            self,
            columns=tuple(self.columns[s] for s in spots),
            classes=tuple(self.classes[s] for s in spots),
            links=tuple(self.links[s] for s in spots),
        )

    def look_up(self, a: int, b: int) -> tuple[Relation, str]:
        """Relation and deciding rule of two spots, "" if undecided."""
        for name, *buckets in zip(TESTS, self.columns[a], self.columns[b], strict=True):
            if NOT_KNOWN not in buckets and buckets[0] != buckets[1]:
                return Relation.DISTINGUISHABLE, name
        low, high = sorted((self.classes[a], self.classes[b]))
        if low == high:
            same = self.links[a] == self.links[b] != ""
            rule = self.links[a].partition("/")[0] if same else EXACT.name
            return Relation.INDISTINGUISHABLE, rule
        if (low, high) in self.open:
            return Relation.UNDECIDED, ""
        return Relation.DISTINGUISHABLE, EXACT.name

    def grade(self, a: int, b: int) -> Grade | tuple[str, int]:
        """Certainty and safety of all together, "" of what is undecided."""
        rule = self.look_up(a, b)[1]
        if not rule:
            return "", self.safety
        sure = rule in CERTAIN or not self.safety
        return Certainty.PROVEN if sure else Certainty.BOUNDED, self.safety


@dataclass(frozen=True)
class SpotPairs:
    """Spots of which every pair is decided: spot s is subject `at[s]` of `decided`."""

    decided: Decisions
    at: tuple[int, ...]

    def only(self, spots: Sequence[int]) -> "SpotPairs":
        """Some of the spots, in this order."""
        return replace(self, at=tuple(self.at[s] for s in spots))

    def look_up(self, a: int, b: int) -> tuple[Relation, str]:
        """Relation and deciding rule of two spots, "" if undecided."""
        i, j = self.at[a], self.at[b]
        return self.decided.relation(i, j), self.decided.rule(i, j)

    def grade(self, a: int, b: int) -> tuple[str, int]:
        """Certainty and safety of the verdict."""
        i, j = sorted((self.at[a], self.at[b]))
        return self._grades[i, j]

    @cached_property
    def _grades(self) -> dict[tuple[int, int], tuple[str, int]]:
        return {(i, j): (grade, bits) for i, j, _, _, grade, bits in self.decided.grades()}


@dataclass(frozen=True)
class Placement:
    """Result of one kind of experiment, spot against spot.

    `places[k]`: masses or nodes of structure k; `gains[s]`: what is gained at spot s, structure by
    structure and place by place; `decided` of them.
    """

    kind: Kind
    places: tuple[tuple[int, ...], ...]
    gains: tuple[Gain, ...]
    decided: Decided

    def __repr__(self) -> str:
        return summary(self, f"{self.kind.name}, {plural(len(self.gains), 'place')}")

    @cached_property
    def _at(self) -> dict[Spot, int]:
        spots = ((k, i) for k, places in enumerate(self.places) for i in places)
        return {spot: s for s, spot in enumerate(spots)}

    @cached_property
    def _alike(self) -> dict[tuple[Spot, int], tuple[int, ...]]:
        """Cache of answers: pairs of experiments request each of them repeatedly."""
        return {}

    def only(self, structures: Sequence[int]) -> "Placement":
        """Some of the structures, counted from 0, in this order."""
        at = [self._at[k, i] for k in structures for i in self.places[k]]
        places = tuple(self.places[k] for k in structures)
        gains = tuple(self.gains[s] for s in at)
        return replace(self, places=places, gains=gains, decided=self.decided.only(at))

    def gain(self, spot: Spot) -> Gain:
        """Gain at the spot."""
        return self.gains[self._at[spot]]

    def look_up(self, left: Spot, right: Spot) -> tuple[Relation, str]:
        """Relation and deciding rule of two spots, "" if undecided."""
        return self.decided.look_up(self._at[left], self._at[right])

    def grade(self, left: Spot, right: Spot) -> Grade | tuple[str, int]:
        """Certainty of that, and e where it is wrong with a probability of 2**-e at most; "" of
        what is undecided.
        """
        return self.decided.grade(self._at[left], self._at[right])

    def alike(self, spot: Spot, other: int) -> tuple[int, ...]:
        """Places in another structure at which it is not distinguished from this one at this spot;
        what is undecided included.
        """
        if (spot, other) not in self._alike:
            apart = Relation.DISTINGUISHABLE
            self._alike[spot, other] = tuple(
                j for j in self.places[other] if self.look_up(spot, (other, j))[0] is not apart
            )
        return self._alike[spot, other]

    def answer(self, spot: Spot, other: int) -> Answer:
        """Decide whether the experiment at a spot distinguishes its structure from another one, for
        every place in that.
        """
        return answer_of({self.look_up(spot, (other, j))[0] for j in self.places[other]})
