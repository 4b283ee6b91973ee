"""Choice among the fitted candidates: those that the data do not exclude, and the selected one.

A candidate is excluded if it does not explain the data (`explanation`) while others do, or if
another one shows that it misses more than noise (`exclusion`). Of those that are left the simplest
one is selected, of equally simple ones that with the lowest cost on test. What a structure adds on
single lines alone is not shown (`lone_lines`): such a structure is selected last. Under the paper's
rule only candidates whose criteria hold are considered.

Candidates that contain one that explains the data, or that the data do not exclude.

A candidate that contains another one (`fit.search.containment`) has its response in the limit.
Therefore it is left if the other one is, whatever its own search found. A search may fail on its
own data, or a fold of the cross-validation may run away: a resonance without damping at one line
fits the others better and misses that one by any amount. Then the search begins again at the limit,
and where it fails there too the candidate is taken at the limit itself.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import exp, log

import numpy as np

from disting.fit.judge.admissible import Rule
from disting.fit.judge.candidate import Candidate, Scatters, judge, values_of
from disting.fit.judge.exclusion import (
    Exclusion,
    Fit,
    basis_of,
    exclusions,
    limit,
    rests_on_lone_lines,
    statistic,
)
from disting.fit.judge.explanation import (
    Explanation,
    explain,
    line_frequencies,
    needed_lines,
    noises,
)
from disting.fit.search.containment import contains
from disting.fit.search.cost import Cost
from disting.fit.search.data import WhitenedCost
from disting.fit.search.descent import fine
from disting.fit.search.estimate import Estimate, Task, embedded
from disting.fit.search.joint import AnyCost
from disting.measurement.arrays import Real
from disting.model.chain import Chain
from disting.model.question import Settings
from disting.statistics.lone_lines import LoneLines
from disting.statistics.scatter import Scatter

ALIKE = 0.01  # of the scatter of a line: closer responses are the same


def searched_again(
    left: Sequence[Candidate],
    judged: Sequence[Candidate],
    task: Task,
    test: AnyCost | None,
    scatters: Scatters,
    settings: Settings,
) -> dict[Chain, Candidate]:
    """The judged candidates that do not fit the data although they contain one that is left, each
    as good as that; none where the bounds of the task keep them away from it.
    """
    scatter = scatters[1]
    own = {c.chain: c for c in left}
    chains = set(own)
    for c in sorted(judged, key=lambda c: c.n_parameters):
        if c.explains(scatter):
            continue
        inner = (own[s] for s in own if contains(c.chain, s))
        for contained in sorted(inner, key=lambda s: s.j_train)[:1]:
            limit = limit_in(c.chain, contained, task, scatters[0])
            if limit is not None:
                ends = _from_limit(c, contained, limit, task, test, scatters, settings)
                own[c.chain] = next(end for end in ends if end.explains(scatter))
    return {chain: c for chain, c in own.items() if chain not in chains}


def left_with_contained(
    excluded: Mapping[Chain, Exclusion],
    candidates: Sequence[Candidate],
    task: Task,
    scatters: Scatters,
) -> dict[Chain, Exclusion]:
    """The exclusions without those of candidates that contain one which is not excluded."""
    left = [c for c in candidates if c.chain not in excluded]
    return {
        chain: exclusion
        for chain, exclusion in excluded.items()
        if not any(limit_in(chain, c, task, scatters[0]) is not None for c in left)
    }


def check_left(
    left: Sequence[Candidate], judged: Sequence[Candidate], task: Task, scatters: Scatters
) -> None:
    """Raise AssertionError if a judged candidate that contains one that is left is not left."""
    chains = {c.chain for c in left}
    for other in (c for c in judged if c.chain not in chains):
        for c in left:
            if limit_in(other.chain, c, task, scatters[0]) is not None:
                raise AssertionError(f"{other!r} contains {c!r}, which is left, and is not left")


def limit_in(chain: Chain, contained: Candidate, task: Task, scatter: Scatter) -> Real | None:
    """The parameters of a chain, shape (n_p,), at which it has the response of a fitted candidate
    within `ALIKE` of the scatter, the least extreme ones; None where it does not contain it, or
    where the bounds of the task keep it away from the limit.
    """
    if not contains(chain, contained.chain):
        return None
    starts = embedded(chain, contained.estimate, task)
    cost = WhitenedCost(task.cost, scatter)
    own = cost.residual(task.plant(contained.chain).response(values_of(contained.estimate, task)))
    with np.errstate(all="ignore"):
        apart = np.abs(cost.residual(task.plant(chain).response(starts)) - own).max(axis=-1)
    near = np.flatnonzero(apart <= ALIKE)
    return starts[near[0]] if near.size else None


def _from_limit(
    candidate: Candidate,
    contained: Candidate,
    limit: Real,
    task: Task,
    test: AnyCost | None,
    scatters: Scatters,
    settings: Settings,
) -> Iterator[Candidate]:
    """Yield the candidate searched again from the limit, then that at the limit, with the residual
    of the one that it contains.
    """
    chain, box = candidate.chain, task.box(task.names(candidate.chain))
    p, j = fine(task.plant(chain), task.cost, box, limit)
    yield from judge([_estimate(candidate, p, j, task)], task, test, scatters, settings)
    estimate = _estimate(candidate, limit, contained.j_train, task)
    (there,) = judge([estimate], task, test, scatters, settings)
    yield replace(
        there,
        j_test=contained.j_test,
        chi2=contained.chi2,
        chi2_apart=contained.chi2_apart,
        worst_apart=contained.worst_apart,
        residual=contained.residual,
        missed=contained.missed,
    )


def _estimate(candidate: Candidate, p: Real, j: float, task: Task) -> Estimate:
    names = task.names(candidate.chain)
    values = dict(zip(names, map(float, p), strict=True))
    return replace(candidate.estimate, parameters=values, j=j)


def with_akaike_weights(candidates: Sequence[Candidate], task: Task) -> list[Candidate]:
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
    p = values_of(candidate.estimate, task)
    each = cost.by_residual(cost.residual(task.plant(candidate.chain).response(p)))
    return [(float(own @ own), own.size) for own in each]


@dataclass(frozen=True)
class Choice:
    """`candidates` in the order of the cost on test. `left`: those that the data do not exclude,
    the selected one first, then the simplest; `better` as in `select.Selection`.
    """

    candidates: tuple[Candidate, ...]
    explanation: Explanation
    selected: Candidate | None = None
    left: tuple[Candidate, ...] = ()
    better: tuple[Candidate, ...] = ()


def choice(
    fitted: Sequence[Candidate],
    task: Task,
    test: AnyCost | None,
    scatters: Scatters,
    rule: Rule,
    settings: Settings,
) -> Choice:
    """Find the remaining candidates and select one; `fitted` in the order of J on test, `scatters`
    = scatter of training data and of those on test.
    """
    judging, scatter = test or task.cost, scatters[1]
    eligible_ones, enough = eligible(fitted, rule), judged(fitted, rule, judging)
    explaining = [c for c in enough if c.explains(scatter)]
    lone = _lone(eligible_ones, task, scatters[0], settings) if explaining else {}
    if all(c.chain in lone for c in explaining):
        best = next((c for c in eligible_ones if c.chain not in lone), None)
        explanation_of_best = _explain_described(best or fitted[0], judging, scatter)
        better = _better(best, fitted, task, scatters) if best and rule is Rule.PAPER else ()
        whole = tuple(replace(c, rests_on=lone.get(c.chain)) for c in fitted)
        return Choice(whole, explanation_of_best, best, better=better)
    out, lone = _find_excluded(explaining, lone, task, test, scatters, settings)
    out = left_with_contained(out, explaining, task, scatters)
    whole = tuple(replace(c, excluded=out.get(c.chain), rests_on=lone.get(c.chain)) for c in fitted)
    chains = {c.chain for c in explaining} - out.keys()
    left = sorted(
        (c for c in whole if c.chain in chains),
        key=lambda c: (c.rests_on is not None, c.n_parameters, c.order),
    )
    selected = left[0]
    better = _better(selected, fitted, task, scatters) if rule is Rule.PAPER else ()
    return Choice(
        whole, _explain_described(selected, judging, scatter), selected, tuple(left), better
    )


def eligible(fitted: Sequence[Candidate], rule: Rule) -> list[Candidate]:
    """The candidates that may be left: those that some data determine, and, under the paper's rule,
    whose criteria hold.
    """
    admitted = [c for c in fitted if c.admissible] if rule is Rule.PAPER else list(fitted)
    return [c for c in admitted if not c.practical.unidentifiable] or admitted


def judged(fitted: Sequence[Candidate], rule: Rule, judging: AnyCost) -> list[Candidate]:
    """The eligible candidates that the data have lines enough to judge."""
    lines = sum(len(part.measured) for part in judging.parts)
    return [c for c in eligible(fitted, rule) if lines >= needed_lines(c.n_parameters)]


def _explain_described(described: Candidate, judging: AnyCost, seen: Scatter) -> Explanation:
    found = explain(judging, described.residual, described.missed, seen)
    return replace(found, needed=needed_lines(described.n_parameters))


def _lone(
    candidates: Sequence[Candidate], task: Task, inside: Scatter, settings: Settings
) -> dict[Chain, LoneLines]:
    """Candidates whose gain on the data of the fit rests on single lines."""
    trained = [trained_as(c, task, inside) for c in candidates]
    return rests_on_lone_lines(trained, inside.freedom, settings)


def _find_excluded(
    candidates: Sequence[Candidate],
    lone: dict[Chain, LoneLines],
    task: Task,
    test: AnyCost | None,
    scatters: Scatters,
    settings: Settings,
) -> tuple[dict[Chain, Exclusion], dict[Chain, LoneLines]]:
    """Those that others exclude: on the data not used in any fit, where there are such, since a
    machine that changes leaves traces that a rich candidate fits too; else on those of the fit.
    Those whose gain rests on single lines, of the fit (`lone`) or of these data.
    """
    inside, outside = scatters
    if test is None:
        trained = [trained_as(c, task, inside) for c in candidates]
        return exclusions(trained, inside.freedom, settings, lone=lone), lone
    other_task = replace(task, cost=test)
    values = {c.chain: values_of(c.estimate, task) for c in candidates}

    def again(fit: Fit) -> Fit:
        """The structure fitted to the test data, from where it was."""
        plant, box = other_task.plant(fit.chain), task.box(task.names(fit.chain))
        p, _ = fine(plant, WhitenedCost(test, outside), box, values[fit.chain])
        return _fit_at(fit.chain, p, other_task, outside)

    tested = [_fit_at(chain, p, other_task, outside) for chain, p in values.items()]
    lone = rests_on_lone_lines(tested, outside.freedom, settings) | lone
    return exclusions(tested, outside.freedom, settings, again, lone), lone


def trained_as(candidate: Candidate, task: Task, scatter: Scatter) -> Fit:
    """Fit of a candidate to its training data, as the test of exclusion needs it."""
    return _fit_at(candidate.chain, values_of(candidate.estimate, task), task, scatter)


def _fit_at(chain: Chain, p: Real, task: Task, scatter: Scatter) -> Fit:
    residual, columns = WhitenedCost(task.cost, scatter).of(task.plant(chain), p)
    free = task.box(task.names(chain)).free
    noise = noises(task.cost, residual, np.ones(residual.size))
    basis = basis_of(columns[:, free])
    return Fit(chain, residual, basis, noise, line_frequencies(task.cost))


def _better(
    selected: Candidate, fitted: Sequence[Candidate], task: Task, scatters: Scatters
) -> tuple[Candidate, ...]:
    """Candidates that the paper's criteria leave out, and that would exclude the selected one,
    those with few parameters first.
    """
    inside = scatters[0]
    own = trained_as(selected, task, inside)
    lower = [c for c in fitted if not c.admissible and c.j_train < selected.j_train]
    candidates = [
        c
        for c in lower
        if statistic(own, trained_as(c, task, inside)) > limit(c.n_parameters, inside.freedom)
    ]
    return tuple(sorted(candidates, key=lambda c: (c.n_parameters, c.order)))
