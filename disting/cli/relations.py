"""Output of relations that several commands share: on a terminal in colour, always in words too.

Nothing is coloured where standard output is no terminal, where the environment variable NO_COLOR
is set (https://no-color.org), and where TERM is dumb.
"""

import os
import sys
from collections import Counter
from collections.abc import Iterable

from disting.conditions.rule import RULES
from disting.model.question import Domain
from disting.verdict.result import Relation

# bright enough on a dark ground, dark enough on a light one
COLOURS = {
    Relation.DISTINGUISHABLE: "34",  # blue
    Relation.INDISTINGUISHABLE: "31",  # red
    Relation.SOMETIMES: "35",  # magenta
    Relation.UNDECIDED: "33",  # yellow
}


def in_colour(text: str, relation: Relation) -> str:
    """The text as a terminal shows it in the colour of the relation, or as it is."""
    return f"\033[1;{COLOURS[relation]}m{text}\033[0m" if _is_wanted() else text


def _is_wanted() -> bool:
    silent = os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb"
    return not silent and sys.stdout.isatty()


def relations_in_words(relations: Iterable[Relation]) -> str:
    """Number of pairs by relation; SOMETIMES only where it occurs.

    >>> relations_in_words([Relation.DISTINGUISHABLE, Relation.SOMETIMES])
    '1 distinguishable, 0 indistinguishable, 1 sometimes, 0 undecided'
    """
    counts = Counter(relations)
    return ", ".join(
        f"{counts[r]} {r}" for r in Relation if counts[r] or r is not Relation.SOMETIMES
    )


def rules_in_words(counts: dict[str, int], domain: Domain) -> str:
    """Number of pairs that each rule decides."""
    return (
        ", ".join(
            f"{n} by {RULES[rule].in_words(domain)}" for rule, n in counts.items() if rule and n
        )
        or "none"
    )
