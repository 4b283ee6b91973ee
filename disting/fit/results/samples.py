"""Parameters drawn from what a fit knows of them: normal in their logarithms, with their covariance
(`practical.covariance`). Where the data determine a direction badly a response is not as straight
as the covariance takes it. What a draw x does to the residuals is, to first order, S x; where it
does more the parameters are searched that do just this,

    min |r(p) - r(p_0) - S x|^2,    from p_0 exp(x),

and a draw that leads to none is left out.

What behaves as a fitted structure does (a twin) is drawn along with it: its parameters q are
searched that give the response of the draw at the lines of the data, G_twin(q) = G(p); a draw that
has no such twin near by is left out.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import inf

import numpy as np

from disting.fit.judge.candidate import OUTSIDE, Candidate
from disting.fit.judge.exclusion import limit
from disting.fit.judge.members import Member, Twin
from disting.fit.search.cost import SquaredCost
from disting.fit.search.descent import rough
from disting.fit.search.estimate import Task
from disting.fit.search.joint import AnyCost
from disting.fit.search.plant import Plant
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain
from disting.statistics.practical import NoiseModel

DRAWS = 100  # of a structure
WIDEST = 1.0  # standard deviation of a logarithm, where the data do not determine it
STRAIGHT = 0.05  # standard deviation of a logarithm up to which a response is straight enough
BLIND = 1e-8  # of the largest singular value of S: what is less says nothing of its direction
BACK = 20  # steps of the search for what a draw stands for
NEAR = 0.05  # of the largest change of a response: so exactly a twin gives that of a draw
ROUNDED = 1e-9  # of a logarithm
STEPS = 20  # of the search for it, each of a factor e at most
FELT = 1e-12  # of the square of a twin's largest sensitivity: what is less has no effect


@dataclass(frozen=True, eq=False)
class ParameterSamples:
    """A structure with its parameters drawn, shape (n, n_p), its own first, and the number of
    structures that do the same at the sensor.
    """

    chain: Chain
    p: Real
    alike: int = 1


def draw_samples(left: Sequence[Member], task: Task) -> tuple[ParameterSamples, ...]:
    """The structures that were fitted."""
    return tuple(
        ParameterSamples(m.candidate.chain, draws(m.candidate, task), 1 + len(m.twins))
        for m in left
    )


def with_twins(
    left: Sequence[Member], fitted: Sequence[ParameterSamples], omega: Real
) -> Iterator[ParameterSamples]:
    """Each fitted structure, then its twins; `omega`: lines of the data [rad/s]."""
    for member, sample in zip(left, fitted, strict=True):
        yield sample
        yield from (_carried(twin, sample, omega) for twin in member.twins)


def _carried(twin: Twin, sample: ParameterSamples, omega: Real) -> ParameterSamples:
    """The twin, drawn along with the structure whose twin it is: Newton's steps from its own
    values, the smallest where there are several.
    """
    plant = Plant(twin.chain.structure, omega)
    aims = Plant(sample.chain.structure, omega).response(sample.p)
    own = np.array([twin.parameters[name] for name in twin.chain.parameters])
    x, near = np.tile(np.log(own), (len(aims), 1)), NEAR * np.abs(np.log(aims / aims[0])).max()
    active = np.arange(len(aims))
    for _ in range(STEPS):
        p = np.exp(x[active])
        response, gradient = plant.logarithmic_gradient(p)
        left = _halves(np.log(aims[active] / response))
        apart = np.abs(left).max(axis=-1) > near + ROUNDED
        active = active[apart]
        if not active.size:
            break
        rows = _halves(gradient[apart] * p[apart, :, None])
        squares, slope = rows @ rows.swapaxes(-1, -2), rows @ left[apart, :, None]
        step = (np.linalg.pinv(squares, rcond=FELT, hermitian=True) @ slope)[..., 0]
        x[active] += step / np.maximum(1.0, np.abs(step).max(axis=-1, keepdims=True))
    return ParameterSamples(twin.chain, np.exp(np.delete(x, active, axis=0)))


def _halves(values: Complex) -> Real:
    """Real parts first, shape (..., 2 n_f)."""
    return np.concatenate([values.real, values.imag], axis=-1)


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


def _axes(columns: Real, noise: NoiseModel) -> tuple[Real, Real]:
    """Standard deviations of ln p along the axes of their covariance (`practical.covariance`),
    none above `WIDEST`, and these axes, shape (n_p, n_p), a row each: of a root of it, as squares
    lose the short ones.
    """
    left, values, right = np.linalg.svd(columns, full_matrices=False)
    half = noise.seen(left) / np.maximum(values, BLIND * values[0]) @ right
    _, sizes, axes = np.linalg.svd(np.linalg.qr(half, mode="r"))
    unseen = len(axes) - len(sizes)  # where the data are fewer than the parameters
    return np.minimum(np.pad(sizes, (0, unseen), constant_values=WIDEST), WIDEST), axes
