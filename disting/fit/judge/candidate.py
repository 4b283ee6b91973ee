"""Figures of merit of fitted candidates: criteria, standard errors, cost on data not used in any
fit, chi2 per line.

Structural identifiability of fitted candidates: what no data can determine, whatever the
excitation and the noise.

Where a candidate has more free parameters than the Jacobian of its transfer function's coefficients
by these has rank, its sensitivities are dependent for all parameter values: condition and
collinearity index are infinite, and what a computer finds is rounding. Such a candidate is
described by the combinations that data do determine, not by a number. Rank and combinations are
those of `disting.decide.identifiability`, at random points modulo random primes; how many
parameter vectors fit is not asked here, which costs more than the fit.
"""

from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from math import inf

import numpy as np

from disting.decide.identifiability.functions import basis
from disting.decide.identifiability.parts import Formula
from disting.decide.identifiability.tangent import proof_tangents
from disting.experiments.machine_model import rank_by
from disting.fit.judge.exclusion import Exclusion
from disting.fit.judge.explanation import (
    Explanation,
    Level,
    chi2,
    chi2_apart,
    explain,
    level_of,
    line_frequencies,
    merge,
    noises,
    scatters,
    yardsticks,
)
from disting.fit.search.candidates import reference
from disting.fit.search.cost import CostOfEach, Indices, comparable
from disting.fit.search.data import WhitenedCost
from disting.fit.search.descent import rough
from disting.fit.search.estimate import Estimate, Task
from disting.fit.search.joint import AnyCost, JointCost
from disting.fit.search.setup import measured_chain
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain
from disting.model.presentation import plural, summary
from disting.model.question import Settings
from disting.statistics.covariance import expected_deviation
from disting.statistics.lone_lines import LoneLines
from disting.statistics.practical import NoiseModel, Practical, practical
from disting.statistics.scatter import Scatter
from disting.store.scheduling import map_tasks
from disting.verdict.engine import Progress, silent

MOST_TERMS = 3  # of a combination that is written out


def with_structure(
    judged: Mapping[Chain, Practical], task: Task, settings: Settings
) -> dict[Chain, Practical]:
    """The criteria of each chain; where data cannot determine it, `unidentifiable` is set and
    indices are infinite.
    """
    return {
        chain: _told_together(chain, assessment, task, settings)
        if isinstance(task.cost, JointCost)
        else _describe_determined(chain, assessment, settings)
        for chain, assessment in judged.items()
    }


def _told_together(
    chain: Chain, assessment: Practical, task: Task, settings: Settings
) -> Practical:
    """Practical identifiability from all responses: parameters that the first response determines,
    else the stacked Jacobian.
    """
    common = tuple(name for name in assessment.names if name in chain.parameters)
    proof = proof_tangents(chain.structure, settings.seed, settings.points)
    if max(t.rank_by(common) for t in proof) == len(common):
        return assessment
    measured = measured_chain(chain, task.cost.setups_of(chain.structure))
    labels = (f"joint:{settings.seed}:{k}" for k in range(settings.points))
    rank = max(rank_by(measured, common, label) for label in labels)
    lacking = len(common) - rank
    if lacking <= 0:
        return assessment
    indices = (*assessment.condition_indices[: len(assessment.names) - lacking], *(inf,) * lacking)
    directions = plural(lacking, "combination") + " of its parameters"
    words = f"not identifiable: these responses together leave {directions} open, whatever the data"
    return replace(assessment, condition_indices=indices, collinearity=inf, unidentifiable=words)


def _describe_determined(chain: Chain, assessment: Practical, settings: Settings) -> Practical:
    proof = proof_tangents(chain.structure, settings.seed, settings.points)
    rank = max(t.rank_by(assessment.names) for t in proof)
    lacking = len(assessment.names) - rank
    if lacking <= 0:
        return assessment
    chosen = basis(chain.structure, proof, max(t.rank for t in proof), settings.seed).chosen
    indices = assessment.condition_indices[:rank] + (inf,) * lacking
    text = " and what is given" if len(assessment.names) < len(chain.parameters) else ""
    words = in_words([c.formula for c in chosen]) + text
    return replace(assessment, condition_indices=indices, collinearity=inf, unidentifiable=words)


def in_words(determined: Sequence[Formula]) -> str:
    """Largest set of determinable parameters in words; long combinations are only counted.

    >>> from disting.decide.identifiability.parts import monomial
    >>> in_words([monomial(k12=1, d12=-1), monomial(k12=1, m1=-1, m2=-1)])
    'not identifiable: no data determine more than k12/d12, k12/(m1*m2)'
    """
    short = [formula.text for formula in determined if len(formula.terms) <= MOST_TERMS]
    more = len(determined) - len(short)
    counted = [plural(more, "longer combination" if short else "combination")] if more else []
    return (
        "not identifiable: no data determine more than"
        f" {' and '.join(([', '.join(short)] if short else []) + counted)}"
    )


FOLDS = 5  # of the cross-validation
FOLD_GAIN = 1e-6  # relative gain of cost at which the fit of a fold ends,
FOLD_STEPS = 100  # or so many steps after the fit to all lines
AT_BOUND = 1e-6  # relative distance at which a parameter counts as being at its bound
OUTSIDE = 0.05  # probability of true values outside of what is said of them
WITNESSES = 5  # best candidates that help to see how much the data scatter

Scatters = tuple[Scatter, Scatter]
"""Scatter of the lines of the training data, and of those that candidates are judged by."""


@dataclass(frozen=True)
class Candidate:
    """A fitted candidate; `reasons` name the parameters that are not determined, `residual` is that
    on the test data, shape (n_y,), whitened, and `missed` its expected value.

    `chi2` per line, and `chi2_apart` and `worst_apart` without the lines with the largest misfit,
    see `explain`; `noise` = covariance of the residuals on the training data, from which all
    standard errors follow; `excluded`: the candidate that excludes it, if any; `rests_on`: single
    lines on which its gain over a structure that it contains rests, if it does.
    """

    chain: Chain
    estimate: Estimate
    practical: Practical
    j_test: float
    chi2: float
    at_bound: tuple[str, ...]
    residual: Real = field(repr=False, compare=False)
    missed: Real = field(repr=False, compare=False)
    noise: NoiseModel = field(repr=False, compare=False)
    reasons: tuple[str, ...] = ()
    akaike_weight: float = 0.0
    excluded: Exclusion | None = None
    rests_on: LoneLines | None = None
    chi2_apart: float = inf
    worst_apart: float = inf

    def __repr__(self) -> str:
        excluded = f", excluded by {reference(self.excluded.by)}" if self.excluded else ""
        return summary(
            self,
            f"{reference(self.chain)}, N_p = {self.n_parameters}, J = {self.j_test:.4g}{excluded}",
        )

    @property
    def admissible(self) -> bool:
        """True if all its parameters are determined, by the criteria of the rule."""
        return not self.reasons

    @property
    def j_train(self) -> float:
        """Cost on the training data."""
        return self.estimate.j

    @property
    def n_parameters(self) -> int:
        """N_p: all parameters that the fit was free to choose."""
        return len(self.practical.names)

    def explains(self, seen: Scatter) -> bool:
        """True if it explains the judged data, which scatter so, apart from something or nearly."""
        return level_of(self.chi2, self.chi2_apart, self.worst_apart, seen) is not Level.NOT

    @property
    def order(self) -> tuple[float, int]:
        """By the cost on test, of equal costs the fewest parameters first."""
        return comparable(self.j_test), self.n_parameters

    @property
    def standard_errors(self) -> dict[str, float]:
        """Standard error of each fitted parameter, in its unit."""
        return {
            n: e * self.estimate.parameters[n] for n, e in self.practical.relative_errors.items()
        }


def observed_scatters(
    estimates: Iterable[Estimate], task: Task, test_cost: AnyCost | None
) -> Scatters:
    """The scatter of training and judged data about the best estimates."""
    cost = test_cost or task.cost
    best = sorted(estimates, key=lambda e: e.j)[:WITNESSES]
    return yardsticks(
        task.cost,
        cost,
        [_response(e, task) for e in best],
        [_response(e, replace(task, cost=cost)) for e in best],
    )


def judge(
    estimates: Iterable[Estimate],
    task: Task,
    test_cost: AnyCost | None,
    own_scatters: Scatters,
    settings: Settings,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> list[Candidate]:
    """Judge each estimate by the scatter of the data, in the order of the cost on test. Without
    test data each is fitted again to every fold, in the executor's workers if there is one.
    """
    each = list(estimates)
    first = {e.chain: _criteria(e, task, own_scatters[0]) for e in each}
    criteria = with_structure({c: residuals for c, (residuals, _) in first.items()}, task, settings)
    rows = [(e, criteria[e.chain], first[e.chain][1], task, test_cost, own_scatters) for e in each]
    found = dict[Chain, Candidate]()
    for _, candidate in map_tasks(_candidate, rows, executor if test_cost is None else None):
        found[candidate.chain] = candidate
        progress("cross-validation" if test_cost is None else "test data", len(found), len(rows))
    return sorted((found[e.chain] for e in each), key=lambda c: c.order)


def explains(estimate: Estimate, task: Task, most: Real) -> bool:
    """Return True if an estimate explains the data, or nearly, as `unseen_explanation` has it."""
    return unseen_explanation(estimate, task, most).is_near


def unseen_explanation(estimate: Estimate, task: Task, most: Real) -> Explanation:
    """Explain the data of a task, of one response, by an estimate at lines that its fit did not
    use, if these scatter as they do about it and by no more than the shares `most` of the measured
    amplitudes, shape (n_f,).
    """
    own, size = _scatter_about(estimate, task), np.abs(task.cost.measured.G)
    sigma = np.minimum(own.sigma, most * size)
    scatter = replace(own, rho=sigma / (np.sqrt(2) * own.size))
    missed = _expect_residuals(estimate, task, None, scatter, scatter)
    response = _cross_validate(estimate, task, values_of(estimate, task))
    residual = WhitenedCost(task.cost, scatter).residual(response)
    return explain(task.cost, residual, missed, scatter)


def share_about(estimate: Estimate, task: Task) -> Real:
    """Scatter of the data about one estimate, as shares of the measured amplitudes, shape
    (n_f,).
    """
    return np.asarray(_scatter_about(estimate, task).sigma / np.abs(task.cost.measured.G))


def _scatter_about(estimate: Estimate, task: Task) -> Scatter:
    """Scatter of the data about one estimate."""
    return merge(scatters(task.cost, [_response(estimate, task)]))


def values_of(estimate: Estimate, task: Task) -> Real:
    """Parameters as an array, in the order of the task."""
    return np.array([estimate.parameters[n] for n in task.names(estimate.chain)])


def _response(estimate: Estimate, task: Task) -> Complex:
    return task.plant(estimate.chain).response(values_of(estimate, task))


def _criteria(estimate: Estimate, task: Task, scatter: Scatter) -> tuple[Practical, NoiseModel]:
    """The criteria at the optimum, of the parameters that are free, and what the residuals
    there are like.
    """
    chain, names = estimate.chain, task.names(estimate.chain)
    p = values_of(estimate, task)
    free = task.box(names).free
    residual, columns = task.cost.of(task.plant(chain), p)
    sigma = task.cost.scatter(scatter)
    noise = noises(task.cost, residual, sigma, expected_deviation(columns[:, free], sigma))
    chosen = [n for n, is_free in zip(names, free, strict=True) if is_free]
    return practical(columns[:, free], chosen, noise), noise


def at_other_values(
    candidate: Candidate, values: Mapping[str, float], task: Task, scatter: Scatter
) -> Candidate:
    """A candidate at other values that give the same response, with the standard errors there."""
    estimate = replace(candidate.estimate, parameters=dict(values), valleys=())
    there, noise = _criteria(estimate, task, scatter)
    practical_there = replace(candidate.practical, relative_errors=there.relative_errors)
    return replace(candidate, estimate=estimate, practical=practical_there, noise=noise)


def _candidate(
    estimate: Estimate,
    criteria: Practical,
    noise: NoiseModel,
    task: Task,
    test: AnyCost | None,
    own_scatters: Scatters,
) -> Candidate:
    """Test cost of one estimate with its criteria."""
    chain, names = estimate.chain, task.names(estimate.chain)
    p = values_of(estimate, task)
    box = task.box(names)
    cost = test or task.cost
    response = _cross_validate(estimate, task, p) if test is None else _at(chain, task, test, p)
    residual = cost.residual(response)
    near = (box.high - p <= AT_BOUND * p) | ((box.low > 0) & (p - box.low <= AT_BOUND * p))
    at_bound = tuple(n for n, hit, free in zip(names, near, box.free, strict=True) if hit and free)
    missed = _expect_residuals(estimate, task, test, *own_scatters)
    whitened = WhitenedCost(cost, own_scatters[1]).residual(response)
    apart, worst = chi2_apart(whitened, missed, line_frequencies(cost))
    return Candidate(
        chain,
        estimate,
        criteria,
        float(residual @ residual),
        chi2(whitened, missed),
        at_bound,
        whitened,
        missed,
        noise,
        chi2_apart=apart,
        worst_apart=worst,
    )


def _expect_residuals(
    estimate: Estimate, task: Task, test: AnyCost | None, inside: Scatter, outside: Scatter
) -> Real:
    """Expected whitened residuals on the judged data, shape (n_y,): 1, and the errors of the
    parameters. Without test data these are errors of a fit without the line: what one line alone
    determines, as the height of a narrow resonance, the others do not foretell.
    """
    p, free = values_of(estimate, task), task.box(task.names(estimate.chain)).free
    plant, sigma, judging = task.plant(estimate.chain), task.cost.scatter(inside), test or task.cost
    other_plant = replace(task, cost=judging).plant(estimate.chain)
    columns = WhitenedCost(judging, outside).of(other_plant, p)[1][:, free]
    ones = np.ones(len(columns))
    if test is not None:
        return expected_deviation(task.cost.of(plant, p)[1][:, free], sigma, columns, ones)
    fitted = task.cost.of(plant, p)[1][:, free]
    for seen in _mark_seen(task.cost):
        out = seen == 0
        ones[out] = expected_deviation(fitted * seen[:, None], sigma, columns[out], ones[out])
    return ones


def _folds(cost: AnyCost) -> list[Indices]:
    """To which fold each line of each response belongs: lines are dealt out in turn."""
    return [np.arange(len(part.measured)) % FOLDS for part in cost.parts]


def _mark_seen(cost: AnyCost) -> Real:
    """Residuals that the fit without each fold sees, shape (FOLDS, n_y): 1, and 0 for those of the
    lines of the fold.
    """
    rows = np.concatenate([np.tile(fold, 2) for fold in _folds(cost)])
    return np.asarray(rows != np.arange(FOLDS)[:, None], dtype=float)


def _at(chain: Chain, task: Task, cost: AnyCost, p: Real) -> Complex:
    return replace(task, cost=cost).plant(chain).response(p)


def _cross_validate(estimate: Estimate, task: Task, p: Real) -> Complex:
    """The response at each line of the fit to the other folds, shape (n_f,)."""
    if not task.box(task.names(estimate.chain)).free.any():
        return _at(estimate.chain, task, task.cost, p)  # no fit sees any line
    plant, box = task.plant(estimate.chain), task.box(task.names(estimate.chain))
    starts, cost = np.tile(p, (FOLDS, 1)), CostOfEach(task.cost, _mark_seen(task.cost))
    ends, _ = rough(plant, cost, box, starts, FOLD_STEPS, FOLD_GAIN)
    at = np.concatenate(_folds(task.cost))
    return np.asarray(plant.response(ends)[at, np.arange(len(at))])
