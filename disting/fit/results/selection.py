"""What a selection found: the structures that the data do not exclude, the selected one among them,
and what all of them rest on.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from disting.fit.judge.admissible import Rule
from disting.fit.judge.alternatives import Alternative
from disting.fit.judge.candidate import Candidate
from disting.fit.judge.explanation import Explanation
from disting.fit.judge.members import Member
from disting.fit.judge.practical import Thresholds
from disting.fit.judge.readings import Reading
from disting.fit.results.loop import Controller
from disting.fit.results.reliance import Statement
from disting.fit.search.candidates import reference
from disting.fit.search.estimate import Task
from disting.fit.search.joint import AnyCost
from disting.measurement import FrequencyResponse
from disting.model.chain import Chain
from disting.model.presentation import Shown, plural, summary

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Selection(Shown):
    """What a selection found. `selected` is None where no candidate is admissible; candidates in
    the order of the cost on test.

    `explanation` is that of the selected candidate, else of the best one; `members`: the
    structures that the data do not exclude, the selected one first, none where nothing explains
    the data; `containing`: those that only contain one of them, with elements that the data do not
    determine; `readings`: what would fit then; `relied_on`: what holds for all members, around
    which `controller` closes the loop; `better`: candidates that the paper's rule does not admit
    and that would exclude the selected one; `saved` counts the candidates that were not fitted
    because one with the same positive models was (`same_as`, by candidate); `validation` says where
    the test cost comes from, `judging` is that cost. Where several responses are fitted, `test` is
    the data of the first one, and `silent` names those that are zero, from which nothing is
    learned. `quantities`: sentences on the sensor quantities that explain the data as well as the
    assumed one; `command`: what reads and fits the same data once more, without the candidates.
    """

    selected: Candidate | None
    candidates: tuple[Candidate, ...]
    alternatives: tuple[Alternative, ...]
    thresholds: Thresholds
    validation: str
    same_as: dict[Chain, Chain]
    rule: Rule
    explanation: Explanation
    members: tuple[Member, ...]
    containing: tuple[Member, ...]
    readings: tuple[Reading, ...]
    relied_on: tuple[Statement, ...]
    controller: Controller | None
    better: tuple[Candidate, ...]
    silent: tuple[str, ...]
    task: Task = field(repr=False)
    test: FrequencyResponse = field(repr=False)
    judging: AnyCost = field(repr=False)
    quantities: tuple[str, ...] = ()
    command: str = ""

    def __repr__(self) -> str:
        found = "none is admissible" if self.selected is None else reference(self.selected.chain)
        left = len(self.members) + len(self.containing)
        members = f", {left} not excluded" if left else ""
        return summary(self, f"{found} of {plural(len(self.candidates), 'candidate')}{members}")

    def plot(self, ax: "Axes | Sequence[Axes] | None" = None) -> tuple["Axes", ...]:
        """Bode diagram with matplotlib: the data on test, and the structures that they do not
        exclude, else the best one. `ax` and what is returned as in `FrequencyResponse.plot`.
        """
        return tuple(self._presenter.plot(self, ax, {}))

    @property
    def described(self) -> Candidate:
        """The candidate that `explanation` is about: the selected one, else the one with the
        lowest cost on test.
        """
        return self.selected or self.candidates[0]

    @property
    def saved(self) -> int:
        """Number of fits that verdicts saved."""
        return len(self.same_as)
