"""How a plan finds the best fit of a rival: of a chain as a fit does, with the smaller ones that
lead to it; of a network from random starts and from the model's own values.
"""

from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass, replace

import numpy as np

from disting.errors import InputError
from disting.fit.networks import SEED, STARTS, BestFit, search_from
from disting.fit.search.containment import AnyStructure as AnyStructure, name_of as name_of
from disting.fit.search.descent import Box, fine
from disting.fit.search.estimate import Estimate, Task, estimate
from disting.fit.search.exchange import estimates
from disting.fit.search.joint import AnyCost
from disting.fit.search.neighbours import carry_over
from disting.fit.search.network_plant import (
    AnyNetworkPlant,
    network_plant,
    random_starts,
)
from disting.fit.search.plant import Plant
from disting.fit.search.starts import Scale, natural, scale, stack
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain, Sensor
from disting.network.network import Network
from disting.simulation.mechanics import check_values
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
    """What it shows; of circuits and compartments what stands for a position."""
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
    InputError for a chain beside a network.
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
