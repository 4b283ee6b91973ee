"""Models in classes by what is known of pairs: a forest of parents.

To have equal closures of the image is transitive, so models that are the same form classes. Over
every domain of parameters that is so: where generic parameters of A have equivalents in B, and
those of B in C, those of A have some in C.
"""

from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations

from disting.errors import ContradictionError
from disting.verdict.result import Relation


@dataclass
class Forest:
    """Classes of the numbers from 0 on: of a class, the first in this order represents it."""

    parent: list[int]
    order: Callable[[int], object]

    @staticmethod
    def of(count: int, order: Callable[[int], object] = lambda i: i) -> "Forest":
        """Each number is a class of its own."""
        return Forest(list(range(count)), order)

    def root(self, i: int) -> int:
        """Representative of a class."""
        while self.parent[i] != i:
            self.parent[i] = self.parent[self.parent[i]]
            i = self.parent[i]
        return i

    def unite(self, i: int, j: int) -> None:
        """Make one class of two."""
        low, high = sorted((self.root(i), self.root(j)), key=self.order)  # type: ignore[arg-type]
        self.parent[high] = low

    def classes(self) -> list[tuple[int, ...]]:
        """The members of every class, classes in the order of their first ones."""
        members: dict[int, list[int]] = defaultdict(list)
        for i in range(len(self.parent)):
            members[self.root(i)].append(i)
        return sorted(map(tuple, members.values()))


def classes_of(
    names: Sequence[str], relation: Callable[[int, int], Relation]
) -> list[tuple[int, ...]]:
    """The classes of models by the relations of all pairs i < j; an undecided pair of one class is
    none. Raises ContradictionError where a class holds a pair that can be distinguished.
    """
    relations = {pair: relation(*pair) for pair in combinations(range(len(names)), 2)}
    same = Forest.of(len(names))
    for pair, r in relations.items():
        if r is Relation.INDISTINGUISHABLE:
            same.unite(*pair)
    apart = (Relation.DISTINGUISHABLE, Relation.SOMETIMES)
    for (i, j), r in relations.items():
        if r in apart and same.root(i) == same.root(j):
            raise ContradictionError(
                f"{names[i]} and {names[j]} are in one group, but distinguishable"
            )
    return same.classes()
