"""Scatter of a measured line: the basis of every statement on a fit.

sigma_k^2 = E |noise of G_k|^2, and rho_k = sigma_k / (|G_k| sqrt 2) the standard deviation of
ln |G| and of arg G of line k (0.01 = 1 %, 0.01 rad). What is known of it is put together so:

- one measurement: the sources of noise that a bench has (below), their sizes from what
  neighbouring lines do not predict of each other (`contrasts`); with a coherence its shape
  (1 - g^2) / g^2 |G|^2 instead of these sources;
- with standard deviations s_k of noise of nu degrees of freedom: the sources fitted to s_k^2, and
  each line shrunk to them,

      sigma_k^2 = (nu_0 m_k + nu s_k^2) / (nu_0 + nu),

  nu_0 = degrees of freedom that the sources count for, from how far s_k^2 are from them beyond
  their own scatter (G. Smyth, Linear models and empirical Bayes methods, 2004). A file that does
  not say how many repeats it has tells nu by how much ln s_k^2 jumps from line to line. The
  variance of a distortion that the data show is added (`disting.measurement.distortion`).

Repeats of one excitation do not show the effects of the machine itself: distortion by friction and
play, and the steps of an encoder, repeat with it, and jump from line to line. Nor do they show that
a machine changes between two measurements. Both are found where the data scatter more than sigma
allows (F test), and added as a relative variance tau^2 that makes them agree (R. Paule, J. Mandel,
Consensus values and weighting factors, 1982), or as the sources of a bench where these describe the
jumps far better.

The variance of the lines of a bench, as a sum of few sources.

    sigma_k^2 = a^2 |G_k|^2 + b_2^2 + b_1^2 w_k^2 + b_0^2 w_k^4        (of an acceleration)

a: noise of the current; b_n: noise that is white in the acceleration, the speed, the position.
Coefficients are not negative and maximise the gamma likelihood of observed powers q_i with means
mu_i = sum_k C_ik sigma_k^2: sum ln mu_i + q_i / mu_i (restricted maximum likelihood, where these
are contrasts free of the parameters of a model: H. D. Patterson, R. Thompson, 1971).

Scatter of a line from its neighbours: pure error, which no model explains.

A local quadratic through the six nearest lines predicts each line k of R = G / G_fit,

    e_k = R_k - sum_j h_kj R_j,    E |e_k G_fit,k|^2 = sum_j C_kj sigma_j^2,
    C_kj = (delta_kj + h_kj^2) |G_fit,k / G_fit,j|^2,

sigma_j^2 = E |noise of G_j|^2. Division by a fitted response removes bends of resonances; one by a
wrong response adds bends and removes no scatter, so of several the smallest result counts.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import exp, inf, log, sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, nnls
from scipy.sparse import csr_array
from scipy.special import digamma, fdtri, polygamma  # scipy.stats takes a second to import

from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real
from disting.model.presentation import summary

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
    """`power` = |e_k G_fit,k|^2, shape (n_f,); `at` = the lines of each, itself first, and `weight`
    = C of these, shape (n_f, 7) each; `size` = |G_fit|, shape (n_f,).
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
    leakage next to a weak line counts for more.
    """
    x = omega / np.exp(np.mean(np.log(omega)))
    shapes = np.stack([size**2, *(x ** (2.0 * (order - n)) for n in range(3))], axis=1)
    if drive is not None:
        shapes = shapes / drive[:, None] ** 2
    return np.asarray(shapes / shapes.mean(axis=0))


def quietest(mean: Real, power: Real) -> Real:
    """The coefficients of most powers: those far above the lower quarter are omitted, whatever
    their number, such as where a response bends.
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


# tau up to which lines that jump are distorted; beyond, the grid may be too coarse for resonances
DISTORTED = 0.05
# gain in the logarithm of the likelihood of a line from which on jumps are those of sources: where
# distortion would do, and where it would be too large
BETTER, GOOD = 1.0, 0.5
MOST_TAU = 2.0  # that is looked for
COMMON = 8  # lines that two measurements must share
SAME = 1e-6  # relative distance of two frequencies that count as one
LEAST = 1e-5  # scatter below this is the rounding of a file
SURE = 1e-3  # level of the tests for tau, and for standard deviations that are wrong
WRONG = 2.0  # factor by which standard deviations are too large before that is said
TINY = 1e-12  # share of a variance that is as good as nothing
WORSE = 4.0  # ratio of variances from which on no fitted response is near the truth
JUMPS = "neighbouring lines, which jump by more than their standard deviations"
DIFFERENCE = "the difference of training and test data"
CLEAR = 0.2  # rho below which a line carries information


@dataclass(frozen=True, eq=False)
class Scatter:
    """rho of every line, shape (n_f,), |G| that it is a share of, and in words where it comes from;
    `freedom`: degrees of freedom of its level; `doubt`: what contradicts it, in a sentence, or "".
    """

    rho: Real
    size: Real
    source: str
    freedom: float = inf
    doubt: str = ""

    def __repr__(self) -> str:
        return summary(self, f"{100 * self.typical:.3g} %, from {self.source}")

    @property
    def sigma(self) -> Real:
        """sqrt(E |noise of G|^2), shape (n_f,)."""
        return np.asarray(sqrt(2) * self.rho * self.size)

    def at(self, lines: slice) -> "Scatter":
        """That of some of the lines."""
        return replace(self, rho=self.rho[lines], size=self.size[lines])

    @property
    def typical(self) -> float:
        """Median of rho: 0.01 means 1 % in amplitude, 0.01 rad in phase."""
        return float(np.median(self.rho))

    @property
    def clear(self) -> float:
        """Share of the lines that scatter by less than 20 %."""
        return float(np.mean(self.rho < CLEAR))


def scatter(measured: FrequencyResponse, fitted: Sequence[Complex] = ()) -> Scatter:
    """Scatter of a measured response; `fitted` = responses of candidates at its lines, shape
    (n_f,) each.
    """
    if measured.noise is not None and np.any(measured.noise > 0):
        return _scatter_as_stated(measured, measured.noise, fitted)
    if measured.coherence is not None and np.any(measured.coherence < 1):
        squared = np.clip(measured.coherence, 1e-6, 1 - 1e-6)
        shape = ((1 - squared) / squared * np.abs(measured.G) ** 2)[:, None]
        source = "the coherence, its level from neighbouring lines"
        return _from_neighbours(measured, fitted, lambda size: shape / shape.mean(), source)

    def shapes(size: Real) -> Real:
        """The sources of a bench."""
        return _sources(measured, size)

    return _from_neighbours(measured, fitted, shapes, "neighbouring lines")


def _sources(measured: FrequencyResponse, size: Real) -> Real:
    """The sources of a bench over the lines of a response of amplitudes `size`."""
    return sources(measured.omega, size, measured.quantity.order, measured.drive)


def _from_neighbours(
    measured: FrequencyResponse,
    fitted: Sequence[Complex],
    shapes: Callable[[Real], Real],
    source: str,
) -> Scatter:
    """From contrasts with that fitted response which leaves the least; from those of the logarithm
    where all that are fitted leave far more, as wrong ones do.
    """
    plain = contrasts(measured.omega, measured.G)
    columns = shapes(plain.size)
    pairs = [(columns @ quietest(plain.expected(columns), plain.power), plain.size)]
    for own in (contrasts(measured.omega, measured.G, other) for other in fitted):
        columns = shapes(own.size)
        pairs.append((columns @ coefficients(own.expected(columns), own.power), own.size))
    levels = [float(np.mean(np.log(np.maximum(v, (LEAST * size) ** 2)))) for v, size in pairs]
    variance, size = pairs[_choose_level(levels)]
    rho = np.sqrt(variance / 2) / size
    return Scatter(np.maximum(rho, LEAST), size, source, freedom(measured.omega))


def _choose_level(levels: Sequence[float]) -> int:
    """Index of the level to use, logarithms of variances without and with fitted responses: the
    smallest with one, unless that without is smaller by far.
    """
    best = int(np.argmin(levels[1:])) + 1 if len(levels) > 1 else 0
    return best if levels[best] <= levels[0] + log(WORSE) else 0


def _scatter_as_stated(
    measured: FrequencyResponse, deviation: Real, fitted: Sequence[Complex]
) -> Scatter:
    """From standard deviations of the noise and of the distortion in the data, against contrasts
    where candidates are fitted.
    """
    each = [contrasts(measured.omega, measured.G, other) for other in (None, *fitted)]
    used = each[
        _choose_level([log(max(float(np.median(one_way.power)), TINY**2)) for one_way in each])
    ]
    floor = float(np.median(deviation[deviation > 0])) ** 2
    power = np.maximum(deviation**2, 1e-6 * floor)
    nu = measured.freedom or freedom_by_jumps(measured.omega, power)
    variance, prior = shrunk(power, nu, _sources(measured, used.size))
    sure, known_from = max(len(power) * nu, prior), "the standard deviations of the data"
    if measured.nonlinear is not None:
        # about as many lines tell of the distortion as it distorts
        variance, sure = variance + measured.nonlinear**2, min(sure, 2.0 * len(power))
        known_from += " and their distortion"
    own = Scatter(np.maximum(np.sqrt(variance / 2) / used.size, LEAST), used.size, known_from, sure)
    return _check_scatter(own, variance, used, measured) if fitted else own


def _check_scatter(
    own: Scatter, variance: Real, seen: Contrasts, measured: FrequencyResponse
) -> Scatter:
    """Standard deviations checked by neighbouring lines."""
    lines_free = freedom(measured.omega)
    level = _excess(seen, variance) + 1
    if level > fdtri(lines_free, own.freedom, 1 - SURE):
        widened = _widen_variance(variance, seen, measured)
        if widened is None:
            return own
        return replace(
            own,
            rho=np.maximum(np.sqrt(widened / 2) / seen.size, LEAST),
            source=JUMPS,
            freedom=lines_free,
        )
    # distortion by a sweep is smooth over the lines
    small = fdtri(lines_free, own.freedom, SURE)
    if measured.nonlinear is None and level * WRONG**2 < 1 and level < small:
        return replace(
            own,
            doubt=(
                f"the standard deviations are {1 / sqrt(max(level, TINY)):.2g} times as large as"
                " what neighbouring lines scatter by: are they those of single repeats, or of"
                " something else?"
            ),
        )
    return own


def _widen_variance(variance: Real, seen: Contrasts, measured: FrequencyResponse) -> Real | None:
    """Variances with what makes neighbouring lines jump: distortion, a share tau of each line, or
    what the sources of a bench add, such as the steps of an encoder, which repeat with the
    excitation too, where these describe the jumps far better. None where neither does.
    """
    tau = _balance_tau(lambda tau: _excess(seen, variance + 2 * (tau * seen.size) ** 2))
    distorted = variance + 2 * (tau * seen.size) ** 2
    columns = _sources(measured, seen.size)
    columns = np.column_stack([variance, columns])
    noisy = np.maximum(columns @ coefficients(seen.expected(columns), seen.power), variance)
    gain = _deviance(seen, distorted) - _deviance(seen, noisy)
    if gain > (BETTER if tau <= DISTORTED else GOOD):
        return noisy
    return distorted if tau <= DISTORTED else None


def _deviance(seen: Contrasts, variance: Real) -> float:
    """ln mu + q / mu of contrasts q that are expected to be mu, mean of all: what sources describe
    has no lines far beyond them, what a machine distorts has, at its resonances.
    """
    expected = seen.expected(variance)
    return float(np.mean(np.log(expected) + seen.power / expected))


def _excess(seen: Contrasts, variance: Real) -> float:
    """Mean ratio of contrasts to what is expected, less 1."""
    ratio = seen.power / seen.expected(variance)
    kept = ratio <= np.quantile(ratio, 1 - LARGEST_LEFT_OUT)
    return float(ratio[kept].mean()) / kept_mean(LARGEST_LEFT_OUT) - 1


def _balance_tau(excess: Callable[[float], float]) -> float:
    """The tau at which a falling excess is zero."""
    return MOST_TAU if excess(MOST_TAU) > 0 else float(brentq(excess, 0.0, MOST_TAU, xtol=1e-6))


def change(
    own_response: FrequencyResponse, other: FrequencyResponse, own: Scatter, other_scatter: Scatter
) -> float:
    """tau by which a machine changes between two measurements, from lines that both have; 0 where
    what both scatter accounts for their difference.
    """
    at, common = nearest_lines(own_response, other)
    if own_response is other or common.sum() < COMMON:
        return 0.0
    power = np.abs(np.log(other.G[common] / own_response.G[at[common]])) ** 2
    both = 2 * (own.rho[at[common]] ** 2 + other_scatter.rho[common] ** 2)
    sure = fdtri(2 * len(both), min(own.freedom, other_scatter.freedom), 1 - SURE)
    if np.mean(power / both) <= sure:
        return 0.0
    return _balance_tau(lambda tau: float(np.mean(power / (both + 4 * tau**2))) - 1)


def widen(own: Scatter, tau: float) -> Scatter:
    """The scatter with what a machine changes by between two measurements."""
    if not tau:
        return own
    return replace(own, rho=np.hypot(own.rho, tau), source=DIFFERENCE)


def nearest_lines(
    response: FrequencyResponse, other: FrequencyResponse
) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
    """For each line of `other` the nearest one of `response`, and whether they are the same; shape
    (n_f,) each.
    """
    at = np.clip(np.searchsorted(response.omega, other.omega), 1, len(response.omega) - 1)
    at -= other.omega - response.omega[at - 1] < response.omega[at] - other.omega
    return at, np.abs(response.omega[at] - other.omega) <= SAME * other.omega
