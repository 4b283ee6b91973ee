"""All pairs of thousands of models of one size, by buckets and classes: no pair is stored, every
pair is looked up.

1. Necessary conditions are functions of one model, so each is a column of bucket numbers. A pair
   that differs in a column is distinguishable by that condition; the first such column decides.
2. Models whose closures of the image are equal form a class, because equality is transitive:
   renamings (6), free choice (7), models that contain one another with equal rank (8, 9), the
   exact decision (one representative of a class decides for all).
3. What is left are pairs of classes of one bucket: distinguishable by the exact decision, or
   listed as open.

The relation of a pair is that of `compare`, wherever that is found here; what is open here
`compare` may still decide with more time. So is the rule, but for two cases: a pair whose models
are linked by a chain of rules of different kinds, and one that is separated by ranks of 1/G (see
`behaviour.profile`), is reported as decided by the exact decision.
"""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from disting.conditions.rule import EXACT, FREE_CHOICE, RENAMING, SUBMODEL, SUPERMODEL
from disting.errors import InputError
from disting.model.chain import Chain
from disting.verdict.result import Relation

Numbers = NDArray[np.int32]
Masses = frozenset[int]


@dataclass(frozen=True)
class Classes:
    """Models `chains`, in order; `tests` names the rule of each column (the exact decision for
    ranks of 1/G).

    `columns[i, t]`: bucket of model i in test t, -1 where that is not known; `group[i]`: its
    class; `renamed[i]`: models of equal number are renamings of each other; `free[i]`: models of
    equal number, not -1, have a free choice (condition 7); `rank[i]`; `open_groups`: pairs (low,
    high) of classes that nothing decides.
    """

    chains: tuple[Chain, ...]
    tests: tuple[str, ...]
    columns: Numbers
    group: Numbers
    renamed: Numbers
    free: Numbers
    rank: Numbers
    open_groups: frozenset[tuple[int, int]]

    def __len__(self) -> int:
        return len(self.chains)

    def relation(self, i: int, j: int) -> Relation:
        """Relation of two different models, counted from 0."""
        return self.look_up(i, j)[0]

    def look_up(self, i: int, j: int) -> tuple[Relation, str]:
        """Relation and deciding rule ("" if undecided) of two different models, counted from 0;
        raises InputError.
        """
        if i == j or not (0 <= i < len(self) and 0 <= j < len(self)):
            raise InputError(
                f"a pair is two different models 0 to {len(self) - 1}, not {i} and {j}"
            )
        left, right = self.columns[i], self.columns[j]
        differ = np.flatnonzero((left != right) & (left >= 0) & (right >= 0))
        if len(differ):
            return Relation.DISTINGUISHABLE, self.tests[int(differ[0])]
        a, b = sorted((int(self.group[i]), int(self.group[j])))
        if a == b:
            return Relation.INDISTINGUISHABLE, self._link(i, j)
        open_pair = (a, b) in self.open_groups
        return (Relation.UNDECIDED, "") if open_pair else (Relation.DISTINGUISHABLE, EXACT.name)

    def classes(self) -> tuple[tuple[int, ...], ...]:
        """Classes of two or more mutually indistinguishable models, counted from 0."""
        return tuple(m for m in self._members.values() if len(m) > 1)

    def counts(self) -> dict[Relation, int]:
        """Number of pairs by relation, from the sizes of the classes alone."""
        size = {g: len(m) for g, m in self._members.items()}
        n = len(self)
        same = sum(s * (s - 1) // 2 for s in size.values())
        undecided = sum(size[a] * size[b] for a, b in self.open_groups)
        apart = n * (n - 1) // 2 - same - undecided
        return {
            Relation.DISTINGUISHABLE: apart,
            Relation.INDISTINGUISHABLE: same,
            Relation.UNDECIDED: undecided,
        }

    def counts_by_rule(self) -> dict[str, int]:
        """Number of pairs by deciding rule, "" for the undecided ones: whole buckets at once."""
        parts, by_rule = [np.arange(len(self))], Counter[str]()
        for t, name in enumerate(self.tests):
            pieces = [_split(part, self.columns[part, t]) for part in parts]
            for part, split in zip(parts, pieces, strict=True):
                by_rule[name] += _pairs(len(part)) - sum(_pairs(len(p)) for p in split)
            parts = [piece for split in pieces for piece in split]
        for members in self._members.values():
            by_rule.update(self._link(i, j) for i, j in combinations(members, 2))
        counts = self.counts()
        by_rule[""] = counts[Relation.UNDECIDED]
        inside = sum(_pairs(len(p)) for p in parts)
        by_rule[EXACT.name] += (
            inside - counts[Relation.INDISTINGUISHABLE] - counts[Relation.UNDECIDED]
        )
        return {rule: n for rule, n in sorted(by_rule.items()) if n or not rule}

    def pairs(self) -> Iterator[tuple[int, int, Relation, str]]:
        """Yield (i, j, relation, rule) of all pairs, one at a time."""
        for i, j in combinations(range(len(self)), 2):
            yield i, j, *self.look_up(i, j)

    @cached_property
    def _members(self) -> dict[int, tuple[int, ...]]:
        members: dict[int, list[int]] = {}
        for i, g in enumerate(self.group):
            members.setdefault(int(g), []).append(i)
        return {g: tuple(m) for g, m in members.items()}

    @cached_property
    def _ranks(self) -> dict[tuple[Chain, Masses], int]:
        sets = (frozenset(c.ground_dampers) for c in self.chains)
        return {
            (base, masses): int(r)
            for base, masses, r in zip(self._bases, sets, self.rank, strict=True)
        }

    @cached_property
    def _bases(self) -> tuple[Chain, ...]:
        return tuple(map(without_dampers, self.chains))

    def _link(self, i: int, j: int) -> str:
        """The rule that connects two models of one class."""
        if self.renamed[i] == self.renamed[j]:
            return RENAMING.name
        if self.free[i] == self.free[j] >= 0:
            return FREE_CHOICE.name
        return self._by_structure(i, j)

    def _by_structure(self, i: int, j: int) -> str:
        """8 where one set of ground dampers contains the other, 9 where their union has the
        same rank.
        """
        bases = [self._bases[k] for k in (i, j)]
        mine, yours = (frozenset(self.chains[k].ground_dampers) for k in (i, j))
        for base, own in self._turn_chain(bases[1], yours):
            if base == bases[0]:
                if mine <= own or own <= mine:
                    return SUBMODEL.name
                if own == yours and self._ranks.get((base, mine | own)) == self.rank[i]:
                    return SUPERMODEL.name
        return EXACT.name

    @staticmethod
    def _turn_chain(base: Chain, masses: Masses) -> Iterator[tuple[Chain, Masses]]:
        """The chain itself, and mirrored where force and sensor of the free row sit at its
        centre.
        """
        yield base, masses
        fold = base.gap + 1 + base.n_masses
        if base.act_plus == base.meas_plus == fold - base.act_plus:
            yield base, frozenset(fold - m if m > base.gap else m for m in masses)


def without_dampers(chain: Chain) -> Chain:
    """The chain without its dampers to the ground."""
    return replace(chain, ground_dampers=())


def _split(part: NDArray[np.int64], bucket: Numbers) -> list[NDArray[np.int64]]:
    """The part by bucket; where a bucket is not known the whole part stays together."""
    if len(part) < 2 or bucket.min() < 0:
        return [part]
    return [part[bucket == value] for value in np.unique(bucket)]


def _pairs(n: int) -> int:
    return n * (n - 1) // 2
