"""Functions that several commands share: options for conditions and views, and the output of
relations, on a terminal in colour, always in words too.

Nothing is coloured where standard output is no terminal, where the environment variable NO_COLOR
is set (https://no-color.org), and where TERM is dumb.
"""

import os
import sys
from collections import Counter
from collections.abc import Iterable

from disting.conditions.rule import RULES
from disting.errors import InputError
from disting.model.question import Domain
from disting.verdict.result import Query, Relation, View

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


VIEWS = {"tf": View.TF, "markov": View.MARKOV, "all": View.EXACT}


def query(conditions: tuple[str, ...] | None, view: View, domain: str, markov: int = 0) -> Query:
    """Over positive parameters where no domain ("") is named, but the paper's view, over complex
    ones, where it is requested.

    Conditions that are named decide alone: the exact decision belongs to the default.
    """
    paper = conditions is not None or view is not View.EXACT
    domain = domain or (Domain.COMPLEX if paper else Domain.POSITIVE)
    if domain != Domain.COMPLEX:
        if paper:
            raise InputError(
                f"--domain {domain} is not supported with --conditions or --representation;"
                " remove one of them"
            )
        return Query(View(domain), markov=markov)
    if conditions is None:
        return Query(view, markov=markov)
    return Query(View.COMBINED if view is View.EXACT else view, conditions, markov)


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
