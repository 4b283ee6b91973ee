"""What an engineer has to know of a selection, in sentences: the truth first, then what is
suspicious. The commands that lead on: `links`.

Structures are named as the commands read them, such as 2:1+b2+delay.
"""

from collections.abc import Iterator

from disting.fit.judge.explanation import allowed
from disting.fit.judge.reading import outside
from disting.fit.results.selection import Selection
from disting.fit.search.candidates import reference
from disting.measurement.time_series import FOLLOWS
from disting.report.fit.doubts import (
    bad,
    better,
    changing,
    clear_band,
    disagreeing,
    doubled,
    doubtful_deviations,
    hanging,
    suspicious_data,
    unseen,
    weak,
)

FEW = 8  # names in one line


def first_lines(found: Selection) -> tuple[str, ...]:
    """At most five lines: does anything explain the data, what is selected, what else may it
    be, what is suspicious.
    """
    return (
        _verdict(found),
        *doubled(found),
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
        *better(found),
        *(disagreeing(m.disagreements) for m in found.members[:1] if m.disagreements),
        *changing(found),
        *hanging(found),
        *weak(found),
        *outside(found.described, found.task.cost.measured),
        *unseen(found),
        *doubled(found),
        *bad(found),
        *doubtful_deviations(found),
        *suspicious_data(found.task.cost),
        *learned(found),
    ]
    return tuple(dict.fromkeys(said))


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
    yield from better(found)
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
    yield from (disagreeing(m.disagreements) for m in found.members[:1] if m.disagreements)
    yield from (*changing(found), *hanging(found), *weak(found), *doubtful_deviations(found))


def _unexplained(found: Selection) -> Iterator[str]:
    if found.explanation.misses:
        yield f"missed most at {', at '.join(m.sentence for m in found.explanation.misses)}"
    if bad(found):
        yield from bad(found)
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
    yield from clear_band(found)
    yield from better(found)


def _said(found: Selection) -> tuple[str, ...]:
    """What the reader says of the data."""
    data = found.task.cost.measured
    return (*data.notes, *data.suspicions)


def _listed(names: list[str]) -> str:
    more = len(names) - FEW
    return ", ".join(names[:FEW]) + (f" and {more} more" if more > 0 else "")
