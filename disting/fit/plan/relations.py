"""How the structures that a fit left stand to each other: which of them no data with this force and
sensor tell apart, and which the noise alone left together.

Over generic complex parameters to be indistinguishable is transitive, so each structure is compared
with one of each class only.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from disting.fit.plan.fit_file import Left
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.query import Query, View
from disting.verdict.result import Relation


class Standing(StrEnum):
    """Of two structures that the data leave.

    EQUAL: indistinguishable by this force and sensor, over generic complex parameters; TWIN: one
    has the response of the other for its fitted values, though generic ones are told apart; NOISE:
    distinguishable, and noise alone leaves both; OPEN: whether they are distinguishable is not
    known.
    """

    EQUAL = "equal"
    TWIN = "same for the fitted values"
    NOISE = "noise"
    OPEN = "undecided"


@dataclass(frozen=True, slots=True)
class Stood:
    """`classes`: structures of one size, counted from 0, that are EQUAL, singles included; `rules`:
    what told the first ones of two classes apart, "" where nothing did; `across`: pairs of classes
    that are EQUAL though of two sizes.
    """

    left: tuple[Left, ...]
    classes: tuple[tuple[int, ...], ...]
    rules: dict[tuple[int, int], str]
    across: frozenset[tuple[int, int]] = frozenset()

    @property
    def groups(self) -> tuple[tuple[int, ...], ...]:
        """The classes of several structures."""
        return tuple(c for c in self.classes if len(c) > 1)

    def standing(self, a: int, b: int) -> Standing:
        """Of two different structures."""
        one, other = self.left[a], self.left[b]
        if self._class(a) == self._class(b) or self._classes(a, b) in self.across:
            return Standing.EQUAL
        if one.chain in other.like or other.chain in one.like or set(one.like) & set(other.like):
            return Standing.TWIN
        return Standing.NOISE if self.rule(a, b) else Standing.OPEN

    def rule(self, a: int, b: int) -> str:
        """What tells two structures of different classes apart now; "" where nothing does."""
        return self.rules[self._classes(a, b)]

    def _classes(self, a: int, b: int) -> tuple[int, int]:
        low, high = sorted((self._class(a), self._class(b)))
        return low, high

    def _class(self, at: int) -> int:
        return next(k for k, members in enumerate(self.classes) if at in members)


def stood(left: Sequence[Left], engine: Engine, progress: Progress = silent) -> Stood:
    """Sort the structures into classes; those of other sizes are in other classes."""
    sides = [engine.subject(one.name, one.chain) for one in left]
    query = Query(View.EXACT, inclusion=False)
    classes = list[list[int]]()
    rules: dict[tuple[int, int], str] = {}
    across = set[tuple[int, int]]()
    for at, one in enumerate(left):
        progress("structures", at, len(left))
        found = {}
        for number, members in enumerate(classes):
            found[number] = engine.verdict(sides[members[0]], sides[at], query)
            size = left[members[0]].chain.n_masses
            same = found[number].relation is Relation.INDISTINGUISHABLE
            if same and size == one.chain.n_masses:
                members.append(at)
                break
        else:
            rules |= {
                (number, len(classes)): verdict.decided_by
                if verdict.relation is Relation.DISTINGUISHABLE
                else ""
                for number, verdict in found.items()
            }
            across |= {
                (number, len(classes))
                for number, verdict in found.items()
                if verdict.relation is Relation.INDISTINGUISHABLE
            }
            classes.append([at])
    return Stood(tuple(left), tuple(map(tuple, classes)), rules, frozenset(across))
