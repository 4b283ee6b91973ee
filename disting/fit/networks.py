"""Networks fitted to a measured response: which of them explain it, which the data do not exclude.

Networks that give the same responses for all positive values are fitted once (their verdict is
theirs, not the data's). One that contains another one (`fit.search.containment`) never fits worse,
explains what that explains, and is left where that is left.

Each is searched from random starts in logarithms of its values, then brought to the last digit in
units of what the lines scatter (`whitened`); the test by which one network excludes another one,
and the question whether any explains the data, are those of chains.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import permutations
from math import isfinite

import numpy as np

from disting.errors import InputError
from disting.evidence.limits import Minor
from disting.fit.judge.exclusion import CLEARLY, basis_of, limit, statistic
from disting.fit.judge.explanation import Level, explain, merge, needed_lines, noises, scatters
from disting.fit.judge.network_intervals import (
    NetworkTwin,
    deviations,
    network_intervals,
    twin_at,
    without_noise,
)
from disting.fit.results.networks import FittedNetwork, NetworkSelection
from disting.fit.search.containment import limit_of
from disting.fit.search.cost import Case, Cost, comparable
from disting.fit.search.data import WhitenedCost, check_range
from disting.fit.search.descent import Box, fine, rough
from disting.fit.search.estimate import NESTED, NOTHING, REACHED
from disting.fit.search.joint import AnyCost, JointCost
from disting.fit.search.machines import each_once, with_ground_damper
from disting.fit.search.network_plant import (
    AnyNetworkPlant,
    is_lossless,
    measured_as,
    network_plant,
    random_starts,
)
from disting.fit.search.setup import Setup
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Real
from disting.measurement.response import NO_MOTION
from disting.model.chain import Sort
from disting.network.network import Network
from disting.network.notation import network_of
from disting.renamed import renamed
from disting.statistics.covariance import expected_deviation
from disting.statistics.scatter import Scatter
from disting.verdict.decisions import Decisions
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.result import Query, Relation, View

STARTS, KEPT = 60, 6  # random starts of a network, and how many are searched on
ITERATIONS = 40
BREADTHS = (0.1, 0.03)  # of resonances, one after the other, before they are as sharp as they are
SEED = 20_240_601  # of the starts
AGAIN = 20  # starts of a second search, near the limit that is a smaller network
FAR = 1e8  # times a random start, for a value that vanishes or grows without bound there


@dataclass(frozen=True, slots=True, eq=False)
class BestFit:
    """The parameters found, shape (n_p,), their cost, and the costs to which all starts led, in
    rising order: few are searched to the end.
    """

    p: Real
    j: float
    costs: tuple[float, ...]

    @property
    def reached(self) -> int:
        """Number of starts that came within 0.1 % of the best cost."""
        return sum(cost <= self.j * (1 + REACHED) + NOTHING for cost in self.costs)


@renamed(networks="models")
def fit_networks(
    measured: FrequencyResponse | Sequence[FrequencyResponse],
    models: Sequence[Network | str],
    *,
    notation: str = "",
    ground_damper: bool = False,
    engine: Engine | None = None,
    progress: Progress = silent,
) -> NetworkSelection:
    """Fit networks to a measured response, or to several: those of the first sensor to all inputs,
    then those of the next one, as a `MatrixModel` has its rows. `measured.quantity` is that of
    the sensors of machines; circuits give an impedance.

    `models`: networks, or texts of them such as "R0-p(R1,C1)", in this `notation` where the text
    does not show it; `ground_damper`: each machine also with a damper from the mass with the force
    to the ground. Raises InputError.

    >>> import numpy as np
    >>> omega = np.logspace(0, 4, 60)
    >>> noisy = 1 + 1e-3 * np.random.default_rng(1).normal(size=(60, 2)) @ [1, 1j]
    >>> cell = FrequencyResponse(omega, (1 + 2 / (1 + 0.02j * omega)) * noisy, quantity="position")
    >>> fit_networks(cell, ["R1-C1", "R0-p(R1,C1)", "p(R0,R1-C1)"]).sentence[:69]
    'R0-p(R1,C1) is the simplest that explains the data, which cannot be d'
    """
    data = [measured] if isinstance(measured, FrequencyResponse) else list(measured)
    networks = [network_of(m, notation) if isinstance(m, str) else m for m in models]
    networks = each_once(with_ground_damper(networks)) if ground_damper else networks
    compared = _match_quantity(data, networks)
    engine = engine or Engine()
    subjects = engine.general_subjects(compared)
    decided = engine.decisions(subjects, Query(View.POSITIVE, inclusion=False))
    first = _first_of_same(decided, len(compared))
    cost, pairs = _cost(data), list[tuple[AnyNetworkPlant, Real]]()
    chosen = [i for i, k in enumerate(first) if i == k]
    for done, i in enumerate(chosen):
        progress("networks", done, len(chosen))
        plant = network_plant(compared[i], [response.omega for response in data])
        starts = random_starts(plant, data[0], STARTS, np.random.default_rng((SEED, i)))
        pairs.append((plant, search_from(plant, cost, starts).p))
    scatter = merge(scatters(cost, [plant.response(p) for plant, p in pairs]))
    fits = [
        replace(
            _refine(plant, p, cost, scatter, subjects[i].rank),
            same=tuple(compared[j].name for j, k in enumerate(first) if k == i != j),
        )
        for i, (plant, p) in zip(chosen, pairs, strict=True)
    ]
    classes = [[compared[j] for j, k in enumerate(first) if k == i] for i in chosen]
    limits = _limits(fits, classes)
    fits = _improve_to_contained(fits, limits, [plant for plant, _ in pairs], data, scatter)
    fits = _exclude_containing(
        [replace(f, excluded_by=_excluding(f, fits, scatter)) for f in fits], limits
    )
    ranks = {network: subject.rank for network, subject in zip(compared, subjects, strict=True)}
    whitened, plants = WhitenedCost(cost, scatter), [plant for plant, _ in pairs]
    fits = _add_intervals(fits, classes, ranks, plants, whitened, data, progress)
    ordered = tuple(sorted(fits, key=lambda f: comparable(f.chi2)))
    whole = NetworkSelection(ordered, tuple(compared), tuple(data), scatter, decided)
    order = sorted(whole.fits, key=lambda f: (f is not whole.selected, f not in whole.left))
    return replace(whole, fits=tuple(order))


def _match_quantity(
    data: Sequence[FrequencyResponse], networks: Sequence[Network]
) -> list[Network]:
    """The networks with sensors that show what was measured; raises InputError."""
    if not networks or not data:
        raise InputError("name at least one network to fit, and a measured response")
    if any(response.hold for response in data):
        raise InputError(
            "--hold is not supported for networks; remove it, and lines above a tenth of the"
            " sampling rate too (--band)"
        )
    for response in data:
        check_range(response)
        if response.is_impedance and any(n.sort is not Sort.CIRCUIT for n in networks):
            raise InputError(f"{response.origin or 'data'}: {NO_MOTION}")
    shown = [measured_as(network, data[0]) for network in networks]
    for network in shown:
        outputs, inputs = network.shape
        if network.shape != shown[0].shape:
            raise InputError(
                f"{network.name} has {outputs} x {inputs} outputs and inputs, {shown[0].name}"
                f" has {' x '.join(map(str, shown[0].shape))}: fit them separately"
            )
        if outputs * inputs != len(data):
            raise InputError(
                f"{network.name} has {outputs} x {inputs} outputs and inputs: give as many measured"
                f" responses, not {len(data)}"
            )
    if len({response.quantity for response in data}) > 1:
        raise InputError("all responses of a network must have the same quantity: convert them")
    return shown


def _cost(data: Sequence[FrequencyResponse]) -> AnyCost:
    costs = tuple(Cost(response, Case.LOGARITHM) for response in data)
    if len(costs) == 1:
        return costs[0]
    return JointCost(costs, tuple(Setup(sensor=str(k)) for k in range(1, len(costs) + 1)))


def _first_of_same(decided: Decisions, count: int) -> list[int]:
    """For each network the first one that gives the same responses for all positive values."""
    first = list(range(count))
    for i in range(count):
        for k in range(i):
            if first[k] == k and decided.relation(i, k) is Relation.INDISTINGUISHABLE:
                first[i] = k
                break
    return first


def search_from(plant: AnyNetworkPlant, cost: AnyCost, starts: Real) -> BestFit:
    """The best values found from starts, shape (n_s, n_p).

    Logarithms are used first, for every cost: far from the optimum distances in the complex plane
    depend on the peaks alone. A network without losses is searched with broad resonances first.
    """
    box, leading = Box(np.zeros(len(plant.parameters)), plant.highest), cost.leading
    breadths = BREADTHS if is_lossless(plant.network) else ()
    first, *others = *(replace(plant, breadth=h) for h in breadths), plant
    with np.errstate(all="ignore"):  # far from the data responses may overflow
        points, sizes = rough(first, leading, box, starts, ITERATIONS)
        costs, ends = cost.total(plant.response(points)), list[tuple[Real, float]]()
        for k in np.argsort(sizes)[:KEPT]:
            p = points[k]
            for other in others:
                p, _ = fine(other, leading, box, p)
            ends.append(fine(plant, cost, box, p))
            valley = np.isclose(sizes, sizes[k], rtol=REACHED, atol=NOTHING)
            costs[valley] = np.fmin(costs[valley], ends[-1][1])
        p, j = min(ends, key=lambda end: end[1])
    return BestFit(p, j, tuple(sorted(map(float, np.nan_to_num(costs, nan=np.inf)))))


def _refine(
    plant: AnyNetworkPlant, start: Real, cost: AnyCost, scatter: Scatter, rank: int
) -> FittedNetwork:
    """Refined to the last digit in units of the scatter, and compared with it."""
    whitened = WhitenedCost(cost, scatter)
    p, _ = fine(plant, whitened, Box(np.zeros(len(plant.parameters)), plant.highest), start)
    residual, columns = whitened.of(plant, p)
    ones = np.ones(len(residual))
    missed = expected_deviation(columns, ones)
    explained = explain(cost, residual, missed, scatter)
    explained = replace(explained, needed=needed_lines(len(plant.parameters)))
    level, own_noise = explained.chi2, noises(cost, residual, ones, missed)
    return FittedNetwork(
        network=plant.network,
        values=dict(zip(plant.parameters, map(float, p), strict=True)),
        relative=dict(zip(plant.parameters, deviations(columns, level, own_noise), strict=True)),
        rank=rank,
        chi2=level,
        residual=residual,
        basis=basis_of(columns),
        noise=own_noise,
        columns=columns,
        explains=explained.is_near,
        apart=explained.size_level is Level.APART,
        misses=explained.misses,
    )


def _add_intervals(
    fits: Sequence[FittedNetwork],
    classes: Sequence[Sequence[Network]],
    ranks: Mapping[Network, int],
    plants: Sequence[AnyNetworkPlant],
    whitened: WhitenedCost,
    data: Sequence[FrequencyResponse],
    progress: Progress,
) -> list[FittedNetwork]:
    """Return the fits, those that are left and the best one with intervals and with the values of
    the other networks of their class; `ranks`: numbers of determinable values.
    """
    own, best = list(fits), min(fits, key=lambda f: comparable(f.chi2))
    for k, (fit, plant) in enumerate(zip(fits, plants, strict=True)):
        if not (fit.is_left or fit is best):
            continue
        progress("intervals", k, len(fits))
        p, relative = (
            np.array([entries[name] for name in plant.parameters])
            for entries in (fit.values, fit.relative)
        )
        exact = without_noise(data, plant.response(p))
        others = [n for n in classes[k] if n is not fit.network and not fit.contains]
        twins = (_twin(other, ranks[other], exact, whitened, fit.chi2) for other in others)
        found = network_intervals(plant, whitened, p, relative)
        own[k] = replace(fit, intervals=found, twins=tuple(twins))
    return own


def _twin(
    network: Network,
    rank: int,
    exact: Sequence[FrequencyResponse],
    whitened: WhitenedCost,
    level: float,
) -> NetworkTwin:
    """Return the network with the values that give the responses `exact`."""
    plant, cost = network_plant(network, [response.omega for response in exact]), _cost(exact)
    starts = random_starts(plant, exact[0], STARTS, np.random.default_rng(SEED))
    start = search_from(plant, cost, starts).p
    free = len(plant.parameters) - rank
    return twin_at(plant, start, WhitenedCost(cost, whitened.known), whitened, level, free)


Limits = Mapping[tuple[int, int], Minor]
"""By (larger, smaller), of fits counted from 0: the limit of the one that is the other."""


def _limits(fits: Sequence[FittedNetwork], classes: Sequence[Sequence[Network]]) -> Limits:
    """Containments among fitted networks; `classes`: the networks that each one represents, all of
    which give the same responses.
    """
    limits = dict[tuple[int, int], Minor]()
    for large, small in permutations(range(len(fits)), 2):
        pairs = ((fits[large].network, other) for other in classes[small])
        found = next(filter(None, (limit_of(*pair) for pair in pairs)), None)
        if found is not None:
            limits[large, small] = found
    return limits


def _improve_to_contained(
    fits: Sequence[FittedNetwork],
    limits: Limits,
    plants: Sequence[AnyNetworkPlant],
    data: Sequence[FrequencyResponse],
    scatter: Scatter,
) -> list[FittedNetwork]:
    """The fits, those searched again at their limit that miss more than one which they contain;
    where that fails too they have its residuals, as it is their limit.
    """
    own, cost = list(fits), _cost(data)
    for i in sorted(range(len(fits)), key=lambda i: len(fits[i].values)):
        inner = [k for k in range(len(fits)) if (i, k) in limits]
        if not inner:
            continue
        best = min(inner, key=lambda k: own[k].cost)
        if own[i].cost > own[best].cost * (1 + NESTED):
            source = np.random.default_rng((SEED, i))
            starts = random_starts(plants[i], data[0], AGAIN, source)
            p = search_from(plants[i], cost, _at_limit(plants[i], limits[i, best], starts)).p
            again = _refine(plants[i], p, cost, scatter, own[i].rank)
            own[i] = min(own[i], replace(again, same=own[i].same), key=lambda f: f.cost)
        if own[i].cost > own[best].cost * (1 + NESTED):
            own[i] = replace(own[i], residual=own[best].residual)
        for k in (k for k in inner if own[k].explains and not own[i].explains):
            own[i] = replace(
                own[i], chi2=own[k].chi2, explains=True, apart=own[k].apart, misses=own[k].misses
            )
    return own


def _at_limit(plant: AnyNetworkPlant, limit: Minor, starts: Real) -> Real:
    """Starts, shape (n_s, n_p), with what vanishes and what grows without bound near there."""
    at = {name: k for k, name in enumerate(plant.parameters)}
    moved = starts.copy()
    special = dict(limit.exponents)
    for e in plant.network.elements:
        if e.value in (*limit.missing, *limit.rigid) and e.value in at:
            grows = (e.value in limit.rigid) != e.kind.divides
            moved[:, at[e.value]] *= FAR if grows else 1 / FAR
        if e.value in special:
            moved[:, at[e.exponent]] = float(Fraction(special[e.value]))
    return moved


def _exclude_containing(fits: Sequence[FittedNetwork], limits: Limits) -> list[FittedNetwork]:
    """The fits, none of them excluded that contains one which is left, and with what each one
    contains: the selected network, or, where the data do not determine all of its values, any.
    """
    kept = {i for i, f in enumerate(fits) if f.is_left}
    kept |= {i for i, f in enumerate(fits) if f.explains and any((i, k) in limits for k in kept)}
    own = [replace(f, excluded_by="") if i in kept else f for i, f in enumerate(fits)]
    order = sorted(kept, key=lambda i: (own[i].rank, comparable(own[i].cost)))
    for i in order:
        inner = order if not all(map(isfinite, own[i].relative.values())) else order[:1]
        simplest = (own[k].network.name for k in inner if (i, k) in limits)
        own[i] = replace(own[i], contains=next(simplest, ""))
    return own


def _excluding(candidate: FittedNetwork, fits: Sequence[FittedNetwork], scatter: Scatter) -> str:
    """The network that excludes this one, the clearest first; "" if none does."""
    clear = list[tuple[float, str]]()
    for other in fits:
        if other.cost < candidate.cost:
            surplus = max(1, other.rank - candidate.rank)
            size, most = statistic(candidate, other), limit(surplus, scatter.freedom)
            if size > most and candidate.cost - other.cost > CLEARLY * most:
                clear.append((size / most, other.network.name))
    return max(clear)[1] if clear else ""
