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

import numpy as np

from disting.errors import InputError
from disting.fit.admissible import Rule, reasons
from disting.fit.alternatives import Alternative, alternatives, limits_of, representatives
from disting.fit.cost import Case, Cost
from disting.fit.estimate import Method, Task, estimates
from disting.fit.explained import LARGEST, Explanation, explanation
from disting.fit.judged import FOLDS, Candidate, judged
from disting.fit.members import Member, members
from disting.fit.noise import Noise, noise
from disting.fit.plant import Real
from disting.fit.practical import Thresholds
from disting.fit.readings import Reading, readings
from disting.fit.repeatability import margin, repeatability
from disting.fit.scatter import Scatter
from disting.measurement import FrequencyResponse, are_opposite
from disting.model.chain import Chain
from disting.store import Store
from disting.verdict import Engine

MOST_EXTREME = 1e30  # of a frequency or an amplitude

Progress = Callable[[str, int, int], object]


def silent(what: str, done: int, total: int) -> None:
    """No progress is shown."""


@dataclass(frozen=True)
class Selection:
    """What a selection found. `selected` is None where no candidate is admissible; candidates in
    the order of the cost on test.

    `explanation` is that of the selected candidate, else of the best one; `members`: the
    structures that the data do not exclude, the selected one first, none where nothing explains
    the data; `readings`: what would fit then; `better`: excluded candidates that fit better than
    the selected one by more than noise. `margin` is what the selected candidate may lose by to the
    best one; `saved` counts the candidates that were not fitted because one with the same positive
    models was (`same_as`, by candidate); `validation` says where the test cost comes from.
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
    task: Task = field(repr=False)
    test: FrequencyResponse = field(repr=False)

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
    """
    _check(train, test, candidates)
    engine = engine or Engine(store=Store.none())
    cost = Cost(train, case, weights, lines(train) if lines else None)
    task = Task(cost, sign or 1, bounds or {}, fixed or {}, seed)
    task = task if sign else _signed(task, candidates)
    within = limits_of(task.bounds, task.fixed)
    first = representatives(candidates, engine, within) if prune else {c: c for c in candidates}
    wanted = [c for c in candidates if first[c] == c]
    found = estimates(
        wanted, task, method=method, store=engine.store, executor=executor, progress=progress
    )
    test_cost = replace(cost, measured=test, lines=lines(test) if lines else None) if test else None
    fitted, seen = judged({c: found[c] for c in wanted}, task, test_cost, engine.settings)
    limits = thresholds or Thresholds()
    fitted = _weighted(
        [replace(c, reasons=reasons(c, task, limits, rule)) for c in fitted], cost.n_residuals
    )
    typical = repeatability(train, test or train, _best(fitted).residual)
    choice = _choice(fitted, test_cost or cost, seen, typical, rule)
    selected, described = choice.selected, choice.selected or fitted[0]
    said = explanation(described.residual, described.missed, test_cost or cost, seen)
    hopeless = not (said.explains or said.noisy)
    return Selection(
        selected=selected,
        candidates=tuple(fitted),
        alternatives=alternatives(selected.chain, candidates, engine, within) if selected else (),
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
        task=task,
        test=test or train,
    )


def _check(
    train: FrequencyResponse, test: FrequencyResponse | None, candidates: Sequence[Chain]
) -> None:
    if not candidates:
        raise InputError("a selection needs at least one candidate")
    if test is not None and test.sensor is not train.sensor:
        raise InputError(
            f"training shows {train.sensor.value}, test {test.sensor.value}; convert one of them"
        )
    if test is not None and are_opposite(train, test):
        raise InputError(
            "training and test are of opposite sign; reverse one of them, as by sign_reversed()"
        )
    other = {c.sensor for c in candidates} - {train.sensor}
    if other:
        raise InputError(
            f"the data shows {train.sensor.value}, a candidate {other.pop().value}; choose one"
            " sensor quantity"
        )
    for data in filter(None, (train, test)):
        _check_units(data)


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


def _signed(task: Task, candidates: Sequence[Chain]) -> Task:
    """The sign with which candidates fit better, the best of the largest and the smallest ones
    of each size.
    """
    by_size = [
        [c for c in candidates if c.n_masses == n] for n in sorted({c.n_masses for c in candidates})
    ]
    asked = dict.fromkeys(
        choose(one, key=lambda c: len(c.parameters)) for one in by_size for choose in (min, max)
    )
    both = [replace(task, sign=sign) for sign in (1, -1)]
    return min(both, key=lambda t: min(found.j for found in estimates(list(asked), t).values()))


def _weighted(candidates: list[Candidate], n_y: int) -> list[Candidate]:
    """Akaike weights among the admissible ones: exp(-AIC/2), AIC = n_y ln(J/n_y) + 2 N_p, in
    all 1.
    """
    criteria = {
        c.chain: n_y * log(max(c.j_train, 1e-300) / n_y) + 2 * c.n_parameters
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
    fitted: Sequence[Candidate], cost: Cost, seen: Scatter, typical: Scatter, rule: Rule
) -> _Choice:
    """Which candidate is selected, and what stands beside it; `fitted` in the order of J on
    test, `cost` that on test.
    """
    kept = [c for c in fitted if c.admissible]
    if not kept:
        return _Choice(None, (), 0.0, ())
    sigma = cost.scatter(seen.rho)
    there = _left(kept[0], sigma)
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
        _better(selected, fitted, sigma),
    )


def _best(fitted: Sequence[Candidate]) -> Candidate:
    """The admissible candidate with the lowest J on test; of all, where none is admissible."""
    return next((c for c in fitted if c.admissible), fitted[0])


def _simplest(kept: Sequence[Candidate], noise: Noise) -> tuple[Candidate, float]:
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


def _better(selected: Candidate, fitted: Sequence[Candidate], sigma: Real) -> tuple[Candidate, ...]:
    """Excluded candidates that win against the selected one by more than their margin, those with
    few parameters first.

    The margin is that of the noise which they leave: what the selected one misses beside is no
    noise.
    """
    lower = [c for c in fitted if not c.admissible and c.j_test < selected.j_test]
    found = [
        c
        for c in lower
        if c.j_test < selected.j_test - margin(c.residual, selected.residual, _left(c, sigma))
    ]
    return tuple(sorted(found, key=lambda c: (c.n_parameters, c.j_test)))


def _left(candidate: Candidate, sigma: Real) -> Noise:
    """What a candidate leaves of the judged data, whose residuals scatter by `sigma`: what
    misses them widely is no noise.
    """
    if candidate.chi2 > LARGEST:
        return Noise(sigma)
    return noise(candidate.residual, sigma, candidate.missed)
