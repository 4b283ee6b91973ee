"""Particle swarm optimisation as in section 3.1 of the paper, for comparison: 200 particles a
parameter.

The swarm moves in logarithms of the parameters, over a box around natural sizes; it stops where
the best cost has not improved by 1e-6 for 20 generations, or after 200 generations a parameter.
Needs pymoo: pip install "disting[swarm]".
"""

from collections.abc import Callable, Mapping
from hashlib import blake2b
from math import log
from typing import Any

import numpy as np

from disting.errors import InputError
from disting.fit.search.descent import BATCH
from disting.fit.search.estimate import Estimate, Task
from disting.fit.search.starts import natural, scale
from disting.measurement.arrays import Real
from disting.model.chain import Chain

PARTICLES = 200  # a parameter
GENERATIONS = 200  # a parameter, at most
STALLED = 20  # generations without gain
GAIN = 1e-6
DECADES = 3.0  # of the box, to either side of natural sizes


def search_box(chain: Chain, task: Task) -> tuple[Real, Real]:
    """Lower and upper logarithms, shape (n_p,): the user's bounds, or decades around natural
    sizes.
    """
    sizes = natural(chain, scale(task.cost.measured))
    box = task.box(chain.parameters)
    middle = np.log([sizes[name] for name in chain.parameters])
    with np.errstate(divide="ignore"):
        low, high = np.log(box.low), np.log(box.high)
    wide = DECADES * log(10)
    return np.where(np.isfinite(low), low, middle - wide), np.where(
        np.isfinite(high), high, middle + wide
    )


def by_swarm(chain: Chain, task: Task, estimates: Mapping[Chain, Estimate]) -> Estimate:
    """Best parameters that a particle swarm finds; `costs` are those of the last generation,
    other fits in `estimates` unused.
    """
    low, high = search_box(chain, task)
    plant = task.plant(chain)

    def costs(x: Real) -> Real:
        """Cost of a whole generation, shape (n, n_p) of logarithms, at once."""
        parts = np.array_split(x, len(x) // BATCH)
        return np.concatenate([task.cost.total(plant.response(np.exp(part))) for part in parts])

    algorithm = _run_swarm(costs, low, high, _seed(task))
    best = np.exp(np.asarray(algorithm.opt[0].X, dtype=float))
    return Estimate(
        chain,
        dict(zip(chain.parameters, map(float, best), strict=True)),
        float(algorithm.opt[0].F[0]),
        tuple(sorted(float(c) for c in algorithm.pop.get("F")[:, 0])),
    )


def _run_swarm(costs: Callable[[Real], Real], low: Real, high: Real, seed: int) -> Any:
    """pymoo's swarm over a box, moved until it converges; raises InputError without pymoo."""
    try:
        from pymoo.algorithms.soo.nonconvex.pso import PSO
        from pymoo.core.problem import Problem
        from pymoo.termination.ftol import SingleObjectiveSpaceTermination
        from pymoo.termination.max_gen import MaximumGenerationTermination
        from pymoo.termination.robust import RobustTermination
    except ImportError:
        raise InputError('the particle swarm needs pymoo: pip install "disting[swarm]"') from None

    class Fit(Problem):  # type: ignore[misc]
        """The costs in the interface of pymoo."""

        def _evaluate(self, x: Real, out: dict[str, Any], *_: object, **__: object) -> None:
            out["F"] = costs(x)

    n_p = len(low)
    stalled = RobustTermination(
        SingleObjectiveSpaceTermination(tol=GAIN, only_feas=False), period=STALLED
    )
    algorithm = PSO(pop_size=PARTICLES * n_p)
    problem = Fit(n_var=n_p, n_obj=1, xl=low, xu=high)
    algorithm.setup(problem, termination=MaximumGenerationTermination(GENERATIONS * n_p), seed=seed)
    while algorithm.has_next():
        algorithm.next()
        stalled.update(algorithm)
        if stalled.has_terminated():
            break
    return algorithm


def _seed(task: Task) -> int:
    return int.from_bytes(blake2b(task.seed.encode(), digest_size=4).digest())
