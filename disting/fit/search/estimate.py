"""The best parameters of one candidate: structured starts, a rough search of all, the last digits
of the best.

Starts come from the data, from the fits of smaller candidates and from those of neighbours (which
of them there are: `exchange`). A candidate that contains another one (`containment`) is never worse
than that: the smaller one's fit, near the limit at which both are the same, is a start.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cache
from hashlib import sha256
from math import inf

import numpy as np
from threadpoolctl import ThreadpoolController

from disting.errors import InputError
from disting.fit.search.containment import contains, embeddings
from disting.fit.search.descent import Box, fine, rough
from disting.fit.search.joint import AnyCost, AnyPlant
from disting.fit.search.neighbours import carry_over, conspicuous, neighbours, split_starts
from disting.fit.search.plant import Plant
from disting.fit.search.starts import (
    Parameters,
    at_modes,
    extend,
    from_extrema,
    merge,
    random,
    scale,
    shorten,
    split,
    stack,
)
from disting.measurement.arrays import Real
from disting.model.chain import Chain
from disting.model.presentation import summary

ITERATIONS = 30  # of the rough search, and again from the best that it found
FEW, MANY = 8, 32  # random starts, where the data lead to others and where not
FINISHED = 4  # starts that are searched on, the best of which is brought to the last digit
VALLEYS = 12  # of the rough search that are kept beside the best parameters
REACHED = 1e-3  # relative excess of cost within which a start counts as a hit,
NOTHING = 1e-6  # or a cost that is as good as zero
GAIN = 1e-4  # relative gain of cost from which on a neighbour's fit helps
DAMPERS = "db"  # first letters of what may be fixed to zero
SMOOTH = (0.03, 0.01, 0.003)  # distances from the axis, of each frequency, of undamped fits
SHORT = 10  # iterations at each
NESTED = 1e-9  # relative excess of cost that a candidate may have over one that it contains


@dataclass(frozen=True)
class Task:
    """Settings that all candidates of one fit share. `bounds` and `fixed` by parameter name; `sign`
    = -1: sensor reversed.

    `divided`: each candidate takes one of so many parts of its starts. Where candidates exchange
    their fits, what one of them finds helps all, and together they try every kind of start.
    """

    cost: AnyCost
    sign: int = 1
    bounds: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    fixed: Mapping[str, float] = field(default_factory=dict)
    seed: str = "disting"
    divided: int = 1

    def __post_init__(self) -> None:
        for name, (low, high) in self.bounds.items():
            if not 0 <= low < high:
                raise InputError(f"bounds of {name} are 0 <= low < high, not {low:g}..{high:g}")
        for name, value in self.fixed.items():
            if not (0 < value < inf or (value == 0 and name[0] in DAMPERS)):
                zero = ", or a damper to 0" if name[0] in DAMPERS else ""
                raise InputError(f"{name} is fixed to a positive number{zero}, not {value:g}")

    def __repr__(self) -> str:
        return summary(self, f"{self.cost!r}, sign {self.sign}")

    def plant(self, chain: Chain) -> AnyPlant:
        """The chain at the frequencies of the data."""
        return self.cost.plant(chain.structure, self.sign)

    def names(self, chain: Chain) -> tuple[str, ...]:
        """Names of the fitted values, in the order of parameter vectors: the chain's parameters,
        then dead times of single responses.
        """
        return (*chain.parameters, *(self.cost.delays if chain.dead_time else ()))

    def on(self, chain: Chain) -> "Task":
        """The task of a chain that may have fewer places: of the responses that it has."""
        return replace(self, cost=self.cost.on(chain))

    def thinned(self, count: int) -> "Task":
        """The task of at most so many lines of each response; itself if there are no more."""
        cost = self.cost.thinned(count)
        return self if cost is self.cost else replace(self, cost=cost)

    def box(self, names: Sequence[str]) -> Box:
        """Bounds as arrays."""
        limits = [
            (self.fixed[n],) * 2 if n in self.fixed else self.bounds.get(n, (0.0, inf))
            for n in names
        ]
        low, high = np.array(limits, dtype=float).reshape(-1, 2).T
        return Box(low, high)


@dataclass(frozen=True)
class Estimate:
    """A candidate's best parameters and their cost J; `costs` of all starts after the rough
    search, in rising order; `valleys`: where the best of them ended, shape (n, n_p), in the order
    of `Task.names`: noise may make another valley than the true one the deepest.

    Among the starts are those from the data and from smaller fits, then the fits of neighbours,
    once for each change.
    """

    chain: Chain
    parameters: dict[str, float]
    j: float
    costs: tuple[float, ...] = ()
    valleys: tuple[tuple[float, ...], ...] = ()

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value:.4g}" for name, value in self.parameters.items())
        return summary(self, f"J = {self.j:.4g}, {values}")

    @property
    def hit_rate(self) -> float:
        """Share of the starts whose rough search came within 0.1 % of the best cost."""
        return sum(c <= self.j * (1 + REACHED) + NOTHING for c in self.costs) / max(
            len(self.costs), 1
        )


@contextmanager
def one_thread() -> Iterator[None]:
    """The libraries of linear algebra get one thread: matrices are small, so that many threads wait
    for each other a hundred times as long as one computes, and workers share the processors.
    """
    with _libraries().limit(limits=1):
        yield


@cache
def _libraries() -> ThreadpoolController:
    """Those of this process, looked up once, which takes as long as many a search."""
    return ThreadpoolController()


Method = Callable[[Chain, Task, Mapping[Chain, Estimate]], Estimate]
"""Finds the best parameters of one candidate, with the fits of others that help."""


@one_thread()
def estimate(chain: Chain, task: Task, estimates: Mapping[Chain, Estimate]) -> Estimate:
    """Best parameters of one candidate, from the data and from the fits of smaller candidates
    in `estimates`.
    """
    task = task.on(chain)
    first = sha256(str(chain).encode()).digest()[0] % task.divided
    starts = _stack_starts(
        list(_starts(chain, task, estimates))[first :: task.divided], chain, task
    )
    return _best(chain, task, estimates, starts)


def evaluate(chain: Chain, task: Task) -> Estimate:
    """The cost of a candidate whose parameters are all given: there is nothing to search."""
    task = task.on(chain)
    names = task.names(chain)
    values = [task.fixed[name] for name in names]
    j = float(task.cost.total(task.plant(chain).response(np.array(values))))
    return Estimate(chain, dict(zip(names, values, strict=True)), j, (j,))


@one_thread()
def improve(chain: Chain, task: Task, estimates: Mapping[Chain, Estimate]) -> Estimate:
    """The candidate's estimate in `estimates`, or a better one that the fits of its neighbours
    there lead to.
    """
    task = task.on(chain)
    own, names, size = estimates[chain], task.names(chain), scale(task.cost.measured)
    offered = [_common(estimates[c]) for c in neighbours(chain) if c in estimates]
    starts = _stack_starts(
        [start for fit in offered for start in carry_over(chain, fit, size)], chain, task
    )
    plant, box = task.plant(chain), task.box(names)
    points, costs = rough(plant, task.cost, box, starts, ITERATIONS)
    i = int(np.argmin(costs))
    p, j = np.array([own.parameters[name] for name in names]), own.j
    if costs[i] < j * (1 - GAIN):
        p, j = fine(plant, task.cost, box, points[i])
    p, j = _refit_contained(chain, task, estimates, p, j)
    tried = tuple(sorted([*own.costs, *map(float, costs)]))
    return Estimate(chain, dict(zip(names, map(float, p), strict=True)), j, tried, own.valleys)


@one_thread()
def refine(chain: Chain, task: Task, estimates: Mapping[Chain, Estimate]) -> Estimate:
    """The candidate's estimate in `estimates`, found on other lines, on those of the task; no worse
    than what it contains.
    """
    task = task.on(chain)
    own, names = estimates[chain], task.names(chain)
    start = np.array([own.parameters[name] for name in names])
    p, j = fine(task.plant(chain), task.cost, task.box(names), start)
    p, j = _refit_contained(chain, task, estimates, p, j)
    share = j / own.j if own.j else 1.0
    costs = tuple(share * cost for cost in own.costs)
    return Estimate(chain, dict(zip(names, map(float, p), strict=True)), j, costs, own.valleys)


def _best(chain: Chain, task: Task, estimates: Mapping[Chain, Estimate], starts: Real) -> Estimate:
    names = task.names(chain)
    plant, box = task.plant(chain), task.box(names)
    points, costs = rough(plant, task.cost, box, starts, ITERATIONS)
    nearest = points[different(costs, FINISHED)]
    ends, reached = rough(plant, task.cost, box, nearest, ITERATIONS)
    if not chain.damped and isinstance(plant, Plant):
        across, there = _across_lines(plant, task.cost, box, nearest)
        ends, reached = np.concatenate([ends, across]), np.append(reached, there)
    p, j = fine(plant, task.cost, box, ends[int(np.argmin(reached))])
    p, j = _refit_contained(chain, task, estimates, p, j)
    return Estimate(
        chain,
        dict(zip(names, map(float, p), strict=True)),
        j,
        tuple(sorted(map(float, costs))),
        tuple(tuple(map(float, points[i])) for i in different(costs, VALLEYS)),
    )


def _across_lines(plant: Plant, cost: AnyCost, box: Box, points: Real) -> tuple[Real, Real]:
    """Points and costs reached from these where no damper is fitted.

    An undamped resonance cannot move across a line: on it the amplitude has no bounds, and the
    phase to either side is constant, so that no slope shows the right side. Right of the imaginary
    axis, at s = (j + share) omega, both are smooth. The search comes nearer to the axis step by
    step and ends on it.
    """
    for share in SMOOTH:
        points, _ = rough(replace(plant, aside=share), cost, box, points, SHORT)
    return rough(plant, cost, box, points, SHORT)


def _refit_contained(
    chain: Chain, task: Task, estimates: Mapping[Chain, Estimate], p: Real, j: float
) -> tuple[Real, float]:
    """Parameters and cost that are no worse than those of a candidate which this one contains."""
    lower = [e for e in estimates.values() if e.j * (1 + NESTED) < j]
    inner = [e for e in lower if contains(chain, e.chain) and task.cost.on(e.chain) is task.cost]
    for contained in sorted(inner, key=lambda e: e.j)[:1]:
        starts = embedded(chain, contained, task)
        if len(starts):
            plant, box = task.plant(chain), task.box(task.names(chain))
            nearest = starts[int(np.argmin(task.cost.total(plant.response(starts))))]
            p, j = min((p, j), fine(plant, task.cost, box, nearest), key=lambda parts: parts[1])
    return p, j


def embedded(chain: Chain, contained: Estimate, task: Task) -> Real:
    """Points of a chain, shape (n, n_p), at which it almost is a candidate that it contains with
    the parameters of its estimate, inside the bounds of the task; n = 0 where it contains none.
    """
    names, size = task.names(chain), scale(task.cost.measured)
    near = embeddings(chain, contained.chain, _common(contained), size)
    starts = _stack_starts([_own(contained) | dict(start) for start in near], chain, task)
    return task.box(names).clipped(starts) if len(starts) else starts


def _stack_starts(starts: Sequence[Parameters], chain: Chain, task: Task) -> Real:
    """Starts as an array; a dead time of a single response is that of all where a start has
    none.
    """
    own = task.names(chain)[len(chain.parameters) :]
    whole = [dict.fromkeys(own, start["Td"]) | dict(start) for start in starts] if own else starts
    return stack(whole, task.names(chain))


def _common(the_estimate: Estimate) -> Parameters:
    """The parameters of the chain alone."""
    return {name: the_estimate.parameters[name] for name in the_estimate.chain.parameters}


def _own(the_estimate: Estimate) -> dict[str, float]:
    """Dead times of single responses."""
    chain = the_estimate.chain.parameters
    return {name: value for name, value in the_estimate.parameters.items() if name not in chain}


def different(costs: Real, most: int) -> list[int]:
    """The best starts, at most so many, one of each valley as far as costs show."""
    chosen = list[int]()
    for i in np.argsort(costs, kind="stable"):
        if len(chosen) < most and all(costs[i] > costs[k] * (1 + REACHED) for k in chosen):
            chosen.append(int(i))
    return chosen


def _starts(chain: Chain, task: Task, estimates: Mapping[Chain, Estimate]) -> Iterator[Parameters]:
    """All starts of one candidate."""
    size = scale(task.cost.measured)
    found = list(from_extrema(chain, task.cost.measured))
    found += at_modes(chain, task.cost.measured, task.sign)
    yield from found
    for joint, fewer in merge(chain):
        if fewer in estimates:
            yield from split(chain, joint, _common(estimates[fewer]), size)
    for fewer, joint in {fewer: joint for joint, fewer in merge(chain)}.items():
        if fewer in estimates:
            response = Plant(fewer.structure, task.cost.measured.omega, task.sign).response(
                np.array(list(_common(estimates[fewer]).values()))
            )
            missed = conspicuous(task.cost.measured, response)
            yield from split_starts(chain, joint, _common(estimates[fewer]), size, missed)
    for fewer in shorten(chain):
        if fewer in estimates:
            yield from extend(chain, _common(estimates[fewer]), size)
    yield from random(chain, size, task.seed, FEW if found else MANY)
