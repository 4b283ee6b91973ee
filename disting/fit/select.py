"""Model selection (section 2.2): fit all candidates, keep those that the data do not exclude, take
the simplest.

What the data exclude, and which of the others is selected, is decided in `choice`, by the residuals
on independent test data where there are such; without them cross-validation over the frequency
lines gives a cost that orders candidates. What comes out is a set, of which one is selected
(`members`), after the question whether any candidate explains the data at all (`explanation`).
"""

from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from typing import TypeVar

from disting.errors import InputError, enumeration, short
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
from disting.fit.old_names import accept_old_names
from disting.fit.results.loop import Controller, read_controller
from disting.fit.results.reliance import statements
from disting.fit.results.selection import Selection
from disting.fit.search.cost import Case, Cost, lines_by_coherence, lines_by_deviation
from disting.fit.search.data import Lines, Weights, check
from disting.fit.search.estimate import Estimate, Method, Task, one_thread
from disting.fit.search.exchange import SEARCHED, body, estimates, polish
from disting.fit.search.joint import AnyCost, FurtherResponse, JointCost, with_dead_times
from disting.measurement import FrequencyResponse
from disting.measurement.assumptions import as_shown
from disting.model.chain import Chain, Quantity, as_quantity
from disting.statistics.practical import Thresholds
from disting.store import Store
from disting.verdict.engine import Engine, Progress, silent

CROSS_VALIDATION = f"{FOLDS}-fold cross-validation over the frequency lines"
T = TypeVar("T")
MOST_LINES = 10_000  # of a response that are fitted, unless more are asked for


@accept_old_names
@one_thread()
def select(
    train: FrequencyResponse,
    candidates: Sequence[Chain],
    *,
    test: FrequencyResponse | None = None,
    quantity: Quantity | str | None = None,
    band: tuple[float, float] | None = None,
    lines: int = MOST_LINES,
    further: Sequence[FurtherResponse] = (),
    home: Chain | None = None,
    dead_time: str = "shared",
    weights: str | Lines = "auto",
    thresholds: Thresholds | tuple[float, float, float] | None = None,
    rule: Rule | str = Rule.NOT_EXCLUDED,
    case: Case | int | None = None,
    case_weights: tuple[float, float] | None = None,
    sign: int | str = 1,
    bound: Mapping[str, tuple[float, float]] | None = None,
    fix: Mapping[str, float] | None = None,
    seed: str = "disting",
    prune: bool = True,
    controller: Controller | str | None = None,
    optimiser: str | Method = "starts",
    engine: Engine | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Selection:
    """Fit `candidates` to `train` and select one, by a rule for what is admissible.

    Parameters are those of the highest likelihood: the search is by logarithms, whose costs have
    few valleys, the last digits are found in the complex plane in units of what each line scatters
    (`Cost.likely`), where noise is normal however small a response is compared with it. A cost of
    the paper is kept to the end where one is named: by its `case` (1, 2 or 3), by `case_weights` of
    amplitude and phase, see `Cost`, or by `weights` of the lines: "std", "coherence", a function of
    the response such as `lines_by_deviation`, shape (n_f,), or "none", by which all lines count
    alike (default "auto": by the scatter of each, if known). `sign` -1 or "-": the sensor is
    reversed, 0 or "auto": whichever fits better. `bound` and `fix`: ranges and values by parameter
    name, in SI units. `prune`: candidates with the same positive models, within `bound` and `fix`,
    are fitted once. `band`: lowest and highest frequency that are used [Hz]; `lines`: of a response
    with more so many are fitted, and its `reading` states it. `controller`: one whose margins are
    reported (`reliance`), also as text such as "P=2,I=30". `optimiser`: "starts", the paper's
    "swarm", or a method as in `estimates`. `thresholds`: largest condition index, PII ratio and
    collinearity index; `rule`: "not-excluded" or "paper"; `seed` of the random starts. An
    engine with a store resumes interrupted work. Raises InputError, also for an impedance, to which
    no chain is fitted, and for names in `bound` and `fix` that no candidate has.

    `quantity` of the sensor, "position", "velocity" or "acceleration": what `train` and `test`
    show, whatever they were read as, and what the candidates answer with (default: as they are).
    Where the sensor quantity of `train` is assumed and another one explains the data as well,
    nothing is selected: `question` of the result requests it, `quantities` are the readings.

    `further`: responses of the same machine that are fitted together with `train`, one parameter
    vector for all; each counts in units of its own scatter (`Weights`). Candidates without their
    places are left out, and a response that is zero in every candidate: nothing is learned from it.
    `dead_time` of these: "shared", or "own", one for each, called Td2, Td3 and so on. `home`: the
    chain whose masses the places of `further` name; of a candidate with other masses, springs or
    ports every choice of places is fitted, and the best is taken (`joint_verdicts.locate`).
    """
    if quantity is not None:
        shown = as_quantity(quantity)
        train, test = as_shown(train, shown), test and as_shown(test, shown)
        candidates = [replace(c, quantity=shown) for c in candidates]
    further = with_dead_times(further, dead_time)
    if band is not None:
        train, test = train.masked(*band), test and test.masked(*band)
        further = [extra.masked(*band) for extra in further]
    terms, method = _terms(thresholds, rule, controller), _method(optimiser)
    train, test, further = check(train, test, further, candidates, lines)
    _check_names(candidates, further, (*(fix or {}), *(bound or {})))
    candidates, further, zero = informative(candidates, further, home)
    work = Work(engine or Engine(store=Store.none()), executor, progress)
    case = None if case is None else Case(case)
    cost = Cost(train, case or Case.LOGARITHM, case_weights)
    weighing = Weights(cost, test, further, _lines_of(weights), weights == "none")
    number = _one_of("sign", sign, SIGNS) if isinstance(sign, str) else sign
    task = Task(weighing.training(), number or 1, bound or {}, fix or {}, seed)
    task = task if number else better_sign(task, _at_home(candidates, home))
    task = locate(task, candidates, home, work.engine.store) if home else task
    search, judging = _weigh_by_trial(task, candidates, weighing)
    same_as = _find_represented(candidates, search, work.engine) if prune else {}
    fitted = [c for c in candidates if c not in same_as]
    likely = weighing.by_scatter and case is None and case_weights is None
    fits = _fits(fitted, search, judging, likely, method, work)
    return _selection(fits, terms, candidates, same_as, tuple(zero), work)


WEIGHTS: dict[str, Lines | None] = {
    "auto": None,
    "none": None,
    "std": lines_by_deviation,
    "coherence": lines_by_coherence,
}
SIGNS = {"+": 1, "-": -1, "auto": 0}


def _one_of(name: str, word: str, table: Mapping[str, T]) -> T:
    """The entry of an option's word; raises InputError for another word."""
    if word not in table:
        raise InputError(f"{name} is one of {', '.join(table)}, not {short(word)}")
    return table[word]


def _lines_of(weights: str | Lines) -> Lines | None:
    """The function that weighs the lines of a response; None for their scatter, and for none."""
    return _one_of("weights", weights, WEIGHTS) if isinstance(weights, str) else weights


def _method(optimiser: str | Method) -> Method | None:
    """The search of that name, None for the usual one; raises InputError."""
    if not isinstance(optimiser, str):
        return optimiser
    if not _one_of("optimiser", optimiser, {"starts": False, "swarm": True}):
        return None
    from disting.fit.search.swarm import by_swarm  # with a library that few runs need

    return by_swarm


def _check_names(
    candidates: Sequence[Chain], further: Sequence[FurtherResponse], named: Sequence[str]
) -> None:
    """Raise InputError for names that are parameters of no candidate and of no response."""
    names = {name for chain in candidates for name in chain.parameters}
    names |= {extra.setup.delay for extra in further} - {""}
    unknown = [name for name in dict.fromkeys(named) if name not in names]
    if unknown:
        raise InputError(
            f"no candidate has a parameter {enumeration(unknown)}; their parameters are"
            f" {enumeration(sorted(names))}"
        )


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


def _terms(
    thresholds: Thresholds | tuple[float, float, float] | None,
    rule: Rule | str,
    controller: Controller | str | None,
) -> Terms:
    """The criteria, from text where they are text; raises InputError."""
    limits = Thresholds(*thresholds) if isinstance(thresholds, tuple) else thresholds
    the_rule = Rule(_one_of("rule", rule, {r.value: r for r in Rule}))
    law = read_controller(controller) if isinstance(controller, str) else controller
    return Terms(limits or Thresholds(), the_rule, law)


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
    chosen = _choose(fits, terms, work)
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


def _choose(fits: Fits, terms: Terms, work: Work) -> Choice:
    """Choose the selected candidate and the remaining ones, and determine whether any explains the
    data.
    """
    task, test, scatters = fits.task, fits.test, fits.known
    settings = work.engine.settings
    fitted = judge(fits.found, task, test, scatters, settings, work.executor, work.progress)
    work.progress("comparison of the structures", 0, 1)
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
