"""Rows of the tables of numbers: what a model says about the machine, its parameters, and their
intervals.
"""

from dataclasses import dataclass

from disting.fit.judge.candidate import Candidate
from disting.fit.judge.members import Member
from disting.fit.judge.modes import Result
from disting.fit.search.estimate import Task
from disting.measurement import FrequencyResponse
from disting.report.fit.words import (
    between,
    error_in_percent,
    readable,
    result_unit,
    unit_of,
    with_error,
)


@dataclass(frozen=True, slots=True)
class Row:
    """A row of a table of numbers: what, value, unit, how sure it is (error in percent, or an
    interval), a remark.
    """

    name: str
    value: str
    unit: str
    percent: str
    remark: str = ""


def result_row(found: Result, measured: FrequencyResponse) -> Row:
    """A physical result in the units of the data."""
    share = found.standard_error / abs(found.value) if found.value else 0.0
    low, high = measured.frequency[0], measured.frequency[-1]
    outside = found.unit == "Hz" and not low <= found.value <= high
    remark = "outside the measured band" if outside else ""
    # follows its mode
    what = "its damping ratio" if found.name.startswith("damping ratio") else found.name
    return Row(
        what,
        with_error(found.value, found.standard_error),
        result_unit(found, measured),
        error_in_percent(share),
        remark,
    )


def parameter_rows(candidate: Candidate, task: Task, measured: FrequencyResponse) -> list[Row]:
    """Parameters in the order of the chain."""
    values = candidate.estimate.parameters
    return [
        _parameter(candidate, task, n, value, unit_of(n[0], measured))
        for n, value in values.items()
    ]


def _parameter(candidate: Candidate, task: Task, n: str, value: float, of: str) -> Row:
    if n in task.fixed:
        return Row(n, readable(value, 6), of, "", "fixed")
    share = candidate.practical.relative_errors[n]
    return Row(
        n,
        with_error(value, share * value),
        of,
        error_in_percent(share),
        "at its bound" if n in candidate.at_bound else "",
    )


def intervals(member: Member, measured: FrequencyResponse) -> list[Row]:
    """Values of a member with their intervals of 95 %, those that the test data contradict
    marked; last, what is given.
    """
    apart = {d.name: d for d in member.disagreements}
    values, known = member.candidate.estimate.parameters, member.intervals
    return [
        Row(
            n,
            readable(value, 4 if n in known else 6),
            unit_of(n[0], measured),
            between(*known[n]) if n in known else "given",
            f"{readable(apart[n].test)} on test data" if n in apart else "",
        )
        for n, value in values.items()
    ]
