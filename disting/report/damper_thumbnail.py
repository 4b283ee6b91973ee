"""A family with ground dampers in small: a field for each two structures, coloured by what any
of their sets of dampers are.
"""

from collections.abc import Iterator
from itertools import groupby

from disting.catalogs.damper_family import DamperFamily
from disting.report.scene import Ink, Layer, Path, Rect, Scene
from disting.verdict import Relation

INKS = {Relation.INDISTINGUISHABLE: Ink.INDISTINGUISHABLE, Relation.UNDECIDED: Ink.OPEN}


def thumbnail(found: DamperFamily, side: float = 168) -> Scene:
    """A triangle with its diagonal, `side` pixels wide: a field that is not blue holds pairs
    that are not told apart.
    """
    size = len(found.family)
    cell = side / size
    steps = [(x * cell, y * cell) for i in range(size) for x, y in ((i, i), (i + 1, i))]
    stairs = Path((*steps, (side, side), (0, side)), Ink.NONE, Ink.DISTINGUISHABLE)
    fields = tuple(
        Rect(x * cell, y * cell, count * cell, cell, INKS[relation])
        for relation, x, y, count in sorted(runs(found))
    )
    return Scene(side, side, (Layer("distinguishable", (stairs,)), Layer("others", fields)))


def runs(found: DamperFamily) -> Iterator[tuple[Relation, int, int, int]]:
    """Neighbours in a row that are not all distinguishable: relation, first column, row, length."""
    rows = found.found.group.reshape(len(found.family), len(found.sets)).tolist()
    groups = [frozenset(row) for row in rows]
    holders = {
        group: [s for s, of in enumerate(groups) if group in of]
        for group in frozenset().union(*groups)
    }
    opened = {
        frozenset((s, t))
        for a, b in found.found.open_groups
        for s in holders[a]
        for t in holders[b]
    }

    def relation(s: int, t: int) -> Relation:
        """Of two structures, some of whose sets of dampers are not told apart; of one, two of
        its own sets.
        """
        same = groups[s] & groups[t] if s != t else len(groups[s]) < len(found.sets)
        if same:
            return Relation.INDISTINGUISHABLE
        return Relation.UNDECIDED if frozenset((s, t)) in opened else Relation.DISTINGUISHABLE

    for s in range(len(groups)):
        x = 0
        for kind, run in groupby(relation(s, t) for t in range(s + 1)):
            count = len(list(run))
            if kind in INKS:
                yield kind, x, s, count
            x += count
