"""Test of whether a held input explains the actuator of a fitted structure.

A digital drive holds its input from sample to sample, which is half a sample of delay and a little
gain (`measurement.observation`). A fit that does not know it answers with a lag or a dead time of
about half a sampling time T, or of 3 T/2 where the drive also computes for one sample. The record
gives T but not whether the input was held, so the structure is fitted both ways, with

    Q = |e|^2, residuals in units of the scatter of the lines,

as it is and behind a hold, there with no actuator, with a dead time, and with its own. Behind the
hold the structure is as good where its Q is higher by at most the quantile of F at the level of the
test of exclusion, and better where the Q of the other is higher by more than that.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from disting.fit.judge.exclusion import limit
from disting.fit.judge.mechanics import mechanics
from disting.fit.search.cost import Cost
from disting.fit.search.data import WhitenedCost
from disting.fit.search.descent import fine
from disting.fit.search.estimate import Estimate, Task
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain
from disting.statistics.scatter import Scatter, scatter


@dataclass(frozen=True, slots=True)
class Held:
    """A structure behind the hold: sampling time `period` [s], the chain with what its actuator
    adds then, its Q and that of the structure as it was fitted, and the limit of their difference.
    """

    period: float
    chain: Chain
    dead_time: float
    held: float
    bare: float
    limit: float

    @property
    def is_better(self) -> bool:
        """True if the data exclude the structure without the hold."""
        return self.bare - self.held > self.limit


def held(estimate: Estimate, task: Task) -> Held | None:
    """Return the simplest actuator behind a hold that explains the data as well as that of an
    estimate does without one; None where none does, where the structure has no actuator, the input
    is known to be held, or the data is no record in time.
    """
    cost, chain = task.cost, estimate.chain
    if not (chain.lag or chain.dead_time) or not isinstance(cost, Cost):
        return None
    data, method = cost.measured, cost.measured.method
    if method is None or data.hold is not None or data.frequency[-1] >= method.rate / 2:
        return None
    period = 1 / method.rate
    known = scatter(data, [_response(estimate, task)])
    bare = _fit_near(estimate.parameters, chain, task, known)[1]
    behind = replace(task, cost=replace(cost, measured=data.held(period, method.order)))
    start = {"Td": period, "T1": period, **estimate.parameters}
    most = limit(1, known.freedom)
    for other in _actuators(chain):
        p, q = _fit_near(start, other, behind, known)
        if q - bare <= most:
            dead_time = dict(zip(other.parameters, p, strict=True)).get("Td", 0.0)
            return Held(period, other, float(dead_time), q, bare, most)
    return None


def _actuators(chain: Chain) -> list[Chain]:
    """With no actuator, with a dead time, and with that of the chain."""
    plain = mechanics(chain)
    return list(dict.fromkeys([plain, replace(plain, dead_time=True), chain]))


def _response(estimate: Estimate, task: Task) -> Complex:
    names = task.names(estimate.chain)
    p = np.array([estimate.parameters[n] for n in names])
    return task.plant(estimate.chain).response(p)


def _fit_near(
    start: Mapping[str, float], chain: Chain, task: Task, known: Scatter
) -> tuple[Real, float]:
    """Parameters and Q of a chain near a start."""
    names = task.names(chain)
    p = np.array([start[n] for n in names])
    return fine(task.plant(chain), WhitenedCost(task.cost, known), task.box(names), p)
