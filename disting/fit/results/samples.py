"""Parameters drawn from what a fit knows of them: normal in their logarithms, with their covariance
(`practical.covariance`). Where the data determine a direction badly a response is not as straight
as the covariance takes it. What a draw x does to the residuals is, to first order, S x; where it
does more the parameters are searched that do just this,

    min |r(p) - r(p_0) - S x|^2,    from p_0 exp(x),

and a draw that leads to none is left out.

What behaves as a fitted structure does (a twin) is drawn along with it, to first order: with
sensitivities S = d ln G / d ln p at the lines of the data a step x of the fitted structure's
logarithms is a step y of the twin's with S_twin y = S x, the smallest where there are several.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import inf

import numpy as np

from disting.fit.judge.candidate import OUTSIDE, Candidate
from disting.fit.judge.exclusion import limit
from disting.fit.judge.members import Member, Twin
from disting.fit.judge.practical import Seen
from disting.fit.search.cost import SquaredCost
from disting.fit.search.descent import rough
from disting.fit.search.estimate import Task
from disting.fit.search.joint import AnyCost
from disting.fit.search.plant import Plant
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain

DRAWS = 100  # of a structure
WIDEST = 1.0  # standard deviation of a logarithm, where the data do not determine it
STRAIGHT = 0.05  # standard deviation of a logarithm up to which a response is straight enough
BLIND = 1e-8  # of the largest singular value of S: what is less says nothing of its direction
BACK = 20  # steps of the search for what a draw stands for
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
    response = Plant(one.chain.structure, omega).response(one.p)
    moved = np.log(response / response[0])
    moved = np.concatenate([moved.real, moved.imag], axis=-1)
    there = np.linalg.lstsq(_sensitivity(twin.chain, own, omega), moved.T, rcond=FELT)[0]
    return Drawn(twin.chain, own * np.exp(there.T))


def _sensitivity(chain: Chain, p: Real, omega: Real) -> Real:
    """d ln G / d ln p, real parts first, shape (2 n_f, n_p)."""
    columns = Plant(chain.structure, omega).logarithmic_gradient(p)[1] * p[:, None]
    return np.concatenate([columns.real, columns.imag], axis=-1).T


def draws(candidate: Candidate, task: Task, count: int = DRAWS) -> Real:
    """Parameters of the chain, shape (n, n_p): the fit, then at most count - 1 draws near it.

    A direction that the data do not determine is drawn with a standard deviation of `WIDEST`, what
    is given not at all.
    """
    names = task.names(candidate.chain)
    p = np.array([candidate.estimate.parameters[name] for name in names])
    plant, box = task.plant(candidate.chain), task.box(names)
    free, whole = box.free, np.tile(p, (count, 1))
    if not free.any():
        return whole[:, : len(candidate.chain.parameters)]
    residual, columns = task.cost.of(plant, p)
    sizes, axes = _axes(columns[:, free], candidate.noise)
    steps = np.random.default_rng(0).normal(size=(count - 1, len(sizes))) * sizes @ axes
    whole[1:, free] *= np.exp(steps)
    if np.any(sizes > STRAIGHT):
        ends = [
            rough(
                plant, _Towards(task.cost, residual + columns[:, free] @ x), box, start[None], BACK
            )
            for x, start in zip(steps, whole[1:], strict=True)
        ]
        most = _excess(candidate, task.cost.n_residuals, len(sizes))
        whole = np.stack([p, *(points[0] for points, costs in ends if costs[0] <= most)])
    return whole[:, : len(candidate.chain.parameters)]


@dataclass(frozen=True, eq=False)
class _Towards(SquaredCost):
    """The distance from given residuals, shape (n_y,), instead of from none."""

    cost: AnyCost
    aim: Real

    @property
    def n_residuals(self) -> int:
        """Those of the cost."""
        return self.cost.n_residuals

    def residual(self, response: Complex) -> Real:
        """What is left to the aim, shape (..., n_y)."""
        return np.asarray(self.cost.residual(response) - self.aim)

    def sensitivity(self, response: Complex, gradient: Complex) -> Real:
        """That of the cost."""
        return self.cost.sensitivity(response, gradient)


def _excess(candidate: Candidate, n_y: int, n_p: int) -> float:
    """By how much J may exceed its minimum where parameters are not excluded, the noise as the
    residuals have it.
    """
    return candidate.estimate.j * limit(n_p, inf, level=OUTSIDE) / max(n_y - n_p, 1)


def _axes(columns: Real, noise: Seen) -> tuple[Real, Real]:
    """Standard deviations of ln p along the axes of their covariance (`practical.covariance`),
    none above `WIDEST`, and these axes, shape (n_p, n_p), a row each: of a root of it, as squares
    lose the short ones.
    """
    left, values, right = np.linalg.svd(columns, full_matrices=False)
    half = noise.seen(left) / np.maximum(values, BLIND * values[0]) @ right
    _, sizes, axes = np.linalg.svd(np.linalg.qr(half, mode="r"))
    unseen = len(axes) - len(sizes)  # where the data are fewer than the parameters
    return np.minimum(np.pad(sizes, (0, unseen), constant_values=WIDEST), WIDEST), axes
