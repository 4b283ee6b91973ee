"""Closed loops in records whose excitation does not repeat, recognised by causality, and the bias
of Welch's method in them.

**Recognition.** Input and output are whitened by autoregressive models; a position is differenced
before, since the low frequencies of an integrated signal hide the rest. Of an input that repeats,
the mean over its periods is removed from both. In open loop the whitened input is uncorrelated with
the past of the output, whatever the noise; a controller feeds noise of the output back, and it
appears in the input some samples later (Soderstrom and Stoica, System Identification, 1989, section
10). Whitening is never perfect. With a(l) the autocorrelation of the whitened input and h the
causal weights, 0 to `LAGS` samples, by which it makes the whitened output (least squares), open
loop gives

    r(tau) = corr(input(t), output(t - tau)) = sum_{k >= 0} h(k) a(tau + k),    tau > 0,

which is subtracted. Each of `BLOCKS` parts of the record has its own h, a and r. The mean of the
remainder over the blocks, divided by its standard error, is t distributed in open loop, so that
changing noise and the instantaneous frequency of a sweep raise the error and not the statistic.
Outlying blocks are moved to `OUTLYING` robust deviations from the median. A loop that is slow
compared with the sampling shows in sums over `RUNS` lags. The largest of all values exceeds its
critical value with probability `LEVEL` in open loop (Bonferroni). A smooth input that is recorded
less often than it changes moves the output before it is recorded: where a smooth input is
correlated by less than `WEAK`, the evidence states it.

**Bias.** A vector autoregressive model of input and output (block Yule-Walker equations, order
`ORDER`) has innovations e_u, e_y and transfer functions H from them. The noise e_y moves input and
output in the ratio -1/C; it makes the part |H_uy|^2 var(e_y) of the power S_uu of the input. The
response of output over input has the relative bias

    H_uy^* (H_yy / G - H_uy) var(e_y) / S_uu,    G = H_yu / H_uu.

Innovations of the same sample are correlated by a controller that acts at once, or by a machine
that does: an accelerometer shows a force at once, position and velocity do not.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from disting.errors import InputError
from disting.measurement.arrays import Complex, Real
from disting.measurement.feedback import LEVEL, PERIODS, ROUNDING, Feedback, biased_share
from disting.measurement.periodic import detected_period

ORDER_OF_WHITENING = 32
LAGS = 64  # samples into the past and the future
WEAK = 0.2  # correlation that inputs between the samples reach as well: 0.13 was measured
WHITE = 0.9  # share of the power of an input that its past does not predict
RUNS = (1, 4, 16, 64)  # lags of a sum
BLOCKS = 32
OUTLYING = 3.0
TOO_SHORT = 2000  # samples: a block has as many as a lag then
ORDER = 256  # of the joint model
SAMPLES = 100  # of the record for each of its lags, at least
SOFTENED = 1e-3  # added to the autocorrelation at 0
RIDGE = 1e-9  # a signal without noise is predicted too well
EVIDENCE = "the input follows the past output (correlation {:.2g}, {:.1f} standard errors)"
BETWEEN = ", unless the input changes between the recorded samples"
REMEDY = (
    "record the reference of the controller too, --read reference=NAME, or excite periodically and"
    " average periods"
)


@dataclass(frozen=True, slots=True, eq=False)
class NoiseLoop:
    """A closed loop: `evidence` in words, and the joint model of input and output, `model` of shape
    (order, 2, 2) with the covariance of its innovations, shape (2, 2); `acts_at_once`: the machine
    may respond within the same sample.
    """

    evidence: str
    model: Real
    covariance: Real
    acts_at_once: bool

    def bias(self, omega: Real) -> Real:
        """Return the bias of output over input as a share of that biased response, shape (n_f,), at
        `omega` [rad per sample].
        """
        response = _responses(self.model, omega)
        own, crossed = self.covariance.diagonal(), self.covariance[0, 1]
        # innovations made independent: e_y = d e_u + rest, or e_u = d e_y + rest
        if self.acts_at_once:
            d, variances = crossed / own[0], own - [0.0, crossed**2 / own[0]]
            first, second = response[:, :, 0] + d * response[:, :, 1], response[:, :, 1]
        else:
            d, variances = crossed / own[1], own - [crossed**2 / own[1], 0.0]
            first, second = response[:, :, 0], response[:, :, 1] + d * response[:, :, 0]
        powers = np.abs(first[:, 0]) ** 2 * variances[0], np.abs(second[:, 0]) ** 2 * variances[1]
        ratio = second[:, 1] * first[:, 0] / (second[:, 0] * first[:, 1])
        return biased_share((ratio - 1) * powers[1] / (powers[0] + powers[1]))

    def feedback(self, bias: Real, scatter: Real) -> Feedback:
        """Return the loop with relative bias and scatter of lines, shape (n_f,) each."""
        return Feedback(self.evidence, bias, scatter, REMEDY)


def loop_in_noise(u: Real, y: Real, order: int) -> NoiseLoop | None:
    """Return the loop that a record of input and output, shape (n,) each, shows, or None: there is
    none, or this record cannot show it. `order` of the sensor (0: position).
    """
    from scipy.special import stdtrit

    if order == 0:
        u, y = u[1:], np.diff(y)
    if len(u) < TOO_SHORT:
        return None
    own, other = _noise(u, y)
    if not (np.ptp(own) > ROUNDING * np.ptp(u) and np.ptp(other) > 0):
        return None
    values, other = _whiten(own), _whiten(other)
    if not (np.isfinite(values).all() and np.isfinite(other).all()):
        return None
    rest = _sums(_unexplained_correlation(values, other))
    mean, error = rest.mean(axis=0), rest.std(axis=0, ddof=1) / np.sqrt(BLOCKS)
    # a correlation of n samples has at least the error of white noise
    error = np.maximum(error, 1 / np.sqrt(len(values)))
    sizes = np.abs(mean) / error
    if sizes.max() < -float(stdtrit(BLOCKS - 1, LEVEL / rest.shape[1] / 2)):
        return None
    correlation = float(np.abs(mean[np.argmax(sizes)]))
    # what whitening leaves of unit power
    is_smooth = own is u and float(np.mean(values**2)) < WHITE
    model, covariance = _joint_model(u, y)
    return NoiseLoop(
        EVIDENCE.format(correlation, float(sizes.max()))
        + BETWEEN * (is_smooth and correlation < WEAK),
        model,
        covariance,
        acts_at_once=order == 2,
    )


def _noise(u: Real, y: Real) -> tuple[Real, Real]:
    """Return input and output without what repeats with the input: a sum of sines cannot be
    whitened. All of it where too few periods leave no measurable noise.
    """
    try:
        period = detected_period(u)
    except InputError:
        return u, y
    count = len(u) // period
    if count < PERIODS:
        return np.zeros_like(u), y
    whole = (x[: count * period].reshape(count, period) for x in (u, y))
    own, other = ((x - x.mean(axis=0)).ravel() for x in whole)
    return own, other


def _whiten(x: Real) -> Real:
    """Return what an autoregressive model does not predict, shape (n - ORDER_OF_WHITENING,)."""
    from scipy.linalg import solve_toeplitz
    from scipy.signal import lfilter

    x, order = (x - x.mean()) / np.std(x), ORDER_OF_WHITENING
    covariance = np.array([x[lag:] @ x[: len(x) - lag] for lag in range(order + 1)]) / len(x)
    covariance[0] *= 1 + RIDGE
    model = solve_toeplitz(covariance[:order], covariance[1:])
    return np.asarray(lfilter(np.concatenate([[1.0], -model]), 1.0, x)[order:])


def _unexplained_correlation(values: Real, other: Real) -> Real:
    """Return the correlation of `values` with `other` 1 to `LAGS` samples before, less that of an
    open loop, of each block, shape (BLOCKS, LAGS).
    """
    size = len(values) // BLOCKS
    u, y = _blocks(values, size), _blocks(other, size)
    crossed, own = _correlations(u, y), _correlations(u, u)
    past = crossed[:, 1 : LAGS + 1]
    # index -k: the input k samples before the output
    future = np.concatenate([crossed[:, :1], crossed[:, : -LAGS - 1 : -1]], axis=1)
    shifted = np.arange(1, LAGS + 1)[:, None] + np.arange(LAGS + 1)
    near = np.abs(np.arange(LAGS + 1)[:, None] - np.arange(LAGS + 1))
    matrix = own[:, near] + SOFTENED * np.eye(LAGS + 1)
    weights = np.linalg.solve(matrix, future[:, :, None])
    leaked = (own[:, shifted] @ weights)[:, :, 0]
    rest = past - leaked
    middle = np.median(rest, axis=0)
    reach = OUTLYING * 1.4826 * np.median(np.abs(rest - middle), axis=0)
    return np.asarray(np.clip(rest, middle - reach, middle + reach))


def _sums(rest: Real) -> Real:
    """Return sums over neighbouring lags with the variance of a single one, shape (BLOCKS, n)."""
    sums = (rest.reshape(BLOCKS, -1, m).sum(axis=2) / np.sqrt(m) for m in RUNS)
    return np.concatenate(list(sums), axis=1)


def _blocks(x: Real, size: int) -> Real:
    """Return blocks of `size` samples with unit power, shape (BLOCKS, size)."""
    cut = x[: BLOCKS * size].reshape(BLOCKS, size)
    power = np.mean(cut**2, axis=1, keepdims=True)
    return np.asarray(cut / np.sqrt(np.where(power > 0, power, 1.0)))


def _correlations(a: Real, b: Real) -> Real:
    """Return the mean of a(t + l) b(t) at index l, negative l from the end, for each block."""
    size = a.shape[1]
    length = 2 * size + 2 * LAGS
    spectra = np.fft.rfft(a, length, axis=1) * np.fft.rfft(b, length, axis=1).conj()
    return np.asarray(np.fft.irfft(spectra, length, axis=1) / size)


def _joint_model(u: Real, y: Real) -> tuple[Real, Real]:
    """Return coefficients A_1 .. A_p of x(t) = sum_k A_k x(t - k) + e(t), x = (u, y), shape
    (p, 2, 2), and the covariance of e, both in units of the deviations of u and y.
    """
    x = np.stack([(signal - signal.mean()) / np.std(signal) for signal in (u, y)])
    n = x.shape[1]
    p = min(ORDER, n // SAMPLES)
    spectra = np.fft.rfft(x, 2 * n, axis=1)
    # R_l = E x(t + l) x(t)^T, shape (p + 1, 2, 2)
    products = np.einsum("if,jf->ijf", spectra, spectra.conj())
    covariances = np.moveaxis(np.fft.irfft(products, 2 * n, axis=2)[:, :, : p + 1], 2, 0) / n
    lags = np.arange(p)[:, None] - np.arange(p)
    tiles = np.where(
        (lags >= 0)[..., None, None],
        covariances[np.abs(lags)],
        covariances[np.abs(lags)].transpose(0, 1, 3, 2),
    )
    # sum_k A_k R_{l - k} = R_l for l = 1 .. p
    matrix = tiles.transpose(1, 2, 0, 3).reshape(2 * p, 2 * p)
    matrix = matrix + RIDGE * np.eye(2 * p)
    right = covariances[1:].transpose(1, 0, 2).reshape(2, 2 * p)
    model = np.linalg.solve(matrix.T, right.T).T.reshape(2, p, 2).transpose(1, 0, 2)
    return model, covariances[0] - np.einsum("kij,klj->il", model, covariances[1:])


def _responses(model: Real, omega: Real) -> Complex:
    """Return the responses of x to e, shape (n_f, 2, 2), at `omega` [rad per sample]."""
    delays = np.exp(-1j * np.outer(omega, np.arange(1, len(model) + 1)))
    inverse: NDArray[np.complex128] = np.eye(2) - np.einsum("fk,kij->fij", delays, model)
    return np.asarray(np.linalg.inv(inverse))
