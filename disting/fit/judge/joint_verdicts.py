"""Verdict on two structures where several responses are fitted together.

More responses never make two structures harder to distinguish: structures that the first one
distinguishes stay distinguishable, and structures equivalent in it may differ in the others.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import permutations
from math import inf

import numpy as np

from disting.errors import InputError, enumeration
from disting.experiments.experiment import MeasuredChain
from disting.experiments.machine_model import is_renaming
from disting.fit.judge.alternatives import Alternative, Limits, is_within
from disting.fit.search.candidates import reference
from disting.fit.search.estimate import Task
from disting.fit.search.exchange import SEARCHED, body, estimates
from disting.fit.search.joint import AnyCost, FurtherResponse, JointCost
from disting.fit.search.setup import Setup, measurable, measured_chain
from disting.measurement.arrays import Complex
from disting.model.chain import Chain, Structure
from disting.store import Store
from disting.verdict.engine import Engine
from disting.verdict.result import Query, Relation, View

SAME = 1e-6  # largest relative difference of two responses that are one, at all lines
OPEN = "Whether that holds for positive parameters is not decided."
RENAMED = "A renaming of the parameters turns all responses of the one into those of the other."


def under_all(
    chain: Chain, other: Chain, cost: AnyCost, engine: Engine, limits: Limits
) -> Alternative | None:
    """Relation of another structure, possibly indistinguishable in the first response, under all
    responses, at its places; None where they distinguish it.

    By conditions and the exact decision over complex parameters. That all positive models are the
    same is known where a renaming of the parameters, within the limits, turns all responses of the
    one into those of the other.
    """
    if chain.gap_damper or other.gap_damper:
        return Alternative(other, Relation.UNDECIDED, OPEN)
    mine, theirs = (
        engine.measured_subject(str(c), _measure_chain(c, cost)) for c in (chain, other)
    )
    verdict = engine.verdict(mine, theirs, Query(View.COMBINED))
    if verdict.relation is Relation.DISTINGUISHABLE:
        return None
    if is_same_under_all(chain, other, cost, limits):
        return Alternative(other, Relation.INDISTINGUISHABLE, RENAMED)
    return Alternative(other, Relation.UNDECIDED, f"{verdict.sentence} {OPEN}")


def is_same_under_all(chain: Chain, other: Chain, cost: AnyCost, limits: Limits) -> bool:
    """Return True if a renaming of the parameters turns all responses of a chain into those of
    another, and maps every range into that of the parameter's new name; in both directions.
    """
    # a fit of one response asks for none
    from disting.questions.positive import renamings

    return chain == other or all(
        any(
            is_within(renaming, limits)
            and is_renaming(_measure_chain(this_chain, cost), _measure_chain(two, cost), renaming)
            for renaming in renamings(this_chain, two)
        )
        for this_chain, two in ((chain, other), (other, chain))
    )


def alternatives_under_all(
    chain: Chain,
    alternatives: Iterable[Alternative],
    cost: AnyCost,
    engine: Engine,
    limits: Limits,
) -> tuple[Alternative, ...]:
    """Structures that may be equivalent to a chain in all responses, from those that may be so in
    the first one.
    """
    if len(cost.setups) == 1:
        return tuple(alternatives)
    each = (
        under_all(chain, alternative.chain, cost, engine, limits) for alternative in alternatives
    )
    return tuple(alternative for alternative in each if alternative is not None)


def representatives_under_all(
    first: Mapping[Chain, Chain], cost: AnyCost, limits: Limits
) -> dict[Chain, Chain]:
    """For each candidate the one that has the same positive models in all responses, from `first`,
    which has them in the first one.
    """
    if len(cost.setups) == 1:
        return dict(first)
    return {
        chain: stands if is_same_under_all(chain, stands, cost, limits) else chain
        for chain, stands in first.items()
    }


def behaves_alike(
    chain: Chain,
    values: Mapping[str, float],
    other: Chain,
    other_entries: Mapping[str, float],
    task: Task,
) -> bool:
    """Return True if another structure with its own values has all responses too, with all sensors
    and changes at some places.

    One thing is one mass in all responses; which one is not known of the other structure, so that
    each is tried.
    """
    mine = _responses(chain, values, task.cost.setups_of(chain.structure), task)
    return any(
        all(
            _same(own_response, other_response)
            for own_response, other_response in zip(
                mine, _responses(other, other_entries, setups, task), strict=True
            )
        )
        for setups in placements(chain, other, task.cost.setups_of(chain.structure))
    )


def _responses(
    chain: Chain, values: Mapping[str, float], setups: Sequence[Setup], task: Task
) -> list[Complex]:
    """Each response at its lines."""
    cost = JointCost(task.cost.parts, tuple(setups))
    under = replace(task, cost=cost)
    p = np.array([values[name] for name in under.names(chain)])
    return task.cost.by_line(under.plant(chain).response(p))


def _same(values: Complex, other: Complex) -> bool:
    return bool(np.all(np.abs(values - other) <= SAME * np.abs(values)))


def _measure_chain(chain: Chain, cost: AnyCost) -> MeasuredChain:
    return measured_chain(chain, cost.setups_of(chain.structure))


def placements(chain: Chain, other: Chain, setups: Sequence[Setup]) -> Iterator[tuple[Setup, ...]]:
    """The setups of a chain at every choice of masses of another one where all sensors move."""
    n = chain.n_masses
    used = sorted({i for setup in setups for i in setup.experiment(n).masses})
    for chosen in permutations(range(1, other.n_masses + 1), len(used)):
        at = dict(zip(used, chosen, strict=True))
        moved = tuple(setup.moved(n, at.__getitem__) for setup in setups)
        if all(measurable(other, moved)):
            yield moved


def locate(task: Task, candidates: Sequence[Chain], home: Chain, store: Store) -> Task:
    """The task with the places of further responses in every candidate. Their names are those of
    `home`, and of chains that differ from it in dampers, lag and dead time alone; which mass is
    which in another one is not known: every choice is fitted, and the best is taken.
    """
    cost = task.cost
    if not isinstance(cost, JointCost):
        return task
    ways = {
        c: [cost.setups] if body(c) == body(home) else list(placements(home, c, cost.setups))
        for c in candidates
    }
    the_setups = dict[Structure, tuple[Setup, ...]]()
    least = dict[Chain, float]()
    few = cost.thinned(SEARCHED)
    for k in range(max(map(len, ways.values()))):
        tried = {c: each[k] for c, each in ways.items() if k < len(each)}
        other_setups = {c.structure: setups for c, setups in tried.items()}
        fits = estimates(tried, replace(task, cost=replace(few, places=other_setups)), store=store)
        for c, setups in tried.items():
            if fits[c].j < least.get(c, inf):
                least[c], the_setups[c.structure] = fits[c].j, setups
    return replace(task, cost=replace(cost, places=the_setups))


def informative(
    candidates: Sequence[Chain], further: Sequence[FurtherResponse], home: Chain | None = None
) -> tuple[list[Chain], list[FurtherResponse], list[str]]:
    """The candidates that have all places, the responses that are informative for them, and in
    words those that do not; raises InputError where no candidate has the places. `home`: as in
    `locate`.
    """
    if home is not None:
        lacking = [extra.setup.missing(home.structure) for extra in further]
        if any(lacking):
            sentence = enumeration(list(filter(None, lacking)))
            raise InputError(f"{reference(home)} cannot be measured like this: {sentence}")
        setups = [Setup(), *(extra.setup for extra in further)]
        other_chains = [
            c for c in candidates if body(c) == body(home) or any(placements(home, c, setups))
        ]
        return other_chains, list(further), []
    kept, reasons = list(candidates), dict[str, None]()
    for extra in further:
        missing = {c.n_masses: extra.setup.missing(c.structure) for c in kept}
        reasons |= dict.fromkeys(filter(None, missing.values()))
        kept = [c for c in kept if not missing[c.n_masses]]
    if not kept:
        raise InputError(f"no candidate can be measured like this: {enumeration(reasons)}")
    silent = [all(extra.setup.is_silent(c.structure) for c in kept) for extra in further]
    heard = [extra for extra, dead in zip(further, silent, strict=True) if not dead]
    kept = [c for c in kept if not any(extra.setup.is_silent(c.structure) for extra in heard)]
    if not kept:
        raise InputError("in every candidate one of the responses is zero: check the places")
    words = [extra.setup.text for extra, dead in zip(further, silent, strict=True) if dead]
    return kept, heard, words
