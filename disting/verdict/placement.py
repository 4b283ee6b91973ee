"""One kind of further experiment on a group of structures that one measurement cannot distinguish:
every place of every structure against every place of every other one.

A spot is a place of a structure at which the experiment is made. Chains and networks differ in how
their spots are decided only.

Spots of networks are matrices of transfer functions, which are all compared in pairs.

For chains, as in `class_search`, no pair is compared where a bucket decides:

0. A spot is looked at as the standard form of its machine (`equal_machines`): a force moved is a
   sensor moved in the machine with force and sensor exchanged, so both kinds share their work,
   and spots of one standard form are the same by a renaming.
1. A spot where the experiment repeats what is known, or where the sensor never moves, needs no
   profile: two such spots are alike because their structures are, and one that repeats is unlike
   one that is proven to show something new.
2. A profile of the stacked summary a spot: columns of conditions 1 to 5.
3. Spots of one bucket: free choice (7), equal colours looked at for a renaming (6); to have equal
   closures of the image is transitive, so they form classes.
4. The first class of a bucket is compared with all others by the exact decision; those that are
   not the same are a bucket of their own. So c classes cost fewer than c of them a member.

All of it is over generic complex parameters: models that are distinguishable there are so over
positive ones.
"""

from collections.abc import Iterable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from math import ceil, log2

from disting.algebra.certainty import Certainty, full_text
from disting.behaviour.profile import Profile
from disting.behaviour.sample import Representation
from disting.conditions.rule import FREE_CHOICE, RENAMING, Outcome
from disting.conditions.sufficient import condition_7
from disting.conditions.table import NECESSARY
from disting.errors import InputError
from disting.experiments.equal_machines import standard
from disting.experiments.exact import QUICKLY
from disting.experiments.experiment import MeasuredChain, places_of
from disting.experiments.machine_side import ComparedMachine
from disting.experiments.measured_network import further_model
from disting.experiments.menu import Gain, Item, gain, measure_with
from disting.model.chain import Chain
from disting.model.kinds import Kind
from disting.network.chains import of_chain
from disting.network.network import Network
from disting.questions.same.exact import resting_on_ranks
from disting.verdict.buckets import NOT_KNOWN, Buckets
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.placement_record import REPEATS, TESTS, Placement, Spot, SpotClasses, SpotPairs
from disting.verdict.result import Query, View

MOST_SPOTS = 400  # of networks
QUERY = Query(View.EXACT, inclusion=False)


def place(
    structures: Sequence[Chain | Network],
    kind: Kind,
    engine: Engine,
    *,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Placement:
    """Find the classes that this kind of experiment leaves of structures that are
    indistinguishable, over complex parameters, in the present measurement: chains of one size, or
    networks of one sort; mixed, chains are taken as networks. Raises InputError for too many
    networks, and for transfer functions that grow too large.
    """
    chains = [s for s in structures if isinstance(s, Chain)]
    if len(chains) == len(structures):
        return _place_chains(chains, kind, engine, executor, progress)
    networks = [of_chain(s) if isinstance(s, Chain) else s for s in structures]
    return _place_networks(networks, kind, engine, executor, progress)


def _place_networks(
    networks: Sequence[Network],
    kind: Kind,
    engine: Engine,
    executor: Executor | None,
    progress: Progress,
) -> Placement:
    places = tuple(map(places_of, networks))
    spots = [(k, i) for k, nodes in enumerate(places) for i in nodes]
    if len(spots) > MOST_SPOTS:
        raise InputError(
            f"these networks have {len(spots)} nodes together; {MOST_SPOTS} at most are looked at:"
            " name some of them only"
        )
    models, gains = zip(
        *(further_model(networks[k], kind, i, f"{networks[k].name} at {i}") for k, i in spots),
        strict=True,
    )
    sides = engine.general_subjects(models)
    decided = engine.decisions(sides, QUERY, executor=executor, progress=progress)
    return Placement(kind, places, gains, SpotPairs(decided, tuple(range(len(spots)))))


def _place_chains(
    chains: Sequence[Chain],
    kind: Kind,
    engine: Engine,
    executor: Executor | None,
    progress: Progress,
) -> Placement:
    work = _Work.of(chains, kind, engine)
    new = [s for s, g in enumerate(work.gains) if g is Gain.NEW]
    engine.prefetch({work.sides[s].profiled for s in new}, Representation.TF, 0, executor, progress)
    profiles = {s: work.sides[s].profile(Representation.TF, 0) for s in new}
    work.buckets.split(profiles, NECESSARY, 1)
    work.safeties += [p.safety for p in profiles.values()]
    work.join_known(profiles)
    work.decide(profiles, executor, progress)
    places = tuple(map(places_of, chains))
    return Placement(kind, places, tuple(work.gains), work.finished())


@dataclass
class _Work:
    """All spots in buckets and classes, and what else is known of them so far."""

    engine: Engine
    spots: list[Spot]
    sides: list[ComparedMachine]
    gains: list[Gain]
    buckets: Buckets
    links: list[str]
    open: set[tuple[int, int]] = field(default_factory=set)
    apart: set[tuple[int, int]] = field(default_factory=set)
    safeties: list[int] = field(default_factory=list)

    @staticmethod
    def of(chains: Sequence[Chain], kind: Kind, engine: Engine) -> "_Work":
        """Only what is gained is known."""
        spots = [(k, i) for k, chain in enumerate(chains) for i in places_of(chain)]
        sides, gains, firsts = [], [], []
        by_form: dict[MeasuredChain, ComparedMachine] = {}
        for k, i in spots:
            form = standard(measure_with(chains[k], Item(kind, i)))
            name = f"structure {k}, mass {i}"
            sides.append(by_form.setdefault(form, engine.measured_subject(name, form)))
            gained = gain(chains[k], Item(kind, i))
            gains.append(gained or Gain.NEW)
            firsts.append(NOT_KNOWN if gained is None else list(Gain).index(gained))
        size = len(sides)
        buckets = Buckets.of(sides, len(TESTS))
        for row, first in zip(buckets.columns, firsts, strict=True):
            row[0] = first
        work = _Work(engine, spots, sides, gains, buckets, [""] * size)
        for same in (Gain.REPEATS, Gain.SILENT):
            alike = [s for s in range(size) if gains[s] is same]
            for s in alike[1:]:
                work.unite(alike[0], s, REPEATS)
            # where it is not known whether something new is seen, neither is this
            work.open |= {(alike[0], s) for s in range(size) if alike and firsts[s] == NOT_KNOWN}
        return work

    def asked(self, chosen: Iterable[int]) -> list[list[int]]:
        """Roots by buckets, where those hold more than one structure."""
        tasks = []
        for bucket in self.buckets.shared(chosen):
            if len({self.spots[s][0] for s in bucket}) > 1:
                roots = list(dict.fromkeys(map(self.buckets.classes.root, bucket)))
                tasks += [roots] if len(roots) > 1 else []
        return tasks

    def join_known(self, profiles: dict[int, Profile]) -> None:
        """Free choice and renamings."""
        for bucket in self.asked(profiles):
            free = [s for s in bucket if self._is_free(profiles[bucket[0]], profiles[s])]
            for s in free:
                self.unite(bucket[0], s, FREE_CHOICE.name)
            for first, s in self.buckets.renamed([s for s in bucket if s not in free]):
                self.unite(first, s, RENAMING.name)

    @staticmethod
    def _is_free(first: Profile, second: Profile) -> bool:
        return condition_7(first, second).outcome is Outcome.HOLDS

    def decide(
        self, profiles: dict[int, Profile], executor: Executor | None, progress: Progress
    ) -> None:
        """The first of each bucket against the others, until nothing is left."""
        rounds = self.asked(s for s, g in enumerate(self.gains) if g is Gain.NEW)
        while rounds:
            pairs = [(bucket[0], s) for bucket in rounds for s in bucket[1:]]
            models = {(a, b): self._order_pair(a, b) for a, b in pairs}
            self.engine.answer_all(
                QUICKLY, list(models.values()), executor=executor, progress=progress
            )
            for (a, b), questions in models.items():
                finding = self.engine.answer(QUICKLY, questions, self.engine.settings)
                finding = resting_on_ranks(finding, profiles[a], profiles[b])
                if finding.outcome is Outcome.HOLDS:
                    self.unite(a, b)
                else:
                    (self.apart if finding.outcome is Outcome.FAILS else self.open).add((a, b))
                if finding.certainty is Certainty.BOUNDED:
                    self.safeties.append(finding.safety)
            rest = [
                [s for s in bucket[1:] if self.buckets.classes.root(s) == s] for bucket in rounds
            ]
            rounds = [b for b in rest if len({self.spots[s][0] for s in self._members(b)}) > 1]

    def _order_pair(self, a: int, b: int) -> tuple[MeasuredChain, MeasuredChain]:
        """Both machines, in an order that does not depend on that of the structures."""
        low, high = sorted((self.sides[s].measured for s in (a, b)), key=full_text)
        return low, high

    def _members(self, roots: Iterable[int]) -> list[int]:
        chosen = set(roots)
        return [s for s in range(len(self.sides)) if self.buckets.classes.root(s) in chosen]

    def unite(self, first: int, s: int, rule: str = "") -> None:
        """One class of two, for this reason; by the exact decision where none is named."""
        self.buckets.classes.unite(first, s)
        if rule:
            self.links[first] = self.links[s] = f"{rule}/{first}"

    def finished(self) -> SpotClasses:
        """Result; classes are numbered in the order of their first member."""
        root = self.buckets.classes.root
        roots = [root(s) for s in range(len(self.sides))]
        number = {r: k for k, r in enumerate(dict.fromkeys(roots))}
        kept, apart = (
            {tuple(sorted((number[root(a)], number[root(b)]))) for a, b in pairs}
            for pairs in (self.open, self.apart)
        )
        lost = ceil(log2(len(self.safeties))) if self.safeties else 0
        return SpotClasses(
            tuple(map(tuple, self.buckets.columns)),
            tuple(number[r] for r in roots),
            tuple(self.links),
            frozenset((a, b) for a, b in kept - apart if a != b),
            min(self.safeties) - lost if self.safeties else 0,
        )
