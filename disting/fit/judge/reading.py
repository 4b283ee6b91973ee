"""What was measured: how the data were read, which quantity the sensor shows, which lines are bad.

The quantity of a sensor is often not said. A speed read as an acceleration is explained all the
same, by a lag whose corner lies below the band: it integrates. So where the quantity is assumed,
the small candidates are fitted with the other two. With n residuals and p parameters they are
compared by n ln(J/n) + p ln n (Schwarz 1978): J in logarithms does not depend on the unit. One that
does not explain the data (`explains`) tells nothing: where none does, all quantities miss as much.
"""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from math import inf, log, pi

import numpy as np

from disting.fit.judge.candidate import Candidate, explains, share_about
from disting.fit.search.candidates import reference
from disting.fit.search.cost import Case
from disting.fit.search.estimate import Estimate, Task
from disting.fit.search.exchange import estimates, explore
from disting.fit.search.joint import JointCost
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Real
from disting.measurement.assumptions import assumed_quantity
from disting.model.chain import Chain, Sensor
from disting.store import Store

SMALL = (1, 2)  # masses
AS_WELL = 2.0  # what the criterion may be worse by
NOTHING = 1e-300  # a cost that is as good as zero
SHARE = 0.8  # of the misfit, from which on single lines are named
BESIDE = 0.1  # of theirs, that their neighbours may miss
MOST_LINES = 2  # that are named
FEWEST = 12  # lines, from which on one of them is not many


def read_in_words(measured: FrequencyResponse) -> str:
    """How a response was read, such as: a.csv, column 2 (Re): frequency in Hz (column 1), real
    part (column 2), imaginary part (column 3); sensor: acceleration (assumed).
    """
    origin = f"{measured.origin}: " if measured.origin else ""
    reading = f"{measured.reading}; " if measured.reading else ""
    quantity = assumed_quantity(measured)
    phrase = "" if quantity is None else " (assumed)"
    if quantity is not None and quantity is not measured.sensor:
        phrase = f", from a {quantity.value} (assumed)"
    return f"{origin}{reading}sensor: {measured.sensor.value}{phrase}"


def other_quantities(
    searched: Sequence[Estimate],
    task: Task,
    store: Store | None = None,
    executor: Executor | None = None,
    progress: Callable[[str, int, int], object] = lambda what, done, total: None,
) -> tuple[str, ...]:
    """Sentences on the quantities that explain the data as well as the assumed one, or better; none
    where nothing is assumed, several responses are fitted, or the cost is not of logarithms.
    """
    cost = task.cost
    if isinstance(cost, JointCost) or cost.case is not Case.LOGARITHM:
        return ()
    taken = assumed_quantity(cost.measured)
    if taken is None:
        return ()
    task, own_estimates = explore(searched, task)
    nearest = min(own_estimates, key=lambda fit: _criterion(fit, task))
    before, most = _criterion(nearest, task), share_about(nearest, task)
    pairs = list[tuple[float, Sensor, Estimate]]()
    for quantity in Sensor:
        if quantity is taken:
            continue
        progress(f"read as {quantity.value}", len(pairs), len(Sensor) - 1)
        shifted = _shifted(task.cost.measured, taken.order - quantity.order)
        seen = replace(task, cost=replace(task.cost.parts[0], measured=shifted))
        fits = estimates(_small(own_estimates), seen, store=store, executor=executor).values()
        best = min(fits, key=lambda fit: _criterion(fit, seen))
        if _criterion(best, seen) <= before + AS_WELL and explains(best, seen, most):
            pairs.append((_criterion(best, seen), quantity, best))
    return tuple(
        f"read as {quantity.value}, {reference(fit.chain)} fits the data as well or better"
        f" (J = {fit.j:.3g} with {len(fit.parameters)} parameters): that it is"
        f" {taken.value} is assumed; give --quantity {quantity.value}, or --quantity {taken.value}"
        for _, quantity, fit in sorted(pairs, key=lambda parts: parts[0])
    )


def outside(candidate: Candidate, measured: FrequencyResponse) -> Iterator[str]:
    """Sentences on a lag and a dead time that act below the band only."""
    low, values = measured.frequency[0], candidate.estimate.parameters
    corner = 1 / (2 * pi * values["T1"]) if values.get("T1") else inf
    if corner < low:
        yield (
            f"the lag T1 = {values['T1']:.3g} s has its corner at {corner:.3g} Hz, below the lowest"
            f" line ({low:.3g} Hz): over the whole band it integrates; is the quantity"
            f" {measured.sensor.value} right? --quantity names another"
        )
    if values.get("Td", 0.0) * low > 1:
        yield (
            f"the dead time Td = {values['Td']:.3g} s is longer than a period of the lowest line"
            f" ({low:.3g} Hz): are the phases those of this response?"
        )


def bad_lines(candidates: Sequence[Candidate], best: Candidate, task: Task) -> str | None:
    """A sentence on one or two lines that make most of the misfit of a candidate which is no larger
    than the best one; None where the misfit lies elsewhere, or several responses are fitted.
    """
    if isinstance(task.cost, JointCost) or len(task.cost.measured) < FEWEST:
        return None
    for candidate in sorted(candidates, key=lambda c: (c.n_parameters, c.j_train)):
        if candidate.n_parameters > best.n_parameters:
            break
        lines, share = _isolated(_missed(candidate.estimate, task))
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


def _criterion(fit: Estimate, task: Task) -> float:
    """n ln(J/n) + p ln n."""
    n = task.cost.n_residuals
    free = sum(name not in task.fixed for name in fit.parameters)
    return n * log(max(fit.j, NOTHING) / n) + free * log(n)


def _shifted(measured: FrequencyResponse, steps: int) -> FrequencyResponse:
    """The response differentiated so many times more."""
    deviation = measured.deviation
    return replace(
        measured,
        G=measured.G * (1j * measured.omega) ** steps,
        deviation=None if deviation is None else deviation * measured.omega**steps,
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


def _missed(fit: Estimate, task: Task) -> Real:
    """The squared residual of each line, shape (n_f,)."""
    values = np.array([fit.parameters[name] for name in task.names(fit.chain)])
    residual = task.cost.residual(task.plant(fit.chain).response(values))
    return np.asarray((residual.reshape(2, -1) ** 2).sum(axis=0))


def _isolated(missed: Real) -> tuple[list[int], float]:
    """The one or two lines that make most of a misfit, their neighbours hardly any, and their
    share.
    """
    order = np.argsort(-missed, kind="stable")
    for count in range(1, MOST_LINES + 1):
        lines = [int(i) for i in order[:count]]
        share = float(missed[lines].sum() / max(missed.sum(), NOTHING))
        beside = {i + step for i in lines for step in (-1, 1)} - set(lines)
        near = max((missed[i] for i in beside if 0 <= i < len(missed)), default=0.0)
        if share >= SHARE and near <= BESIDE * missed[lines].min():
            return lines, share
    return [], 0.0
