"""Candidates that contain one that explains the data, or that the data do not exclude.

A candidate that contains another one (`fit.search.containment`) has its response in the limit.
Therefore it is left if the other one is, whatever its own search found. A search may fail on the
data that it has seen, or a fold of the cross-validation may run away: a resonance without damping
at one line fits the others better and misses that one by any amount. Then the search begins again
at the limit, and where it fails there too the candidate is taken at the limit itself.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from disting.fit.judge.candidate import Candidate, Scatters, judge, values_of
from disting.fit.judge.exclusion import Exclusion
from disting.fit.search.containment import contains
from disting.fit.search.data import WhitenedCost
from disting.fit.search.descent import fine
from disting.fit.search.estimate import Estimate, Task, embedded
from disting.fit.search.joint import AnyCost
from disting.measurement.arrays import Real
from disting.model.chain import Chain
from disting.model.question import Settings
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
    """The judged candidates that miss the data although they contain one that is left, each as good
    as that; none where the bounds of the task keep them away from it.
    """
    seen = scatters[1]
    own = {c.chain: c for c in left}
    chains = set(own)
    for c in sorted(judged, key=lambda c: c.n_parameters):
        if c.explains(seen):
            continue
        inner = (own[s] for s in own if contains(c.chain, s))
        for contained in sorted(inner, key=lambda s: s.j_train)[:1]:
            limit = limit_in(c.chain, contained, task, scatters[0])
            if limit is not None:
                ends = _from_limit(c, contained, limit, task, test, scatters, settings)
                own[c.chain] = next(end for end in ends if end.explains(seen))
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
