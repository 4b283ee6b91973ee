"""Ability of a rival structure to reproduce a model: its best fit to the model's own response,
without noise, and the test by which data of the model exclude it.

Lines scatter by rho in ln |G| and in arg G. With G_A of the model at its values and G_B of the
rival the cost of the fit is

    lambda = min over the rival's parameters of sum_k |G_B/G_A - 1|_k^2 / rho_k^2,

the noncentrality of the test below if the model is true. Distances are those in the complex plane,
in which `fit` tests (`WhitenedCost`): of a noise that is not small logarithms give a different
power. The search is that of a fit to measured data, which begins from the model's values too where
the rival has the same masses and springs; what it finds is never below the smallest one, so lambda
is at most the reported value. The model itself is fitted together with its rival: a search that
does not find back the values from which the response was computed has missed the rival's best
values perhaps too.

The test is that of `exclusion`: both structures are fitted to the data, and T is the part of the
rival's residuals that the difference of the two responses explains, after removing what other
parameters of the rival could also produce. If the rival is true T is distributed as chi2 of as
many degrees of freedom as the model has parameters beyond the rival, if the model is, as noncentral
chi2 with lambda.

How a plan finds the best fit of a rival: of a chain as a fit does, with the smaller ones that
lead to it; of a network from random starts and from the model's own values.
"""

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np

from disting.errors import InputError
from disting.fit.judge.exclusion import basis_of, statistic
from disting.fit.networks import SEED, STARTS, BestFit, search_from
from disting.fit.search.containment import AnyStructure as AnyStructure, name_of as name_of
from disting.fit.search.cost import Case, Cost
from disting.fit.search.descent import Box, fine
from disting.fit.search.estimate import Estimate, Task, estimate
from disting.fit.search.exchange import estimates
from disting.fit.search.joint import AnyCost, JointCost
from disting.fit.search.neighbours import carry_over
from disting.fit.search.network_plant import (
    AnyNetworkPlant,
    network_plant,
    random_starts,
)
from disting.fit.search.plant import Plant
from disting.fit.search.setup import Setup
from disting.fit.search.starts import Scale, natural, scale, stack
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain, Sensor
from disting.model.presentation import summary
from disting.network.network import Network
from disting.simulation.mechanics import check_values
from disting.statistics.covariance import Noise
from disting.store import Store
from disting.verdict.engine import Progress, silent

AnyPlant = Plant | AnyNetworkPlant


@dataclass(frozen=True, slots=True, eq=False)
class Search:
    """Both `plants`, of the model and of the rival, on the lines; the rival's `best` fit, and that
    to lines of other weights (`again`); the cost of the model's `own` one; natural sizes of the
    rival's parameters (`usual`).
    """

    plants: tuple[AnyPlant, AnyPlant]
    best: BestFit
    again: Callable[[AnyCost], BestFit]
    own: float
    usual: Mapping[str, float]


def sensor_of(structure: AnyStructure) -> Sensor:
    """Quantity of its sensor; for circuits and compartments the quantity in place of a position."""
    return list(Sensor)[structure.order]


def shown_as(structure: AnyStructure, sensor: Sensor) -> AnyStructure:
    """The structure with a sensor of this quantity; circuits and compartments have one only."""
    if isinstance(structure, Chain):
        return replace(structure, sensor=sensor)
    return replace(structure, order=sensor.order)


def plant_of(structure: AnyStructure, omega: Real) -> AnyPlant:
    """A structure at angular frequencies [rad/s]: of a network with several inputs or outputs all
    its responses, one behind the other, row by row.
    """
    if isinstance(structure, Chain):
        return Plant(structure.structure, omega)
    outputs, inputs = structure.shape
    return network_plant(structure, (omega,) * (outputs * inputs))


def responses_of(
    structure: AnyStructure, values: Mapping[str, float], omega: Real
) -> tuple[Complex, ...]:
    """G(j omega), shape (n_f,) each, between each output and each input of a structure at its
    values; raises InputError for missing, unknown or negative ones, and where one is zero.
    """
    plant = plant_of(structure, omega)
    numbers = check_values(structure, values)
    whole = plant.response(np.array([numbers[name] for name in plant.parameters]))
    if not np.all(whole):
        raise InputError(
            f"{name_of(structure)}: a sensor shows nothing of an input: leave one of both away"
        )
    return tuple(whole.reshape(-1, len(omega)))


def search(
    model: AnyStructure,
    values: Mapping[str, float],
    rival: AnyStructure,
    cost: AnyCost,
    *,
    store: Store | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Search:
    """The best fit of a rival to the response of a model, and of the model itself. Raises
    InputError for a chain together with a network.
    """
    if isinstance(model, Chain) and isinstance(rival, Chain):
        task = Task(cost)
        own_estimates = estimates(
            [model, rival], task, store=store, executor=executor, progress=progress
        )
        return _of_chains(model, values, rival, cost, task, own_estimates)
    if isinstance(model, Network) and isinstance(rival, Network):
        return _of_networks(model, values, rival, cost)
    raise InputError("plan two chains, or two networks: write the chain as a network too")


def _of_chains(
    model: Chain,
    values: Mapping[str, float],
    rival: Chain,
    cost: AnyCost,
    task: Task,
    own_estimates: Mapping[Chain, Estimate],
) -> Search:
    def again(other: AnyCost) -> BestFit:
        return _best(estimate(rival, replace(task, cost=other), own_estimates))

    omega, size = cost.measured.omega, scale(cost.measured)
    plants = plant_of(model, omega), plant_of(rival, omega)
    starts = _from_values(rival, values, size)
    best = _better(_best(own_estimates[rival]), plants[1], cost, starts)
    return Search(plants, best, again, own_estimates[model].j, natural(rival, size))


def _best(the_estimate: Estimate) -> BestFit:
    p = np.array([the_estimate.parameters[name] for name in the_estimate.chain.parameters])
    return BestFit(p, the_estimate.j, the_estimate.costs)


def _from_values(rival: Chain, values: Mapping[str, float], size: Scale) -> Real:
    """Starts from the model's own values, where the rival has the same masses and springs, shape
    (n_s, n_p).
    """
    names = rival.parameters
    first, second = ({n for n in some if n[0] in "mk"} for some in (values, names))
    if first != second:
        return np.empty((0, len(names)))
    return stack(list(carry_over(rival, dict(values), size)), names)


def _of_networks(
    model: Network, values: Mapping[str, float], rival: Network, cost: AnyCost
) -> Search:
    def again(other: AnyCost) -> BestFit:
        return _better(search_from(rival_plant, other, starts), rival_plant, other, own)

    measured = cost.measured
    n = len(cost.parts)
    model_plant, rival_plant = (
        network_plant(network, (measured.omega,) * n) for network in (model, rival)
    )
    starts, others = (
        random_starts(plant, measured, STARTS, np.random.default_rng((SEED, i)))
        for i, plant in ((1, rival_plant), (0, model_plant))
    )
    usual = dict(zip(rival_plant.parameters, np.exp(np.log(starts).mean(axis=0)), strict=True))
    own = np.array([[values.get(name, size) for name, size in usual.items()]])
    return Search(
        (model_plant, rival_plant),
        again(cost),
        again,
        search_from(model_plant, cost, others).j,
        usual,
    )


def _better(best_fit: BestFit, plant: AnyPlant, cost: AnyCost, starts: Real) -> BestFit:
    """The best fit, or a better one to which further starts lead."""
    box = box_of(plant)
    with np.errstate(all="ignore"):  # far from the data responses may overflow
        ends = [fine(plant, cost, box, start) for start in starts]
    p, j = min([(best_fit.p, best_fit.j), *ends], key=lambda end: end[1])
    return BestFit(p, j, tuple(sorted([*best_fit.costs, *(end[1] for end in ends)])))


def box_of(plant: AnyPlant) -> Box:
    """No bounds, but of exponents."""
    size = len(plant.parameters)
    return Box(np.zeros(size), np.full(size, np.inf) if isinstance(plant, Plant) else plant.highest)


ROUNDING = 1e-6  # relative deviation a line below which two responses are the same
FEWEST = 3  # starts that reach the best fit, for it to be trusted
WITHOUT_EFFECT = 1e-5  # of the largest sensitivity
EXTREME = 1e4  # times its natural size, or of it: where an element has gone to a limit
QUIETEST, LOUDEST = 1e-9, 10.0  # noise of a line
WIDEST = 1e5  # ratio of the highest to the lowest frequency


class Trust(StrEnum):
    """Confidence that the rival's best fit is the global optimum."""

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
    """The best fit of `structure` to the response of `model` at `values`; `rho`, shape (n_f,), of
    its lines; `recovered`: the search finds back the model's own response; `cost` of that response.
    """

    model: AnyStructure
    values: Mapping[str, float]
    rho: Real
    structure: AnyStructure
    best: BestFit
    recovered: bool
    cost: AnyCost = field(repr=False)
    search: Search = field(repr=False)

    def __repr__(self) -> str:
        return summary(
            self, f"{name_of(self.structure)}, lambda {self.noncentrality:.4g}, {self.trust}"
        )

    @property
    def plant(self) -> AnyPlant:
        """The rival on the lines."""
        return self.search.plants[1]

    @property
    def noncentrality(self) -> float:
        """lambda."""
        return self.best.j

    @property
    def parameters(self) -> dict[str, float]:
        """The rival's, by name."""
        return dict(zip(self.plant.parameters, map(float, self.best.p), strict=True))

    @property
    def hertz(self) -> Real:
        """Frequencies of the lines, shape (n_f,)."""
        return self.cost.measured.frequency

    @property
    def apart(self) -> Real:
        """|G_B/G_A - 1| of every line, shape (n_f,); of several responses the root of the sum of
        squares.
        """
        return relative_distance(self, self.best.p)

    @property
    def is_same(self) -> bool:
        """True if the rival reproduces the model up to rounding."""
        return bool(np.sqrt(np.mean(self.apart**2)) < ROUNDING)

    @property
    def trust(self) -> Trust:
        """Agreed where several starts reached the best fit and the model's own values were found
        back.
        """
        agreed = self.recovered and (self.best.reached >= FEWEST or self.is_same)
        return Trust.AGREED if agreed else Trust.DOUBTFUL

    @property
    def limits(self) -> dict[str, Limit]:
        """The rival's elements that have no effect, and what they have become."""
        columns = np.linalg.norm(self.cost.of(self.plant, self.best.p)[1], axis=0)
        gone = columns < WITHOUT_EFFECT * columns.max(initial=0.0)
        values = self.parameters
        return {
            name: _limit(values[name] / self.search.usual[name])
            for name, limit in zip(values, gone, strict=True)
            if limit
        }


def _limit(share: float) -> Limit:
    """From the share of its natural size that an element has."""
    if share < 1 / EXTREME:
        return Limit.ZERO
    return Limit.INFINITY if share > EXTREME else Limit.ANY


def relative_distance(rival: Rival, p: Real) -> Real:
    """|G_B/G_A - 1| of every line, shape (n_f,), for parameters `p`, shape (n_p,), of the rival; of
    several responses the root of the sum of squares.
    """
    whole = np.concatenate([part.measured.G for part in rival.cost.parts])
    each = np.abs(rival.plant.response(p) / whole - 1)
    return np.asarray(np.linalg.norm(each.reshape(-1, len(rival.rho)), axis=0))


def fitted_rival(
    model: AnyStructure,
    values: Mapping[str, float],
    rival: AnyStructure,
    omega: Real,
    rho: Real,
    *,
    store: Store | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Rival:
    """The rival's best fit at angular frequencies [rad/s] with the scatter `rho`, shape (n_f,)
    each. Raises InputError for a scatter that is not positive, and where both are one structure.
    """
    sensor = sensor_of(model)
    rival = shown_as(rival, sensor)
    if rival == model:
        raise InputError("a structure is no rival of itself: name another one")
    _check(omega, rho)
    _check_ports(model, rival)
    responses = responses_of(model, values, omega)
    cost = _cost([FrequencyResponse(omega, g, sensor=sensor) for g in responses], 1.0 / rho)
    the_search = search(
        model, values, rival, cost, store=store, executor=executor, progress=progress
    )
    own = the_search.own * float(np.mean(rho**2)) / len(omega)
    return Rival(model, values, rho, rival, the_search.best, own < ROUNDING**2, cost, the_search)


def _check_ports(model: AnyStructure, rival: AnyStructure) -> None:
    """Raises InputError for networks with other numbers of inputs and outputs."""
    shapes = [n.shape for n in (model, rival) if isinstance(n, Network)]
    if len(set(shapes)) > 1:
        (a, b), (c, d) = shapes
        raise InputError(
            f"{name_of(model)} has {a} x {b} outputs and inputs, {name_of(rival)} {c} x {d}: name"
            " two with as many"
        )


def _cost(responses: Sequence[FrequencyResponse], weights: Real) -> AnyCost:
    """That of relative distances with weights of the lines, shape (n_f,)."""
    parts = tuple(
        Cost(response, Case.COMPLEX, lines=weights / np.abs(response.G)) for response in responses
    )
    return parts[0] if len(parts) == 1 else JointCost(parts, (Setup(),) * len(parts))


def reweight(rival: Rival, weights: Real) -> AnyCost:
    """The rival's cost with further weights of its lines, shape (n_f,)."""
    return _cost([part.measured for part in rival.cost.parts], weights / rival.rho)


def _check(omega: Real, rho: Real) -> None:
    if not (np.all(rho >= QUIETEST) and np.all(rho <= LOUDEST)):
        raise InputError(
            f"the noise of a line lies between {QUIETEST:g} and {LOUDEST:g}, such as 0.02 for 2 %"
        )
    if omega.max() > WIDEST * omega.min():
        raise InputError(f"the highest frequency is at most {WIDEST:g} times the lowest one")


def gain(rival: Rival, *measured: FrequencyResponse) -> float:
    """T of the module for measured responses at the rival's lines, one for each response of the
    model: both structures are fitted from where they lie closest without noise. Raises InputError
    for other lines.
    """
    parts = rival.cost.parts
    planned = [part.measured.omega for part in parts]
    same = map(np.array_equal, (plant.omega for plant in measured), planned)
    if len(measured) != len(parts) or not all(same):
        raise InputError("the test needs a response at the planned lines")
    measured_by_plan = tuple(
        replace(part, measured=m) for part, m in zip(parts, measured, strict=True)
    )
    cost = (
        measured_by_plan[0]
        if isinstance(rival.cost, Cost)
        else replace(rival.cost, parts=measured_by_plan)
    )
    plant, other = rival.search.plants
    own = np.array([rival.values[name] for name in plant.parameters])
    return statistic(_fit_rest(other, cost, rival.best.p), _fit_rest(plant, cost, own))


@dataclass(frozen=True, slots=True, eq=False)
class _Left:
    """Remaining structures of a fit."""

    residual: Real
    basis: Real
    noise: Noise


def _fit_rest(plant: AnyPlant, cost: AnyCost, start: Real) -> _Left:
    p, _ = fine(plant, cost, box_of(plant), start)
    residual, columns = cost.of(plant, p)
    return _Left(residual, basis_of(columns), Noise(np.ones(len(residual))))
