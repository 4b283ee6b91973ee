"""Title area of the page of a fit: the result, three numbers, the rule by which the structure was
chosen.

Rows of the tables of numbers: the results of a model on the machine, its parameters, and their
intervals.

The structures that the data do not exclude, as the page shows them: drawn, with intervals,
links and commands.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from markupsafe import Markup

from disting.fit.judge.admissible import Rule
from disting.fit.judge.candidate import Candidate
from disting.fit.judge.exclusion import LEVEL
from disting.fit.judge.explanation import Level, largest_cost, noise_limit
from disting.fit.judge.mechanics import fold
from disting.fit.judge.members import Member, Twin
from disting.fit.judge.modes import Result
from disting.fit.results.selection import Selection
from disting.fit.search.estimate import Task
from disting.measurement import FrequencyResponse
from disting.report.drawing import draw
from disting.report.fit.doubts import hold
from disting.report.fit.links import Link, Site, Step, step_to, steps_of
from disting.report.fit.look_alikes import is_other
from disting.report.fit.mechanics_words import actuators_in_words, headline
from disting.report.fit.responses import drawing, with_all_sensors
from disting.report.fit.words import (
    between,
    error_in_percent,
    fits_of,
    percent,
    readable,
    result_unit,
    unit_of,
    with_error,
)


@dataclass(frozen=True, slots=True)
class ParameterRow:
    """A row of a table of numbers: what, value, unit, how sure it is (error in percent, or an
    interval), a remark.
    """

    name: str
    value: str
    unit: str
    percent: str
    remark: str = ""


def result_row(result: Result, measured: FrequencyResponse) -> ParameterRow:
    """A physical result in the units of the data."""
    share = result.standard_error / abs(result.value) if result.value else 0.0
    low, high = measured.frequency[0], measured.frequency[-1]
    outside = result.unit == "Hz" and not low <= result.value <= high
    remark = "outside the measured band" if outside else ""
    # follows its mode
    what = "its damping ratio" if result.name.startswith("damping ratio") else result.name
    return ParameterRow(
        what,
        with_error(result.value, result.standard_error),
        result_unit(result, measured),
        error_in_percent(share),
        remark,
    )


def with_others(
    row: ParameterRow, value: float, others: Sequence[tuple[float, ParameterRow]]
) -> ParameterRow:
    """A row with the values of other sets that give the same response, where they differ."""
    more = [f"or {other.value}" for there, other in others if is_other(there, value)]
    return replace(row, remark="; ".join(filter(None, [row.remark, *more])))


def parameter_rows(
    candidate: Candidate, task: Task, measured: FrequencyResponse
) -> list[ParameterRow]:
    """Parameters in the order of the chain."""
    values = candidate.estimate.parameters
    return [
        _parameter(candidate, task, n, value, unit_of(n[0], measured))
        for n, value in values.items()
    ]


def _parameter(candidate: Candidate, task: Task, n: str, value: float, of: str) -> ParameterRow:
    if n in task.fixed:
        return ParameterRow(n, readable(value, 6), of, "", "fixed")
    share = candidate.practical.relative_errors[n]
    return ParameterRow(
        n,
        with_error(value, share * value),
        of,
        error_in_percent(share),
        "at its bound" if n in candidate.at_bound else "",
    )


def intervals(member: Member, measured: FrequencyResponse) -> list[ParameterRow]:
    """Values of a member with their intervals of 95 %, those that the test data contradict
    marked; last, what is given.
    """
    apart = {d.name: d for d in member.disagreements}
    values, intervals = member.candidate.estimate.parameters, member.intervals
    return [
        ParameterRow(
            n,
            readable(value, 4 if n in intervals else 6),
            unit_of(n[0], measured),
            between(*intervals[n]) if n in intervals else "given",
            f"{readable(apart[n].test)} on test data" if n in apart else "",
        )
        for n, value in values.items()
    ]


@dataclass(frozen=True, slots=True)
class Same:
    """A structure that behaves as one of the set does: its drawing, its page in the catalogue,
    how to compare both.
    """

    twin: Twin
    drawing: Markup
    page: Link | None
    step: Step


@dataclass(frozen=True, slots=True)
class ListedStructure:
    """A structure of the set: its drawing, its page in the catalogue, parameters, what behaves
    the same, what comes next; where there are several responses, how much it reproduces of each.
    """

    member: Member
    drawing: Markup
    page: Link | None
    parameters: Sequence[ParameterRow]
    same: Sequence[Same]
    steps: Sequence[Step]
    fits: Sequence[tuple[str, str]]


def list_structures(
    selection: Selection, measured: FrequencyResponse, site: Site | None
) -> list[ListedStructure]:
    """The structures that the data do not exclude, each with those that behave as it does."""
    return [
        ListedStructure(
            m,
            drawing(with_all_sensors(m.candidate.chain, selection)),
            site.page(m.candidate.chain) if site else None,
            intervals(m, measured),
            [
                Same(t, drawing(draw(t.chain)), site.page(t.chain) if site else None, step_to(m, t))
                for t in m.twins
            ],
            steps_of(selection, m),
            fits_of(selection, m.candidate),
        )
        for m in selection.members
    ]


@dataclass(frozen=True, slots=True)
class ListedLine:
    """Structures of the same mechanics: name, what the actuator may add, the best one first."""

    name: str
    adds: str
    structures: Sequence[ListedStructure]


def list_lines(structures: Sequence[ListedStructure]) -> list[ListedLine]:
    """The listed structures, folded to mechanics."""
    each = {shown.member.name: shown for shown in structures}
    return [
        ListedLine(
            line.name,
            actuators_in_words(line.actuators),
            sorted((each[m.name] for m in line.members), key=lambda s: s.member is not line.best),
        )
        for line in fold([shown.member for shown in structures]).lines
    ]


@dataclass(frozen=True, slots=True)
class KeyFigure:
    """A number that matters, and what it means."""

    what: str
    value: str
    meaning: str


@dataclass(frozen=True, slots=True)
class Answer:
    """`title`: what was found."""

    title: str
    numbers: tuple[KeyFigure, ...]
    rule: str


def answer(selection: Selection, results: Sequence[ParameterRow]) -> Answer:
    """The answer of a selection; `results`: the results of the described model on the machine."""
    numbers = (_misfit(selection), _count_left(selection), _third(selection, results))
    return Answer(_title(selection), numbers, _rule(selection))


def _title(selection: Selection) -> str:
    if selection.selected is None:
        return "No model is admissible"
    best = headline(fold(selection.members)) if selection.members else ""
    if selection.explanation.level is Level.EXPLAINS:
        return f"{best}: this explains the measurement"
    if selection.explanation.explains:
        return f"{best}: this explains the measurement apart from a part that it misses"
    if selection.explanation.is_near:
        return f"No fitted structure explains the measurement fully; near it: {best}"
    if selection.explanation.noisy:
        return "The measurement is mostly noise"
    if selection.explanation.too_few:
        return f"{selection.explanation.lines} lines are too few to judge a structure"
    return "No fitted structure explains the measurement"


def _misfit(selection: Selection) -> KeyFigure:
    found = selection.explanation
    meaning = (
        f"chi2 per line: 1 is noise alone, at most {readable(noise_limit(found.scatter), 2)}; above"
        f" {readable(largest_cost(found.scatter), 2)} a structure does not explain the data"
    )
    return KeyFigure("misfit", readable(found.chi2), meaning)


def _count_left(selection: Selection) -> KeyFigure:
    count, of, more = (
        len(each) for each in (selection.members, selection.candidates, selection.containing)
    )
    which = "one of these" if count > 1 else "it"
    beside = f"; {more} more contain{'s' if more == 1 else ''} {which}" if more else ""
    meaning = f"fitted, and not excluded by the data{beside}"
    return KeyFigure("structures left", f"{count} of {of}", meaning)


def _third(selection: Selection, results: Sequence[ParameterRow]) -> KeyFigure:
    """The first resonance; of a model without one how far a line scatters."""
    for row in results:
        if row.name.startswith("resonance"):
            only = hold(selection) and f", {hold(selection)}"
            return KeyFigure(row.name, f"{row.value} {row.unit}", f"value ± standard error{only}")
    scatter = selection.explanation.scatter
    return KeyFigure("scatter", percent(scatter.typical), f"of a line, known from {scatter.source}")


def _rule(selection: Selection) -> str:
    """Rule by which the structure was chosen."""
    left = f"the data do not exclude (level {percent(LEVEL)})"
    if selection.rule is Rule.PAPER:
        left = f"the paper's three criteria admit and {left}"
    return (
        f"Of the structures that {left}, the one with the fewest parameters is taken; of several"
        " with as few, the one with the lowest cost on "
        + (
            "the test data."
            if selection.test is not selection.task.cost.measured
            else "lines that were left out of the fit."
        )
    )
