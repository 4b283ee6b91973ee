"""Questions about rows that pairs of chains leave open: decided once, for chains of any size, and
shipped as `rows.jsonl`.

The file is read wherever a pair is decided (see `disting.fibres.ideals.by_one_row`), so an answer
serves every command at once.
"""

from collections.abc import Callable, Iterator
from itertools import combinations
from pathlib import Path

from disting.algebra.certainty import LEAST_SAFETY
from disting.fibres.ideals.by_one_row import row_pairs
from disting.fibres.ideals.row_answers import ROWS, line_of, read_answers
from disting.fibres.ideals.zeros import Branched, branches, refute, safety_of_branches
from disting.model.family import Family
from disting.model.row import Row
from disting.questions.same.exact import rational_part
from disting.verdict import Engine, Query, Relation, View

LABEL = "rows:disting"


def settle(n_masses: int, folder: Path, engine: Engine, told: Callable[[str], None]) -> int:
    """Decide the rows that leave damped chains of so many masses open; every answer is kept at
    once. The number of them.
    """
    count = 0
    for pair in open_rows(n_masses, engine):
        if pair in read_answers(folder):
            continue
        answer = decided(pair)
        told(f"{' against '.join(map(str, sorted(pair)))}: {'differ' if answer else 'left open'}")
        if answer is not None:
            with (folder / ROWS).open("a", encoding="utf-8", newline="\n") as file:
                file.write(line_of(answer))
            count += 1
    return count


def open_rows(n_masses: int, engine: Engine) -> Iterator[frozenset[Row]]:
    """The rows that differ between damped chains which no condition and no known answer
    decides, each pair once.
    """
    subjects = [
        engine.subject(f"A{number}", chain)
        for number, chain in enumerate(Family(n_masses, True), 1)
    ]
    found = engine.decisions(subjects, Query(View.EXACT, inclusion=False))
    told = set[frozenset[Row]]()
    for i, j in combinations(range(len(subjects)), 2):
        if found.relation(i, j) is Relation.UNDECIDED:
            first, second = subjects[i].in_order(subjects[j])
            pairs = row_pairs(rational_part(first), rational_part(second))
            yield from (pair for _, pair in pairs if pair not in told)
            told |= {pair for _, pair in pairs}


def decided(pair: frozenset[Row]) -> Branched | None:
    """That the rows of a pair differ, searched in the direction with fewer branches first; None
    if it is not found.
    """
    for given, searched in sorted(
        [tuple(sorted(pair)), tuple(sorted(pair))[::-1]], key=lambda rows: len(branches(*rows))
    ):
        if safety_of_branches(given, searched) >= LEAST_SAFETY and (
            found := refute(given, searched, LABEL)
        ):
            return found
    return None
