"""Practical identifiability of fitted parameters (section 2.4): equations (16), (17), (18), and
what they leave unsaid.

S is the sensitivity matrix, shape (n_y, n_p), at the optimum, columns multiplied by the parameters
(Delta p_j = p_j). A scaling of columns changes neither collinearity nor condition indices, which
use columns of unit length.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import inf, isfinite
from typing import Protocol

import numpy as np

from disting.errors import InputError
from disting.measurement.arrays import Real
from disting.model.presentation import summary

NAMED = 0.3  # share of the largest entry from which on a parameter belongs to the worst direction
MANY = 4_000_000  # entries of a product, from which on it is not formed
ROUNDING = 1e-15  # a singular value below this share of the largest one is zero
# share of a gradient along undetermined directions from which on its function is not determined
LOST = 1e-6


class NoiseModel(Protocol):
    """Noise as standard errors use it."""

    def seen(self, columns: Real) -> Real:
        """F' columns, with C = F F', shape (n_y, n)."""


def importance(columns: Real) -> Real:
    """delta_j^msqr = |S_j Delta p_j| of (16), shape (n_p,); Brun et al. 2001. Raises InputError
    for what is no finite matrix.

    >>> importance(np.array([[3.0, 0.0], [4.0, 1.0]])).tolist()
    [5.0, 1.0]
    """
    return np.asarray(np.linalg.norm(_finite(columns), axis=0))


def unit_columns(columns: Real) -> Real:
    """S-tilde: columns of unit length; columns of zeros stay. Raises InputError for what is no
    finite matrix.
    """
    matrix = _finite(columns)
    length = np.linalg.norm(matrix, axis=0)
    return np.asarray(matrix / np.where(length > 0, length, 1.0))


def _finite(columns: Real) -> Real:
    matrix = np.asarray(columns, dtype=float)
    if matrix.ndim != 2 or not matrix.size or not np.all(np.isfinite(matrix)):
        raise InputError("a sensitivity matrix has rows and columns of finite numbers")
    return matrix


def collinearity_index(columns: Real) -> float:
    """gamma = 1 / smallest singular value of S-tilde (17); infinite for dependent columns;
    critical above 5 to 20. Raises InputError for what is no finite matrix.

    >>> collinearity_index(np.array([[1.0, 1.0], [0.0, 1.0]])).__round__(6)
    1.847759
    """
    values = _singular_values(columns)
    return inf if values[-1] <= ROUNDING * values[0] else float(1.0 / values[-1])


def condition_indices(columns: Real) -> Real:
    """mu_max / mu_k of S-tilde (18), rising, shape (n_p,); Belsley 1991; critical above 10 to
    30. Raises InputError for what is no finite matrix.

    >>> condition_indices(np.eye(2)).tolist()
    [1.0, 1.0]
    """
    values = _singular_values(columns)
    with np.errstate(divide="ignore"):
        return np.asarray(np.where(values > ROUNDING * values[0], values[0] / values, inf))


def _singular_values(columns: Real) -> Real:
    """Falling, one a column: zero for each column more than rows."""
    matrix = unit_columns(columns)
    values = np.linalg.svd(matrix, compute_uv=False)
    return np.concatenate([values, np.zeros(matrix.shape[1] - len(values))])


def collinearity_by_subset(columns: Real) -> Iterator[tuple[tuple[int, ...], float]]:
    """Yield the collinearity index of every set of two or more columns."""
    n = columns.shape[1]
    matrix = unit_columns(columns)
    for size in range(2, n + 1):
        for chosen in combinations(range(n), size):
            yield chosen, collinearity_index(matrix[:, chosen])


CONDITION = "badly determined together: {} (condition index {})"
IMPORTANCE = "with little effect: {} (PII ratio {})"
COLLINEARITY = "made up for by each other: {} (collinearity index {})"


@dataclass(frozen=True)
class Practical:
    """The criteria of one fit.

    `importance` (16) and `relative_errors` (standard errors divided by the parameters, 0.01 = 1 %)
    by parameter; `condition_indices` rising; `worst_direction`: the combination of logarithms of
    parameters that the data determine least. `unidentifiable` states what is determinable where no
    data at all determine every parameter, else "".
    """

    names: tuple[str, ...]
    importance: dict[str, float]
    collinearity: float
    condition_indices: tuple[float, ...]
    relative_errors: dict[str, float]
    worst_direction: dict[str, float]
    unidentifiable: str = ""

    def __repr__(self) -> str:
        ratio, index = self.importance_ratio, self.collinearity
        others = f"PII ratio {ratio:.3g}, collinearity index {index:.3g}"
        return summary(self, f"condition index {self.condition_index:.3g}, {others}")

    @property
    def importance_ratio(self) -> float:
        """Largest importance divided by the smallest; infinite where a parameter has none, 1
        without any.
        """
        values = list(self.importance.values()) or [1.0]
        return max(values) / min(values) if min(values) > 0 else inf

    @property
    def rank(self) -> int:
        """Number of directions that are determined: those with a finite condition index."""
        return sum(map(isfinite, self.condition_indices))

    @property
    def condition_index(self) -> float:
        """The largest scaled condition index; 1 where nothing is estimated."""
        return self.condition_indices[-1] if self.condition_indices else 1.0


def practical(columns: Real, names: Sequence[str], noise: NoiseModel) -> Practical:
    """Criteria at an optimum with residuals of covariance `noise`; `columns` = S_j p_j, shape
    (n_y, n_p), of free parameters.

    Where all are fixed nothing depends on the data, so that nothing is undetermined: every index
    is 1. Raises InputError for what is no finite matrix.
    """
    if not names:
        return Practical(
            names=(),
            importance={},
            collinearity=1.0,
            condition_indices=(),
            relative_errors={},
            worst_direction={},
        )
    deviations = np.sqrt(np.diag(covariance(columns, noise)))
    return Practical(
        names=tuple(names),
        importance=dict(zip(names, importance(columns).tolist(), strict=True)),
        collinearity=collinearity_index(columns),
        condition_indices=tuple(condition_indices(columns).tolist()),
        relative_errors=dict(zip(names, deviations.tolist(), strict=True)),
        worst_direction=worst_direction(columns, names),
    )


def covariance(columns: Real, noise: NoiseModel) -> Real:
    """Covariance of ln p, shape (n_p, n_p): H (S' C S) H, H = (S' S)^-1, with C of the
    residuals; infinite if S is singular.
    """
    n_y, n_p = columns.shape
    length = np.linalg.norm(columns, axis=0)
    left, values, right = np.linalg.svd(unit_columns(columns), full_matrices=False)
    if n_y <= n_p or values[-1] <= ROUNDING * values[0]:
        return np.full((n_p, n_p), inf)
    half = noise.seen(left) / values @ right / length
    return np.asarray(half.T @ half)


def standard_errors(slopes: Real, columns: Real, noise: NoiseModel, rank: int) -> Real:
    """Standard errors of functions of ln p with gradients `slopes`, shape (n, n_p): sqrt(g' C g),
    without cancellation.

    `rank` directions of ln p count as determined, those that the data determine best; infinite for
    a function that changes along another one.
    """
    n_y, n_p = columns.shape
    length = np.linalg.norm(columns, axis=0)
    if n_y <= n_p or not length.all():
        return np.full(len(slopes), inf)
    left, values, right = np.linalg.svd(unit_columns(columns), full_matrices=False)
    parts = slopes / length @ right.T
    seen, along = noise.seen(left[:, :rank]), (parts[:, :rank] / values[:rank]).T
    if len(seen) * len(slopes) > MANY:
        seen = np.linalg.qr(seen)[1]  # the same lengths with few rows
    errors = np.linalg.norm(seen @ along, axis=0)
    lost = np.linalg.norm(parts[:, rank:], axis=1) > LOST * np.linalg.norm(parts, axis=1)
    return np.asarray(np.where(lost, inf, errors))


def worst_direction(columns: Real, names: Sequence[str]) -> dict[str, float]:
    """Right singular vector of the smallest singular value of S-tilde, its large entries by
    parameter, largest positive.
    """
    matrix = unit_columns(columns)
    # full where columns outnumber rows
    vector = np.linalg.svd(matrix, full_matrices=len(matrix) < matrix.shape[1])[2][-1]
    vector = vector / vector[np.argmax(np.abs(vector))]
    return {name: float(v) for name, v in zip(names, vector, strict=True) if abs(v) >= NAMED}


@dataclass(frozen=True)
class Thresholds:
    """Largest admissible condition index, importance ratio and collinearity index; the first
    row of Table 1 by default.

    >>> Thresholds(condition_index=100.0).collinearity
    20.0
    """

    condition_index: float = 30.0
    importance_ratio: float = 1000.0
    collinearity: float = 20.0

    def reasons(self, assessment: Practical) -> tuple[str, ...]:
        """Why a candidate is excluded; nothing if it is admissible. What is not a number violates
        every threshold.

        Structural unidentifiability excludes at any threshold, and is reported instead of the
        infinite indices that follow from it.
        """
        along = ", ".join(assessment.worst_direction)
        least = max(assessment.importance.values(), default=0.0) / self.importance_ratio
        weak = ", ".join(
            name for name, value in assessment.importance.items() if not value >= least
        )
        rows = [
            (CONDITION, assessment.condition_index, self.condition_index, along),
            (IMPORTANCE, assessment.importance_ratio, self.importance_ratio, weak),
            (COLLINEARITY, assessment.collinearity, self.collinearity, along),
        ]
        unknown = dict.fromkeys(who for _, value, limit, who in rows if value == inf > limit)
        infinite = [
            f"these data do not determine {who}"
            for who in unknown
            if not (assessment.unidentifiable and who == along)
        ]
        finite = [
            what.format(who, f"{v:.3g} exceeds {limit:g}")
            for what, v, limit, who in rows
            if v != inf and not v <= limit
        ]
        return (*filter(None, [assessment.unidentifiable]), *infinite, *finite)
