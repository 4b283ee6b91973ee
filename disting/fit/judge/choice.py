"""Which of the fitted candidates the data do not exclude, and which of these is selected.

A candidate is excluded if it does not explain the data (`explanation`) while others do, or if
another one shows that it misses more than noise (`exclusion`). Of those that are left the simplest
one is selected, of equally simple ones that with the lowest cost on test. What a structure adds on
single lines alone is not shown (`lone_lines`): such a structure is selected last. Under the paper's
rule only candidates whose criteria hold are asked at all.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import exp, log

import numpy as np

from disting.fit.judge.admissible import Rule
from disting.fit.judge.candidate import Candidate, Scatters, values_of
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
from disting.fit.judge.larger import left_with_contained
from disting.fit.search.cost import Cost
from disting.fit.search.data import WhitenedCost
from disting.fit.search.descent import fine
from disting.fit.search.estimate import Task
from disting.fit.search.joint import AnyCost
from disting.measurement.arrays import Real
from disting.model.chain import Chain
from disting.model.question import Settings
from disting.statistics.lone_lines import LoneLines
from disting.statistics.scatter import Scatter


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
    """Which candidates are left, and which one is selected; `fitted` in the order of J on test,
    `scatters` = scatter of training data and of those on test.
    """
    judging, seen = test or task.cost, scatters[1]
    asked, enough = eligible(fitted, rule), judged(fitted, rule, judging)
    explaining = [c for c in enough if c.explains(seen)]
    lone = _lone(asked, task, scatters[0], settings) if explaining else {}
    if all(c.chain in lone for c in explaining):
        best = next((c for c in asked if c.chain not in lone), None)
        said = _explained(best or fitted[0], judging, seen)
        better = _better(best, fitted, task, scatters) if best and rule is Rule.PAPER else ()
        whole = tuple(replace(c, rests_on=lone.get(c.chain)) for c in fitted)
        return Choice(whole, said, best, better=better)
    out, lone = _excluded(explaining, lone, task, test, scatters, settings)
    out = left_with_contained(out, explaining, task, scatters)
    whole = tuple(replace(c, excluded=out.get(c.chain), rests_on=lone.get(c.chain)) for c in fitted)
    chains = {c.chain for c in explaining} - out.keys()
    left = sorted(
        (c for c in whole if c.chain in chains),
        key=lambda c: (c.rests_on is not None, c.n_parameters, c.order),
    )
    selected = left[0]
    better = _better(selected, fitted, task, scatters) if rule is Rule.PAPER else ()
    return Choice(whole, _explained(selected, judging, seen), selected, tuple(left), better)


def eligible(fitted: Sequence[Candidate], rule: Rule) -> list[Candidate]:
    """The candidates that may be left: those that some data determine, and, under the paper's rule,
    whose criteria hold.
    """
    asked = [c for c in fitted if c.admissible] if rule is Rule.PAPER else list(fitted)
    return [c for c in asked if not c.practical.unidentifiable] or asked


def judged(fitted: Sequence[Candidate], rule: Rule, judging: AnyCost) -> list[Candidate]:
    """The eligible candidates that the data have lines enough to judge."""
    lines = sum(len(part.measured) for part in judging.parts)
    return [c for c in eligible(fitted, rule) if lines >= needed_lines(c.n_parameters)]


def _explained(described: Candidate, judging: AnyCost, seen: Scatter) -> Explanation:
    said = explain(judging, described.residual, described.missed, seen)
    return replace(said, needed=needed_lines(described.n_parameters))


def _lone(
    candidates: Sequence[Candidate], task: Task, inside: Scatter, settings: Settings
) -> dict[Chain, LoneLines]:
    """Candidates whose gain on the data of the fit rests on single lines."""
    trained = [trained_as(c, task, inside) for c in candidates]
    return rests_on_lone_lines(trained, inside.freedom, settings)


def _excluded(
    candidates: Sequence[Candidate],
    lone: dict[Chain, LoneLines],
    task: Task,
    test: AnyCost | None,
    scatters: Scatters,
    settings: Settings,
) -> tuple[dict[Chain, Exclusion], dict[Chain, LoneLines]]:
    """Those that others exclude: on the data that no fit has seen, where there are such, since a
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
    """What the test of exclusion asks of a candidate on the data of its fit."""
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
