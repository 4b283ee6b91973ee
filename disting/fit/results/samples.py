"""Parameters drawn from what a fit knows of them: normal in their logarithms, with their covariance
(`practical.covariance`).

What behaves as a fitted structure does (a twin) is drawn along with it, to first order: with
sensitivities S = d ln G / d ln p at the lines of the data a step x of the fitted structure's
logarithms is a step y of the twin's with S_twin y = S x, the smallest where there are several.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from disting.fit.judge.candidate import Candidate
from disting.fit.judge.members import Member, Twin
from disting.fit.judge.practical import covariance
from disting.fit.search.estimate import Task
from disting.fit.search.plant import Plant
from disting.measurement.arrays import Real
from disting.model.chain import Chain

DRAWS = 100  # of a structure
WIDEST = 1.0  # standard deviation of a logarithm, where the data do not determine it
FELT = 1e-9  # of the largest sensitivity of a twin: what is less has no effect


@dataclass(frozen=True, eq=False)
class Drawn:
    """A structure with its parameters drawn, shape (n, n_p), its own first, and the number of
    structures that do the same at the sensor.
    """

    chain: Chain
    p: Real
    alike: int = 1


def drawn(left: Sequence[Member], task: Task) -> tuple[Drawn, ...]:
    """The structures that were fitted."""
    return tuple(Drawn(m.candidate.chain, draws(m.candidate, task), 1 + len(m.twins)) for m in left)


def with_twins(left: Sequence[Member], fitted: Sequence[Drawn], omega: Real) -> Iterator[Drawn]:
    """Each fitted structure, then its twins; `omega`: lines of the data [rad/s]."""
    for member, one in zip(left, fitted, strict=True):
        yield one
        yield from (_carried(twin, one, omega) for twin in member.twins)


def _carried(twin: Twin, one: Drawn, omega: Real) -> Drawn:
    """The twin, drawn along with the structure whose twin it is."""
    own = np.array([twin.parameters[name] for name in twin.chain.parameters])
    held = one.p[0] == 0  # a damper that is not there
    steps = np.log(np.where(held, 1.0, one.p) / np.where(held, 1.0, one.p[0]))
    moved = _sensitivity(one.chain, one.p[0], omega) @ steps.T
    there = np.linalg.lstsq(_sensitivity(twin.chain, own, omega), moved, rcond=FELT)[0]
    return Drawn(twin.chain, own * np.exp(there.T))


def _sensitivity(chain: Chain, p: Real, omega: Real) -> Real:
    """d ln G / d ln p, real parts first, shape (2 n_f, n_p)."""
    columns = Plant(chain.structure, omega).logarithmic_gradient(p)[1] * p[:, None]
    return np.concatenate([columns.real, columns.imag], axis=-1).T


def draws(candidate: Candidate, task: Task, count: int = DRAWS) -> Real:
    """Parameters of the chain, shape (count, n_p): the fit, then draws near it.

    A direction that the data do not determine is drawn with a standard deviation of `WIDEST`, what
    is given not at all.
    """
    names = task.names(candidate.chain)
    p = np.array([candidate.estimate.parameters[name] for name in names])
    free = task.box(names).free
    whole = np.tile(p, (count, 1))
    if free.any():
        columns = task.cost.of(task.plant(candidate.chain), p)[1][:, free]
        normal = np.random.default_rng(0).normal(size=(count - 1, int(free.sum())))
        whole[1:, free] *= np.exp(normal @ _half(covariance(columns, candidate.noise)))
    return whole[:, : len(candidate.chain.parameters)]


def _half(spread: Real) -> Real:
    """F with F'F the covariance of ln p, no direction wider than `WIDEST`."""
    if not np.all(np.isfinite(spread)):
        return WIDEST * np.eye(len(spread))
    sizes, directions = np.linalg.eigh(spread)
    kept = np.minimum(np.sqrt(np.maximum(sizes, 0.0)), WIDEST)
    return np.asarray(kept[:, None] * directions.T)
