"""Do the data settle the quantity of a sensor that nobody named?

A speed read as an acceleration is explained all the same, by a lag whose corner lies below the
band: it integrates. A position and a speed look alike where friction governs the whole band. So
where the quantity is assumed, small candidates, and the structure that explains the data best, are
fitted with the other two. With n residuals and p parameters they are compared by n ln(J/n) + p ln n
(Schwarz 1978): J in logarithms does not depend on the unit. A quantity under which nothing explains
the data (`unseen_explanation`) does not count: where none does, all of them miss as much.

Inertias of a wrong quantity are wrong by factors of (j omega)^n, so that nothing may be said of the
machine before somebody names the quantity.
"""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from math import log

from disting.fit.judge.candidate import share_about, unseen_explanation
from disting.fit.judge.reading import NOTHING, corner_of
from disting.fit.search.candidates import reference
from disting.fit.search.cost import Case
from disting.fit.search.estimate import Estimate, Task
from disting.fit.search.exchange import SEARCHED, estimates, explore
from disting.fit.search.joint import JointCost
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import apply
from disting.measurement.assumptions import assumed_quantity
from disting.model.chain import Chain, Sensor
from disting.quantities import MODELLED
from disting.store import Store

SMALL = (1, 2)  # masses
AS_WELL = 2.0  # what the criterion may be worse by


@dataclass(frozen=True, slots=True)
class QuantityReading:
    """The data read as one sensor quantity: the structure that explains them best, its `chi2` per
    line; `is_assumed`: the fit took the data so; `integrates`: the lag of the structure does so
    over the whole band.
    """

    quantity: Sensor
    found: Estimate
    chi2: float
    is_assumed: bool = False
    integrates: bool = False

    @property
    def name(self) -> str:
        """The structure, such as 2:1+b1+delay."""
        return reference(self.found.chain)

    @property
    def sentence(self) -> str:
        """Such as: as velocity 2:1+b1+delay has chi2 0.95 per line."""
        assumed = " (assumed)" if self.is_assumed else ""
        lag = ", with a lag that integrates over the whole band" if self.integrates else ""
        what = f"as {self.quantity.value}{assumed} {self.name}"
        return f"{what} has chi2 {self.chi2:.3g} per line{lag}"


def question(readings: Sequence[QuantityReading]) -> str:
    """Ask for the quantity, and show the readings side by side."""
    ways = " or ".join(f"--quantity {r.quantity.value}" for r in readings)
    return (
        "the data do not settle which quantity the sensor shows, and nothing says it:"
        f" {'; '.join(r.sentence for r in readings)}; give {ways}"
    )


def quantity_readings(
    searched: Sequence[Estimate],
    selected: Estimate | None,
    task: Task,
    store: Store | None = None,
    executor: Executor | None = None,
    progress: Callable[[str, int, int], object] = lambda what, done, total: None,
) -> tuple[QuantityReading, ...]:
    """The assumed quantity and those under which the data are explained as well or better, in the
    order of the criterion; none where the quantity is stated, or where the data settle it.

    Of several responses the first one is read. A quantity counts too where the lag of the
    `selected` structure takes its place, integrating over the whole band.
    """
    measured = task.cost.parts[0].measured
    taken = assumed_quantity(measured)
    if taken is None:
        return ()
    task, own = _first_response(searched, selected, task, store, executor)
    nearest = min(own, key=lambda fit: _criterion(fit, task))
    before, most = _criterion(nearest, task), share_about(nearest, task)
    imitated = any(_integrates(fit, measured) for fit in (nearest, selected) if fit is not None)
    others = list[tuple[float, QuantityReading]]()
    for quantity in (q for q in MODELLED if q is not taken):
        progress(f"read as {quantity.value}", len(others), len(MODELLED) - 1)
        shifted = _shifted(task.cost.measured, taken.order - quantity.order)
        seen = replace(task, cost=replace(task.cost.parts[0], measured=shifted))
        chains = dict.fromkeys((*_small(own), *_with_and_without_lag(nearest.chain)))
        fits = estimates(tuple(chains), seen, store=store, executor=executor).values()
        best = min(fits, key=lambda fit: _criterion(fit, seen))
        size, said = _criterion(best, seen), unseen_explanation(best, seen, most)
        takes_its_place = imitated and quantity.order == taken.order - 1
        if said.is_near and (size <= before + AS_WELL or takes_its_place):
            others.append((size, QuantityReading(quantity, best, said.chi2)))
    if not others:
        return ()
    chi2 = unseen_explanation(nearest, task, most).chi2
    assumed = QuantityReading(taken, nearest, chi2, True, _integrates(nearest, measured))
    return (assumed, *(reading for _, reading in sorted(others, key=lambda pair: pair[0])))


def _first_response(
    searched: Sequence[Estimate],
    selected: Estimate | None,
    task: Task,
    store: Store | None,
    executor: Executor | None,
) -> tuple[Task, Sequence[Estimate]]:
    """The task of the first response by logarithms, on few lines, and estimates of it; of several
    responses, or of another cost, small candidates and the selected one are fitted to it anew.
    """
    if not isinstance(task.cost, JointCost) and task.cost.case is Case.LOGARITHM:
        return explore(searched, task)
    alone = replace(task, cost=replace(task.cost.parts[0], case=Case.LOGARITHM))
    few = alone.thinned(SEARCHED)
    chains = dict.fromkeys((*_small(searched), *([selected.chain] if selected else ())))
    return few, [*estimates(tuple(chains), few, store=store, executor=executor).values()]


def _criterion(fit: Estimate, task: Task) -> float:
    """n ln(J/n) + p ln n."""
    n = task.cost.n_residuals
    free = sum(name not in task.fixed for name in fit.parameters)
    return n * log(max(fit.j, NOTHING) / n) + free * log(n)


def _integrates(fit: Estimate, measured: FrequencyResponse) -> bool:
    """Return True if the corner of a lag lies below all lines."""
    return bool(corner_of(fit.parameters) < measured.frequency[0])


def _shifted(measured: FrequencyResponse, steps: int) -> FrequencyResponse:
    """The response differentiated so many times more."""
    factor = measured.omega**steps
    return replace(
        measured,
        G=measured.G * (1j * measured.omega) ** steps,
        deviation=apply(lambda d: d * factor, measured.deviation),
        nonlinear=apply(lambda d: d * factor, measured.nonlinear),
    )


def _small(candidates: Sequence[Estimate]) -> tuple[Chain, ...]:
    """Chains of one and two masses where these are candidates, else of the fewest: with and without
    ground dampers and lag, all with a dead time.
    """
    sizes = {c.chain.n_masses for c in candidates}
    wanted = sizes & set(SMALL) or {min(sizes)}
    chains = dict[Chain, None]()
    for n in sorted(wanted):
        chain = next(c.chain for c in candidates if c.chain.n_masses == n)
        for dampers in ((), tuple(range(1, n + 1))):
            for lag in (False, True):
                chains[replace(chain, ground_dampers=dampers, lag=lag, dead_time=True)] = None
    return tuple(chains)


def _with_and_without_lag(chain: Chain) -> Iterator[Chain]:
    yield from (replace(chain, lag=lag, dead_time=True) for lag in (False, True))
