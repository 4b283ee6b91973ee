"""Builds `Classes`: profiles and buckets of canonical forms, then classes, then the exact decision
between classes.

Everything dear goes through the engine's store, so a run that is killed resumes; the order of the
work is that of its price:

1. Profiles of the transfer function and, where pairs are left, of the Markov parameters: columns
   of conditions 1 to 5.
2. Without looking at pairs: models of one bucket with full rank are free (7); a set of ground
   dampers contained in another of equal rank on the same chain gives the same closure (8), two
   such sets with a union of equal rank as well (9); equal fingerprints of colours are looked at
   for a renaming (6).
3. One representative a class: ranks of the Markov parameters of 1/G, then every pair of a bucket
   that is still together is asked: `quick` first, then whatever questions are added.

Certainty: every step is a theorem, proven, or bounded by 2^-LEAST_SAFETY at most; the relation of
a pair rests on as many steps as link its two models to their representatives, and one more, so its
error is bounded by that many times 2^-LEAST_SAFETY.
"""

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from itertools import combinations

import numpy as np

from disting.algebra.certainty import Certainty
from disting.behaviour.profile import Profile, Unsearched
from disting.behaviour.sample import Representation
from disting.conditions.finding import Finding, Outcome
from disting.conditions.rule import EXACT
from disting.conditions.sufficient import condition_6
from disting.conditions.table import NECESSARY, Necessary
from disting.errors import ContradictionError, InputError
from disting.model.chain import Chain
from disting.model.protocol import Model
from disting.model.question import Question
from disting.questions.same.limited import INVERSELY, QUICKLY
from disting.verdict.chains import ComparedChain
from disting.verdict.classes import Classes, without_dampers
from disting.verdict.engine import Engine, Progress, silent

Ask = Callable[[Question[Finding], Sequence[tuple[Chain, ...]]], list[Finding]]
Key = Callable[[int], Hashable]
OF_MARKOV = tuple(c for c in NECESSARY if not c.of_degrees)
# transfer function, Markov parameters, 1/G
TESTS = (*(c.rule.name for c in (*NECESSARY, *OF_MARKOV)), EXACT.name)


def classes(
    chains: Sequence[Chain],
    engine: Engine,
    *,
    more: Sequence[Question[Finding]] = (),
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Classes:
    """The classes of chains of one size and sensor without dead time; `more`: questions about what
    `quick` leaves open.

    Raises InputError for chains that differ in size, sensor or dampers beside the springs, or that
    have a dead time.
    """
    if len({(c.n_masses, c.sensor, c.damped) for c in chains}) != 1 or any(
        c.dead_time for c in chains
    ):
        raise InputError(
            "classes are made of chains of one size, sensor and damping without dead time"
        )
    work = _Work.of(chains, engine)
    count = 2 * max(s.chain.structure.n_states for s in work.subjects)
    everyone = range(len(work.subjects))
    profiles = work.profiles(everyone, Representation.TF, 0, executor, progress)
    work.split_by(profiles, NECESSARY, 0)
    work.link(profiles)
    several = [
        i
        for bucket in work.buckets(everyone)
        for i in bucket
        if len(bucket) > 1 and work.free[i] < 0
    ]
    work.split_by(
        work.profiles(several, Representation.MARKOV, count, executor, progress),
        OF_MARKOV,
        len(NECESSARY),
    )
    work.rename()
    _invert(work, executor, progress)
    for question in (QUICKLY, *more):
        _decide(work, question, executor, progress)
    return work.finished(chains)


@dataclass
class _Work:
    """Canonical subjects, what is known of each, and the classes found so far (a forest of
    parents).
    """

    engine: Engine
    subjects: list[ComparedChain]
    place: list[int]
    columns: list[list[int]]
    parent: list[int]
    renamed: list[int]
    free: list[int]
    refuted: set[tuple[int, int]] = field(default_factory=set)
    unions: dict[tuple[Chain, frozenset[int]], int] = field(default_factory=dict)

    @staticmethod
    def of(chains: Sequence[Chain], engine: Engine) -> "_Work":
        """Nothing is known yet but the canonical forms."""
        numbers: dict[Chain, int] = {}
        place = [
            numbers.setdefault(engine.subject("", c).canonical.chain, len(numbers)) for c in chains
        ]
        subjects, n = [engine.subject(f"form {i}", c) for c, i in numbers.items()], len(numbers)
        unions = {
            (without_dampers(c), frozenset(c.ground_dampers)): i
            for c, i in zip(chains, place, strict=True)
        }
        empty = [[-1] * len(TESTS) for _ in range(n)]
        return _Work(
            engine, subjects, place, empty, list(range(n)), list(range(n)), [-1] * n, unions=unions
        )

    def profiles(
        self,
        wanted: Iterable[int],
        r: Representation,
        count: int,
        executor: Executor | None,
        progress: Progress,
    ) -> dict[int, Profile]:
        """Profiles of the wanted subjects."""
        chosen = list(wanted)
        models: set[Model] = {self.subjects[i].profiled for i in chosen}
        self.engine.prefetch(models, r, count, executor, progress)
        return {i: self.subjects[i].profile(r, count) for i in chosen}

    def split_by(
        self, profiles: dict[int, Profile], conditions: Iterable[Necessary], first: int
    ) -> None:
        """Columns of necessary conditions, from the `first` one on."""
        for column, condition in enumerate(conditions, first):
            self.fill(column, {i: condition.key(p) for i, p in profiles.items()})

    def fill(self, column: int, values: dict[int, Hashable]) -> None:
        """Bucket numbers in one column; a bucket in which a value is not known is not split."""
        numbers: dict[Hashable, int] = {}
        for bucket in self.buckets(values):
            if not any(isinstance(values[i], Unsearched) for i in bucket):
                for i in bucket:
                    self.columns[i][column] = numbers.setdefault(values[i], len(numbers))

    def buckets(self, chosen: Iterable[int]) -> list[list[int]]:
        """The chosen subjects by all columns."""
        found: dict[tuple[int, ...], list[int]] = defaultdict(list)
        for i in chosen:
            found[tuple(self.columns[i])].append(i)
        return list(found.values())

    def link(self, profiles: dict[int, Profile]) -> None:
        """Free choice, and sets of ground dampers in one another."""
        for number, bucket in enumerate(self.buckets(profiles)):
            first = profiles[bucket[0]]
            if first.rank == len(first.form) and len({profiles[i].constants for i in bucket}) == 1:
                for i in bucket:
                    self.free[i] = number
                    self.unite(bucket[0], i)
        for (base, masses), i in self.unions.items():
            for more in range(1, base.n_masses + 1):
                j = self.unions.get((base, masses | {more}), i)
                if profiles[i].rank == profiles[j].rank:
                    self.unite(i, j)

    def rename(self) -> None:
        """Renamings inside buckets: those by symmetry are one canonical form already."""
        for bucket in self.buckets(range(len(self.subjects))):
            prints: dict[str, int] = {}
            for i in bucket if len(bucket) > 1 else []:
                first = prints.setdefault(self.subjects[i].colouring.fingerprint, i)
                if (
                    first != i
                    and condition_6(self.subjects[first], self.subjects[i], True).outcome
                    is Outcome.HOLDS
                ):
                    self.renamed[i] = first
                    self.unite(first, i)

    def root(self, i: int) -> int:
        """Representative of a class."""
        while self.parent[i] != i:
            self.parent[i] = self.parent[self.parent[i]]
            i = self.parent[i]
        return i

    def unite(self, i: int, j: int) -> None:
        """Make one class of two; the model with the fewest dampers represents it."""
        a, b = self.root(i), self.root(j)
        keys = {
            k: (len(self.subjects[k].chain.ground_dampers), self.subjects[k].chain.indices, k)
            for k in (a, b)
        }
        low, high = sorted((a, b), key=keys.__getitem__)
        self.parent[high] = low

    def open_pairs(self) -> list[tuple[int, int]]:
        """Pairs of representatives that share all columns and are not refuted."""
        roots = [i for i in range(len(self.subjects)) if self.root(i) == i]
        apart = {_sorted(self.root(a), self.root(b)) for a, b in self.refuted}
        pairs = (
            _sorted(i, j) for bucket in self.buckets(roots) for i, j in combinations(bucket, 2)
        )
        return [pair for pair in pairs if pair not in apart]

    def finished(self, chains: Sequence[Chain]) -> Classes:
        """What was found, for the chains as given."""
        told = {i: self.columns[i][:-1] for i in range(len(self.subjects))}
        apart = [*self.refuted, *((i, self.root(i)) for i in told if told[i] != told[self.root(i)])]
        for a, b in apart:
            if self.root(a) == self.root(b):
                raise ContradictionError(
                    f"one class holds {self.subjects[a].chain} and {self.subjects[b].chain}"
                )
        at = self.place
        return Classes(
            chains=tuple(chains),
            tests=TESTS,
            columns=np.array([self.columns[self.root(i)] for i in at], np.int32),
            group=np.array([self.root(i) for i in at], np.int32),
            renamed=np.array([self.renamed[i] for i in at], np.int32),
            free=np.array([self.free[i] for i in at], np.int32),
            rank=np.array([self.subjects[i].rank for i in at], np.int32),
            open_groups=frozenset(self.open_pairs()),
        )


def _invert(work: _Work, executor: Executor | None, progress: Progress) -> None:
    """Split the representatives that are still together by the dependences of the Markov
    parameters of 1/G.
    """
    wanted = sorted({i for pair in work.open_pairs() for i in pair})
    asked = [(work.subjects[i].chain,) for i in wanted]
    work.engine.answer_all(INVERSELY, asked, executor=executor, progress=progress)
    found = [work.engine.answer(INVERSELY, chains, work.engine.settings) for chains in asked]
    values: dict[int, Hashable] = {}
    for i, p in zip(wanted, found, strict=True):
        values[i] = p.matroid if isinstance(p.matroid, Unsearched) else (p.form, p.rank, p.matroid)
    work.fill(len(TESTS) - 1, values)


def _decide(
    work: _Work, question: Question[Finding], executor: Executor | None, progress: Progress
) -> None:
    """Ask about all open pairs of representatives, and take over what is decided."""
    pairs = work.open_pairs()
    asked = [work.subjects[i].in_order(work.subjects[j]) for i, j in pairs]
    work.engine.answer_all(question, asked, executor=executor, progress=progress)
    for (i, j), chains in zip(pairs, asked, strict=True):
        found = work.engine.answer(question, chains, work.engine.settings)
        sure = found.certainty is not Certainty.NUMERICAL
        if sure and found.outcome is Outcome.HOLDS:
            work.unite(i, j)
        elif sure and found.outcome is Outcome.FAILS:
            work.refuted.add((i, j))


def _sorted(i: int, j: int) -> tuple[int, int]:
    return (i, j) if i < j else (j, i)
