"""The signs of sensors where nobody said them: those with which candidates fit better."""

from collections.abc import Sequence
from dataclasses import replace

from disting.fit.estimate import Task, estimates
from disting.fit.joint import JointCost
from disting.model.chain import Chain


def signed(task: Task, candidates: Sequence[Chain]) -> Task:
    """The sign with which candidates fit better, the best of the largest and the smallest ones
    of each size; of further responses each is tried beside the first one.
    """
    by_size = [
        [c for c in candidates if c.n_masses == n] for n in sorted({c.n_masses for c in candidates})
    ]
    asked = list(
        dict.fromkeys(
            choose(one, key=lambda c: len(c.parameters)) for one in by_size for choose in (min, max)
        )
    )
    cost = task.cost
    first = replace(task, cost=cost.parts[0])
    found = _better([replace(first, sign=sign) for sign in (1, -1)], asked)
    if not isinstance(cost, JointCost):
        return found
    setups = [cost.setups[0]]
    for part, setup in zip(cost.parts[1:], cost.setups[1:], strict=True):
        pairs = [
            JointCost((cost.parts[0], part), (cost.setups[0], replace(setup, sign=sign, delay="")))
            for sign in (1, -1)
        ]
        best = _better([replace(found, cost=pair) for pair in pairs], asked)
        setups.append(replace(setup, sign=best.cost.setups[1].sign))
    return replace(found, cost=replace(cost, setups=tuple(setups)))


def _better(tasks: list[Task], asked: list[Chain]) -> Task:
    return min(tasks, key=lambda t: min(e.j for e in estimates(asked, t).values()))
