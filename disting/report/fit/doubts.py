"""Sentences on what looks wrong in a selection: in its data, its misfit, its values."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations
from math import isfinite

import numpy as np
from scipy.ndimage import median_filter

from disting.fit.judge.admissible import FROM_ZERO, KNOWN, UNDETERMINED
from disting.fit.judge.explanation import Level, correlations, partners
from disting.fit.judge.members import Disagreement
from disting.fit.judge.modes import between_lines
from disting.fit.judge.readings import bad_lines
from disting.fit.results.selection import Selection, response_of
from disting.fit.search.candidates import reference
from disting.fit.search.joint import AnyCost
from disting.measurement import FrequencyResponse
from disting.measurement.linearity import (
    NOT_COUNTED,
    ONLY,
    describe_jumps,
    describe_levels,
    describe_nonlinearity,
    held,
    with_change,
)
from disting.statistics.scatter import CLEAR, JUMPS, change, scatter

FEWEST = 8  # lines of a fit
SMOOTHED = 5  # lines over which the scatter is looked at
MOST_CLEAR = 0.7  # share of the lines that carry information, above which no band is proposed
LINEAR = "the machine is not linear: friction, backlash"  # why two measurements differ
CHANGED = "the machine changed between them, for example its friction with the amplitude"
APPROXIMATE = "as an approximation only"  # beside a value of a structure that comes near the data
NEITHER_COUNTED = "± counts scatter, not by how much another structure shifts a value"
HANGING = 0.3  # correlation of neighbouring residuals from which on it is named


def unseen(selection: Selection) -> Iterator[str]:
    """Resonances of the described candidate of which the lines show flanks at most."""
    chain, values = selection.described.chain, selection.described.estimate.parameters
    for pole, zero in between_lines(
        chain.structure, values, selection.task.cost.measured.frequency
    ):
        yield (
            f"{reference(chain)} has a resonance at {pole:.5g} Hz and an antiresonance at"
            f" {zero:.5g} Hz. Both lie between two measured lines and are narrower than the"
            " distance of these lines, so the data show their flanks only: measure more lines there"
            " before you trust the values that make them"
        )


def _of_each(cost: AnyCost) -> list[str]:
    """Names of the responses, where there are several."""
    return [""] if len(cost.setups) == 1 else [f" of {setup.text}" for setup in cost.setups]


def suspicious_data(cost: AnyCost) -> Iterator[str]:
    """Suspicious features of the data."""
    for part, of in zip(cost.parts, _of_each(cost), strict=True):
        yield from (f"{of[4:]}: {doubt}" if of else doubt for doubt in part.measured.suspicions)


def closed_loops(selection: Selection) -> tuple[str, ...]:
    """One sentence on closed loops that the records show; empty where they show none."""
    cost = selection.task.cost
    each = zip(cost.parts, _of_each(cost), strict=True)
    loops = [(part.measured, of) for part, of in each if part.measured.loop is not None]
    # what is biased matters most
    for measured, of in sorted(loops, key=lambda pair: not pair[0].is_biased_by_loop)[:1]:
        more = f" (so do {len(loops) - 1} more responses)" if len(loops) > 1 else ""
        return (f"{of[4:]}: {measured.loop_sentence}{more}" if of else measured.loop_sentence,)
    return ()


def same_data_twice(selection: Selection) -> Iterator[str]:
    """Test data that are the training data once more."""
    train = selection.task.cost.measured
    if selection.test is not train and selection.test == train:
        yield (
            "training and test data are the same numbers: nothing is validated; measure again, or"
            " leave --test away"
        )


def bad(selection: Selection) -> tuple[str, ...]:
    """Single lines that make most of a misfit."""
    if selection.explanation.explains and not selection.better:
        return ()
    lines = bad_lines(selection.candidates, selection.described, selection.task)
    return () if lines is None else (lines,)


def doubtful_deviations(selection: Selection) -> Iterator[str]:
    """Contradictions to the standard deviations of the data."""
    if selection.explanation.scatter.doubt:
        yield selection.explanation.scatter.doubt


def clear_band(selection: Selection) -> Iterator[str]:
    """The frequencies that carry information, where many others do not."""
    data = selection.judging.parts[0].measured
    rho = selection.explanation.scatter.rho[: len(data)]
    clear = np.flatnonzero(median_filter(rho, SMOOTHED, mode="nearest") < CLEAR)
    runs = np.split(clear, np.flatnonzero(np.diff(clear) > 1) + 1)
    longest = max(runs, key=len)
    if len(longest) >= FEWEST and selection.explanation.scatter.clear < MOST_CLEAR:
        low, high = (data.frequency[i] for i in (longest[0], longest[-1]))
        yield (
            f"from {low:.4g} to {high:.4g} Hz the lines scatter by less than {100 * CLEAR:.0f} %:"
            f" --band {low * 0.999:.4g}..{high * 1.001:.4g} fits these alone"
        )


def better(selection: Selection) -> Iterator[str]:
    """The excluded candidate that fits better than the selected one."""
    if selection.selected is None or not selection.better:
        return
    best, more = selection.better[0], len(selection.better) - 1
    others = f" ({more} more)" if more else ""
    yield (
        f"{reference(best.chain)}{others} fits better, J = {best.j_test:.3g} instead of"
        f" {selection.selected.j_test:.3g}, but is not admissible: {'; '.join(best.reasons)}"
    )


def differing_parameters(both: tuple[Disagreement, ...]) -> str:
    """Parameters that training and test give differently."""
    values = ", ".join(
        f"{d.name} ({d.train:.3g} and {d.test:.3g}, {d.distance:.2g} standard errors apart)"
        for d in both
    )
    return (
        f"training and test data disagree on {values}: the model misses something, for example"
        " friction that changes with the amplitude; trust neither interval"
    )


def amplitude(selection: Selection) -> tuple[str, ...]:
    """Evidence that values hold for this amplitude only, one sentence for each response: distortion
    of its own, and the difference to another measurement of it. Empty where the machine is linear
    as far as the data show.
    """
    own, changes = list(_nonlinearity(selection)), list(_machine_change(selection))
    if len(own) == len(changes) == 1:
        of, sentence = own[0]
        first, cause = changes[0]
        both = with_change(sentence, f"{first}{': the machine is not linear' * (cause == LINEAR)}")
        return (f"{of}{both}",)
    return (*(f"{of}{sentence}" for of, sentence in own), *(held([s], c) for s, c in changes))


def distorts(selection: Selection) -> bool:
    """Return True if a response by itself shows that the machine is not linear."""
    return any(True for _ in _nonlinearity(selection))


def hold(selection: Selection) -> str:
    """Caveat for values and intervals; empty where they hold for any amplitude, as far as the data
    show, and nothing systematic is missed.
    """
    return " and ".join(_limits(selection))


def not_counted(selection: Selection) -> str:
    """Effects that the ± of such values does not include; empty where `hold` is."""
    return "; ".join(_limits(selection).values())


def _limits(selection: Selection) -> dict[str, str]:
    """Conditions for values, each with the effect that may shift them beyond their ±."""
    if selection.question:
        return {}
    is_near = selection.explanation.level is Level.NEARLY
    return ({ONLY: NOT_COUNTED} if amplitude(selection) else {}) | (
        {APPROXIMATE: NEITHER_COUNTED} if is_near else {}
    )


def _nonlinearity(selection: Selection) -> Iterator[tuple[str, str]]:
    """Distortion of each response, which it is and a sentence: what its lines or its repeats show,
    else lines that jump by more than they scatter.
    """
    for k, (part, of) in enumerate(
        zip(selection.task.cost.parts, _of_each(selection.task.cost), strict=True)
    ):
        own = part.measured
        fitted = response_of(selection.described, selection.task, own.omega, k)
        sentence = describe_nonlinearity(own)
        own_scatter = scatter(own, [fitted])
        # else the misfit makes the jumps
        explains = selection.explanation.size_level is Level.EXPLAINS
        if not sentence and explains and own_scatter.source == JUMPS and own.noise is not None:
            noise = float(np.median(own.noise / np.abs(own.G)))
            sentence = describe_jumps(float(np.sqrt(2)) * own_scatter.typical, noise)
        if sentence:
            yield f"{of[4:]}: " if of else "", sentence


def _machine_change(selection: Selection) -> Iterator[tuple[str, str]]:
    """A machine that is not the same in two measurements, and why: where their excitations are
    known to differ, it is not linear.
    """
    for one, other, at, names in _measured_twice(selection):
        fitted = [
            response_of(selection.described, selection.task, d.omega, at) for d in (one, other)
        ]
        scatters = [scatter(d, [own]) for d, own in zip((one, other), fitted, strict=True)]
        tau, levels = change(one, other, *scatters), describe_levels(one, other)
        own = max(this_scatter.typical for this_scatter in scatters)
        if tau:
            at_levels = f" at {levels[0]} and {levels[1]} (input, rms)" if levels else ""
            yield (
                f"{names}{at_levels} differ by {100 * tau:.2g} % a line beyond their scatter of"
                f" {100 * own:.2g} %",
                LINEAR if levels else CHANGED,
            )


def _measured_twice(
    selection: Selection,
) -> Iterator[tuple[FrequencyResponse, FrequencyResponse, int, str]]:
    """Pairs of measurements of one response, the number of its setup, and their names."""
    cost, judging = selection.task.cost, selection.judging
    whole = enumerate(zip(cost.setups, cost.parts, strict=True))
    for (i, (setup, one)), (_, (other_setup, other)) in combinations(whole, 2):
        if replace(setup, delay="") == replace(other_setup, delay=""):
            yield one.measured, other.measured, i, "two training responses"
    tests = zip(partners(cost, judging), judging.parts, judging.setups, strict=True)
    for (train, judged, setup), of in zip(tests, _of_each(judging), strict=True):
        yield train, judged.measured, cost.setups.index(setup), f"training and test data{of}"


def correlated_residuals(selection: Selection) -> Iterator[str]:
    """Correlated residuals: the remainder is not noise."""
    candidate, cost = selection.described, selection.task.cost
    plant = selection.task.plant(candidate.chain)
    values = [candidate.estimate.parameters[n] for n in selection.task.names(candidate.chain)]
    size = correlations(cost, cost.residual(plant.response(np.array(values))))
    # of one that comes near the structure line says it
    if size > HANGING and selection.explanation.explains:
        yield (
            f"residuals of neighbouring lines are correlated by {size:.2f} on the training data:"
            " the model misses something small; the standard errors allow for it"
        )


def weak(selection: Selection) -> Iterator[str]:
    """Parameters of the selected candidate that are known badly."""
    if selection.selected is None:
        return
    wide = selection.members[0].intervals if selection.members else {}
    loose = {
        n: e for n, e in selection.selected.practical.relative_errors.items() if not e <= KNOWN
    }
    names = [
        f"{n} {limits_in_words(*wide[n])}" if n in wide and not e <= FROM_ZERO else _loose(n, e)
        for n, e in loose.items()
    ]
    if names:
        yield f"known badly: {', '.join(names)}"


def _loose(name: str, error: float) -> str:
    return f"{name} to ± {100 * error:.0f} %" if error <= UNDETERMINED else f"{name} not at all"


def limits_in_words(low: float, high: float) -> str:
    """An interval of 95 %, of which an end may be missing.

    >>> limits_in_words(0.0, 0.004), limits_in_words(2.0, float("inf"))
    ('below 0.004 (95 %)', 'above 2 (95 %)')
    """
    if not isfinite(high):
        return f"above {low:.3g} (95 %)" if low > 0 else "not determined"
    return f"{low:.3g} to {high:.3g} (95 %)" if low > 0 else f"below {high:.3g} (95 %)"
