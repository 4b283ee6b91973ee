"""What a few fits tell before all candidates are fitted: the signs of sensors where nobody said
them, and how much the lines of several responses scatter.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from disting.fit.search.estimate import Task
from disting.fit.search.exchange import SEARCHED, estimates
from disting.fit.search.joint import AnyCost, JointCost
from disting.measurement.arrays import Complex
from disting.model.chain import Chain

PILOT = 3  # masses: fits that only tell what lines scatter by have no more


def signed(task: Task, candidates: Sequence[Chain]) -> Task:
    """The sign with which candidates fit better, the best of the largest and the smallest ones
    of each size; of further responses each is tried beside the first one.
    """
    asked = _extremes(candidates)
    cost = task.cost.thinned(SEARCHED)
    first = replace(task, cost=cost.parts[0])
    found = _better([replace(first, sign=sign) for sign in (1, -1)], asked)
    if not isinstance(task.cost, JointCost):
        return replace(task, sign=found.sign)
    setups = [cost.setups[0]]
    for part, setup in zip(cost.parts[1:], cost.setups[1:], strict=True):
        pairs = [
            JointCost((cost.parts[0], part), (cost.setups[0], replace(setup, sign=sign, delay="")))
            for sign in (1, -1)
        ]
        best = _better([replace(found, cost=pair) for pair in pairs], asked)
        setups.append(replace(setup, sign=best.cost.setups[1].sign))
    whole = replace(task.cost, setups=tuple(setups))
    return replace(task, sign=found.sign, cost=whole)


def pilot(task: Task, candidates: Sequence[Chain]) -> Callable[[AnyCost], list[Complex]]:
    """The responses of the best of a few candidates at the lines of any cost: a response divided by
    them bends no more, so that neighbouring lines show what they scatter by.
    """
    least = min(c.n_masses for c in candidates)
    asked = _extremes([c for c in candidates if c.n_masses <= max(PILOT, least)])
    known = estimates(asked, task.thinned(SEARCHED))  # and smaller chains, which may lack a place
    there = min((known[chain] for chain in asked), key=lambda e: e.j)
    p = np.array([there.parameters[n] for n in task.names(there.chain)])
    return lambda cost: [replace(task, cost=cost).plant(there.chain).response(p)]


def _extremes(candidates: Sequence[Chain]) -> list[Chain]:
    """The largest and the smallest ones of each size."""
    by_size = [
        [c for c in candidates if c.n_masses == n] for n in sorted({c.n_masses for c in candidates})
    ]
    return list(
        dict.fromkeys(
            choose(one, key=lambda c: len(c.parameters)) for one in by_size for choose in (min, max)
        )
    )


def _better(tasks: list[Task], asked: list[Chain]) -> Task:
    return min(tasks, key=lambda t: min(e.j for e in estimates(asked, t).values()))
