"""Standard deviation of stochastic nonlinear contributions at the excited lines of a response.

A periodic input with random phases makes a nonlinear machine show its best linear approximation
and, beside it, contributions that repeat from period to period and look like noise from line to
line (Pintelon and Schoukens, System Identification, 2nd ed. 2012, chapters 3 and 4). Their variance
adds to that of the noise: with sigma_n^2 the variance of the mean by noise,

    sigma_k^2 = sigma_n,k^2 + sigma_s,k^2.

- Lines without excitation: where all excited lines are odd, the odd ones without excitation show
  what falls on the excited ones too; else all of them. sigma_s,k^2 = |G_k|^2 times the mean of
  (level^2 - noise^2) / |G|^2 over the `NEAR` nearest of them.
- Repeats with other phases (realisations): their mean scatters by sigma_k^2, the periods of each
  tell sigma_n,k^2. The difference, as a share of |G_k|^2, is averaged over as many lines.

Both count only where the whole is larger than noise alone allows (F test over all lines).
"""

import numpy as np
from scipy.stats import f as f_distribution

from disting.measurement.arrays import Complex, Real
from disting.measurement.distortion import FEWEST, Distortion

NEAR = 7  # lines whose mean is taken
SURE = 1e-3  # chance of a distortion where there is noise alone
LEAST = 1e-6  # share of the response below which a distortion is rounding


def from_unexcited(
    between: Distortion | None, omega: Real, response: Complex, periods: int
) -> Real | None:
    """Return sigma_s at the excited lines, shape (n_f,), from those between them; None where these
    show noise alone, where their noise is unknown, or where too few are of the kind that counts.
    """
    if between is None or between.noise is None:
        return None
    kind = ~between.even if between.told_apart else np.ones(len(between.omega), dtype=bool)
    if np.count_nonzero(kind) < FEWEST:
        return None
    at = between.omega[kind]
    size = np.interp(at, omega, np.abs(response))
    level, noise = (x[kind] / size for x in (between.level, between.noise))
    freedom = 2.0 * len(at), 2.0 * len(at) * (periods - 1)
    share = _beyond(level**2, noise**2, freedom)
    if share is None:
        return None
    nearest = np.argsort(np.abs(np.log(omega[:, None] / at)), axis=1)[:, :NEAR]
    return np.asarray(np.sqrt(_positive(share[nearest].mean(axis=1), share)) * np.abs(response))


def from_realisations(
    total: Real, noise: Real, response: Complex, freedom: tuple[float, float]
) -> Real | None:
    """Return sigma_s of a mean, shape (n_f,): `total` = its standard deviation by the scatter of
    n repeats, `noise` = that by the scatter of their periods; `freedom` = degrees of freedom of
    both at each line. None where noise is all.
    """
    size = np.abs(response)
    whole = freedom[0] * len(size), freedom[1] * len(size)
    share = _beyond((total / size) ** 2, (noise / size) ** 2, whole)
    if share is None:
        return None
    return np.asarray(np.sqrt(_positive(_near(share), share)) * size)


def _beyond(power: Real, noise: Real, freedom: tuple[float, float]) -> Real | None:
    """Powers without noise, shape (n,), None unless they are beyond noise in the mean."""
    ratio = float(np.mean(power / np.maximum(_near(noise), LEAST**2)))
    return power - noise if ratio > f_distribution.isf(SURE, *freedom) else None


def _near(values: Real) -> Real:
    """Means over the `NEAR` lines around each line."""
    window = np.ones(min(NEAR, len(values)))
    count = np.convolve(np.ones(len(values)), window, mode="same")
    return np.asarray(np.convolve(values, window, mode="same") / count)


def _positive(near: Real, share: Real) -> Real:
    """Local means, not below a tenth of that of all lines: few lines may show none by chance."""
    return np.maximum(near, 0.1 * max(float(share.mean()), 0.0))
