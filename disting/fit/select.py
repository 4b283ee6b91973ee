"""Model selection (section 2.2): fit all candidates, keep those that the data do not exclude, take
the simplest.

What the data exclude, and which of the others is selected, is decided in `choice`, by the residuals
on independent test data where there are such; without them cross-validation over the frequency
lines gives a cost that orders candidates. What comes out is a set, of which one is selected
(`members`), after the question whether any candidate explains the data at all (`explanation`).
"""

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace

from disting.fit.judge.admissible import Rule, reasons
from disting.fit.judge.alternatives import (
    Alternative,
    alternatives,
    limits_of,
    representatives,
)
from disting.fit.judge.candidate import FOLDS, Candidate, Scatters, judge, observed_scatters
from disting.fit.judge.choice import (
    Choice,
    check_left,
    choice,
    judged,
    searched_again,
    with_akaike_weights,
)
from disting.fit.judge.explanation import Explanation
from disting.fit.judge.joint_verdicts import (
    alternatives_under_all,
    informative,
    locate,
    representatives_under_all,
)
from disting.fit.judge.members import Member, members
from disting.fit.judge.outside import Outside, machines_outside
from disting.fit.judge.readings import Reading, better_sign, pilot, quantity_readings, readings
from disting.fit.results.loop import Controller
from disting.fit.results.reliance import statements
from disting.fit.results.selection import Selection
from disting.fit.search.cost import Case, Cost
from disting.fit.search.data import Weights, check
from disting.fit.search.estimate import Estimate, Method, Task, one_thread
from disting.fit.search.exchange import SEARCHED, body, estimates, polish
from disting.fit.search.joint import AnyCost, FurtherResponse, JointCost
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Real
from disting.measurement.assumptions import as_shown
from disting.model.chain import Chain, Sensor, as_sensor
from disting.model.question import Settings
from disting.statistics.practical import Thresholds
from disting.store import Store
from disting.verdict.engine import Engine, Progress, silent

CROSS_VALIDATION = f"{FOLDS}-fold cross-validation over the frequency lines"
MOST_LINES = 10_000  # of a response that are fitted, unless more are asked for


@one_thread()
def select(
    train: FrequencyResponse,
    candidates: Sequence[Chain],
    *,
    test: FrequencyResponse | None = None,
    quantity: Sensor | str | None = None,
    further: Sequence[FurtherResponse] = (),
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
    (`Cost.likely`), where noise is normal however small a response is compared with it. A cost of
    the paper is kept to the end where one is named: by its `case`, by `weights` of amplitude and
    phase, see `Cost`, by the weights that `lines` gives, such as `lines_by_deviation`, or if all
    lines count `alike`; `sign` -1: the sensor is reversed, 0: whichever fits better. `bounds` and
    `fixed` by parameter name. `prune`: candidates with the same positive models, within `bounds`
    and `fixed`, are fitted once; `most_lines`: of a response with more so many are fitted, and its
    `reading` states it; `controller`: one whose margins are reported (`reliance`); `method` as in
    `estimates`. An engine with a store resumes interrupted work. Raises InputError, also for an
    impedance, to which no chain is fitted.

    `quantity` of the sensor, "position", "velocity" or "acceleration": what `train` and `test`
    show, whatever they were read as, and what the candidates answer with (default: as they are).
    Where the sensor quantity of `train` is assumed and another one explains the data as well,
    nothing is selected: `question` of the result requests it, `quantities` are the readings.

    `further`: responses of the same machine that are fitted together with `train`, one parameter
    vector for all; each counts in units of its own scatter (`Weights`). Candidates without their
    places are left out, and a response that is zero in every candidate: nothing is learned from it.
    `home`: the chain whose masses the places of `further` name; of a candidate with other masses,
    springs or ports every choice of places is fitted, and the best is taken
    (`joint_verdicts.locate`).
    """
    if quantity is not None:
        shown = as_sensor(quantity)
        train, test = as_shown(train, shown), test and as_shown(test, shown)
        candidates = [replace(c, sensor=shown) for c in candidates]
    train, test, further = check(train, test, further, candidates, most_lines)
    candidates, further, zero = informative(candidates, further, home)
    work = Work(engine or Engine(store=Store.none()), executor, progress)
    weighing = Weights(Cost(train, case or Case.LOGARITHM, weights), test, further, lines, alike)
    task = Task(weighing.training(), sign or 1, bounds or {}, fixed or {}, seed)
    task = task if sign else better_sign(task, _at_home(candidates, home))
    task = locate(task, candidates, home, work.engine.store) if home else task
    search, judging = _weigh_by_trial(task, candidates, weighing)
    same_as = _find_represented(candidates, search, work.engine) if prune else {}
    fitted = [c for c in candidates if c not in same_as]
    likely = weighing.by_scatter and case is None and weights is None
    fits = _fits(fitted, search, judging, likely, method, work)
    terms = Terms(thresholds or Thresholds(), rule, controller)
    return _selection(fits, terms, candidates, same_as, tuple(zero), work)


@dataclass(frozen=True, slots=True)
class Work:
    """Resources of the computation."""

    engine: Engine
    executor: Executor | None
    progress: Progress


@dataclass(frozen=True, slots=True)
class Terms:
    """Criteria for judging the fits, and the controller whose margins are reported."""

    thresholds: Thresholds
    rule: Rule
    controller: Controller | None


@dataclass(frozen=True, slots=True)
class Fits:
    """The best parameters of all candidates that are fitted: `searched` by the cost of `search`,
    `found` by that of `task`, the same where a cost of the paper is kept; `test`: the cost on test
    data, None without such; `known`: how the lines of both scatter.
    """

    search: Task
    searched: Sequence[Estimate]
    task: Task
    found: Sequence[Estimate]
    test: AnyCost | None
    known: Scatters


def _fits(
    candidates: Sequence[Chain],
    search: Task,
    test: AnyCost | None,
    likely: bool,
    method: Method | None,
    work: Work,
) -> Fits:
    """Searched by logarithms, then, where the highest likelihood is requested, brought to the last
    digit in units of what each line scatters.
    """
    store, executor, progress = work.engine.store, work.executor, work.progress
    each = estimates(
        candidates,
        search.thinned(SEARCHED) if likely else search,
        method=method,
        store=store,
        executor=executor,
        progress=progress,
    )
    searched = [each[c] for c in candidates]
    if not likely:
        return Fits(
            search, searched, search, searched, test, observed_scatters(searched, search, test)
        )
    shown, test = replace(search, cost=search.cost.windowed()), test and test.windowed()
    scatters = observed_scatters(searched, shown, test)
    task = replace(shown, cost=shown.cost.likely(scatters[0]))
    the_estimates = polish(searched, task, store, executor, progress)
    return Fits(search, searched, task, the_estimates, test and test.likely(scatters[1]), scatters)


def _selection(
    fits: Fits,
    terms: Terms,
    candidates: Sequence[Chain],
    same_as: dict[Chain, Chain],
    silent: tuple[str, ...],
    work: Work,
) -> Selection:
    """Selection from the fits of all candidates."""
    task, search = fits.task, fits.search
    chosen = _choose(fits, terms, work.engine.settings)
    quantities = quantity_readings(
        fits.searched,
        chosen.selected.estimate if chosen.selected else None,
        search,
        work.engine.store,
        work.executor,
        work.progress,
    )
    if quantities and chosen.explanation.is_near:  # nothing is said before somebody names it
        chosen = replace(chosen, selected=None, left=(), better=())
    outside = _outside(fits, chosen)
    if any(machine.is_better for machine in outside):
        chosen = replace(chosen, explanation=replace(chosen.explanation, is_beaten=True))
    whole, containing = _members(fits, chosen, work)
    return Selection(
        selected=chosen.selected,
        candidates=chosen.candidates,
        alternatives=_alternatives(chosen.selected, candidates, task, work.engine),
        thresholds=terms.thresholds,
        validation="test data" if fits.test else CROSS_VALIDATION,
        same_as=same_as,
        rule=terms.rule,
        explanation=chosen.explanation,
        members=whole,
        containing=containing,
        readings=_readings(fits, chosen.explanation, work),
        relied_on=statements(whole, task, terms.controller),
        controller=terms.controller,
        better=chosen.better,
        silent=silent,
        task=task,
        test=(fits.test or task.cost).measured,
        judging=fits.test or task.cost,
        quantities=quantities,
        outside=outside,
    )


def _choose(fits: Fits, terms: Terms, settings: Settings) -> Choice:
    """Choose the selected candidate and the remaining ones, and determine whether any explains the
    data.
    """
    task, test, scatters = fits.task, fits.test, fits.known
    fitted = judge(fits.found, task, test, scatters, settings)
    while True:
        fitted = [
            replace(c, reasons=reasons(c, task, terms.thresholds, terms.rule)) for c in fitted
        ]
        weighed = with_akaike_weights(fitted, task)
        chosen = choice(weighed, task, test, scatters, terms.rule, settings)
        each = judged(fitted, terms.rule, test or task.cost)
        again = searched_again(chosen.left, each, task, test, scatters, settings)
        if not again:
            break
        fitted = sorted((again.get(c.chain, c) for c in fitted), key=lambda c: c.order)
    check_left(chosen.left, each, task, scatters)
    return chosen


def _members(
    fits: Fits, chosen: Choice, work: Work
) -> tuple[tuple[Member, ...], tuple[Member, ...]]:
    """Structures that the data do not exclude: those that contain no other one, and those that
    do.
    """
    kept = chosen.left if chosen.explanation.is_near else ()
    within = limits_of(fits.task.bounds, fits.task.fixed)
    left = members(kept, fits.task, fits.test, fits.known, within, work.executor, work.progress)
    return tuple(m for m in left if m.contains is None), tuple(m for m in left if m.contains)


def _outside(fits: Fits, chosen: Choice) -> tuple[Outside, ...]:
    """Machines outside the candidates that explain the data on which these are judged."""
    explanation, described = chosen.explanation, chosen.selected or chosen.candidates[0]
    is_by_scatter = fits.task is not fits.search  # else the chain is not where its misfit is least
    if explanation.noisy or explanation.too_few or not is_by_scatter:
        return ()
    bases = all(c.chain.gap == 0 for c in chosen.candidates)
    judging = fits.test or fits.task.cost
    return machines_outside(described, fits.task, judging, fits.known, bases)


def _at_home(candidates: Sequence[Chain], home: Chain | None) -> Sequence[Chain]:
    """The candidates of which it is known which mass is which."""
    return [c for c in candidates if body(c) == body(home)] if home else candidates


def _weigh_by_trial(
    task: Task, candidates: Sequence[Chain], weighing: Weights
) -> tuple[Task, AnyCost | None]:
    """The task, its responses weighed by how their lines scatter about the best of a few candidates
    (`pilot`), and the cost on test data, weighed so too.
    """
    is_seen = weighing.by_scatter or isinstance(task.cost, JointCost)
    seen_by = pilot(task, candidates) if is_seen else lambda cost: []
    weighed = weighing.training(seen_by(task.cost))
    cost = replace(task.cost, parts=weighed.parts) if isinstance(task.cost, JointCost) else weighed
    return replace(task, cost=cost), weighing.judging(cost, seen_by)


def _find_represented(
    candidates: Sequence[Chain], task: Task, engine: Engine
) -> dict[Chain, Chain]:
    """Candidates that are not fitted, each with the one that represents it in all responses."""
    within = limits_of(task.bounds, task.fixed)
    # what stands for another in the first response need not do so in the others
    first = representatives(candidates, engine, within)
    whole = representatives_under_all(first, task.cost, within)
    return {c: other for c, other in whole.items() if c != other}


def _alternatives(
    selected: Candidate | None, candidates: Sequence[Chain], task: Task, engine: Engine
) -> tuple[Alternative, ...]:
    """Structures that may be equivalent to the selected one in all responses."""
    if selected is None:
        return ()
    within = limits_of(task.bounds, task.fixed)
    the_alternatives = alternatives(selected.chain, candidates, engine, within)
    return alternatives_under_all(selected.chain, the_alternatives, task.cost, engine, within)


def _readings(fits: Fits, said: Explanation, work: Work) -> tuple[Reading, ...]:
    """Other readings of the data, where the fits do not explain them."""
    if said.is_near or said.noisy or not fits.searched or isinstance(fits.search.cost, JointCost):
        return ()
    store, executor, progress = work.engine.store, work.executor, work.progress
    return readings(fits.searched, fits.search, store=store, executor=executor, progress=progress)
