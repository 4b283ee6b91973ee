"""What an engineer has to know of a selection, in sentences: the truth first, then what is
suspicious. The commands that lead on: `links`.

Structures are named as the commands read them, such as 2:1+b2+delay.
"""

from collections.abc import Iterator

from disting.fit.judge.explanation import BESIDE, Explanation, Level, noise_limit
from disting.fit.judge.reading import outside
from disting.fit.results.selection import Selection
from disting.fit.search.candidates import reference
from disting.measurement.time_series import FOLLOWS
from disting.report.fit.doubts import (
    bad,
    better,
    clear_band,
    correlated_residuals,
    differing_parameters,
    doubtful_deviations,
    machine_change,
    nonlinearity,
    same_data_twice,
    suspicious_data,
    unseen,
    weak,
)

FEW = 8  # names in one line


def first_lines(selection: Selection) -> tuple[str, ...]:
    """At most five lines: does anything explain the data, what is selected, what else may it
    be, what is suspicious. Where the sensor quantity is open, the question for it alone.
    """
    if selection.question:
        return (*nonlinearity(selection), selection.question, *same_data_twice(selection))
    return (
        *nonlinearity(selection),
        *machine_change(selection),
        _verdict(selection),
        *same_data_twice(selection),
        *_other_quantities(selection),
        *(_explained(selection) if selection.explanation.explains else _unexplained(selection)),
    )[:5]


def suspicions(selection: Selection) -> tuple[str, ...]:
    """Sentences on what looks wrong, each with what it means; the gravest first, empty where
    nothing does.
    """
    if selection.question:
        cost = selection.task.cost
        first = (*nonlinearity(selection), selection.question)
        return (*first, *same_data_twice(selection), *suspicious_data(cost))
    said = [
        *nonlinearity(selection),
        *machine_change(selection),
        *_other_quantities(selection),
        *(
            []
            if selection.explanation.explains
            else [_verdict(selection), *_unexplained(selection)]
        ),
        *better(selection),
        *(differing_parameters(m.disagreements) for m in selection.members[:1] if m.disagreements),
        *correlated_residuals(selection),
        *weak(selection),
        *outside(selection.described, selection.task.cost.measured),
        *unseen(selection),
        *same_data_twice(selection),
        *bad(selection),
        *doubtful_deviations(selection),
        *suspicious_data(selection.task.cost),
        *uninformative(selection),
    ]
    return tuple(dict.fromkeys(said))


def quantity_rows(selection: Selection) -> list[tuple[str, ...]]:
    """A head and a row for each quantity under which the data are explained."""
    rows = [
        (
            f"{r.quantity.value}{' (assumed)' if r.is_assumed else ''}",
            r.name,
            str(len(r.found.parameters)),
            f"{r.chi2:.3g}",
            "its lag integrates over the whole band" if r.integrates else "",
        )
        for r in selection.quantities
    ]
    return [("read as", "structure", "parameters", "chi2 per line", ""), *rows]


def _other_quantities(selection: Selection) -> Iterator[str]:
    """Other quantities under which the data, which the assumed one does not explain, would be."""
    for reading in selection.quantities[1:]:
        wanted, assumed = reading.quantity.value, selection.quantities[0].quantity.value
        yield (
            f"read {reading.sentence}: that it is {assumed} is assumed; give"
            f" --quantity {wanted}, or --quantity {assumed}"
        )


def uninformative(selection: Selection) -> tuple[str, ...]:
    """Responses from which nothing is learned, in sentences."""
    return tuple(
        f"{what}: that response is zero whatever the parameters, so nothing is learned from it"
        for what in selection.silent
    )


def which_mass(selection: Selection) -> tuple[str, ...]:
    """Where further responses are in structures that have other places, in sentences."""
    return tuple(
        f"in {name} this is {other_name}: of all its masses these fit best"
        for name, other_name in places(selection)
    )


def places(selection: Selection) -> tuple[tuple[str, str], ...]:
    """Names of the structures that are left, or best, in which further responses have other places
    than they are named by, and these places.
    """
    cost, shown = (
        selection.task.cost,
        [m.candidate for m in (*selection.members, *selection.containing)],
    )
    chains = dict.fromkeys(c.chain for c in (selection.described, *shown))
    each = ((reference(chain), cost.setups_of(chain.structure)) for chain in chains)
    return tuple(
        (name, " and ".join(setup.text for setup in setups[1:]))
        for name, setups in each
        if setups != cost.setups
    )


def _is_joint(selection: Selection) -> bool:
    return len(selection.task.cost.parts) > 1


def _verdict(selection: Selection) -> str:
    """The first line."""
    said, best = selection.explanation, reference(selection.described.chain)
    scattered = (
        f"the lines scatter by {100 * said.scatter.typical:.2g} %, known from {said.scatter.source}"
    )
    size = f"chi2 per line {said.chi2:.3g}, 1 is noise alone; {scattered}"
    if said.level is Level.EXPLAINS:
        return f"{best} explains this data ({size})"
    if said.explains:
        return f"{best} explains this data apart from {misfit_in_words(said)} ({size})"
    if said.too_few:
        return (
            f"{said.lines} lines are too few to judge {best}, the best candidate: at least"
            f" {said.needed} are needed, two for each of its parameters and {BESIDE} more"
        )
    if said.noisy:
        return (
            f"none of the candidates explains this data: it is mostly noise, only"
            f" {100 * said.scatter.clear:.0f} % of the lines scatter by less than 20 %"
            f" ({said.scatter.source}); the best one is {best}"
        )
    which = "none of the candidates"
    if any(c.explains(said.scatter) for c in selection.candidates):
        which = "none of the candidates that may be selected"
    return f"{which} explains this data; the best one is {best} ({size})"


def misfit_in_words(said: Explanation) -> str:
    """What a structure misses that explains the data apart from it."""
    if said.misses:
        return "; ".join(m.sentence for m in said.misses)
    most = noise_limit(said.scatter)
    return f"small differences over the band: noise alone stays below a chi2 of {most:.2g}"


def _explained(selection: Selection) -> Iterator[str]:
    yield from better(selection)
    if selection.selected is None:
        yield (
            "no candidate is selected: by the criteria that you asked for, this data leaves some"
            " parameters of each candidate undetermined; all values are printed"
        )
    others, more = [m.name for m in selection.members[1:]], len(selection.containing)
    contain = f"{more} more that contain{'s' if more == 1 else ''}"
    if others:
        larger = f"{contain} one of these, which no experiment excludes if the smaller one is true"
        yield f"not excluded by this data either: {_listed(others)}{f'; {larger}' if more else ''}"
    elif selection.members:
        larger = f", but {contain} it, which no experiment excludes if it is true"
        yield f"this data excludes every other candidate{larger if more else ''}"
    for m in [m for m in selection.members if m.twins][:1]:
        same = list(dict.fromkeys(t.name for t in m.twins))
        yield (
            f"if it is {m.name}, it may as well be {_listed(same)}: no experiment with this force"
            f" and {'these sensors and states' if _is_joint(selection) else 'sensor'} can tell"
        )
    yield from (
        differing_parameters(m.disagreements) for m in selection.members[:1] if m.disagreements
    )
    yield from (
        *lone(selection),
        *correlated_residuals(selection),
        *weak(selection),
        *doubtful_deviations(selection),
    )


def lone(selection: Selection) -> Iterator[str]:
    """Structures whose gain rests on single lines, in a sentence."""
    resting = [(c, c.rests_on) for c in selection.candidates if c.rests_on is not None]
    for c, lines in resting[:1]:
        more = f"; so do {len(resting) - 1} more" if len(resting) > 1 else ""
        yield (
            f"what {reference(c.chain)} adds {lines.sentence}{more}: that is not shown by the data"
            " and excludes no other structure"
        )


def _unexplained(selection: Selection) -> Iterator[str]:
    if selection.explanation.misses:
        yield f"missed most at {', at '.join(m.sentence for m in selection.explanation.misses)}"
    if bad(selection):
        yield from bad(selection)
    elif selection.readings:
        yield f"what would fit better: {'; '.join(r.sentence for r in selection.readings)}"
    elif _is_joint(selection):
        yield (
            "fit each response alone: where a structure explains one but not all, a place or a sign"
            " is wrong, or the machine changed between the measurements"
        )
    elif not selection.explanation.noisy and not selection.quantities:
        loop = "is the loop closed, " if any(FOLLOWS in said for said in _said(selection)) else ""
        yield (
            "no other sensor quantity or sign, no other place of force and sensor and no further"
            f" mass explains it: {loop}is the machine a chain, are other forces at work?"
        )
    yield from clear_band(selection)
    yield from better(selection)


def _said(selection: Selection) -> tuple[str, ...]:
    """What the reader says of the data."""
    data = selection.task.cost.measured
    return (*data.notes, *data.suspicions)


def _listed(names: list[str]) -> str:
    more = len(names) - FEW
    return ", ".join(names[:FEW]) + (f" and {more} more" if more > 0 else "")
