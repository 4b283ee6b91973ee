"""When data exclude a structure: the one test of fit, next and plan.

A structure with whitened residual r and sensitivities S is tested against another one with residual
r_B (R. Davidson, J. MacKinnon, Several tests for model specification in the presence of alternative
hypotheses, 1981):

    T = (r'd)^2 / d'C d,    d = r_B - r without its projection on S,

C = covariance of the residuals that the other one leaves (`covariance`). If the structure is true,
T / s is distributed as F of s degrees of freedom, what the other one determines beyond it, and
those from which the scatter is known. It is excluded at the level `LEVEL` by another one whose cost
is lower by the share `CLEARLY` of what T may be, or more.

d follows tangents: where responses bend, as over a long valley of parameters that are hardly
determined, the optimum of the other one lies beyond them, and T is large although both fit alike.
So T is at most what a larger structure that contains both, and was fitted to the same data too,
gains in cost: where nothing bends it is that, if the other one is the larger one, or less.

What a further mass adds is an element that looks for noise at every line: the level is divided by
their number. On test data, which the fits did not use, d is given and s = 1; costs there are none
of optima, so that no larger structure bounds T. There T is at most that of the residual which the
structure leaves where it is fitted to the test data too: tangents do not take all of it away.
"""

from collections.abc import Callable, Container, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from math import isfinite
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.special import chdtri, fdtri

from disting.decide.identifiability.tangent import proof_tangents
from disting.fit.search.containment import contains
from disting.fit.search.starts import bare
from disting.measurement.arrays import Real
from disting.model.chain import Chain
from disting.model.question import Settings
from disting.statistics.covariance import VANISHING
from disting.statistics.lone_lines import LoneLines, lone_lines
from disting.statistics.practical import NoiseModel

LEVEL = 0.01  # probability of excluding a structure that is true by another one
CLEARLY = 0.6  # of what T may be: for s = 1 the gain where T is just that and its power is 95 %
FELT = 0.1  # what a parameter must move, in units of the scatter, when it changes by itself
REMEMBERED = 1024  # ranks; each pair asks for those of both structures


class Residuals(Protocol):
    """Whitened residuals of a fit: r, shape (n_y,), an orthonormal basis of the sensitivities,
    shape (n_y, n), and the noise in units of the scatter.
    """

    @property
    def residual(self) -> Real:
        """r."""

    @property
    def basis(self) -> Real:
        """That of the sensitivities."""

    @property
    def noise(self) -> NoiseModel:
        """The noise that it leaves."""


@dataclass(frozen=True, slots=True, eq=False)
class Fit:
    """Whitened residual r, shape (n_y,), of a fitted structure, an orthonormal basis of its
    sensitivities, shape (n_y, n), the noise that it leaves, in units of the scatter, and the
    frequency of each residual [rad/s], shape (n_y,), None where residuals are of no lines.
    """

    chain: Chain
    residual: Real
    basis: Real
    noise: NoiseModel
    omega: Real | None = None

    @property
    def cost(self) -> float:
        """|r|^2."""
        return float(self.residual @ self.residual)


@dataclass(frozen=True, slots=True)
class Exclusion:
    """By which structure another one is excluded: T, bounded as above, and what it may be by
    chance; both in units of the squared scatter.
    """

    by: Chain
    statistic: float
    limit: float


def basis_of(columns: Real) -> Real:
    """Orthonormal basis of the columns S_j p_j, shape (n_y, n_p), that have an effect.

    An element that has gone to zero makes up for nothing: it cannot go below.
    """
    length = np.linalg.norm(columns, axis=0)
    felt = length > FELT
    scaled = columns[:, felt] / length[felt]
    if not scaled.shape[1]:
        return np.asarray(scaled)
    left, sizes, _ = np.linalg.svd(scaled, full_matrices=False)
    return np.asarray(left[:, sizes > VANISHING * sizes[0]])


def statistic(residuals: Residuals, other: Residuals) -> float:
    """T of one structure against another one; 0 where the other one is no step towards the data."""
    d, r = _beyond(residuals, other.residual - residuals.residual), residuals.residual
    towards, size = -float(_beyond(residuals, r) @ d), _spread(d, other)
    return towards**2 / size if towards > 0 and size > 0 else 0.0


def _gain(residuals: Fit, larger: Fit) -> float:
    """By how much a structure that contains it fits better, in units of the noise that this leaves:
    T where nothing bends.
    """
    d = _beyond(residuals, larger.residual - residuals.residual)
    size = _spread(d, larger)
    return (residuals.cost - larger.cost) * float(d @ d) / size if size > 0 else 0.0


def _beyond(residuals: Residuals, vector: Real) -> Real:
    """Less what the parameters make up for."""
    return np.asarray(vector - residuals.basis @ (residuals.basis.T @ vector))


def _spread(d: Real, other: Residuals) -> float:
    """d'C d."""
    return float(np.linalg.norm(other.noise.seen(d[:, None])) ** 2)


@lru_cache(maxsize=REMEMBERED)
def limit(surplus: int, freedom: float, trials: int = 1, level: float = LEVEL) -> float:
    """Critical value of T; of few arguments, for each pair of structures.

    >>> round(limit(1, float("inf")), 2), round(limit(1, 100.0), 2)
    (6.63, 6.9)
    """
    if isfinite(freedom):
        return surplus * float(fdtri(surplus, freedom, 1 - level / trials))
    return float(chdtri(surplus, level / trials))


def trials(chain: Chain, other: Chain, lines: int) -> int:
    """Number of places at which an element of the other structure is searched."""
    return max(lines, 1) if other.n_masses > chain.n_masses else 1


def exclusions(
    fitted: Sequence[Fit],
    freedom: float,
    settings: Settings,
    again: Callable[[Fit], Fit] | None = None,
    lone: Container[Chain] = (),
) -> dict[Chain, Exclusion]:
    """The structures that others exclude, each with the one that does so most clearly, by the data
    that all were fitted to; `again`: by others, and a structure fitted to these too. `lone`:
    structures that exclude none.
    """
    exclusions: dict[Chain, Exclusion] = {}
    is_first, second = again is None, dict[Chain, Fit]()
    candidates = [f for f in fitted if f.chain not in lone]
    for candidate in fitted:
        larger = [f for f in candidates if contains(f.chain, candidate.chain)] if is_first else []
        clearest = 1.0  # T as a multiple of its limit
        for other in candidates:
            gain = candidate.cost - other.cost
            if gain <= 0:
                continue
            size = statistic(candidate, other)
            if size <= limit(1, freedom):
                continue
            most = _limit_beside(candidate, other, freedom, settings if is_first else None)
            if size > clearest * most and again:
                if candidate.chain not in second:
                    second[candidate.chain] = again(candidate)
                size = min(size, statistic(second[candidate.chain], other))
            elif size > clearest * most:
                both = [f for f in larger if f is other or contains(f.chain, other.chain)]
                size = min([size, *(_gain(candidate, f) for f in both)])
            if size > clearest * most and gain > CLEARLY * most:
                clearest = size / most
                exclusions[candidate.chain] = Exclusion(other.chain, size, most)
    return exclusions


def _limit_beside(candidate: Fit, other: Fit, freedom: float, settings: Settings | None) -> float:
    """Critical value of T of a pair on the data of the fits; on other data, where `settings` are
    None, that of a single direction.
    """
    if settings is None:
        return limit(1, freedom)
    count = trials(candidate.chain, other.chain, len(candidate.residual) // 2)
    return limit(surplus(other.chain, candidate.chain, settings), freedom, count)


def rests_on_lone_lines(
    fitted: Sequence[Fit], freedom: float, settings: Settings
) -> dict[Chain, LoneLines]:
    """Structures whose gain over one that they contain rests on single lines, which T alone would
    take for proof, each with these lines.
    """
    found = dict[Chain, LoneLines]()
    least = CLEARLY * limit(1, freedom)
    for other in fitted:
        for candidate in fitted:
            is_gain = candidate.cost - other.cost > least
            if not is_gain or not contains(other.chain, candidate.chain):
                continue
            most = limit(surplus(other.chain, candidate.chain, settings), freedom)
            lines = gain_on_lone_lines(candidate, other, other.omega, most)
            if lines:
                found[other.chain] = lines
                break
    return found


def gain_on_lone_lines(
    candidate: Residuals, other: Residuals, omega: Real | None, most: float
) -> LoneLines | None:
    """Lines on which the gain of another structure over a candidate rests; None where other lines
    show it by more than `most`, or there is no gain that excludes.
    """
    if omega is None or statistic(candidate, other) <= most:
        return None

    def is_shown(kept: NDArray[np.bool_]) -> bool:
        one, rest = _of_lines(candidate, kept), _of_lines(other, kept)
        gain = float(one.residual @ one.residual - rest.residual @ rest.residual)
        return statistic(one, rest) > most and gain > CLEARLY * most

    return lone_lines(candidate.residual, other.residual, omega, is_shown)


@dataclass(frozen=True, slots=True, eq=False)
class _LeftOut:
    """Residuals with zero for lines that are left out."""

    residual: Real
    basis: Real
    noise: NoiseModel


def _of_lines(residuals: Residuals, kept: NDArray[np.bool_]) -> _LeftOut:
    rows = residuals.basis * kept[:, None]
    left, sizes, _ = np.linalg.svd(rows, full_matrices=False)
    basis = left[:, sizes > VANISHING * max(sizes, default=0.0)]
    return _LeftOut(residuals.residual * kept, basis, residuals.noise)


def surplus(model: Chain, rival: Chain, settings: Settings | None = None) -> int:
    """s: the rank of the smallest structure that contains both, less that of the rival.

    What a damper, a lag, a dead time adds to what data determine. Structures that differ in more
    than these have no such structure; there the ranks of the model and of the rival are compared.
    s is at least 1.

    >>> surplus(Chain(2, ground_dampers=(1,)), Chain(2, ground_dampers=(2,)))
    1
    """
    settings = settings or Settings()
    larger = union(model, rival) or model
    return max(1, _rank(larger, settings) - _rank(rival, settings))


def union(model: Chain, rival: Chain) -> Chain | None:
    """The smallest structure that contains both; None where they differ in more than dampers to
    the ground, lag and dead time.
    """
    if bare(model) != bare(rival):
        return None
    return replace(
        model,
        ground_dampers=tuple(sorted({*model.ground_dampers, *rival.ground_dampers})),
        lag=model.lag or rival.lag,
        dead_time=model.dead_time or rival.dead_time,
        gap_damper=model.gap_damper or rival.gap_damper,
    )


@lru_cache(maxsize=REMEMBERED)
def _rank(chain: Chain, settings: Settings) -> int:
    tangents = proof_tangents(chain.structure, settings.seed, settings.points)
    return max(t.rank for t in tangents)
