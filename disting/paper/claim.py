"""A printed statement and its check.

How a check says what it found stands below.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import combinations

from disting.conditions.rule import RULES
from disting.paper.findings import Findings
from disting.verdict.decisions import Decisions


class Outcome(StrEnum):
    """Whether what is found here agrees with what is printed."""

    AGREES = "agrees"
    DIFFERS = "differs"
    UNCHECKED = "cannot be checked"


@dataclass(frozen=True, slots=True)
class Seen:
    """Where verdicts can be seen: all pairs of a family, one of its models, or two of them.

    `models` as their names go on behind the number of masses: 4, 1+b2, 1+lag. With `dampers`,
    the family is that of all sets of ground dampers.
    """

    n_masses: int
    damped: bool = False
    models: tuple[str, ...] = ()
    dampers: bool = False


@dataclass(frozen=True, slots=True)
class Found:
    """What is found here, in words, whether the printed statement holds, and where the verdicts
    that it speaks of can be seen.
    """

    value: str
    agrees: bool
    seen: tuple[Seen, ...] = ()

    @property
    def outcome(self) -> Outcome:
        """As an outcome."""
        return Outcome.AGREES if self.agrees else Outcome.DIFFERS


def families(*sizes: int, damped: bool = False) -> tuple[Seen, ...]:
    """All pairs of each family."""
    return tuple(Seen(n, damped) for n in sizes)


def models(n_masses: int, numbers: Iterable[int], *, damped: bool = False) -> tuple[Seen, ...]:
    """Single models of a family."""
    return tuple(Seen(n_masses, damped, (str(number),)) for number in numbers)


def pairs(
    n_masses: int, numbers: Iterable[tuple[int, int]], *, damped: bool = False
) -> tuple[Seen, ...]:
    """Pairs of models of a family."""
    return tuple(Seen(n_masses, damped, (str(i), str(j))) for i, j in numbers)


@dataclass(frozen=True, slots=True)
class Claim:
    """One statement of the paper.

    `place` where it is printed; `text` the statement, literally where it stands in quotation
    marks; `printed` its value; `check` computes ours, None where nobody can; `outcome` what the
    check is known to give; `reason` why; `about` the subject of what differs, in a few words.
    """

    key: str
    place: str
    text: str
    printed: str
    check: Callable[[Findings], Found] | None
    outcome: Outcome
    reason: str = ""
    about: str = ""

    def __post_init__(self) -> None:
        if (self.check is None) != (self.outcome is Outcome.UNCHECKED):
            raise ValueError(f"{self.key}: a claim without a check is unchecked, and no other")
        if self.outcome is not Outcome.AGREES and not self.reason:
            raise ValueError(f"{self.key}: what does not agree needs a reason")
        if (self.outcome is Outcome.DIFFERS) != bool(self.about):
            raise ValueError(f"{self.key}: what differs, and nothing else, says what it is about")


Pair = tuple[int, int]


def counted(found: Decisions) -> dict[str, int]:
    """Pairs by deciding condition, undecided ones under ""."""
    return {rule: n for rule, n in found.counts().items() if n}


def told(counts: dict[str, int]) -> str:
    """Counts in words.

    >>> told({"1": 26, "": 3})
    '26 by condition 1, 3 undecided'
    """
    decided = [f"{counts[rule]} by {RULES[rule].in_words()}" for rule in sorted(counts) if rule]
    return ", ".join([*decided, f"{counts.get('', 0)} undecided"])


def deciding(found: Decisions) -> dict[Pair, str]:
    """The deciding condition of every pair of models, "" where it is undecided."""
    pairs = combinations(range(len(found.subjects)), 2)
    return {(i + 1, j + 1): found.rule(i, j) for i, j in pairs}


def undecided(found: Decisions) -> set[Pair]:
    """The pairs that stay open."""
    return {pair for pair, rule in deciding(found).items() if not rule}


def named(numbers: Sequence[object]) -> str:
    """Models, pairs or numbers with commas and a final "and".

    >>> named([1, 4, 7]), named([3])
    ('1, 4 and 7', '3')
    """
    *first, last = map(str, numbers)
    return f"{', '.join(first)} and {last}" if first else last
