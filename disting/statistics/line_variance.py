"""The variance of the lines of a bench, as a sum of few sources.

    sigma_k^2 = a^2 |G_k|^2 + b_2^2 + b_1^2 w_k^2 + b_0^2 w_k^4        (of an acceleration)

a: noise of the current; b_n: noise that is white in the acceleration, the speed, the position.
Coefficients are not negative and maximise the gamma likelihood of observed powers q_i with means
mu_i = sum_k C_ik sigma_k^2: sum ln mu_i + q_i / mu_i (restricted maximum likelihood, where these
are contrasts free of the parameters of a model: H. D. Patterson, R. Thompson, 1971).

What neighbouring lines tell of the scatter of a line: pure error, which no model explains.

A local quadratic through the six nearest lines predicts each line k of R = G / G_fit,

    e_k = R_k - sum_j h_kj R_j,    E |e_k G_fit,k|^2 = sum_j C_kj sigma_j^2,
    C_kj = (delta_kj + h_kj^2) |G_fit,k / G_fit,j|^2,

sigma_j^2 = E |noise of G_j|^2. Division by a fitted response takes bends of resonances away; one by
a wrong response adds bends and takes no scatter away, so of several the smallest result counts.
"""

from dataclasses import dataclass
from math import exp, log

import numpy as np
from scipy.optimize import brentq, nnls
from scipy.sparse import csr_array
from scipy.special import digamma, polygamma

from disting.measurement.arrays import Complex, Real

MOST_FREEDOM = 1e4  # of a variance: as good as known
SIDE = 3  # lines to either side of one, whose contrast they are
DEGREE = 2  # of the polynomial through them
LARGEST_LEFT_OUT = 0.075  # share of the ratios q / mu: bends of resonances, single bad lines
FAR = 5.0  # times the mean: what exponential values exceed in 1 of 150
ROUNDS = 25  # of reweighting
MOST_STEPS = 1000  # of the search among the sets of sources
CLOSE = 1e-3  # relative change of all means at which it ends
SMALLEST = 1e-3  # of the mean of neighbours at which weights stop growing


@dataclass(frozen=True, slots=True, eq=False)
class Contrasts:
    """`power` = |e_k G_fit,k|^2, shape (n_f,); `at` = which lines each sees, itself first, and
    `weight` = C of these, shape (n_f, 7) each; `size` = |G_fit|, shape (n_f,).
    """

    power: Real
    at: np.ndarray[tuple[int, int], np.dtype[np.intp]]
    weight: Real
    size: Real

    def expected(self, variance: Real) -> Real:
        """E of `power` for variances of the lines, shape (n_f, ...)."""
        return np.asarray(np.einsum("kj,kj...->k...", self.weight, variance[self.at]))


def contrasts(omega: Real, response: Complex, fitted: Complex | None = None) -> Contrasts:
    """Contrasts of a response, shape (n_f,), divided by a fitted one; without one those of its
    logarithm, which bends less than it does.
    """
    at, h = stencil(omega)
    if fitted is None:
        size = np.abs(response)
        ratio = np.log(size) + 1j * np.unwrap(np.angle(response))
    else:
        size, ratio = np.abs(fitted), response / fitted
    left = ratio - np.einsum("kj,kj->k", h, ratio[at[:, 1:]])
    spread = np.concatenate([np.ones((len(omega), 1)), h**2], axis=1)
    weight = spread * (size[:, None] / size[at]) ** 2
    return Contrasts(np.abs(left * size) ** 2, at, weight, size)


def stencil(omega: Real) -> tuple[np.ndarray[tuple[int, int], np.dtype[np.intp]], Real]:
    """Lines near each line, itself first, shape (n_f, 7), and the weights h of the others, shape
    (n_f, 6): those of a quadratic in ln omega through them, by least squares.
    """
    n = len(omega)
    first = np.clip(np.arange(n) - SIDE, 0, n - 2 * SIDE - 1)
    window = first[:, None] + np.arange(2 * SIDE + 1)
    own = np.arange(n)[:, None]
    others = window[window != own].reshape(n, 2 * SIDE)
    x = np.log(omega)
    apart = x[others] - x[own]
    scaled = apart / np.abs(apart).max(axis=1, keepdims=True)
    powers = scaled[:, :, None] ** np.arange(DEGREE + 1)
    h = np.linalg.pinv(powers)[:, 0, :]
    return np.concatenate([own, others], axis=1), np.asarray(h)


def freedom(omega: Real) -> float:
    """Degrees of freedom of the mean of the contrasts of lines that scatter alike, real ones:
    2 (tr A)^2 / tr A^2 with A = L'L of their coefficients L.
    """
    at, h = stencil(omega)
    n = len(omega)
    rows = np.concatenate([np.ones((n, 1)), -h], axis=1)
    rows /= np.linalg.norm(rows, axis=1, keepdims=True)
    matrix = csr_array((rows.ravel(), at.ravel(), np.arange(0, rows.size + 1, rows.shape[1])))
    return float(2 * n**2 / (matrix @ matrix.T).power(2).sum())


def sources(omega: Real, size: Real, order: int, drive: Real | None = None) -> Real:
    """Shapes of the variances over the lines, shape (n_f, 4), of |G| = `size` of a sensor of this
    order (2: acceleration), each with mean 1; `drive` = amplitude of the input, where it is known:
    what is measured beside a weak line counts for more.
    """
    x = omega / np.exp(np.mean(np.log(omega)))
    shapes = np.stack([size**2, *(x ** (2.0 * (order - n)) for n in range(3))], axis=1)
    if drive is not None:
        shapes = shapes / drive[:, None] ** 2
    return np.asarray(shapes / shapes.mean(axis=0))


def quietest(mean: Real, power: Real) -> Real:
    """The coefficients of most powers: those are left out that are far above what the lower quarter
    tells, as many as they be, such as where a response bends.
    """
    values = coefficients(mean, power)
    for _ in range(ROUNDS):
        if not values.any():
            break
        ratio = power / np.maximum(mean @ values, np.finfo(float).tiny)
        near = ratio <= FAR * np.quantile(ratio, 0.25) / -log(0.75)
        fresh = coefficients(mean[near], power[near], 0.0) / kept_mean(exp(-FAR))
        if np.allclose(fresh, values, rtol=CLOSE):
            break
        values = fresh
    return values


def coefficients(mean: Real, power: Real, trim: float = LARGEST_LEFT_OUT) -> Real:
    """Coefficients, shape (n,), not negative, of the columns of `mean`, shape (n_i, n), for powers
    q, shape (n_i,), of which the largest share `trim` of q / mu is left out.
    """
    usual = float(np.median(power)) / log(2)
    if not usual > np.finfo(float).tiny:  # no noise at all
        return np.zeros(mean.shape[1])
    expected = np.full(len(power), usual)
    used, kept = np.ones(len(power), bool), 1.0
    values = np.zeros(mean.shape[1])
    for turn in range(ROUNDS):
        weight = used / expected
        weighted = mean * weight[:, None]
        length = np.maximum(np.linalg.norm(weighted, axis=0), np.finfo(float).tiny)
        values = nnls(weighted / length, power * weight, maxiter=MOST_STEPS)[0] / length / kept
        fresh = np.maximum(
            mean @ values, SMALLEST * np.median(mean @ values) + np.finfo(float).tiny
        )
        if turn and np.max(np.abs(np.log(fresh / expected))) < CLOSE:
            break
        expected = np.sqrt(fresh * expected) if turn else fresh
        if trim:
            ratio = power / expected
            used = ratio <= np.quantile(ratio, 1 - trim)
            kept = kept_mean(trim)
    return np.asarray(values)


def kept_mean(trim: float) -> float:
    """Mean of exponential values of mean 1 without the share of the largest.

    >>> round(kept_mean(0.075), 3)
    0.79
    """
    return 1 + trim * log(trim) / (1 - trim)


def shrunk(power: Real, nu: float, shapes: Real) -> tuple[Real, float]:
    """Variances of the lines from squared deviations of `nu` degrees of freedom, shrunk to the
    sources, and the degrees of freedom of these.
    """
    trend = np.maximum(shapes @ coefficients(shapes, power, trim=0.0), 1e-9 * np.median(power))
    apart = np.log(power / trend)
    beyond = float(np.var(apart)) - float(polygamma(1, nu / 2))
    prior = _inverse_trigamma(beyond) if beyond > 0 else MOST_FREEDOM
    # the mean of logarithms of a variance of nu degrees lies below the logarithm of its mean
    trend = trend * np.exp(apart.mean() - _bias(nu) + _bias(prior))
    whole = nu + prior
    unsure = whole / (whole - 2) if whole > 4 else 2.0  # mean of r^2 / sigma^2 is to be 1
    return np.asarray((prior * trend + nu * power) / whole * unsure), prior


def _bias(nu: float) -> float:
    return float(digamma(nu / 2)) - log(nu / 2)


def freedom_by_jumps(omega: Real, power: Real) -> float:
    """Degrees of freedom of squared deviations, from how much their logarithms jump."""
    at, h = stencil(omega)
    values = np.log(power)[at]
    jump = values[:, 0] - np.einsum("kj,kj->k", h, values[:, 1:])
    return _inverse_trigamma(float(np.mean(jump**2 / (1 + np.sum(h**2, axis=1)))))


def _inverse_trigamma(value: float) -> float:
    """nu with trigamma(nu / 2) = value, between 0.1 and `MOST_FREEDOM`."""
    low, high = 0.1, MOST_FREEDOM
    if value <= polygamma(1, high / 2):
        return high
    if value >= polygamma(1, low / 2):
        return low
    root = brentq(lambda nu: float(polygamma(1, nu / 2)) - value, low, high)
    return float(root)
