"""What would fit where no candidate does: another sensor quantity, a reversed sensor, phases of
the other sign, gains in dB, a zero-order hold, other places, one mass more.

A chain with dampers, a lag and a dead time, of as many masses as the best candidate, is fitted
under each reading. They are compared by J on the training data, which in
logarithms does not depend on the unit of the quantity. A mass more fits almost everything better, a
rod, a notch filter, friction: it is named only if it explains the data (`explains`).

What a few fits tell before all candidates are fitted: the signs of sensors where nobody said
them, and how much the lines of several responses scatter.
"""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace

import numpy as np

from disting.errors import ConstraintViolation
from disting.fit.judge.candidate import explains, share_about
from disting.fit.search.estimate import Estimate, Task
from disting.fit.search.exchange import SEARCHED, estimates, explore
from disting.fit.search.joint import AnyCost, JointCost
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex
from disting.measurement.tabular import ASSUMED_LINEAR
from disting.model.chain import Chain
from disting.quantities import MODELLED
from disting.store import Store

PILOT = 3  # masses: fits that only tell what lines scatter by have no more
# of the cost: what helps less than that, or than half as much as the best one, is not named
FALLS = 0.5
NOTHING = 1e-6  # a cost that is as good as zero
SMALL = 3  # masses: readings are tried with no more
MOST = 5  # masses: one more than this is not tried
NAMED = 4  # readings that are named
MOST_DB = 400.0  # of a gain
HELD = (2.0, 2.5, 4.0)  # rates of a hold, as ratios to the highest frequency


def better_sign(task: Task, candidates: Sequence[Chain]) -> Task:
    """The sign with which candidates fit better, the best of the largest and the smallest ones
    of each size; of further responses each is tried beside the first one.
    """
    asked = _extremes(candidates)
    cost = task.cost.thinned(SEARCHED)
    first = replace(task, cost=cost.parts[0])
    the_task = _better([replace(first, sign=sign) for sign in (1, -1)], asked)
    if not isinstance(task.cost, JointCost):
        return replace(task, sign=the_task.sign)
    setups = [cost.setups[0]]
    for part, setup in zip(cost.parts[1:], cost.setups[1:], strict=True):
        pairs = [
            JointCost((cost.parts[0], part), (cost.setups[0], replace(setup, sign=sign, delay="")))
            for sign in (1, -1)
        ]
        best = _better([replace(the_task, cost=pair) for pair in pairs], asked)
        setups.append(replace(setup, sign=best.cost.setups[1].sign))
    whole = replace(task.cost, setups=tuple(setups))
    return replace(task, sign=the_task.sign, cost=whole)


def pilot(task: Task, candidates: Sequence[Chain]) -> Callable[[AnyCost], list[Complex]]:
    """The responses of the best of a few candidates at the lines of any cost: a response divided by
    them bends no more, so that neighbouring lines show what they scatter by.
    """
    least = min(c.n_masses for c in candidates)
    asked = _extremes([c for c in candidates if c.n_masses <= max(PILOT, least)])
    own_estimates = estimates(
        asked, task.thinned(SEARCHED)
    )  # and smaller chains, which may lack a place
    estimate = min((own_estimates[chain] for chain in asked), key=lambda e: e.j)
    p = np.array([estimate.parameters[n] for n in task.names(estimate.chain)])
    return lambda cost: [replace(task, cost=cost).plant(estimate.chain).response(p)]


def _extremes(candidates: Sequence[Chain]) -> list[Chain]:
    """The largest and the smallest ones of each size."""
    by_size = [
        [c for c in candidates if c.n_masses == n] for n in sorted({c.n_masses for c in candidates})
    ]
    return list(
        dict.fromkeys(
            choose(chains, key=lambda c: len(c.parameters))
            for chains in by_size
            for choose in (min, max)
        )
    )


def _better(tasks: list[Task], asked: list[Chain]) -> Task:
    return min(tasks, key=lambda t: min(e.j for e in estimates(asked, t).values()))


@dataclass(frozen=True)
class Reading:
    """Another view of the data under which the cost on the training data falls from `before` to
    `found.j`.
    """

    words: str
    found: Estimate
    before: float

    @property
    def sentence(self) -> str:
        """Such as: read as velocity the cost falls from 390 to 1.7."""
        return f"{self.words} the cost falls from {self.before:.3g} to {self.found.j:.3g}"


def readings(
    searched: Sequence[Estimate],
    task: Task,
    *,
    store: Store | None = None,
    executor: Executor | None = None,
    progress: Callable[[str, int, int], object] = lambda what, done, total: None,
) -> tuple[Reading, ...]:
    """Readings under which the data fit much better than the best of the estimates does, small
    changes first.
    """
    task, own_estimates = explore(searched, task)
    small = [e for e in own_estimates if e.chain.n_masses <= SMALL] or own_estimates
    base = _loose(min(small, key=lambda e: e.j).chain)
    largest = max((e.chain for e in own_estimates), key=lambda c: c.n_masses)
    nearest = min(own_estimates, key=lambda fit: fit.j)
    lowest, most = nearest.j, share_about(nearest, task)
    the_readings, views = list[Reading](), list(_views(base, largest, task))
    for words, chain, other in views:
        progress("other readings of the data", len(the_readings), len(views))
        fitted = estimates([chain], other, store=store, executor=executor)[chain]
        if chain.n_masses <= largest.n_masses or explains(fitted, other, most):
            the_readings.append(Reading(words, fitted, lowest))
    limit = max(min(r.found.j for r in the_readings) / FALLS, NOTHING)
    helpful = [r for r in the_readings if r.found.j < FALLS * lowest and r.found.j <= limit]
    return tuple(helpful[:NAMED])


def _loose(chain: Chain) -> Chain:
    """With a damper at every mass, a lag and a dead time."""
    every = tuple(range(1, chain.n_masses + 1))
    return replace(chain, ground_dampers=every, lag=True, dead_time=True)


def _views(loose: Chain, largest: Chain, task: Task) -> Iterator[tuple[str, Chain, Task]]:
    """Words, a chain and a task for each reading of a chain."""
    first, reversed_sensor = task.cost.parts[0], replace(task, sign=-task.sign)
    data = first.measured
    yield "with the sign reversed", loose, reversed_sensor
    for quantity in MODELLED:
        if quantity is not data.sensor:
            cost = replace(first, measured=replace(data, sensor=quantity))
            seen = replace(loose, sensor=quantity)
            yield f"read as {quantity.value}", seen, replace(task, cost=cost)
            yield (
                f"read as {quantity.value} with the sign reversed",
                seen,
                replace(reversed_sensor, cost=cost),
            )
    for words, response in _misread(data):
        seen_so = replace(data, G=response, deviation=None)
        yield words, loose, replace(task, cost=replace(first, measured=seen_so))
    for words, other in _places(loose):
        yield words, other, task
        yield f"{words} and the sign reversed", other, reversed_sensor
    if largest.n_masses < MOST:
        more = replace(largest, n_masses=largest.n_masses + 1)
        yield "with one mass more", _loose(more), task


def _misread(data: FrequencyResponse) -> Iterator[tuple[str, Complex]]:
    """The response if the phases, the gains or the sampling were others than they are taken for."""
    yield "with the sign of all phases (of the imaginary parts) turned", data.G.conj()
    size = np.abs(data.G)
    if any(ASSUMED_LINEAR in said for said in (*data.notes, *data.doubts)) and size.max() < MOST_DB:
        yield "with gains in dB (--unit magnitude=dB)", 10.0 ** (size / 20) * data.G / size
    for ratio in HELD:
        rate = ratio * data.frequency[-1]
        held = np.sinc(data.frequency / rate)
        yield f"with a zero-order hold at {rate:.3g} Hz taken out", data.G / held


def _places(chain: Chain) -> Iterator[tuple[str, Chain]]:
    """Force at one end and the sensor at another mass, or both at one end; ports as they are
    already are left out.
    """
    n = max(chain.n_masses, 2)
    for place in range(1, n + 1):
        try:
            other = replace(
                chain, n_masses=n, gap=0, act_minus=0, act_plus=1, meas_minus=0, meas_plus=place
            )
        except ConstraintViolation:
            continue
        if other.indices[1:] != chain.indices[1:]:
            yield f"with the force at mass 1 and the sensor at mass {place} of {n}", other
