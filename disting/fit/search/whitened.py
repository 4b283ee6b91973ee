"""Residuals in units of what the lines scatter, in the complex plane.

    e_k = sqrt(2) (G_k(p) - G_M,k) conj(G_M,k / |G_M,k|) / sigma_k,

real parts (along the response: amplitude) of all lines first, then imaginary parts (across it:
phase); of the true parameters each has variance 1 and all are independent, however small the
response is beside its noise, where logarithms are neither. |e|^2 is minus twice the logarithm of
the likelihood.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from disting.fit.noise.scatter import Scatter
from disting.fit.search.cost import SquaredCost
from disting.fit.search.joint import AnyCost
from disting.measurement.arrays import Complex, Real


@dataclass(frozen=True, eq=False)
class Whitened(SquaredCost):
    """Of the data of `cost`, whose lines scatter as `known` says."""

    cost: AnyCost
    known: Scatter

    @property
    def n_residuals(self) -> int:
        """Those of the cost."""
        return self.cost.n_residuals

    def residual(self, response: Complex) -> Real:
        """e, shape (..., 2 n_f), of stacked responses, shape (..., n_f)."""
        parts = [
            _apart((own - measured) * unit)
            for own, (measured, unit) in zip(self.cost.by_line(response), self._units, strict=True)
        ]
        return np.concatenate(parts, axis=-1)

    def sensitivity(self, response: Complex, gradient: Complex) -> Real:
        """d e / d p, shape (..., 2 n_f, n_p), from stacked G and d ln G / d p."""
        moved = gradient * response[..., None, :]
        parts = [
            _apart(own * unit)
            for own, (_, unit) in zip(self.cost.by_line(moved), self._units, strict=True)
        ]
        return np.concatenate(parts, axis=-1).swapaxes(-1, -2)

    @property
    def _units(self) -> Iterator[tuple[Complex, Complex]]:
        """Measured response and what turns and scales its residuals, for each response; a line of
        weight zero counts nothing.
        """
        for part, own in zip(self.cost.parts, self.cost.by_line(self.known.sigma), strict=True):
            measured = part.measured.G
            used = 1.0 if part.lines is None else (part.lines > 0) * 1.0
            yield measured, np.sqrt(2) * used * (np.abs(measured) / measured) / own


def _apart(values: Complex) -> Real:
    return np.concatenate([values.real, values.imag], axis=-1)
