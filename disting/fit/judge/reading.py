"""What was measured: how the data were read, and which lines are bad."""

from collections.abc import Iterator, Mapping, Sequence
from math import inf, pi

import numpy as np

from disting.fit.judge.candidate import Candidate
from disting.fit.search.candidates import reference
from disting.fit.search.estimate import Estimate, Task
from disting.fit.search.joint import JointCost
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Real
from disting.measurement.assumptions import assumed_quantity

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
    if measured.is_impedance:
        return f"{origin}{reading}{measured.quantity}"
    quantity = assumed_quantity(measured)
    phrase = "" if quantity is None else " (assumed)"
    if quantity is not None and quantity is not measured.sensor:
        phrase = f", from a {quantity.value} (assumed)"
    return f"{origin}{reading}sensor: {measured.sensor.value}{phrase}"


def outside(candidate: Candidate, measured: FrequencyResponse) -> Iterator[str]:
    """Sentences on a lag and a dead time that act below the band only."""
    low, values = measured.frequency[0], candidate.estimate.parameters
    corner = corner_of(values)
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
