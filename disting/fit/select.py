"""Model selection (section 2.2): fit all candidates, keep those whose parameters are practically identifiable, take the best.

Among the admissible candidates the best is the one with the lowest cost J on independent test data, or, without such data, in
cross-validation over the frequency lines. A candidate with fewer parameters is preferred unless it loses by more than noise
explains (`repeatability`).
"""

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from math import exp, log

import numpy as np

from disting.engine import Engine, Store
from disting.errors import InputError
from disting.fit.alternatives import Alternative, alternatives, limits_of, representatives
from disting.fit.cost import Case, Cost
from disting.fit.descent import fine
from disting.fit.estimate import Estimate, Method, Task, estimates
from disting.fit.plant import Real
from disting.fit.practical import Practical, Thresholds, practical
from disting.fit.repeatability import Repeatability, margin, repeatability
from disting.fit.structural import with_structure
from disting.measurement import FrequencyResponse
from disting.model.chain import Chain
from disting.settings import Settings

FOLDS = 5  # of the cross-validation
MOST_EXTREME = 1e30  # of a frequency or an amplitude
AT_BOUND = 1e-6  # relative distance at which a parameter counts as being at its bound

Progress = Callable[[str, int, int], object]


def silent(what: str, done: int, total: int) -> None:
    """No progress is shown."""


@dataclass(frozen=True)
class Candidate:
    """A fitted candidate; `reasons` say why it is excluded, `residual` is that on the test data, shape (n_y,)."""

    chain: Chain
    estimate: Estimate
    practical: Practical
    j_test: float
    reasons: tuple[str, ...]
    at_bound: tuple[str, ...]
    residual: Real = field(repr=False, compare=False)
    akaike_weight: float = 0.0

    @property
    def admissible(self) -> bool:
        """Whether all criteria hold."""
        return not self.reasons

    @property
    def j_train(self) -> float:
        """Cost on the training data."""
        return self.estimate.j

    @property
    def n_parameters(self) -> int:
        """N_p: all parameters that the fit was free to choose."""
        return len(self.practical.names)

    @property
    def standard_errors(self) -> dict[str, float]:
        """Standard error of each fitted parameter, in its unit."""
        return {n: e * self.estimate.parameters[n] for n, e in self.practical.relative_errors.items()}


@dataclass(frozen=True)
class Selection:
    """What a selection found. `selected` is None where no candidate is admissible; candidates in the order of the cost on test.

    `margin` is what the selected candidate may lose by to the best one; `saved` counts the candidates that were not fitted
    because one with the same positive models was (`same_as`, by candidate); `validation` says where the test cost comes from.
    """

    selected: Candidate | None
    candidates: tuple[Candidate, ...]
    alternatives: tuple[Alternative, ...]
    thresholds: Thresholds
    repeatability: Repeatability
    margin: float
    validation: str
    same_as: dict[Chain, Chain]
    task: Task = field(repr=False)
    test: FrequencyResponse = field(repr=False)

    @property
    def saved(self) -> int:
        """Number of fits that verdicts saved."""
        return len(self.same_as)


def select(
    train: FrequencyResponse,
    candidates: Sequence[Chain],
    *,
    test: FrequencyResponse | None = None,
    thresholds: Thresholds | None = None,
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
    """Fit `candidates` to `train` and select one.

    `weights` of amplitude and phase, see `Cost`; `lines` gives each line's weight, such as `lines_by_deviation`; `sign` -1: the
    sensor is reversed, 0: whichever fits the smallest candidate better. `bounds` and `fixed` by parameter name. `prune`:
    candidates with the same positive models, within `bounds` and `fixed`, are fitted once; `method` as in `estimates`. An
    engine with a store resumes interrupted work. Raises InputError.
    """
    _check(train, test, candidates)
    for data in filter(None, (train, test)):
        _check_units(data)
    engine = engine or Engine(store=Store.none())
    cost = Cost(train, case, weights, lines(train) if lines else None)
    task = Task(cost, sign or 1, bounds or {}, fixed or {}, seed)
    task = task if sign else _signed(task, candidates)
    within = limits_of(task.bounds, task.fixed)
    first = representatives(candidates, engine, within) if prune else {c: c for c in candidates}
    wanted = [c for c in candidates if first[c] == c]
    known = estimates(wanted, task, method=method, store=engine.store, executor=executor, progress=progress)
    limits = thresholds or Thresholds()
    test_cost = replace(cost, measured=test, lines=lines(test) if lines else None) if test else None
    fitted = _fitted({c: known[c] for c in wanted}, task, limits, test_cost, engine.settings)
    kept = [c for c in fitted if c.admissible]
    noise = repeatability(train, test or train, (kept or fitted)[0].residual)
    selected, allowed = _simplest(kept, test_cost or cost, noise) if kept else (None, 0.0)
    return Selection(
        selected,
        tuple(fitted),
        alternatives(selected.chain, candidates, engine, within) if selected else (),
        limits,
        noise,
        allowed,
        "test data" if test else f"{FOLDS}-fold cross-validation over the frequency lines",
        {c: other for c, other in first.items() if c != other},
        task,
        test or train,
    )


def _check(train: FrequencyResponse, test: FrequencyResponse | None, candidates: Sequence[Chain]) -> None:
    if not candidates:
        raise InputError("a selection needs at least one candidate")
    if test is not None and test.sensor is not train.sensor:
        raise InputError(f"training shows {train.sensor.value}, test {test.sensor.value}; convert one of them")
    other = {c.sensor for c in candidates} - {train.sensor}
    if other:
        raise InputError(f"the data shows {train.sensor.value}, a candidate {other.pop().value}; choose one sensor quantity")


def _check_units(data: FrequencyResponse) -> None:
    """Numbers whose squares and products floating point holds; beyond these no unit of measurement is sensible."""
    for name, values, unit in (("frequencies", data.omega, "rad/s"), ("amplitudes", np.abs(data.G), "output per input")):
        low, high = float(values.min()), float(values.max())
        if low < 1 / MOST_EXTREME or high > MOST_EXTREME:
            limits = f"a fit computes with {1 / MOST_EXTREME:g} to {MOST_EXTREME:g}"
            raise InputError(f"the {name} are {low:g} to {high:g} {unit}; {limits}: choose other units or leave lines out")


def _signed(task: Task, candidates: Sequence[Chain]) -> Task:
    """The sign with which the smallest candidate fits better."""
    smallest = min(candidates, key=lambda c: len(c.parameters))
    both = [replace(task, sign=sign) for sign in (1, -1)]
    return min(both, key=lambda t: estimates([smallest], t)[smallest].j)


def _judged(found: Estimate, task: Task) -> Practical:
    """The criteria at the optimum, of the parameters that are free."""
    chain, names = found.chain, found.chain.parameters
    p = np.array([found.parameters[n] for n in names])
    free = task.box(names).free
    columns = task.cost.of(task.plant(chain), p)[1][:, free]
    return practical(columns, [n for n, chosen in zip(names, free, strict=True) if chosen], found.j)


def _fitted(
    known: Mapping[Chain, Estimate], task: Task, limits: Thresholds, test_cost: Cost | None, settings: Settings
) -> list[Candidate]:
    """What each estimate is worth, in the order of the cost on test."""
    judged = with_structure({c: _judged(found, task) for c, found in known.items()}, settings)
    fitted = [_candidate(found, judged[c], task, limits, test_cost) for c, found in known.items()]
    return _weighted(sorted(fitted, key=lambda c: c.j_test), task.cost.n_residuals)


def _candidate(found: Estimate, judged: Practical, task: Task, limits: Thresholds, test: Cost | None) -> Candidate:
    """Test cost and reasons of one estimate with its criteria."""
    chain, names = found.chain, found.chain.parameters
    p = np.array([found.parameters[n] for n in names])
    box = task.box(names)
    residual = _cross_validated(found, task, p) if test is None else _residual(chain, task, test, p)
    near = (box.high - p <= AT_BOUND * p) | ((box.low > 0) & (p - box.low <= AT_BOUND * p))
    at_bound = tuple(n for n, hit, free in zip(names, near, box.free, strict=True) if hit and free)
    reasons = limits.reasons(judged) + tuple(f"{n} is at its bound" for n in at_bound)
    return Candidate(chain, found, judged, float(residual @ residual), reasons, at_bound, residual)


def _residual(chain: Chain, task: Task, cost: Cost, p: Real) -> Real:
    return cost.residual(replace(task, cost=cost).plant(chain).response(p))


def _cross_validated(found: Estimate, task: Task, p: Real) -> Real:
    """Residuals of each line under the fit to the other folds, lines dealt out in turn; shape (n_y,)."""
    if not task.box(found.chain.parameters).free.any():
        return _residual(found.chain, task, task.cost, p)  # no fit sees any line
    cost, n_f = task.cost, len(task.cost.measured.omega)
    whole = np.empty(2 * n_f)
    lines = np.ones(n_f) if cost.lines is None else cost.lines
    for fold in range(FOLDS):
        out = np.arange(n_f) % FOLDS == fold
        kept = replace(task, cost=replace(cost, lines=np.where(out, 0.0, lines)))
        there, _ = fine(kept.plant(found.chain), kept.cost, kept.box(found.chain.parameters), p)
        both = np.tile(out, 2)
        whole[both] = cost.residual(task.plant(found.chain).response(there))[both]
    return whole


def _weighted(candidates: list[Candidate], n_y: int) -> list[Candidate]:
    """Akaike weights among the admissible ones: exp(-AIC/2), AIC = n_y ln(J/n_y) + 2 N_p, in all 1."""
    criteria = {c.chain: n_y * log(max(c.j_train, 1e-300) / n_y) + 2 * c.n_parameters for c in candidates if c.admissible}
    lowest = min(criteria.values(), default=0.0)
    sizes = {chain: exp((lowest - value) / 2) for chain, value in criteria.items()}
    total = sum(sizes.values())
    return [replace(c, akaike_weight=sizes[c.chain] / total) if c.chain in sizes else c for c in candidates]


def _simplest(kept: Sequence[Candidate], cost: Cost, noise: Repeatability) -> tuple[Candidate, float]:
    """The candidate with the fewest parameters that loses to the best by no more than its margin; then the lower cost."""
    best = kept[0]
    allowed = {c.chain: margin(c.residual, best.residual, cost, noise) for c in kept}
    near = [c for c in kept if c is best or (c.n_parameters < best.n_parameters and c.j_test <= best.j_test + allowed[c.chain])]
    winner = min(near, key=lambda c: (c.n_parameters, c.j_test))
    return winner, allowed[winner.chain]
