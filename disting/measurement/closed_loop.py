"""Whether the input of a record follows its output, as under a controller.

Input and output are whitened by autoregressive models. In open loop the whitened input is not
correlated with the past of the output, whatever the noise: the sample correlation at n samples has
the deviation 1/sqrt(n). A controller feeds the output back, and its noise appears in the input a
few samples later (Soderstrom and Stoica, System Identification, 1989, section 10). Not seen: a
controller that acts within the same sample only, and one in a record with hardly any noise.
"""

import numpy as np

from disting.measurement.arrays import Real

FOLLOWS = "the input follows the past output"
ORDER = 32  # of the autoregressive models
LAGS = 64  # samples into the past and the future
DEVIATIONS = 8.0  # by which a correlation is none of chance
# of the largest correlation with the future, which is the plant's own; a whitening that fails
# leaves less
SHARE = 0.4
TOO_SHORT = 500  # samples


def follows_output(u: Real, y: Real) -> str | None:
    """Sentence if the input is correlated with the past output, else None."""
    if len(u) < TOO_SHORT:
        return None
    one, other = _whitened(u), _whitened(y)
    size = np.sqrt((one @ one) * (other @ other))
    if not 0 < size < np.inf:
        return None
    past, future = _largest(one, other) / size, _largest(other, one) / size
    if past * np.sqrt(len(one)) < DEVIATIONS or past < SHARE * future:
        return None
    return (
        f"{FOLLOWS} (correlation {past:.2g}, {past * np.sqrt(len(one)):.0f}"
        " times that of chance): a closed loop? then the response is biased; give the controller's"
        " reference signal, --read reference=NAME"
    )


def _whitened(x: Real) -> Real:
    """What an autoregressive model does not predict, shape (n - ORDER,)."""
    from scipy.linalg import solve_toeplitz
    from scipy.signal import lfilter

    x = (x - x.mean()) / np.std(x)
    covariance = np.array([x[lag:] @ x[: len(x) - lag] for lag in range(ORDER + 1)]) / len(x)
    covariance[0] *= 1 + 1e-9  # a signal without noise is predicted too well
    model = solve_toeplitz(covariance[:ORDER], covariance[1:])
    return np.asarray(lfilter(np.concatenate([[1.0], -model]), 1.0, x)[ORDER:])


def _largest(later: Real, earlier: Real) -> float:
    """The largest sum of products of `later` with `earlier` 1 to `LAGS` samples before."""
    return float(max(abs(later[lag:] @ earlier[:-lag]) for lag in range(1, LAGS + 1)))
