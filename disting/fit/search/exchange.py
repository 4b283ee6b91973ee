"""The best parameters of all candidates of one fit: in an order in which they help each other, with
a store, by workers.

Candidates are taken in the order of masses and elements, so that each finds the fits of smaller
ones ready. Those with the same masses, springs and ports then exchange their fits: what neighbours
found is a start, round by round until no candidate gets better. A valley that one of them enters
is thereby open to all, so that each needs to try a part of the starts only.
"""

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import Executor
from dataclasses import replace
from hashlib import sha256
from itertools import groupby

import numpy as np

from disting.algebra.certainty import full_text
from disting.fit.search.containment import contains
from disting.fit.search.estimate import (
    Estimate,
    Method,
    Task,
    estimate,
    evaluate,
    improve,
    refine,
)
from disting.fit.search.neighbours import neighbours
from disting.fit.search.starts import bare, merge, shorten
from disting.model.chain import Chain
from disting.store import Store
from disting.store.scheduling import map_tasks
from disting.store.store import digest

# every so many candidates that exchange divide their starts into one part more, up to so many parts
FELLOWS, PARTS = 8, 6
SEARCHED = 2000  # lines of a response on which a search is made
ROUNDS = 20  # of the exchange between neighbours, at most: it stands still after fewer


def estimates(
    candidates: Iterable[Chain],
    task: Task,
    *,
    method: Method | None = None,
    store: Store | None = None,
    executor: Executor | None = None,
    progress: Callable[[str, int, int], object] = lambda what, done, total: None,
) -> dict[Chain, Estimate]:
    """Best parameters of every candidate and of the smaller ones that lead to them; what `store`
    holds is not fitted again.

    The search is on `SEARCHED` lines of each response, where there are more; what it finds is
    brought to the last digit on all. Another `method` than structured starts, such as
    `swarm.by_swarm`, gets no fits of smaller candidates.
    """
    store, run = store or Store.none(), method or estimate
    few = task.thinned(SEARCHED)
    if few is not task:
        rough = estimates(
            candidates, few, method=method, store=store, executor=executor, progress=progress
        )
        return {e.chain: e for e in polish(rough.values(), task, store, executor, progress)}
    wanted = sorted(with_smaller(candidates) if method is None else candidates, key=_stage)
    own_estimates: dict[Chain, Estimate] = {}
    for _, variants in groupby(wanted, key=body):
        fellows = list(variants)
        part = (
            replace(task, divided=min(1 + (len(fellows) - 1) // FELLOWS, PARTS))
            if method is None
            else task
        )
        for _, stage in groupby(fellows, key=_stage):
            whole = list(stage)
            own_estimates |= {c: evaluate(c, task) for c in whole if _is_given(c, task)}
            helpful = {c: _helpful(c, own_estimates) for c in whole if c not in own_estimates}
            progress("fit", len(own_estimates), len(wanted))
            for the_estimate in _results(run, helpful, part, store, executor):
                own_estimates[the_estimate.chain] = the_estimate
                progress("fit", len(own_estimates), len(wanted))
        if method is None:
            for the_estimate in _exchange_estimates(
                {c: own_estimates[c] for c in fellows}, task, store, executor
            ):
                own_estimates[the_estimate.chain] = the_estimate
                progress("fit", len(own_estimates), len(wanted))
    return own_estimates


def polish(
    rough: Iterable[Estimate],
    task: Task,
    store: Store,
    executor: Executor | None,
    progress: Callable[[str, int, int], object],
) -> list[Estimate]:
    """The estimates of a search on few lines, or by another cost, brought to the last digit of the
    task; what a candidate contains comes before it.
    """
    own = {this_estimate.chain: this_estimate for this_estimate in rough}
    the_estimates: dict[Chain, Estimate] = {}
    for _, stage in groupby(sorted(own, key=_stage), key=_stage):
        whole = list(stage)
        the_estimates |= {c: evaluate(c, task) for c in whole if _is_given(c, task)}
        helpful = {
            c: _lowest(c, the_estimates, task) | {c: own[c]}
            for c in whole
            if c not in the_estimates
        }
        for this_estimate in _results(refine, helpful, task, store, executor):
            the_estimates[this_estimate.chain] = this_estimate
            progress("last digits", len(the_estimates), len(own))
    return [the_estimates[c] for c in own]


def explore(own_estimates: Iterable[Estimate], task: Task) -> tuple[Task, list[Estimate]]:
    """The task on few lines, on which much can be tried, and estimates of the whole one there."""
    few = task.thinned(SEARCHED)
    if few is task:
        return task, list(own_estimates)
    return few, [
        refine(this_estimate.chain, few, {this_estimate.chain: this_estimate})
        for this_estimate in own_estimates
    ]


def _exchange_estimates(
    own_estimates: dict[Chain, Estimate], task: Task, store: Store, executor: Executor | None
) -> Iterator[Estimate]:
    """Better estimates of variants of one chain, from the fits of neighbours that have changed,
    until none changes.

    All candidates of a round start from the estimates before it: their order and the number of
    workers do not matter.
    """
    changed, left = set(own_estimates), ROUNDS
    while changed and left:
        offers = {
            c: changed.intersection(neighbours(c)) for c in own_estimates if not _is_given(c, task)
        }
        helpful = {
            c: {o: own_estimates[o] for o in own_estimates if o in near or o == c}
            for c, near in offers.items()
            if near
        }
        left -= 1
        after = dict(own_estimates)
        for the_estimate in _results(improve, helpful, task, store, executor):
            after[the_estimate.chain] = the_estimate
            yield the_estimate
        changed = {c for c in own_estimates if after[c].j < own_estimates[c].j}
        own_estimates = after


def _results(
    run: Method,
    helpful: Mapping[Chain, Mapping[Chain, Estimate]],
    task: Task,
    store: Store,
    executor: Executor | None,
) -> Iterator[Estimate]:
    """The estimates that `run` finds of chains, each with what helps it, as they come; from
    `store` where it holds them.
    """
    keys = {c: _key(c, task, near, run.__name__) for c, near in helpful.items()}
    stored = store.get_many(keys.values())
    yield from (estimate_from_json(c, stored[key]) for c, key in keys.items() if key in stored)
    for _, the_estimate in map_tasks(
        run, [(c, task, near) for c, near in helpful.items() if keys[c] not in stored], executor
    ):
        text = estimate_to_json(the_estimate)
        store.put_many({keys[the_estimate.chain]: text})
        yield estimate_from_json(the_estimate.chain, text)  # as it is read the next time


def estimate_to_json(the_estimate: Estimate) -> str:
    """Text that `estimate_from_json` reads back bit-equal."""
    return json.dumps(
        {
            "parameters": the_estimate.parameters,
            "j": the_estimate.j,
            "costs": the_estimate.costs,
            "valleys": the_estimate.valleys,
        }
    )


def estimate_from_json(chain: Chain, text: str) -> Estimate:
    """Inverse of `estimate_to_json`."""
    plain = json.loads(text)
    valleys = tuple(map(tuple, plain["valleys"]))
    return Estimate(chain, plain["parameters"], plain["j"], tuple(plain["costs"]), valleys)


def _key(chain: Chain, task: Task, helpful: Mapping[Chain, Estimate], method: str) -> str:
    """Content address of an estimate: the data, the choices, the chain and what its starts come
    from.
    """
    cost, first = task.cost, task.cost.parts[0]
    arrays = [
        array
        for part in cost.parts
        for array in (
            part.measured.omega,
            part.measured.G,
            np.zeros(0) if part.lines is None else part.lines,
        )
    ]
    texts = [
        digest(__name__),
        method,
        full_text(chain),
        *(part.measured.sensor.value for part in cost.parts),
        *(
            full_text((setup, len(p.measured), p.observation))
            for setup, p in zip(cost.setups_of(chain.structure), cost.parts, strict=True)
        ),
        full_text((first.case, first.weights, task.sign, task.seed, task.divided, cost.delays)),
    ]
    texts += [full_text(sorted(task.bounds.items())), full_text(sorted(task.fixed.items()))]
    texts += [estimate_to_json(helpful[c]) for c in sorted(helpful, key=full_text)]
    return sha256(
        b"\0".join([*(np.ascontiguousarray(a).tobytes() for a in arrays), *map(str.encode, texts)])
    ).hexdigest()


def with_smaller(candidates: Iterable[Chain]) -> set[Chain]:
    """The candidates and, repeatedly, those with two neighbouring masses merged."""
    chains, new = set[Chain](), set(candidates)
    while new:
        chains |= new
        new = {fewer for chain in new for _, fewer in merge(chain)} - chains
    return chains


def _is_given(chain: Chain, task: Task) -> bool:
    """Return True if there is nothing to search."""
    return set(task.names(chain)) <= set(task.fixed)


def _helpful(chain: Chain, own_estimates: Mapping[Chain, Estimate]) -> dict[Chain, Estimate]:
    """Estimates from which one candidate's starts are derived; a worker needs no others."""
    near = {*(c for _, c in merge(chain)), *shorten(chain)}
    return {c: own_estimates[c] for c in own_estimates if c in near}


def _lowest(
    chain: Chain, own_estimates: Mapping[Chain, Estimate], task: Task
) -> dict[Chain, Estimate]:
    """The estimate of least cost that is one of the chain too, at a limit; none where it contains
    no candidate that has the same responses.
    """
    cost = task.cost.on(chain)
    inner = [c for c in own_estimates if contains(chain, c) and cost.on(c) is cost]
    return {c: own_estimates[c] for c in sorted(inner, key=lambda c: own_estimates[c].j)[:1]}


def body(chain: Chain) -> tuple[int, str]:
    """Masses, springs and ports: what candidates that exchange their fits have in common."""
    return chain.n_masses, full_text(bare(chain))


def _stage(chain: Chain) -> tuple[int, str, int]:
    """Order of work: what a candidate contains and what leads to it comes before it."""
    extras = chain.gap_damper + chain.lag + chain.dead_time
    return *body(chain), len(chain.ground_dampers) + extras
