"""Local search: many starts at once by Levenberg-Marquardt on logarithms, then the best ones by
`scipy.optimize.least_squares`.

Logarithms keep masses, springs, dampers and times positive and make steps relative. The rough
search costs little a start, because a batch shares every numpy call; the last digits, bounds and
the stopping rule are those of scipy.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from disting.fit.search.cost import Indices, SquaredCost
from disting.fit.search.plant import Differentiable
from disting.measurement.arrays import Real

# starts at once: more do not fit into a processor's cache, which costs half as much again
BATCH = 8
RESIDUALS = 400_000  # of all starts at once: of many lines, one start alone is enough work
FIRST_DAMPING, HOPELESS = 1e-2, 1e8  # of Levenberg and Marquardt
LARGEST_STEP = 1.5  # of a logarithm in one iteration
WORTHLESS = 1e-4  # relative gain below which a start counts as settled
# of a logarithm from its start: what runs there has no effect on the response any more
FARTHEST = 60.0
SMALLEST = 1e-200  # of a parameter: repeated runs towards zero end here, before numbers do
# of the largest curvature, added to each: an element without effect must not take an unlimited step
TINY = 1e-9
LAST = 1e-12  # relative gain of cost at which the last digit is reached


@dataclass(frozen=True, eq=False)
class Box:
    """Bounds of the parameters, shape (n_p,) each; 0 and infinity where there are none. Equal
    bounds fix a parameter.
    """

    low: Real
    high: Real

    @property
    def free(self) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
        """Flags of the parameters that are not fixed."""
        return self.low < self.high

    @property
    def is_open(self) -> bool:
        """True if there are no bounds."""
        return bool(np.all(self.low <= 0) and np.all(np.isinf(self.high)))

    def clipped(self, p: Real) -> Real:
        """The nearest point inside."""
        return np.clip(p, self.low, self.high)


def rough(
    plant: Differentiable,
    cost: SquaredCost,
    box: Box,
    starts: Real,
    iterations: int,
    gain: float = WORTHLESS,
) -> tuple[Real, Real]:
    """Points, shape (n_s, n_p), and costs, shape (n_s,), after at most so many steps from each
    start, which ends where a step gains less than the share `gain` of its cost.

    None is dropped for a larger cost: the start that leads to the best optimum is often worse than
    half of the others for long.
    """
    points = box.clipped(starts)
    costs, damping = np.empty(len(points)), np.full(len(points), FIRST_DAMPING)
    curvature, slope = np.empty((*points.shape, points.shape[1])), np.empty(points.shape)
    active = np.arange(len(points))
    batch = max(1, min(BATCH, RESIDUALS // cost.n_residuals))
    for part in _batches(active, batch):
        costs[part], curvature[part], slope[part] = _normal(
            plant, cost.of_starts(part), box, points[part]
        )
    costs[np.isnan(costs)] = np.inf
    for _ in range(iterations):
        for part in _batches(active, batch):
            tried = box.clipped(
                points[part] * np.exp(_step(curvature[part], slope[part], damping[part]))
            )
            # Most steps lead downwards: their slope is computed along with their cost, which saves
            # a response a step.
            reached, *rows = _normal(plant, cost.of_starts(part), box, tried)
            better = reached < costs[part]
            settled = better & (reached > costs[part] * (1 - gain))
            damping[part] *= np.where(better, 0.2, 8.0)
            damping[part[settled]] = np.inf
            won = part[better]
            points[won], costs[won] = tried[better], reached[better]
            curvature[won], slope[won] = (array[better] for array in rows)
        active = active[damping[active] < HOPELESS]
        if not active.size:
            break
    return points, costs


def _batches(active: Indices, batch: int) -> list[Indices]:
    return np.array_split(active, -(-len(active) // batch))


def _normal(
    plant: Differentiable, cost: SquaredCost, box: Box, points: Real
) -> tuple[Real, Real, Real]:
    """Cost J = r'r, shape (n_s,), with S'S and S'r of the free logarithms, shapes (n_s, n_p,
    n_p) and (n_s, n_p).
    """
    residual, columns = cost.of(plant, points)
    columns *= box.free
    rows = columns.swapaxes(-1, -2)
    return (
        np.einsum("si,si->s", residual, residual),
        rows @ columns,
        (rows @ residual[..., None])[..., 0],
    )


def _step(curvature: Real, slope: Real, damping: Real) -> Real:
    """Levenberg-Marquardt steps, shape (n_s, n_p): (S'S + damping diag S'S) step = -S' r."""
    diagonal = np.einsum("sii->si", curvature)
    floor = TINY * diagonal.max(axis=-1, keepdims=True) + np.finfo(float).tiny
    damped = curvature.copy()
    np.einsum("sii->si", damped)[...] += damping[:, None] * diagonal + floor
    step = -np.linalg.solve(damped, slope[..., None])[..., 0]
    return np.asarray(np.clip(step, -LARGEST_STEP, LARGEST_STEP))


def fine(
    plant: Differentiable, cost: SquaredCost, box: Box, start: Real, gain: float = LAST
) -> tuple[Real, float]:
    """A local minimum, shape (n_p,), and its cost: never above that of the start; the search ends
    where a step gains less than the share `gain` of the cost.
    """
    free = box.free
    # a start may come from a relative whose parameter was fixed to 0
    origin = np.where(free, np.maximum(box.clipped(start), SMALLEST), box.clipped(start))

    def at(steps: Real) -> Real:
        """Parameters after steps of the logarithms."""
        p = origin.copy()
        p[free] *= np.exp(steps)
        return p

    def residual(steps: Real) -> Real:
        """Residual there."""
        return cost.residual(plant.response(at(steps)))

    def sensitivity(steps: Real) -> Real:
        """Its derivatives by the steps."""
        return cost.of(plant, at(steps))[1][:, free]

    with np.errstate(divide="ignore"):
        bounds = [
            np.clip(np.log(edge[free] / origin[free]), -FARTHEST, FARTHEST)
            for edge in (box.low, box.high)
        ]
    inside = np.clip(np.zeros(int(free.sum())), bounds[0] + 1e-12, bounds[1] - 1e-12)
    result = least_squares(
        residual,
        inside,
        sensitivity,
        bounds=bounds,
        xtol=1e-10,
        ftol=gain,
        gtol=1e-12,
        max_nfev=300,
    )
    best, before = 2.0 * float(result.cost), float(cost.total(plant.response(origin)))
    reached = np.where(free, np.maximum(at(result.x), SMALLEST), origin)
    return (reached, best) if best < before else (origin, before)
