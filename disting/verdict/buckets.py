"""Models in buckets by what is known of each, and in classes by what is known of pairs (`forest`).

A necessary condition is a function of one model, so it is a column of bucket numbers: models that
differ in a column are distinguishable.
"""

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from disting.behaviour.profile import NoMatroid, Profile
from disting.conditions.rule import Outcome
from disting.conditions.side import AnySide
from disting.conditions.sufficient import condition_6
from disting.conditions.table import Necessary
from disting.verdict.forest import Forest

NOT_KNOWN = -1


@dataclass
class Buckets:
    """`columns[i][t]`: bucket of model i in test t, NOT_KNOWN where it is not known; `classes`: of
    those that are the same.
    """

    sides: Sequence[AnySide]
    columns: list[list[int]]
    classes: Forest

    @staticmethod
    def of(
        sides: Sequence[AnySide], tests: int, order: Callable[[int], object] = lambda i: i
    ) -> "Buckets":
        """Nothing is known yet."""
        n = len(sides)
        return Buckets(sides, [[NOT_KNOWN] * tests for _ in range(n)], Forest.of(n, order))

    def split(
        self, profiles: Mapping[int, Profile], conditions: Iterable[Necessary], first: int
    ) -> None:
        """Columns of necessary conditions, from the `first` one on."""
        for column, condition in enumerate(conditions, first):
            self.fill(column, {i: condition.key(p) for i, p in profiles.items()})

    def fill(self, column: int, values: Mapping[int, Hashable]) -> None:
        """Bucket numbers in one column; a bucket in which a value is not known is not split."""
        numbers: dict[Hashable, int] = {}
        for bucket in self.shared(values):
            if not any(isinstance(values[i], NoMatroid) for i in bucket):
                for i in bucket:
                    self.columns[i][column] = numbers.setdefault(values[i], len(numbers))

    def shared(self, chosen: Iterable[int]) -> list[list[int]]:
        """The chosen models by all columns."""
        buckets: dict[tuple[int, ...], list[int]] = defaultdict(list)
        for i in chosen:
            buckets[tuple(self.columns[i])].append(i)
        return list(buckets.values())

    def renamed(self, bucket: Sequence[int]) -> Iterator[tuple[int, int]]:
        """Yield pairs of models of one bucket that are renamings of each other: models of equal
        colours are compared, each with the first of them.
        """
        prints: dict[str, int] = {}
        for i in bucket if len(bucket) > 1 else ():
            first = prints.setdefault(self.sides[i].colouring.fingerprint, i)
            earlier, later = self.sides[first], self.sides[i]
            if first != i and (
                earlier is later or condition_6(earlier, later, True).outcome is Outcome.HOLDS
            ):
                yield first, i
