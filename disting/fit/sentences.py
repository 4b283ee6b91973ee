"""What an engineer has to know of a selection, in sentences: the truth first, what is suspicious,
the commands that lead on.

Structures are named as the commands read them, such as 2:1+b2+delay.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import isfinite

import numpy as np
from scipy.ndimage import median_filter

from disting.fit.judge.admissible import FROM_ZERO, KNOWN, UNDETERMINED
from disting.fit.judge.explanation import allowed
from disting.fit.judge.members import NOTHING, Disagreement
from disting.fit.judge.modes import between_lines
from disting.fit.judge.reading import bad_lines, outside
from disting.fit.judge.responses import correlations, partners
from disting.fit.noise.scatter import CLEAR, changed, scatter
from disting.fit.results.confidence import response_of
from disting.fit.search.candidates import as_listed, reference
from disting.fit.search.joint import AnyCost
from disting.fit.select import Selection
from disting.measurement.closed_loop import FOLLOWS
from disting.model.chain import Chain
from disting.model.names import damping_option

FEW = 8  # names in one line
FEWEST = 8  # lines of a fit
SMOOTHED = 5  # lines over which the scatter is looked at
MOST_CLEAR = 0.7  # share of the lines that carry information, above which no band is proposed
HANGING = 0.3  # correlation of neighbouring residuals from which on it is named


def first_lines(found: Selection) -> tuple[str, ...]:
    """At most five lines: does anything explain the data, what is selected, what else may it
    be, what is suspicious.
    """
    return (
        _verdict(found),
        *_doubled(found),
        *found.quantities,
        *(_explained(found) if found.explanation.explains else _unexplained(found)),
    )[:5]


def suspicions(found: Selection) -> tuple[str, ...]:
    """Sentences on what looks wrong, each with what it means; the gravest first, empty where
    nothing does.
    """
    said = [
        *found.quantities,
        *([] if found.explanation.explains else [_verdict(found), *_unexplained(found)]),
        *_better(found),
        *(_disagreeing(m.disagreements) for m in found.members[:1] if m.disagreements),
        *_changed(found),
        *_hanging(found),
        *_weak(found),
        *outside(found.described, found.task.cost.measured),
        *_unseen(found),
        *_doubled(found),
        *_bad(found),
        *_doubts(found),
        *_suspicious(found.task.cost),
        *learned(found),
    ]
    return tuple(dict.fromkeys(said))


def _unseen(found: Selection) -> Iterator[str]:
    """Resonances of the described candidate of which the lines show flanks at most."""
    chain, values = found.described.chain, found.described.estimate.parameters
    for pole, zero in between_lines(chain.structure, values, found.task.cost.measured.frequency):
        yield (
            f"{reference(chain)} has a resonance at {pole:.5g} Hz and an antiresonance at"
            f" {zero:.5g} Hz. Both lie between two measured lines and are narrower than the"
            " distance of these lines, so the data show their flanks only: measure more lines there"
            " before you trust the values that make them"
        )


def renamed(found: Selection) -> str:
    """What the parameters of the described candidate are called in the structure that it is
    named after; "" for the same.
    """
    form = as_listed(found.described.chain)
    other = ", ".join(f"{old} is {new} there" for old, new in form.renaming.items() if old != new)
    exchanged = "" if other else "force and sensor are exchanged there"
    said = (
        f"{reference(found.described.chain)} is the structure of the catalogue that behaves the"
        " same"
    )
    return "" if form.chain == found.described.chain else f"{said}: {other or exchanged}"


def commands(found: Selection) -> tuple[str, ...]:
    """Ready command lines for the next steps."""
    first = found.described
    rest = [m.name for m in found.members[1:]]
    damped = damping_option(first.chain.damped)
    steps = [f"disting compare {reference(first.chain)} {rest[0]} {damped}"] if rest else []
    chain, fitted = _without_zeros(first.chain, first.estimate.parameters)
    form, damped = as_listed(chain), damping_option(chain.damped)
    values = ",".join(f"{form.renaming[n]}={v:.6g}" for n, v in fitted.items())
    there = f'--to "{chain.n_masses}+b*" --set {values}'
    return (*steps, f"disting equivalents {reference(chain)} {damped} {there}")


def _without_zeros(chain: Chain, values: Mapping[str, float]) -> tuple[Chain, dict[str, float]]:
    """The chain without dampers that are zero, as far as it has a name, and its values; beside one
    of several springs a damper that is as good as zero.
    """
    springs = [name for name in chain.parameters if name[0] == "d"]
    there = replace(
        chain,
        damped=chain.damped and (not springs or any(values[name] for name in springs)),
        ground_dampers=tuple(i for i in chain.ground_dampers if values[f"b{i}"]),
    )
    return there, {name: max(values[name], NOTHING) for name in there.parameters}


def learned(found: Selection) -> tuple[str, ...]:
    """Responses from which nothing is learned, in sentences."""
    return tuple(
        f"{what}: that response is zero whatever the parameters, so nothing is learned from it"
        for what in found.silent
    )


def which_mass(found: Selection) -> tuple[str, ...]:
    """Where further responses are in structures that have other places, in sentences."""
    return tuple(
        f"in {name} this is {there}: of all its masses these fit best"
        for name, there in places(found)
    )


def places(found: Selection) -> tuple[tuple[str, str], ...]:
    """Names of the structures that are left, or best, in which further responses have other places
    than they are named by, and these places.
    """
    cost, shown = found.task.cost, [m.candidate for m in (*found.members, *found.containing)]
    chains = dict.fromkeys(c.chain for c in (found.described, *shown))
    each = ((reference(chain), cost.setups_of(chain.structure)) for chain in chains)
    return tuple(
        (name, " and ".join(setup.text for setup in setups[1:]))
        for name, setups in each
        if setups != cost.setups
    )


def _is_joint(found: Selection) -> bool:
    return len(found.task.cost.parts) > 1


def _of_each(cost: AnyCost) -> list[str]:
    """Which response, where there are several."""
    return [""] if len(cost.setups) == 1 else [f" of {setup.text}" for setup in cost.setups]


def _suspicious(cost: AnyCost) -> Iterator[str]:
    """What looks wrong in the data."""
    for part, of in zip(cost.parts, _of_each(cost), strict=True):
        yield from (f"{of[4:]}: {said}" if of else said for said in part.measured.suspicions)


def _doubled(found: Selection) -> Iterator[str]:
    """Test data that are the training data once more."""
    train = found.task.cost.measured
    if found.test is not train and found.test == train:
        yield (
            "training and test data are the same numbers: nothing is validated; measure again, or"
            " leave --test away"
        )


def _bad(found: Selection) -> tuple[str, ...]:
    """Single lines that make most of a misfit."""
    if found.explanation.explains and not found.better:
        return ()
    said = bad_lines(found.candidates, found.described, found.task)
    return () if said is None else (said,)


def _doubts(found: Selection) -> Iterator[str]:
    """What contradicts the standard deviations of the data."""
    if found.explanation.scatter.doubt:
        yield found.explanation.scatter.doubt


def _verdict(found: Selection) -> str:
    """The first line."""
    said, best = found.explanation, reference(found.described.chain)
    scattered = (
        f"the lines scatter by {100 * said.scatter.typical:.2g} %, known from {said.scatter.source}"
    )
    size = f"chi2 per line {said.chi2:.3g}, 1 is noise alone; {scattered}"
    if said.explains:
        return f"{best} explains this data ({size})"
    if said.noisy:
        return (
            f"none of the candidates explains this data: it is mostly noise, only"
            f" {100 * said.scatter.clear:.0f} % of the lines scatter by less than 20 %"
            f" ({said.scatter.source}); the best one is {best}"
        )
    which = "none of the candidates"
    if any(c.chi2 <= allowed(said.scatter) for c in found.candidates):
        which = "none of the candidates that may be selected"
    return f"{which} explains this data; the best one is {best} ({size})"


def _explained(found: Selection) -> Iterator[str]:
    yield from _better(found)
    if found.selected is None:
        yield (
            "no candidate is selected: by the criteria that you asked for, this data leaves some"
            " parameters of each candidate undetermined; all values are printed"
        )
    others, more = [m.name for m in found.members[1:]], len(found.containing)
    larger = (
        f"{more} more that contain{'s' * (more == 1)} one of these, with elements that this data"
        " does not determine"
    )
    if others:
        yield f"not excluded by this data either: {_listed(others)}" + f"; {larger}" * bool(more)
    elif found.members:
        beside = f", but {larger.replace('one of these', 'it')}" * bool(more)
        yield f"this data excludes every other candidate{beside}"
    for m in [m for m in found.members if m.twins][:1]:
        same = list(dict.fromkeys(t.name for t in m.twins))
        yield (
            f"if it is {m.name}, it may as well be {_listed(same)}: no experiment with this force"
            f" and {'these sensors and states' if _is_joint(found) else 'sensor'} can tell"
        )
    yield from (_disagreeing(m.disagreements) for m in found.members[:1] if m.disagreements)
    yield from (*_changed(found), *_hanging(found), *_weak(found), *_doubts(found))


def _unexplained(found: Selection) -> Iterator[str]:
    if found.explanation.misses:
        yield f"missed most at {', at '.join(m.sentence for m in found.explanation.misses)}"
    if _bad(found):
        yield from _bad(found)
    elif found.readings:
        yield f"what would fit better: {'; '.join(r.sentence for r in found.readings)}"
    elif _is_joint(found):
        yield (
            "fit each response alone: where a structure explains one but not all, a place or a sign"
            " is wrong, or the machine changed between the measurements"
        )
    elif not found.explanation.noisy and not found.quantities:
        loop = "is the loop closed, " * any(FOLLOWS in said for said in _said(found))
        yield (
            "no other sensor quantity or sign, no other place of force and sensor and no further"
            f" mass explains it: {loop}is the machine a chain, are other forces at work?"
        )
    yield from _band(found)
    yield from _better(found)


def _said(found: Selection) -> tuple[str, ...]:
    """What the reader says of the data."""
    data = found.task.cost.measured
    return (*data.notes, *data.suspicions)


def _band(found: Selection) -> Iterator[str]:
    """The frequencies that carry information, where many others do not."""
    data = found.judging.parts[0].measured
    rho = found.explanation.scatter.rho[: len(data)]
    clear = np.flatnonzero(median_filter(rho, SMOOTHED, mode="nearest") < CLEAR)
    runs = np.split(clear, np.flatnonzero(np.diff(clear) > 1) + 1)
    longest = max(runs, key=len)
    if len(longest) >= FEWEST and found.explanation.scatter.clear < MOST_CLEAR:
        low, high = (data.frequency[i] for i in (longest[0], longest[-1]))
        yield (
            f"from {low:.4g} to {high:.4g} Hz the lines scatter by less than {100 * CLEAR:.0f} %:"
            f" --band {low * 0.999:.4g}..{high * 1.001:.4g} fits these alone"
        )


def _better(found: Selection) -> Iterator[str]:
    """The excluded candidate that fits better than the selected one."""
    if found.selected is None or not found.better:
        return
    best, more = found.better[0], len(found.better) - 1
    others = f" ({more} more)" if more else ""
    yield (
        f"{reference(best.chain)}{others} fits better, J = {best.j_test:.3g} instead of"
        f" {found.selected.j_test:.3g}, but is not admissible: {'; '.join(best.reasons)}"
    )


def _disagreeing(both: tuple[Disagreement, ...]) -> str:
    """Parameters that training and test give differently."""
    values = ", ".join(
        f"{d.name} ({d.train:.3g} and {d.test:.3g}, {d.distance:.2g} standard errors apart)"
        for d in both
    )
    return (
        f"training and test data disagree on {values}: the model misses something, for example"
        " friction that changes with the amplitude; trust neither interval"
    )


def _changed(found: Selection) -> Iterator[str]:
    """A machine that is not the same in both measurements."""
    setups = found.task.cost.setups
    tests = zip(partners(found.task.cost, found.judging), found.judging.parts, strict=True)
    for k, (train, judged) in enumerate(tests):
        test, at = judged.measured, setups.index(found.judging.setups[k])
        of = _of_each(found.judging)[k]
        fitted = [response_of(found.described, found.task, d.omega, at) for d in (train, test)]
        known = [scatter(d, [own]) for d, own in zip((train, test), fitted, strict=True)]
        tau = changed(train, test, *known)
        if tau:
            own = max(one.typical for one in known)
            yield (
                f"training and test data{of} differ by {100 * tau:.2g} % a line beyond their"
                f" scatter of {100 * own:.2g} %: the machine changed between them, for example its"
                " friction with the amplitude"
            )


def _hanging(found: Selection) -> Iterator[str]:
    """Residuals that hang together: what is left is not noise."""
    candidate, cost = found.described, found.task.cost
    there = found.task.plant(candidate.chain)
    values = [candidate.estimate.parameters[n] for n in found.task.names(candidate.chain)]
    size = correlations(cost, cost.residual(there.response(np.array(values))))
    if size > HANGING and found.explanation.explains:
        yield (
            f"residuals of neighbouring lines are correlated by {size:.2f} on the training data:"
            " the model misses something small; the standard errors allow for it"
        )


def _weak(found: Selection) -> Iterator[str]:
    """Parameters of the selected candidate that are known badly."""
    if found.selected is None:
        return
    wide = found.members[0].intervals if found.members else {}
    loose = {n: e for n, e in found.selected.practical.relative_errors.items() if not e <= KNOWN}
    said = [
        f"{n} {limits_in_words(*wide[n])}" if n in wide and not e <= FROM_ZERO else _loose(n, e)
        for n, e in loose.items()
    ]
    if said:
        yield f"known badly: {', '.join(said)}"


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


def _listed(names: list[str]) -> str:
    more = len(names) - FEW
    return ", ".join(names[:FEW]) + (f" and {more} more" if more > 0 else "")
