"""The test as a fit will run it: with a scatter that it has to find in the data first.

A fit knows the scatter of a line from one measurement, or a few (`noise.scatter`): here too high,
there too low, least well at the ends of the band and where noise of another kind may hide. With
weights w = sigma / sigma_found of the lines, e = noise in units of sigma, and d = what the rival
misses, less what its parameters make up for under these weights (`exclusion`),

    T = (d'(d + w e))^2 / d'd,    E e e' = 1,

is nearly distributed as v chi2_s(lambda / v) with lambda = d'd and v = d' w^2 d / d'd. The power is
the mean over simulated measurements, each with its own weights and its own limit of T (F, by the
degrees of freedom of the scatter found). Noise is drawn from a fixed seed.
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq
from scipy.stats import ncx2

from disting.fit.judge.exclusion import LEVEL, basis_of, limit
from disting.statistics.scatter import Scatter, scatter
from disting.planning.rival import Rival
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real

POWER = 0.95  # wanted probability of excluding one that is not
LARGEST = 1e6  # noncentrality that is looked for, at most
BEYOND = 40.0  # standard deviations: a normal variable lies there with a probability of 1e-350
DRAWS = 60  # simulated measurements: the mean of their powers is known within a point or two
SEED = 20_251


@dataclass(frozen=True, slots=True, eq=False)
class Sample:
    """Of simulated measurements, shape (n,) each: `limits` of T, `shares` = lambda as they see it
    per lambda, `widths` = v; s = `surplus`.
    """

    limits: Real
    shares: Real
    widths: Real
    surplus: int

    def power(self, noncentrality: float) -> float:
        """Probability of excluding the rival if the model is true."""
        seen = noncentrality * self.shares / self.widths
        return float(np.mean(_exceeding(self.limits / self.widths, self.surplus, seen)))

    def needed(self, wanted: float = POWER) -> float:
        """Noncentrality for a power; infinite where one of a million does not reach it."""
        if self.power(LARGEST) < wanted:
            return np.inf
        return float(brentq(lambda size: self.power(size) - wanted, 1e-6, LARGEST))


def _exceeding(limits: Real, freedom: int, noncentrality: Real) -> Real:
    """P(chi2_s(lambda) > c) for c = `limits` and s = `freedom`, shape (n,) each.

    SciPy's series is not a number for lambda of about 1e12 and more. With one normal variable z,
    chi_s(lambda) >= sqrt(lambda) + z, so the probability is 1 to double precision where sqrt(c)
    lies 40 below sqrt(lambda).
    """
    is_certain = np.sqrt(noncentrality) - np.sqrt(limits) > BEYOND
    within = np.where(is_certain, 0.0, noncentrality)
    return np.where(is_certain, 1.0, ncx2.sf(limits, freedom, within))


def ideal(surplus: int = 1, level: float = LEVEL) -> Sample:
    """The test with a scatter that is known.

    >>> round(ideal().power(17.8), 3), round(ideal(2).needed(), 1)
    (0.95, 20.6)
    """
    ones = np.ones(1)
    return Sample(ones * limit(surplus, np.inf, level=level), ones, ones, surplus)


def simulate(rival: Rival, surplus: int, level: float, repeats: int) -> Sample:
    """The test with the scatter as so many repeats tell it."""
    source = np.random.default_rng(SEED)
    residual, columns = rival.cost.of(rival.plant, rival.best.p)
    limits, shares, widths = np.empty((3, DRAWS))
    for i in range(DRAWS):
        exact = [part.measured for part in rival.cost.parts]
        each = [_found(response, rival.rho, source, repeats) for response in exact]
        ratios = (
            np.abs(g.G) / k.size * rival.rho / k.rho for g, k in zip(exact, each, strict=True)
        )
        weights = np.concatenate([np.tile(ratio, 2) for ratio in ratios])
        basis, missed = basis_of(columns * weights[:, None]), residual * weights
        d = missed - basis @ (basis.T @ missed)
        shares[i] = d @ d
        widths[i] = (d * weights**2) @ d / shares[i]
        limits[i] = limit(surplus, min(own_scatter.freedom for own_scatter in each), level=level)
    return Sample(limits, shares / rival.noncentrality, widths, surplus)


def _found(
    exact: FrequencyResponse, rho: Real, source: np.random.Generator, repeats: int
) -> Scatter:
    """The scatter that a simulated measurement tells."""
    shape = (2, repeats, len(exact))
    real, imaginary = source.normal(size=shape)
    error: Complex = real + 1j * imaginary
    each = exact.G * (1 + np.sqrt(repeats) * rho * error)
    mean = replace(exact, G=each.mean(axis=0))
    if repeats > 1:
        spread = np.std(each, axis=0, ddof=1) / np.sqrt(repeats)
        mean = replace(mean, deviation=spread, freedom=2.0 * (repeats - 1))
    return scatter(mean, [exact.G])
