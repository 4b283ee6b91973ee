"""Model selection (section 2.2): fit all candidates, keep those whose parameters the data
determine, take the best.

Among the admissible candidates (`admissible`) the best is the one with the lowest cost J on
independent test data, or, without such data, in cross-validation over the frequency lines. A
candidate with fewer parameters is preferred unless it loses by more than noise explains
(`repeatability`). What comes out is a set, of which one is selected (`members`), after the
question whether any of them explains the data at all (`explained`).
"""

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from math import exp, log
from typing import TYPE_CHECKING

import numpy as np

from disting.errors import InputError
from disting.fit.admissible import Rule, reasons
from disting.fit.alternatives import Alternative, alternatives, limits_of, representatives
from disting.fit.candidates import reference
from disting.fit.cost import Case, Cost
from disting.fit.each import explained, noises, repeatabilities
from disting.fit.estimate import Method, Task, estimates
from disting.fit.explained import LARGEST, Explanation
from disting.fit.joint import AnyCost, Further, JointCost, joint_cost, judging_cost
from disting.fit.judged import FOLDS, Candidate, judged
from disting.fit.members import Member, members
from disting.fit.noise import Noise
from disting.fit.plant import Real
from disting.fit.practical import Seen, Thresholds
from disting.fit.readings import Reading, readings
from disting.fit.repeatability import margin
from disting.fit.scatter import Scatter
from disting.fit.signs import pilot, signed
from disting.fit.together import alternatives_under_all, learning, representatives_under_all
from disting.measurement import FrequencyResponse, are_opposite
from disting.model.chain import Chain
from disting.model.shown import Shown, plural, summary
from disting.store import Store
from disting.verdict import Engine

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST_EXTREME = 1e30  # of a frequency or an amplitude

Progress = Callable[[str, int, int], object]


def silent(what: str, done: int, total: int) -> None:
    """No progress is shown."""


@dataclass(frozen=True)
class Selection(Shown):
    """What a selection found. `selected` is None where no candidate is admissible; candidates in
    the order of the cost on test.

    `explanation` is that of the selected candidate, else of the best one; `members`: the
    structures that the data do not exclude, the selected one first, none where nothing explains
    the data; `readings`: what would fit then; `better`: excluded candidates that fit better than
    the selected one by more than noise. `margin` is what the selected candidate may lose by to the
    best one; `saved` counts the candidates that were not fitted because one with the same positive
    models was (`same_as`, by candidate); `validation` says where the test cost
    comes from, `judging` is that cost. Where several responses are fitted, `test` is the data of
    the first one, and `silent` names those that are zero, from which nothing is learned.
    """

    selected: Candidate | None
    candidates: tuple[Candidate, ...]
    alternatives: tuple[Alternative, ...]
    thresholds: Thresholds
    repeatability: Scatter
    margin: float
    validation: str
    same_as: dict[Chain, Chain]
    rule: Rule
    explanation: Explanation
    members: tuple[Member, ...]
    readings: tuple[Reading, ...]
    better: tuple[Candidate, ...]
    silent: tuple[str, ...]
    task: Task = field(repr=False)
    test: FrequencyResponse = field(repr=False)
    judging: AnyCost = field(repr=False)

    def __repr__(self) -> str:
        found = "none is admissible" if self.selected is None else reference(self.selected.chain)
        members = f", {len(self.members)} not excluded" if self.members else ""
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


def select(
    train: FrequencyResponse,
    candidates: Sequence[Chain],
    *,
    test: FrequencyResponse | None = None,
    further: Sequence[Further] = (),
    alike: bool = False,
    thresholds: Thresholds | None = None,
    rule: Rule = Rule.DETERMINED,
    case: Case = Case.LOGARITHM,
    weights: tuple[float, float] | None = None,
    lines: Callable[[FrequencyResponse], Real] | None = None,
    sign: int = 1,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    fixed: Mapping[str, float] | None = None,
    seed: str = "disting",
    prune: bool = True,
    method: Method | None = None,
    engine: Engine | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Selection:
    """Fit `candidates` to `train` and select one, by a rule for what is admissible.

    `weights` of amplitude and phase, see `Cost`; `lines` gives each line's weight, such as
    `lines_by_deviation`; `sign` -1: the sensor is reversed, 0: whichever fits better. `bounds` and
    `fixed` by parameter name. `prune`: candidates with the same positive models, within `bounds`
    and `fixed`, are fitted once; `method` as in `estimates`. An engine with a store resumes
    interrupted work. Raises InputError.

    `further`: responses of the same machine that are fitted together with `train`, one parameter
    vector for all; each counts in units of its own scatter, line by line as much as the others if
    `alike` (`joint_cost`). Candidates without their places are left out, and a response that is
    zero in every candidate: nothing is learned from it.
    """
    _check(train, test, candidates)
    _check_further(test, further)
    candidates, further, silent = learning(candidates, further)
    engine = engine or Engine(store=Store.none())
    alone = Cost(train, case, weights, lines(train) if lines else None)
    cost = joint_cost(alone, further, lines, alike)
    task = Task(cost, sign or 1, bounds or {}, fixed or {}, seed)
    task = task if sign else signed(task, candidates)
    seen_by = pilot(task, candidates)
    if isinstance(task.cost, JointCost):
        weighed = joint_cost(alone, further, lines, alike, seen_by(task.cost))
        task = replace(task, cost=replace(task.cost, parts=weighed.parts))
    cost = task.cost
    within = limits_of(task.bounds, task.fixed)
    first = representatives(candidates, engine, within) if prune else {c: c for c in candidates}
    # what stands for another in the first response need not do so in the others
    first = representatives_under_all(first, cost.setups, within)
    wanted = [c for c in candidates if first[c] == c]
    found = estimates(
        wanted, task, method=method, store=engine.store, executor=executor, progress=progress
    )
    test_cost = judging_cost(cost, test, further, lines, alike, seen_by) if test else None
    judging = test_cost or cost
    fitted, seen = judged({c: found[c] for c in wanted}, task, test_cost, engine.settings)
    limits = thresholds or Thresholds()
    fitted = _weighted([replace(c, reasons=reasons(c, task, limits, rule)) for c in fitted], task)
    typical = repeatabilities(cost, judging, _best(fitted).residual)
    choice = _choice(fitted, judging, seen, typical, rule)
    selected, described = choice.selected, choice.selected or fitted[0]
    said = explained(judging, described.residual, described.missed, seen)
    hopeless = not (said.explains or said.noisy or further)
    return Selection(
        selected=selected,
        candidates=tuple(fitted),
        alternatives=(
            alternatives_under_all(
                selected.chain,
                alternatives(selected.chain, candidates, engine, within),
                cost.setups,
                engine,
                within,
            )
            if selected
            else ()
        ),
        thresholds=limits,
        repeatability=typical,
        margin=choice.margin,
        validation=(
            "test data" if test else f"{FOLDS}-fold cross-validation over the frequency lines"
        ),
        same_as={c: other for c, other in first.items() if c != other},
        rule=rule,
        explanation=said,
        members=members(
            choice.near if said.explains else (), task, test_cost, within, executor, progress
        ),
        readings=(
            readings(fitted, task, store=engine.store, executor=executor, progress=progress)
            if hopeless
            else ()
        ),
        better=choice.better,
        silent=tuple(silent),
        task=task,
        test=test or train,
        judging=judging,
    )


def _check(
    train: FrequencyResponse, test: FrequencyResponse | None, candidates: Sequence[Chain]
) -> None:
    if not candidates:
        raise InputError("a selection needs at least one candidate")
    _check_pair(train, test)
    other = {c.sensor for c in candidates} - {train.sensor}
    if other:
        raise InputError(
            f"the data shows {train.sensor.value}, a candidate {other.pop().value}; choose one"
            " sensor quantity"
        )
    for data in filter(None, (train, test)):
        _check_units(data)


def _check_pair(train: FrequencyResponse, test: FrequencyResponse | None) -> None:
    if test is not None and test.sensor is not train.sensor:
        raise InputError(
            f"training shows {train.sensor.value}, test {test.sensor.value}; convert one of them"
        )
    if test is not None and are_opposite(train, test):
        raise InputError(
            "training and test are of opposite sign; reverse one of them, as by sign_reversed()"
        )


def _check_units(data: FrequencyResponse) -> None:
    """Numbers whose squares and products floating point holds; beyond these no unit of
    measurement is sensible.
    """
    for name, values, unit in (
        ("frequencies", data.omega, "rad/s"),
        ("amplitudes", np.abs(data.G), "output per input"),
    ):
        low, high = float(values.min()), float(values.max())
        if low < 1 / MOST_EXTREME or high > MOST_EXTREME:
            limits = f"a fit computes with {1 / MOST_EXTREME:g} to {MOST_EXTREME:g}"
            raise InputError(
                f"the {name} are {low:g} to {high:g} {unit}; {limits}: choose other units or leave"
                " lines out"
            )


def _check_further(test: FrequencyResponse | None, further: Sequence[Further]) -> None:
    """The same of further responses, each against its own test data."""
    for one in further:
        if one.test is not None and test is None:
            raise InputError("test data of a further response need test data of the first one too")
        pair = (one.measured, one.test)
        _check_pair(*pair)
        for data in filter(None, pair):
            _check_units(data)


def _weighted(candidates: list[Candidate], task: Task) -> list[Candidate]:
    """Akaike weights among the admissible ones: exp(-AIC/2), AIC = sum n_y ln(J/n_y) + 2 N_p over
    the responses, each with its own variance; in all 1.
    """
    criteria = {
        c.chain: sum(n_y * log(max(j, 1e-300) / n_y) for j, n_y in _costs(c, task))
        + 2 * c.n_parameters
        for c in candidates
        if c.admissible
    }
    lowest = min(criteria.values(), default=0.0)
    sizes = {chain: exp((lowest - value) / 2) for chain, value in criteria.items()}
    total = sum(sizes.values())
    return [
        replace(c, akaike_weight=sizes[c.chain] / total) if c.chain in sizes else c
        for c in candidates
    ]


def _costs(candidate: Candidate, task: Task) -> list[tuple[float, int]]:
    """Cost on the training data and number of residuals of each response."""
    cost = task.cost
    if isinstance(cost, Cost):
        return [(candidate.j_train, cost.n_residuals)]
    p = np.array([candidate.estimate.parameters[n] for n in task.names(candidate.chain)])
    each = cost.by_residual(cost.residual(task.plant(candidate.chain).response(p)))
    return [(float(own @ own), own.size) for own in each]


@dataclass(frozen=True)
class _Choice:
    """`near`: candidates that lose to the best by no more than noise explains, the selected one
    first; `margin` and `better` as in `Selection`.
    """

    selected: Candidate | None
    near: tuple[Candidate, ...]
    margin: float
    better: tuple[Candidate, ...]


def _choice(
    fitted: Sequence[Candidate], cost: AnyCost, seen: Scatter, typical: Scatter, rule: Rule
) -> _Choice:
    """Which candidate is selected, and what stands beside it; `fitted` in the order of J on
    test, `cost` that on test.
    """
    kept = [c for c in fitted if c.admissible]
    if not kept:
        return _Choice(None, (), 0.0, ())
    sigma = cost.scatter(seen.rho)
    there = _left(kept[0], sigma, cost)
    selected, allowed = _simplest(
        kept, Noise(cost.scatter(typical.rho)) if rule is Rule.PAPER else there
    )
    near = [
        c for c in kept if c.j_test <= kept[0].j_test + margin(c.residual, kept[0].residual, there)
    ]
    return _Choice(
        selected,
        (selected, *(c for c in near if c is not selected)),
        allowed,
        _better(selected, fitted, sigma, cost),
    )


def _best(fitted: Sequence[Candidate]) -> Candidate:
    """The admissible candidate with the lowest J on test; of all, where none is admissible."""
    return next((c for c in fitted if c.admissible), fitted[0])


def _simplest(kept: Sequence[Candidate], noise: Seen) -> tuple[Candidate, float]:
    """The candidate with the fewest parameters that loses to the best by no more than its
    margin; then the lower cost.
    """
    best = kept[0]
    allowed = {c.chain: margin(c.residual, best.residual, noise) for c in kept}
    near = [
        c
        for c in kept
        if c is best
        or (c.n_parameters < best.n_parameters and c.j_test <= best.j_test + allowed[c.chain])
    ]
    winner = min(near, key=lambda c: (c.n_parameters, c.j_test))
    return winner, allowed[winner.chain]


def _better(
    selected: Candidate, fitted: Sequence[Candidate], sigma: Real, cost: AnyCost
) -> tuple[Candidate, ...]:
    """Excluded candidates that win against the selected one by more than their margin, those with
    few parameters first.

    The margin is that of the noise which they leave: what the selected one misses beside is no
    noise.
    """
    lower = [c for c in fitted if not c.admissible and c.j_test < selected.j_test]
    found = [
        c
        for c in lower
        if c.j_test < selected.j_test - margin(c.residual, selected.residual, _left(c, sigma, cost))
    ]
    return tuple(sorted(found, key=lambda c: (c.n_parameters, c.j_test)))


def _left(candidate: Candidate, sigma: Real, cost: AnyCost) -> Seen:
    """What a candidate leaves of the judged data, whose residuals scatter by `sigma`: what
    misses them widely is no noise.
    """
    if candidate.chi2 > LARGEST:
        return Noise(sigma)
    return noises(cost, candidate.residual, sigma, candidate.missed)
