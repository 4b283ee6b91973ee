"""Which damped rows are known to differ: decided once by `zeros`, for chains of any size, and
shipped as `rows.jsonl`.

The file belongs to the package like its code: every command has the same answers. A line a pair of
rows of one kind,

    {"wall": .., "masses": .., "given": [a, b], "searched": [a, b], "label": .., "branches": ..,
    "degree": ..}

The error bound is not stored; it follows from the rows (`zeros.safety_of_branches`).
"""

import json
from functools import cache
from pathlib import Path

from disting.errors import CatalogError
from disting.fibres.ideals.zeros import Branched, confirms_branches
from disting.files import intact_text, shipped_folder
from disting.model.row import Row

ROWS = "rows.jsonl"
Answers = dict[frozenset[Row], Branched]


def rows_text(folder: Path | None = None) -> str:
    """The text of the folder's file, the shipped one by default; nothing if there is none."""
    path = (folder or shipped_folder()) / ROWS
    return intact_text(path) if path.is_file() else ""


def read_answers(folder: Path | None = None) -> Answers:
    """What the folder's file holds; raises CatalogError where it is damaged."""
    try:
        found = [_answer(json.loads(line)) for line in rows_text(folder).splitlines()]
    except (ValueError, LookupError, TypeError) as reason:
        raise CatalogError(
            f"the answers about rows cannot be read ({reason}); make them with 'disting catalog"
            " settle'"
        ) from None
    return {frozenset((a.given, a.searched)): a for a in found}


@cache
def known_answers() -> Answers:
    """The shipped answers."""
    return read_answers()


def line_of(answer: Branched) -> str:
    """A line of the file."""
    row = answer.given
    plain = {
        "wall": row.grounded,
        "masses": row.n_masses,
        "given": row.ports,
        "searched": answer.searched.ports,
        "label": answer.label,
        "branches": answer.branches,
        "degree": answer.degree,
    }
    return json.dumps(plain, separators=(",", ":")) + "\n"


def false_answers(folder: Path, masses: int) -> list[str]:
    """A sentence for each answer about rows of so many masses that does not hold; all of it is
    computed again.
    """
    wanted = (a for a in read_answers(folder).values() if a.given.n_masses == masses)
    return [
        f"{ROWS}: {a.given} and {a.searched}: not what is computed now"
        for a in wanted
        if not confirms_branches(a)
    ]


def _answer(plain: dict[str, object]) -> Branched:
    wall, masses = plain["wall"], plain["masses"]
    label, numbers = plain["label"], (plain["branches"], plain["degree"])
    if not (isinstance(wall, bool) and isinstance(masses, int) and isinstance(label, str)):
        raise TypeError("no row")
    given, searched = (
        Row(masses, wall, *_ports(plain[name]), damped=True) for name in ("given", "searched")
    )
    return Branched(given, searched, label, *(_number(n) for n in numbers))


def _ports(plain: object) -> tuple[int, int]:
    if not isinstance(plain, list):
        raise TypeError("no ports")
    a, b = map(_number, plain)
    return a, b


def _number(plain: object) -> int:
    if not isinstance(plain, int):
        raise TypeError("no number")
    return plain
