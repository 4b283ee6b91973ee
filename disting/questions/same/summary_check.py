"""Evidence of conditions 1 to 5 and 7 seen again in fresh samples of two exhaustive summaries, of
whatever models: without profiles, matroids or searches.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass

from disting.behaviour.sample import Representation, Sample
from disting.evidence.conditions import Counts, Forms, FreeChoice, Labels, Ranks

OfSummaries = Counts | Forms | Ranks | FreeChoice
POINTS = 3
MOST_MARKOV = 1000  # of a file that somebody else wrote: each costs a row


@dataclass(frozen=True, slots=True)
class Summary:
    """What one model reveals: `draw` gives samples of so many Markov parameters after G_0;
    `degrees` of numerator and denominator, of several transfer functions one pair after the other.
    """

    draw: Callable[[Representation, int], tuple[Sample, ...]]
    degrees: tuple[int, ...]

    def rank(self, representation: Representation, rows: Labels) -> int:
        """Rank of the named rows, or of all: the largest that is seen."""
        seen = self.draw(representation, markov_count(rows))
        at = tuple(i for i, label in enumerate(seen[0].labels) if not rows or label in rows)
        return max(s.rank(at) for s in seen)

    def labels(self, representation: Representation, count: int) -> set[str]:
        """All invariants."""
        return set(self.draw(representation, count)[0].labels)

    def free(self, representation: Representation, count: int) -> set[str]:
        """Those that vary."""
        seen = self.draw(representation, count)
        return {
            label for i, label in enumerate(seen[0].labels) if any(any(s.rows[i]) for s in seen)
        }


def confirms_summary(
    evidence: OfSummaries, representation: str, left: Summary, right: Summary
) -> bool:
    """Whether degrees, what varies, or ranks are what the evidence says."""
    if isinstance(evidence, Counts):
        told = evidence.left, evidence.right
        return told == (left.degrees, right.degrees) and evidence.left != evidence.right
    where = Representation(representation)
    match evidence:
        case Forms():
            return _forms(evidence, where, left, right)
        case Ranks():
            return _ranks(evidence, where, left, right)
        case FreeChoice():
            return all(_freely(evidence, where, side) for side in (left, right))


def markov_count(labels: Labels) -> int:
    """Markov parameters needed to have all these labels, such as G3 or G3[2]; raises ValueError for
    more than are looked at.
    """
    found = [re.fullmatch(r"G(\d{1,9})(?:\[\d+\])?", label) for label in labels]
    most = max((int(x[1]) for x in found if x), default=0)
    if most > MOST_MARKOV:
        raise ValueError(f"G{most} is beyond the first {MOST_MARKOV} Markov parameters")
    return most


def _forms(evidence: Forms, where: Representation, left: Summary, right: Summary) -> bool:
    only = (*evidence.only_left, *evidence.only_right)
    here, there = (side.free(where, markov_count(only)) for side in (left, right))
    return (
        bool(only)
        and set(evidence.only_left) <= here - there
        and set(evidence.only_right) <= there - here
    )


def _ranks(evidence: Ranks, where: Representation, left: Summary, right: Summary) -> bool:
    """Both ranks once more, of rows that there are."""
    sides, count = (left, right), markov_count(evidence.rows)
    known = set[str]().union(*(side.labels(where, count) for side in sides))
    ranks = tuple(side.rank(where, evidence.rows) for side in sides)
    told = (evidence.left, evidence.right)
    return set(evidence.rows) <= known and ranks == told and evidence.left != evidence.right


def _freely(evidence: FreeChoice, where: Representation, side: Summary) -> bool:
    free = side.free(where, markov_count(evidence.free))
    return free == set(evidence.free) and (
        side.rank(where, evidence.free) == len(free) == evidence.rank
    )
