"""Result of a selection, and the certainty of its values and criteria.

With g = d ln G / d ln p, shape (n_p,) at each frequency, ln |G| and arg G have by the chain rule
the standard errors

    s_1 = sqrt(Re g' C Re g),    s_2 = sqrt(Im g' C Im g)    [1, rad]

with the covariance C of the logarithms of the parameters from which their own standard errors
follow (`covariance`): the band |G| exp(-+1.96 s_1), arg G -+ 1.96 s_2 holds the true response at
each frequency with 95 %, if the structure is the true one.

What each criterion alone does at every threshold (Figs 5 to 8), and profiles of single
parameters.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from disting.errors import InputError, short
from disting.fit.judge.admissible import Rule
from disting.fit.judge.alternatives import Alternative
from disting.fit.judge.candidate import Candidate
from disting.fit.judge.explanation import Explanation
from disting.fit.judge.members import Member
from disting.fit.judge.outside import Outside
from disting.fit.judge.readings import QuantityReading, Reading, question
from disting.fit.results.loop import Controller
from disting.fit.results.reliance import Statement
from disting.fit.search.candidates import reference
from disting.fit.search.descent import fine
from disting.fit.search.estimate import Task
from disting.fit.search.joint import AnyCost
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain
from disting.model.presentation import NotebookTable, plural, summary
from disting.statistics.practical import Thresholds, standard_errors

CRITERIA = ("condition_index", "importance_ratio", "collinearity")
STEPS = 200  # thresholds from 1 to 10000
PROFILE = 3.0  # standard errors on either side
POINTS = 15
ROUNDING = 1e-12  # share of a response below which its changes are rounding


@dataclass(frozen=True, eq=False)
class Sweep:
    """One criterion alone: at each threshold N_p of the best candidate (0: none fulfils it) and
    how many fulfil it.
    """

    criterion: str
    thresholds: Real
    n_parameters: Real
    fulfilling: Real

    def __repr__(self) -> str:
        return summary(self, f"{self.criterion}, {plural(len(self.thresholds), 'threshold')}")


def sweep(candidates: Sequence[Candidate], criterion: str) -> Sweep:
    """Thresholds from 1 to 10000; the best candidate is the one with the lowest test cost. Raises
    InputError for another criterion.
    """
    if criterion not in CRITERIA:
        raise InputError(f"the criteria are {', '.join(CRITERIA)}, not {short(criterion)}")
    ordered = sorted(candidates, key=lambda c: c.order)
    values = np.array([getattr(c.practical, criterion) for c in ordered])
    sizes = np.array([c.n_parameters for c in ordered])
    thresholds = np.geomspace(1.0, 1e4, STEPS)
    holds = values[None, :] <= thresholds[:, None]
    best = np.where(holds.any(axis=1), sizes[holds.argmax(axis=1)], 0)
    return Sweep(criterion, thresholds, best, holds.sum(axis=1))


@dataclass(frozen=True, eq=False)
class Profile:
    """Smallest cost J over all other parameters at each value of one; flat: the data do not
    determine it.
    """

    name: str
    values: Real
    costs: Real

    def __repr__(self) -> str:
        return summary(self, f"{self.name}, {self.values[0]:.4g} to {self.values[-1]:.4g}")


def profile(candidate: Candidate, task: Task, name: str, span: float = 0.0) -> Profile:
    """Profile of a fitted parameter, `span` of its logarithm to either side; 0: three standard
    errors, at most a factor 10. Raises InputError for a parameter that was not fitted.
    """
    if name not in candidate.practical.names:
        raise InputError(
            f"{name} is not a fitted parameter of this candidate; they are"
            f" {', '.join(candidate.practical.names)}"
        )
    names = task.names(candidate.chain)
    best = np.array([candidate.estimate.parameters[n] for n in names])
    width = span or min(PROFILE * candidate.practical.relative_errors[name], float(np.log(10)))
    steps = np.linspace(-width, width, POINTS)
    at, costs = names.index(name), np.empty(POINTS)
    for order in (np.flatnonzero(steps >= 0), np.flatnonzero(steps < 0)[::-1]):
        point = best
        for i in order:  # each from its neighbour's optimum, outwards
            held = replace(task, fixed={**task.fixed, name: float(best[at] * np.exp(steps[i]))})
            point, costs[i] = fine(held.plant(candidate.chain), task.cost, held.box(names), point)
    return Profile(name, best[at] * np.exp(steps), costs)


@dataclass(frozen=True, slots=True, eq=False)
class Confidence:
    """Standard errors of ln |G| and of arg G [rad] of a model, shape (n_f,) each; infinite where
    the data do not determine them.
    """

    amplitude: Real
    phase: Real


def response_of(candidate: Candidate, task: Task, omega: Real, at: int = 0) -> Complex:
    """Fitted response, shape (n_f,), at angular frequencies [rad/s], with the sign of the fit;
    `at` = which one of several.
    """
    plant = task.plant(candidate.chain).at(omega, at)
    return plant.response(_values(candidate, task))


def confidence(candidate: Candidate, task: Task, omega: Real, at: int = 0) -> Confidence:
    """Standard errors of the fitted response at angular frequencies [rad/s]; zero where all
    parameters are given.
    """
    p, free = _values(candidate, task), task.box(task.names(candidate.chain)).free
    if not free.any():
        return Confidence(np.zeros(len(omega)), np.zeros(len(omega)))
    plant = task.plant(candidate.chain)
    columns = task.cost.of(plant, p)[1][:, free]
    slopes = (plant.at(omega, at).logarithmic_gradient(p)[1] * p[:, None])[free].T
    both = np.concatenate([slopes.real, slopes.imag])
    errors = standard_errors(both, columns, candidate.noise, candidate.practical.rank)
    return Confidence(*np.split(errors, 2))


def fit_percent(
    candidate: Candidate, task: Task, measured: FrequencyResponse, at: int = 0
) -> float:
    """100 (1 - |G - G_m| / |G - mean G|) over the lines, G measured and G_m fitted, norms over the
    complex numbers; `at` = which of several responses.

    The normalised root mean square that MATLAB's `compare` prints: 100 for a perfect fit, 0 for one
    no better than a constant. It weighs lines by their amplitude, so it describes the resonances
    and hardly anything 40 dB below them. Not a number where the data are constant.
    """
    missed = np.linalg.norm(measured.G - response_of(candidate, task, measured.omega, at))
    moved = np.linalg.norm(measured.G - measured.G.mean())
    return (
        float(100 * (1 - missed / moved))
        if moved > ROUNDING * np.linalg.norm(measured.G)
        else float("nan")
    )


def _values(candidate: Candidate, task: Task) -> Real:
    return np.array([candidate.estimate.parameters[name] for name in task.names(candidate.chain)])


if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Selection(NotebookTable):
    """Result of a selection. `selected` is None where no candidate is admissible; candidates in the
    order of the cost on test.

    `explanation` is that of the selected candidate, else of the best one; `members`: the structures
    that the data do not exclude, the selected one first, none where nothing explains the data;
    `containing`: those that contain one of them, which are no rivals: no experiment excludes them
    if the smaller one is true; `readings`: what would fit then; `relied_on`: what holds for all
    members, around which `controller` closes the loop; `better`: candidates that the paper's rule
    does not admit and that would exclude the selected one; `saved` counts the candidates that were
    not fitted because one with the same positive models was (`same_as`, by candidate); `validation`
    is the source of the test cost, `judging` is that cost. Where several responses are fitted,
    `test` is the data of the first one, and `silent` names those that are zero, from which nothing
    is learned. `quantities`: the readings of the data, the assumed quantity first, where others
    explain them equally well; then nothing is selected, and `question` requests the quantity;
    `command`: what reads and fits the same data once more, without the candidates; `outside`:
    machines outside the candidates that explain the data.
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
    quantities: tuple[QuantityReading, ...] = ()
    command: str = ""
    outside: tuple[Outside, ...] = ()

    def __repr__(self) -> str:
        nothing = "the sensor quantity is open" if self.question else "none is admissible"
        text = nothing if self.selected is None else reference(self.selected.chain)
        members = f", {len(self.members)} not excluded" if self.members else ""
        return summary(self, f"{text} of {plural(len(self.candidates), 'candidate')}{members}")

    def plot(self, ax: "Axes | Sequence[Axes] | None" = None) -> tuple["Axes", ...]:
        """Bode diagram with matplotlib: the data on test, and the structures that they do not
        exclude, else the best one. `ax` and what is returned as in `FrequencyResponse.plot`.
        """
        return tuple(self._presenter.plot(self, ax, {}))

    @property
    def question(self) -> str:
        """The sentence that requests the sensor quantity where the data are explained and do not
        settle it; "" else.
        """
        return question(self.quantities) if self.explanation.is_near and self.quantities else ""

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
