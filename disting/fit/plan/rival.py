"""How well a rival structure can do what a model does: its best fit to the model's own response,
without noise, and the test by which data of the model exclude it.

Lines scatter by rho in ln |G| and in arg G. With G_A of the model at its values and G_B of the
rival the cost of the fit is

    lambda = min over the rival's parameters of sum_k |G_B/G_A - 1|_k^2 / rho_k^2,

the noncentrality of the test below if the model is true. Distances are those in the complex plane,
in which `fit` tests (`whitened`): of a noise that is not small logarithms tell another power. The
search is that of a fit to measured data, which begins from the model's values too where the rival
has the same masses and springs; what it finds is never below the smallest one, so lambda is at most
what is said. The model itself is fitted beside its rival: a search that does not find back the
values from which the response was computed has missed the rival's best values perhaps too.

The test is that of `exclusion`: both structures are fitted to the data, and T is what the step from
the rival's response to the model's, less what the rival's parameters make up for, explains of the
rival's residuals. If the rival is true T is distributed as chi2 of as many degrees as the model has
parameters beyond the rival, if the model is, as noncentral chi2 with lambda.
"""

from collections.abc import Mapping
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np

from disting.errors import InputError
from disting.fit.judge.exclusion import Fitted, basis_of, statistic
from disting.fit.noise.covariance import Noise
from disting.fit.results.export import predicted
from disting.fit.search.candidates import reference
from disting.fit.search.cost import Case, Cost
from disting.fit.search.descent import fine
from disting.fit.search.estimate import Estimate, Task
from disting.fit.search.exchange import estimates
from disting.fit.search.neighbours import carried
from disting.fit.search.starts import natural, scale, stacked
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Real
from disting.model.chain import Chain
from disting.model.presentation import summary
from disting.store import Store
from disting.verdict.engine import Progress, silent

ROUNDING = 1e-6  # relative deviation a line below which two responses are the same
FEWEST = 3  # starts that reach the best fit, for it to be trusted
WITHOUT_EFFECT = 1e-5  # of the largest sensitivity
EXTREME = 1e4  # times its natural size, or of it: where an element has gone to a limit
QUIETEST, LOUDEST = 1e-9, 10.0  # noise of a line
WIDEST = 1e5  # ratio of the highest to the lowest frequency


class Trust(StrEnum):
    """How far the rival's best fit may be taken for the best one that there is."""

    AGREED = "agreed"
    DOUBTFUL = "doubtful"


class Limit(StrEnum):
    """Where an element without effect has gone; ANY: it may have any value, as a neighbour has gone
    to a limit.
    """

    ZERO = "zero"
    INFINITY = "infinity"
    ANY = "any"


@dataclass(frozen=True, eq=False)
class Rival:
    """The best fit of `estimate.chain` to the response of `model` at `values`; `rho`, shape
    (n_f,), of its lines; `recovered`: the search finds back the model's own response; `known` =
    fits of smaller structures, from which further searches begin.
    """

    model: Chain
    values: dict[str, float]
    rho: Real
    estimate: Estimate
    recovered: bool
    task: Task = field(repr=False)
    known: Mapping[Chain, Estimate] = field(repr=False)

    def __repr__(self) -> str:
        return summary(
            self, f"{reference(self.chain)}, lambda {self.noncentrality:.4g}, {self.trust}"
        )

    @property
    def chain(self) -> Chain:
        """The rival's structure."""
        return self.estimate.chain

    @property
    def noncentrality(self) -> float:
        """lambda."""
        return self.estimate.j

    @property
    def p(self) -> Real:
        """The rival's parameters as an array, shape (n_p,)."""
        return np.array([self.estimate.parameters[n] for n in self.chain.parameters])

    @property
    def hertz(self) -> Real:
        """Frequencies of the lines, shape (n_f,)."""
        return self.task.cost.measured.frequency

    @property
    def apart(self) -> Real:
        """|G_B/G_A - 1| of every line, shape (n_f,)."""
        return apart(self, self.p)

    @property
    def is_same(self) -> bool:
        """Whether the rival does what the model does, but for rounding."""
        return bool(np.sqrt(np.mean(self.apart**2)) < ROUNDING)

    @property
    def reached(self) -> int:
        """Number of starts that reached the best fit."""
        return round(self.estimate.hit_rate * len(self.estimate.costs))

    @property
    def trust(self) -> Trust:
        """Agreed where several starts reached the best fit and the model's own values were found
        back.
        """
        agreed = self.recovered and (self.reached >= FEWEST or self.is_same)
        return Trust.AGREED if agreed else Trust.DOUBTFUL

    @property
    def limits(self) -> dict[str, Limit]:
        """The rival's elements that have no effect, and what they have become."""
        columns = np.linalg.norm(self.task.cost.of(self.task.plant(self.chain), self.p)[1], axis=0)
        gone = columns < WITHOUT_EFFECT * columns.max(initial=0.0)
        usual = natural(self.chain, scale(self.task.cost.measured))
        found = self.estimate.parameters
        return {
            name: _limit(found[name] / usual[name])
            for name, limit in zip(self.chain.parameters, gone, strict=True)
            if limit
        }


def _limit(share: float) -> Limit:
    """From the share of its natural size that an element has."""
    if share < 1 / EXTREME:
        return Limit.ZERO
    return Limit.INFINITY if share > EXTREME else Limit.ANY


def apart(rival: Rival, p: Real) -> Real:
    """|G_B/G_A - 1| of every line, shape (n_f,), for parameters `p`, shape (n_p,), of the rival."""
    response = rival.task.plant(rival.chain).response(p)
    return np.asarray(np.abs(response / rival.task.cost.measured.G - 1))


def fitted_rival(
    model: Chain,
    values: dict[str, float],
    rival: Chain,
    omega: Real,
    rho: Real,
    *,
    seed: str = "disting",
    store: Store | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Rival:
    """The rival's best fit at angular frequencies [rad/s] with the scatter `rho`, shape (n_f,)
    each. Raises InputError for a scatter that is not positive, and where both are one structure.
    """
    rival = replace(rival, sensor=model.sensor)
    if rival == model:
        raise InputError("a structure is no rival of itself: name another one")
    _check(omega, rho)
    measured = FrequencyResponse(omega, predicted(model, values, omega), sensor=model.sensor)
    cost = Cost(measured, Case.COMPLEX, lines=1.0 / (rho * np.abs(measured.G)))
    task = Task(cost, seed=seed)
    found = estimates([model, rival], task, store=store, executor=executor, progress=progress)
    own = found[model].j * float(np.mean(rho**2)) / len(omega)
    best = _from_values(found[rival], values, task)
    return Rival(model, values, rho, best, own < ROUNDING**2, task, found)


def _from_values(found: Estimate, values: dict[str, float], task: Task) -> Estimate:
    """The estimate, or a better one to which the model's own values lead, where the rival has
    elements of the same names.
    """
    chain = found.chain
    masses_and_springs = [
        {n for n in names if n[0] in "mk"} for names in (values, chain.parameters)
    ]
    if masses_and_springs[0] != masses_and_springs[1]:
        return found
    plant, box = task.plant(chain), task.box(chain.parameters)
    starts = stacked(list(carried(chain, values, scale(task.cost.measured))), chain.parameters)
    ends = [fine(plant, task.cost, box, start) for start in starts]
    p, j = min(ends, key=lambda end: end[1])
    tried = tuple(sorted([*found.costs, *(end[1] for end in ends)]))
    if j >= found.j:
        return replace(found, costs=tried)
    return Estimate(chain, dict(zip(chain.parameters, map(float, p), strict=True)), j, tried)


def _check(omega: Real, rho: Real) -> None:
    if not (np.all(rho >= QUIETEST) and np.all(rho <= LOUDEST)):
        raise InputError(
            f"the noise of a line lies between {QUIETEST:g} and {LOUDEST:g}, such as 0.02 for 2 %"
        )
    if omega.max() > WIDEST * omega.min():
        raise InputError(f"the highest frequency is at most {WIDEST:g} times the lowest one")


def gain(rival: Rival, measured: FrequencyResponse) -> float:
    """T of the module for a measured response at the rival's lines: both structures are fitted
    from where they lie closest without noise. Raises InputError for other lines.
    """
    known = rival.task.cost
    if not isinstance(known, Cost):
        raise InputError("the test is of one response")
    if not np.array_equal(measured.omega, known.measured.omega):
        raise InputError("the test needs a response at the planned lines")
    task = replace(rival.task, cost=replace(known, measured=measured))
    own = np.array([rival.values[n] for n in rival.model.parameters])
    starts = (rival.chain, rival.p), (rival.model, own)
    return statistic(*(_fitted(chain, task, start) for chain, start in starts))


def _fitted(chain: Chain, task: Task, start: Real) -> Fitted:
    plant = task.plant(chain)
    p, _ = fine(plant, task.cost, task.box(chain.parameters), start)
    residual, columns = task.cost.of(plant, p)
    return Fitted(chain, residual, basis_of(columns), Noise(np.ones(len(residual))))
