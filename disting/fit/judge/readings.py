"""Other readings of the data: bad lines, the quantity of a sensor, and readings that would fit
where no candidate does.

What would fit: another sensor quantity, a reversed sensor, phases of the other sign, gains in dB, a
zero-order hold, other places, one mass more. A chain with dampers, a lag and a dead time, of as
many masses as the best candidate, is fitted under each reading. They are compared by J on the
training data, which in logarithms does not depend on the unit of the quantity. A mass more fits
almost everything better, a rod, a notch filter, friction: it is named only if it explains the data
(`explains`). A few fits show, before all candidates are fitted, the signs of sensors that nobody
stated, and how much the lines of several responses scatter.

The quantity of a sensor that nobody named: a speed that is read as an acceleration is explained all
the same, by a lag whose corner lies below the band, because it integrates. A position and a speed
look alike where friction governs the whole band. So where the quantity is assumed, small
candidates, and the structure that explains the data best, are fitted with the other two. With n
residuals and p parameters they are compared by n ln(J/n) + p ln n (Schwarz 1978). A quantity under
which nothing explains the data (`unseen_explanation`) does not count: where none does, all of them
miss as much. Inertias of a wrong quantity are wrong by factors of (j omega)^n, so that nothing can
be stated about the machine before the user gives the quantity.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from math import inf, log, pi

import numpy as np

from disting.fit.judge.candidate import Candidate, explains, share_about, unseen_explanation
from disting.fit.search.candidates import reference
from disting.fit.search.cost import Case
from disting.fit.search.estimate import Estimate, Task
from disting.fit.search.exchange import SEARCHED, estimates, explore
from disting.fit.search.joint import AnyCost, JointCost
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real, apply
from disting.measurement.assumptions import assumed_quantity
from disting.measurement.tabular import ASSUMED_LINEAR
from disting.model.chain import Chain, Quantity
from disting.quantities import MODELLED
from disting.store import Store

ZERO_COST = 1e-300  # a cost that is as good as zero
SHARE = 0.8  # of the misfit, from which on single lines are named
BESIDE = 0.1  # of theirs, that their neighbours may miss
MOST_LINES = 2  # that are named
FEWEST = 12  # lines, from which on one of them is not many


def read_in_words(measured: FrequencyResponse) -> str:
    """Reading of a response, such as: a.csv, column 2 (Re): frequency in Hz (column 1), real part
    (column 2), imaginary part (column 3); sensor: acceleration (assumed).
    """
    origin = f"{measured.origin}: " if measured.origin else ""
    reading = f"{measured.reading}; " if measured.reading else ""
    if measured.is_impedance:
        return f"{origin}{reading}{measured.quantity_word}"
    quantity = assumed_quantity(measured)
    phrase = "" if quantity is None else " (assumed)"
    if quantity is not None and quantity is not measured.quantity:
        phrase = f", from {quantity.value} (assumed)"
    return f"{origin}{reading}sensor: {measured.quantity.value}{phrase}"


def outside(candidate: Candidate, measured: FrequencyResponse) -> Iterator[str]:
    """Sentences on a lag and a dead time that act below the band only."""
    low, values = measured.frequency[0], candidate.estimate.parameters
    corner = corner_of(values)
    if corner < low:
        yield (
            f"the lag T1 = {values['T1']:.3g} s has its corner at {corner:.3g} Hz, below the lowest"
            f" line ({low:.3g} Hz): over the whole band it integrates; is the quantity"
            f" {measured.quantity.value} right? --quantity names another"
        )
    if values.get("Td", 0.0) * low > 1:
        yield (
            f"the dead time Td = {values['Td']:.3g} s is longer than a period of the lowest line"
            f" ({low:.3g} Hz): are the phases those of this response?"
        )


def corner_of(values: Mapping[str, float]) -> float:
    """The corner [Hz] of the lag of a model with these parameters; infinite without a lag."""
    return 1 / (2 * pi * values["T1"]) if values.get("T1") else inf


def bad_lines(candidates: Sequence[Candidate], best: Candidate, task: Task) -> str | None:
    """A sentence on one or two lines that make most of the misfit of a candidate which is no larger
    than the best one; None where the misfit lies elsewhere, or several responses are fitted.
    """
    if isinstance(task.cost, JointCost) or len(task.cost.measured) < FEWEST:
        return None
    for candidate in sorted(candidates, key=lambda c: (c.n_parameters, c.j_train)):
        if candidate.n_parameters > best.n_parameters:
            break
        lines, share = _isolate_lines(_square_misfit(candidate.estimate, task))
        if len(lines):
            hertz = ", ".join(f"{task.cost.measured.frequency[i]:.5g}" for i in sorted(lines))
            name = reference(candidate.chain)
            lead = f"the line at {hertz} Hz alone makes"
            if len(lines) > 1:
                lead = f"the lines at {hertz} Hz alone make"
            return (
                f"{lead} {100 * share:.0f} % of what {name} misses: bad, as by hum or a change of"
                " range, or a resonance narrower than the lines lie apart? remove what is bad from"
                " the file, or measure closer there"
            )
    return None


def _square_misfit(fit: Estimate, task: Task) -> Real:
    """The squared residual of each line, shape (n_f,)."""
    values = np.array([fit.parameters[name] for name in task.names(fit.chain)])
    residual = task.cost.residual(task.plant(fit.chain).response(values))
    return np.asarray((residual.reshape(2, -1) ** 2).sum(axis=0))


def _isolate_lines(missed: Real) -> tuple[list[int], float]:
    """The one or two lines that make most of a misfit, their neighbours hardly any, and their
    share.
    """
    order = np.argsort(-missed, kind="stable")
    for count in range(1, MOST_LINES + 1):
        lines = [int(i) for i in order[:count]]
        share = float(missed[lines].sum() / max(missed.sum(), ZERO_COST))
        beside = {i + step for i in lines for step in (-1, 1)} - set(lines)
        near = max((missed[i] for i in beside if 0 <= i < len(missed)), default=0.0)
        if share >= SHARE and near <= BESIDE * missed[lines].min():
            return lines, share
    return [], 0.0


SMALLEST_SIZES = (1, 2)  # masses
AS_WELL = 2.0  # what the criterion may be worse by


@dataclass(frozen=True, slots=True)
class QuantityReading:
    """The data read as one sensor quantity: the structure that explains them best, its `chi2` per
    line; `is_assumed`: the fit took the data so; `integrates`: the lag of the structure does so
    over the whole band.
    """

    quantity: Quantity
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
        "the data do not determine which quantity the sensor shows, and nothing states it:"
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
        shifted = _differentiate(task.cost.measured, taken.order - quantity.order)
        own_task = replace(task, cost=replace(task.cost.parts[0], measured=shifted))
        chains = dict.fromkeys((*_small(own), *_with_and_without_lag(nearest.chain)))
        fits = estimates(tuple(chains), own_task, store=store, executor=executor).values()
        best = min(fits, key=lambda fit: _criterion(fit, own_task))
        size, found = _criterion(best, own_task), unseen_explanation(best, own_task, most)
        takes_its_place = imitated and quantity.order == taken.order - 1
        if found.is_near and (size <= before + AS_WELL or takes_its_place):
            others.append((size, QuantityReading(quantity, best, found.chi2)))
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
    responses, or of another cost, small candidates and the selected one are fitted to it again.
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
    return n * log(max(fit.j, ZERO_COST) / n) + free * log(n)


def _integrates(fit: Estimate, measured: FrequencyResponse) -> bool:
    """Return True if the corner of a lag lies below all lines."""
    return bool(corner_of(fit.parameters) < measured.frequency[0])


def _differentiate(measured: FrequencyResponse, steps: int) -> FrequencyResponse:
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
    wanted = sizes & set(SMALLEST_SIZES) or {min(sizes)}
    chains = dict[Chain, None]()
    for n in sorted(wanted):
        chain = next(c.chain for c in candidates if c.chain.n_masses == n)
        for dampers in ((), tuple(range(1, n + 1))):
            for lag in (False, True):
                chains[replace(chain, ground_dampers=dampers, lag=lag, dead_time=True)] = None
    return tuple(chains)


def _with_and_without_lag(chain: Chain) -> Iterator[Chain]:
    yield from (replace(chain, lag=lag, dead_time=True) for lag in (False, True))


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
    """The sign with which candidates fit better, the best of the largest and the smallest ones of
    each size; of further responses each is tried together with the first one.
    """
    few = _extremes(candidates)
    cost = task.cost.thinned(SEARCHED)
    first = replace(task, cost=cost.parts[0])
    the_task = _better([replace(first, sign=sign) for sign in (1, -1)], few)
    if not isinstance(task.cost, JointCost):
        return replace(task, sign=the_task.sign)
    setups = [cost.setups[0]]
    for part, setup in zip(cost.parts[1:], cost.setups[1:], strict=True):
        pairs = [
            JointCost((cost.parts[0], part), (cost.setups[0], replace(setup, sign=sign, delay="")))
            for sign in (1, -1)
        ]
        best = _better([replace(the_task, cost=pair) for pair in pairs], few)
        setups.append(replace(setup, sign=best.cost.setups[1].sign))
    whole = replace(task.cost, setups=tuple(setups))
    return replace(task, sign=the_task.sign, cost=whole)


def pilot(task: Task, candidates: Sequence[Chain]) -> Callable[[AnyCost], list[Complex]]:
    """The responses of the best of a few candidates at the lines of any cost: a response divided by
    them bends no more, so that neighbouring lines show what they scatter by.
    """
    least = min(c.n_masses for c in candidates)
    few = _extremes([c for c in candidates if c.n_masses <= max(PILOT, least)])
    own_estimates = estimates(
        few, task.thinned(SEARCHED)
    )  # and smaller chains, which may lack a place
    estimate = min((own_estimates[chain] for chain in few), key=lambda e: e.j)
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
        if quantity is not data.quantity:
            cost = replace(first, measured=replace(data, quantity=quantity))
            view = replace(loose, quantity=quantity)
            yield f"read as {quantity.value}", view, replace(task, cost=cost)
            yield (
                f"read as {quantity.value} with the sign reversed",
                view,
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
    """The response if the phases, the gains or the sampling were others than assumed."""
    yield "with the sign of all phases (of the imaginary parts) turned", data.G.conj()
    size = np.abs(data.G)
    if any(ASSUMED_LINEAR in note for note in (*data.notes, *data.doubts)) and size.max() < MOST_DB:
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
    first = replace(
        chain,
        n_masses=n,
        gap=0,
        gap_damper=False,
        act_minus=0,
        act_plus=1,
        meas_minus=0,
        meas_plus=1,
    )
    for place in range(1, n + 1):
        other = replace(first, meas_plus=place)
        if other.indices[1:] != chain.indices[1:]:
            yield f"with the force at mass 1 and the sensor at mass {place} of {n}", other
