"""The criteria of a candidate as a report puts them: value, threshold and meaning, what is
least determined, who is nearest.
"""

from dataclasses import dataclass, fields
from math import isfinite

from disting.fit.judge.candidate import Candidate
from disting.fit.judge.practical import Thresholds
from disting.fit.results.selection import Selection
from disting.report.fit.thresholds import TITLES
from disting.report.fit.words import readable

MEANINGS = {
    "condition_index": "how unevenly the data determine combinations of parameters: 1 is best",
    "importance_ratio": (
        "influence of the strongest parameter on the response, divided by that of the weakest"
    ),
    "collinearity": (
        "how far the other parameters can compensate a change of one: 1 not at all, 20 to 95 %"
    ),
}
HEADS = (("jointly", "condition index"), ("weakest", "PII ratio"), ("alike", "collinearity"))
"""The criteria as columns of a table, as `columns` explains them, and their terms."""


def columns(thresholds: Thresholds) -> str:
    """What the columns of `HEADS` say, in one sentence.

    >>> print(columns(Thresholds()).partition(";")[0])
    jointly, some combination of parameters (condition index, critical above 30)
    """
    return (
        "jointly, some combination of parameters (condition index, critical above"
        f" {thresholds.condition_index:g}); weakest, the parameter of the smallest effect, beside"
        f" that of the largest (PII ratio, {thresholds.importance_ratio:g}); alike, one that others"
        f" make up for (collinearity index, {thresholds.collinearity:g})"
    )


@dataclass(frozen=True, slots=True)
class Limit:
    """A criterion of the described candidate and its threshold."""

    title: str
    meaning: str
    value: float
    threshold: float

    @property
    def holds(self) -> bool:
        """Whether it is fulfilled."""
        return self.value <= self.threshold

    @property
    def said(self) -> str:
        """The value; nothing where it is infinite, which the candidate's reasons put in words."""
        return readable(self.value) if isfinite(self.value) else "–"


def nearest(selection: Selection) -> list[Candidate]:
    """Excluded candidates, those first whose worst criterion exceeds its threshold by the
    smallest factor.
    """
    return sorted(
        (c for c in selection.candidates if not c.admissible),
        key=lambda c: _excess(c, selection.thresholds),
    )


def _excess(candidate: Candidate, thresholds: Thresholds) -> float:
    return max(limit.value / limit.threshold for limit in limits(candidate, thresholds))


def limits(candidate: Candidate, thresholds: Thresholds) -> list[Limit]:
    """The three criteria."""
    names = [f.name for f in fields(thresholds)]
    return [
        Limit(TITLES[n], MEANINGS[n], getattr(candidate.practical, n), getattr(thresholds, n))
        for n in names
    ]


def weakest(candidate: Candidate) -> str:
    """The combination of parameters that the data determine least, such as "ln k12 + 0.81 ln
    m2".
    """
    terms = sorted(candidate.practical.worst_direction.items(), key=lambda row: -abs(row[1]))
    texts = [
        ("− " if v < 0 else "+ ") + (f"{abs(v):.2g} " if abs(v) < 0.995 else "") + f"ln {n}"
        for n, v in terms
    ]
    return " ".join(texts).removeprefix("+ ")
