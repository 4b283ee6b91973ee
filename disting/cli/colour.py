"""Colour on a terminal: of relations only, which their words tell too.

Nothing is coloured where standard output is no terminal, where the environment variable NO_COLOR
is set (https://no-color.org), and where TERM is dumb.
"""

import os
import sys

from disting.verdict import Relation

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
