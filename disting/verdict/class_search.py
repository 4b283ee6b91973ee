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
   that is still together is asked: `QUICKLY` first; what was settled of two forms before is taken
   over; then whatever questions are added.

Certainty: every step is a theorem, proven, or bounded by 2^-LEAST_SAFETY at most; the relation of
a pair rests on as many steps as link its two models to their representatives, and one more, so its
error is bounded by that many times 2^-LEAST_SAFETY.
"""

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from itertools import combinations

import numpy as np

from disting.algebra.certainty import Certainty
from disting.behaviour.profile import NoMatroid, Profile
from disting.behaviour.sample import Representation
from disting.conditions.rule import EXACT, Finding, Outcome
from disting.conditions.table import NECESSARY
from disting.errors import ContradictionError, InputError
from disting.model.chain import Chain
from disting.model.protocol import Model
from disting.model.question import Question
from disting.questions.same.low_cost import INVERSELY, QUICKLY
from disting.verdict.buckets import NOT_KNOWN, Buckets
from disting.verdict.chain_side import ComparedChain
from disting.verdict.classes import Classes, without_dampers
from disting.verdict.engine import Engine, Progress, silent

Ask = Callable[[Question[Finding], Sequence[tuple[Chain, ...]]], list[Finding]]
Findings = Mapping[tuple[Chain, Chain], Finding]
"""Known findings on pairs of canonical chains."""
OF_MARKOV = tuple(c for c in NECESSARY if not c.of_degrees)
# transfer function, Markov parameters, 1/G
TESTS = (*(c.rule.name for c in (*NECESSARY, *OF_MARKOV)), EXACT.name)


def classes(
    chains: Sequence[Chain],
    engine: Engine,
    *,
    settled: Findings | None = None,
    more: Sequence[Question[Finding]] = (),
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Classes:
    """The classes of chains of one size and sensor without dead time; `more`: questions about what
    `QUICKLY` leaves open. Of what is `settled`, pairs with a chain that is not here are passed
    over.

    Raises InputError for chains that differ in size, sensor or dampers in parallel with the
    springs, or that have a dead time.
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
    work.buckets.split(profiles, NECESSARY, 0)
    work.link(profiles)
    several = [
        i
        for bucket in work.buckets.shared(everyone)
        for i in bucket
        if len(bucket) > 1 and work.free[i] < 0
    ]
    work.buckets.split(
        work.profiles(several, Representation.MARKOV, count, executor, progress),
        OF_MARKOV,
        len(NECESSARY),
    )
    work.rename()
    _invert(work, executor, progress)
    _decide(work, QUICKLY, executor, progress)
    work.take_over(settled or {})
    for question in more:
        _decide(work, question, executor, progress)
    return work.finished(chains)


@dataclass
class _Work:
    """Canonical subjects in buckets and classes, and what else is known of each."""

    engine: Engine
    subjects: list[ComparedChain]
    place: list[int]
    buckets: Buckets
    renamed: list[int]
    free: list[int]
    unions: dict[tuple[Chain, frozenset[int]], int]
    refuted: set[tuple[int, int]] = field(default_factory=set)

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
        # the model with the fewest dampers represents a class
        order = [(len(c.ground_dampers), c.indices, i) for c, i in numbers.items()]
        buckets = Buckets.of(subjects, len(TESTS), order.__getitem__)
        return _Work(engine, subjects, place, buckets, list(range(n)), [NOT_KNOWN] * n, unions)

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

    def link(self, profiles: dict[int, Profile]) -> None:
        """Free choice, and sets of ground dampers in one another."""
        for number, bucket in enumerate(self.buckets.shared(profiles)):
            first = profiles[bucket[0]]
            if first.rank == len(first.form) and len({profiles[i].constants for i in bucket}) == 1:
                for i in bucket:
                    self.free[i] = number
                    self.buckets.classes.unite(bucket[0], i)
        for (base, masses), i in self.unions.items():
            for more in range(1, base.n_masses + 1):
                j = self.unions.get((base, masses | {more}), i)
                if profiles[i].rank == profiles[j].rank:
                    self.buckets.classes.unite(i, j)

    def rename(self) -> None:
        """Renamings inside buckets: those by symmetry are one canonical form already."""
        for bucket in self.buckets.shared(range(len(self.subjects))):
            for first, i in self.buckets.renamed(bucket):
                self.renamed[i] = first
                self.buckets.classes.unite(first, i)

    def take_over(self, settled: Findings) -> None:
        """Take over the known findings on canonical forms that are present."""
        at = {s.canonical.chain: i for i, s in enumerate(self.subjects)}
        for (first, second), finding in settled.items():
            if first in at and second in at:
                self.take(at[first], at[second], finding)

    def take(self, i: int, j: int, finding: Finding) -> None:
        """Record a finding on two forms, where it is certain."""
        if finding.certainty is Certainty.NUMERICAL:
            return
        if finding.outcome is Outcome.HOLDS:
            self.buckets.classes.unite(i, j)
        elif finding.outcome is Outcome.FAILS:
            self.refuted.add((i, j))

    def open_pairs(self) -> list[tuple[int, int]]:
        """Pairs of representatives that share all columns and are not refuted."""
        roots = [i for i in range(len(self.subjects)) if self.buckets.classes.root(i) == i]
        apart = {
            _sort_pair(self.buckets.classes.root(a), self.buckets.classes.root(b))
            for a, b in self.refuted
        }
        pairs = (
            _sort_pair(i, j)
            for bucket in self.buckets.shared(roots)
            for i, j in combinations(bucket, 2)
        )
        return [pair for pair in pairs if pair not in apart]

    def finished(self, chains: Sequence[Chain]) -> Classes:
        """Classes found, for the chains as given."""
        columns, root = self.buckets.columns, self.buckets.classes.root
        keys = {i: columns[i][:-1] for i in range(len(self.subjects))}
        apart = [
            *self.refuted,
            *((i, root(i)) for i in keys if keys[i] != keys[root(i)]),
        ]
        for a, b in apart:
            if root(a) == root(b):
                raise ContradictionError(
                    f"one class holds {self.subjects[a].chain} and {self.subjects[b].chain}"
                )
        at = self.place
        return Classes(
            chains=tuple(chains),
            tests=TESTS,
            columns=np.array([columns[root(i)] for i in at], np.int32),
            group=np.array([root(i) for i in at], np.int32),
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
    tasks = [(work.subjects[i].chain,) for i in wanted]
    work.engine.answer_all(INVERSELY, tasks, executor=executor, progress=progress)
    inverses = [work.engine.answer(INVERSELY, chains, work.engine.settings) for chains in tasks]
    values: dict[int, Hashable] = {}
    for i, p in zip(wanted, inverses, strict=True):
        values[i] = p.matroid if isinstance(p.matroid, NoMatroid) else (p.form, p.rank, p.matroid)
    work.buckets.fill(len(TESTS) - 1, values)


def _decide(
    work: _Work, question: Question[Finding], executor: Executor | None, progress: Progress
) -> None:
    """Ask about all open pairs of representatives, and take over what is decided."""
    pairs = work.open_pairs()
    tasks = [work.subjects[i].pair(work.subjects[j]) for i, j in pairs]
    work.engine.answer_all(question, tasks, executor=executor, progress=progress)
    for (i, j), chains in zip(pairs, tasks, strict=True):
        work.take(i, j, work.engine.answer(question, chains, work.engine.settings))


def _sort_pair(i: int, j: int) -> tuple[int, int]:
    return (i, j) if i < j else (j, i)
