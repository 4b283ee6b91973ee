"""Model selection (section 2.2): fit all candidates, keep those that the data do not exclude, take
the simplest.

What the data exclude, and which of the others is selected, is told in `choice`, by the residuals on
independent test data where there are such; without them cross-validation over the frequency lines
gives a cost that orders candidates. What comes out is a set, of which one is selected (`members`),
after the question whether any candidate explains the data at all (`explanation`).
"""

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from disting.errors import InputError
from disting.fit.judge.admissible import Rule, reasons
from disting.fit.judge.alternatives import (
    Alternative,
    Limits,
    alternatives,
    limits_of,
    representatives,
)
from disting.fit.judge.candidate import FOLDS, Candidate, judged, witnessed
from disting.fit.judge.choice import akaike_weighted, choice
from disting.fit.judge.explanation import Explanation
from disting.fit.judge.joint_verdicts import (
    alternatives_under_all,
    learning,
    located,
    representatives_under_all,
)
from disting.fit.judge.members import Member, members
from disting.fit.judge.practical import Thresholds
from disting.fit.judge.reading import other_quantities
from disting.fit.judge.readings import Reading, readings
from disting.fit.judge.signs import pilot, signed
from disting.fit.results.loop import Controller
from disting.fit.results.reliance import Statement, statements
from disting.fit.search.candidates import reference
from disting.fit.search.cost import Case, Cost
from disting.fit.search.estimate import Estimate, Method, Task
from disting.fit.search.exchange import SEARCHED, body, estimates, polished
from disting.fit.search.joint import AnyCost, Further, JointCost, joint_cost, judging_cost
from disting.measurement import FrequencyResponse, are_opposite
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain
from disting.model.presentation import Shown, plural, summary
from disting.store import Store
from disting.verdict.engine import Engine

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CROSS_VALIDATION = f"{FOLDS}-fold cross-validation over the frequency lines"
MOST_LINES = 10_000  # of a response that are fitted, unless more are asked for
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


def select(
    train: FrequencyResponse,
    candidates: Sequence[Chain],
    *,
    test: FrequencyResponse | None = None,
    further: Sequence[Further] = (),
    home: Chain | None = None,
    alike: bool = False,
    thresholds: Thresholds | None = None,
    rule: Rule = Rule.NOT_EXCLUDED,
    case: Case | None = None,
    weights: tuple[float, float] | None = None,
    lines: Callable[[FrequencyResponse], Real] | None = None,
    sign: int = 1,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    fixed: Mapping[str, float] | None = None,
    seed: str = "disting",
    prune: bool = True,
    most_lines: int = MOST_LINES,
    controller: Controller | None = None,
    method: Method | None = None,
    engine: Engine | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Selection:
    """Fit `candidates` to `train` and select one, by a rule for what is admissible.

    Parameters are those of the highest likelihood: the search is by logarithms, whose costs have
    few valleys, the last digits are found in the complex plane in units of what each line scatters
    (`Cost.likely`), where noise is normal however small a response is beside it. A cost of the
    paper is kept to the end where one is named: by its `case`, by `weights` of amplitude and phase,
    see `Cost`, by the weights that `lines` gives, such as `lines_by_deviation`, or if all lines
    count `alike`; `sign` -1: the sensor is reversed, 0: whichever fits better. `bounds` and
    `fixed` by parameter name. `prune`: candidates with the same positive models, within `bounds`
    and `fixed`, are fitted once; `most_lines`: of a response with more so many are fitted, and its
    `reading` says so; `controller`: one whose margins are told (`reliance`); `method` as in
    `estimates`. An engine with a store resumes interrupted work. Raises InputError.

    `further`: responses of the same machine that are fitted together with `train`, one parameter
    vector for all; each counts in units of its own scatter (`joint_cost`). Candidates without their
    places are left out, and a response that is zero in every candidate: nothing is learned from it.
    `home`: the chain whose masses the places of `further` name; of a candidate with other masses,
    springs or ports every choice of places is fitted, and the best is taken
    (`joint_verdicts.located`).
    """
    _check(train, test, further, candidates)
    train, test = train.thinned(most_lines), None if test is None else test.thinned(most_lines)
    further = [one.thinned(most_lines) for one in further]
    candidates, further, silent = learning(candidates, further, home)
    engine = engine or Engine(store=Store.none())
    likely = not alike and all(choice is None for choice in (case, weights, lines))
    first_cost = Cost(train, case or Case.LOGARITHM, weights)
    weighed = partial(joint_cost, first_cost, further, lines, alike, test)
    asked = Task(weighed(), sign or 1, bounds or {}, fixed or {}, seed)
    asked = asked if sign else signed(asked, _at_home(candidates, home))
    search, seen_by = _tried(
        located(asked, candidates, home, engine.store) if home else asked,
        candidates,
        weighed,
        by_scatter=lines is None and not alike,
    )
    within = limits_of(search.bounds, search.fixed)
    first = _representatives(candidates, search, engine, within, prune)
    wanted = [c for c in candidates if first[c] == c]
    each = estimates(
        wanted,
        search.thinned(SEARCHED) if likely else search,
        method=method,
        store=engine.store,
        executor=executor,
        progress=progress,
    )
    searched = [each[c] for c in wanted]
    test_cost = judging_cost(search.cost, test, further, lines, alike, seen_by) if test else None
    known = witnessed(searched, search, test_cost)
    task, found = search, searched
    if likely:
        task = replace(search, cost=search.cost.likely(known[0]))
        test_cost = test_cost and test_cost.likely(known[1])
        found = polished(searched, task, engine.store, executor, progress)
    limits = thresholds or Thresholds()
    fitted = judged(found, task, test_cost, known, engine.settings)
    fitted = [replace(c, reasons=reasons(c, task, limits, rule)) for c in fitted]
    weighted = akaike_weighted(fitted, task)
    chosen = choice(weighted, task, test_cost, known, rule, engine.settings)
    said = chosen.explanation
    kept = chosen.left if said.explains else ()
    misread = () if said.explains or said.noisy or further else searched
    left = members(kept, task, test_cost, known, within, executor, progress)
    whole = tuple(m for m in left if m.contains is None)
    return Selection(
        selected=chosen.selected,
        candidates=chosen.candidates,
        alternatives=_alternatives(chosen.selected, candidates, task, engine, within),
        thresholds=limits,
        validation="test data" if test else CROSS_VALIDATION,
        same_as={c: other for c, other in first.items() if c != other},
        rule=rule,
        explanation=said,
        members=whole,
        containing=tuple(m for m in left if m.contains),
        readings=_readings(misread, search, engine.store, executor, progress),
        relied_on=statements(whole, task, controller),
        controller=controller,
        better=chosen.better,
        silent=tuple(silent),
        task=task,
        test=test or train,
        judging=test_cost or task.cost,
        quantities=other_quantities(searched, search, engine.store, executor, progress),
    )


def _at_home(candidates: Sequence[Chain], home: Chain | None) -> Sequence[Chain]:
    """The candidates of which it is known which mass is which."""
    return [c for c in candidates if body(c) == body(home)] if home else candidates


def _tried(
    task: Task,
    candidates: Sequence[Chain],
    weighed: Callable[[Sequence[Complex]], AnyCost],
    by_scatter: bool,
) -> tuple[Task, Callable[[AnyCost], Sequence[Complex]]]:
    """The task, its responses weighed by how their lines scatter about the best of a few candidates
    (`pilot`), and what these look like at the lines of any cost.
    """
    if not (by_scatter or isinstance(task.cost, JointCost)):
        return task, lambda cost: []
    seen_by = pilot(task, candidates)
    parts = weighed(seen_by(task.cost)).parts
    if isinstance(task.cost, JointCost):
        return replace(task, cost=replace(task.cost, parts=parts)), seen_by
    return replace(task, cost=parts[0]), seen_by


def _representatives(
    candidates: Sequence[Chain], task: Task, engine: Engine, within: Limits, prune: bool
) -> dict[Chain, Chain]:
    """For each candidate the one that is fitted in its place, in all responses."""
    if not prune:
        return {c: c for c in candidates}
    # what stands for another in the first response need not do so in the others
    first = representatives(candidates, engine, within)
    return representatives_under_all(first, task.cost, within)


def _alternatives(
    selected: Candidate | None,
    candidates: Sequence[Chain],
    task: Task,
    engine: Engine,
    within: Limits,
) -> tuple[Alternative, ...]:
    """What may behave the same as the selected structure in all responses."""
    if selected is None:
        return ()
    found = alternatives(selected.chain, candidates, engine, within)
    return alternatives_under_all(selected.chain, found, task.cost, engine, within)


def _readings(
    searched: Sequence[Estimate],
    task: Task,
    store: Store,
    executor: Executor | None,
    progress: Progress,
) -> tuple[Reading, ...]:
    """What the data would be where these estimates do not explain them."""
    if not searched:
        return ()
    return readings(searched, task, store=store, executor=executor, progress=progress)


def _check(
    train: FrequencyResponse,
    test: FrequencyResponse | None,
    further: Sequence[Further],
    candidates: Sequence[Chain],
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
    for one in further:  # each against its own test data
        if one.test is not None and test is None:
            raise InputError("test data of a further response need test data of the first one too")
        _check_pair(one.measured, one.test)
        for data in filter(None, (one.measured, one.test)):
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
