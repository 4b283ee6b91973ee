"""A digital drive holds its input from sample to sample (zero-order hold) and samples its output.

With T the sampling time and omega_s = 2 pi / T, the response between the samples of input and
output is

    G_T(omega) = sum_m H(omega + m omega_s) G(omega + m omega_s),
    H(omega)   = (1 - exp(-j omega T)) / (j omega T),

over all whole m (K. Astrom, B. Wittenmark, Computer-Controlled Systems, 3rd ed. 1997, section 7.4).
H alone is half a sample of delay and a gain of sin(omega T / 2) / (omega T / 2). The terms m != 0
are images of the response at high frequencies. A dead time between command and motion belongs to G,
at the images too.

exp(-j omega T) is the same at all images, so that H(omega + m omega_s) / H(omega) =
omega / (omega + m omega_s). Beyond its resonances a position falls with 1 / omega^2, a speed with
1 / omega, so images fall with 1 / (m + x)^p, x = omega / omega_s, p = 3 and 2. Those up to `IMAGES`
on either side are computed; the outermost ones count for all further ones too, by a Hurwitz zeta
function. Where all images of a rigid position are below `NEGLECTED` of a line, x < 0.06, it has
none.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.sparse import csr_array
from scipy.special import zeta

from disting.errors import InputError, short
from disting.measurement.arrays import Complex, Real

NEGLECTED = 1e-4  # relative size of images that are left out
IMAGES = 2  # on either side of a line
REMEMBERED = 8  # grids


@dataclass(frozen=True, slots=True)
class Hold:
    """Sampling time `period` [s] of a held input, and the `order` of the sensor that was sampled
    (0: position).
    """

    period: float
    order: int = 0


def as_period(value: object) -> float:
    """Sampling time [s]; raises InputError for what is no positive number.

    >>> as_period("125e-6")
    0.000125
    """
    try:
        period = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        period = 0.0
    if not 0 < period < np.inf:
        raise InputError(
            f"a hold is given by its sampling time in seconds, such as 125e-6, not {short(value)};"
            " of a record in time also as the word record"
        )
    return period


def factor(omega: Complex, period: float) -> Complex:
    """H at angular frequencies [rad/s], real or complex.

    >>> factor(np.array([np.pi + 0j]), 1.0).round(6).tolist()
    [-0.63662j]
    """
    x = 1j * omega * period
    return np.asarray(-np.expm1(-x) / x)


def hold_weights(hold: Hold, omega: Complex, order: int) -> tuple[Complex, csr_array]:
    """Angular frequencies of lines and images, shape (n,), and the weights, shape (n_f, n), by
    which responses of a sensor of `order` there make what a sampled bench shows at `omega`.

    Raises InputError for lines at or above half the sampling rate.
    """
    return _weights(hold, np.asarray(omega, dtype=np.complex128).tobytes(), order)


@lru_cache(maxsize=REMEMBERED)
def _weights(hold: Hold, lines: bytes, order: int) -> tuple[Complex, csr_array]:
    omega = np.frombuffer(lines, dtype=np.complex128)
    rate = 2 * np.pi / hold.period
    share = omega.real / rate
    if np.any(share >= 0.5):
        raise InputError(
            f"a line at {omega.real.max() / (2 * np.pi):g} Hz is not below half the sampling rate"
            f" of {1 / hold.period:g} Hz; is the time of the hold in seconds, or leave lines out"
            " with --band"
        )
    power = 3 - hold.order
    whole = np.abs(_tail(power, 1 + share) + (-1) ** power * _tail(power, 1 - share))
    counts = np.where(share**power * whole < NEGLECTED, 0, IMAGES)
    rows = np.repeat(np.arange(len(omega)), 2 * counts + 1)
    images = np.concatenate([np.arange(-count, count + 1) for count in counts])
    points = omega[rows] + images * rate
    ratio = omega[rows] / points
    # what was sampled as one quantity became the other one line by line
    values = factor(omega, hold.period)[rows] * ratio ** (1 + order - hold.order)
    outer = np.abs(images) == IMAGES
    distance = np.abs(images[outer] + share[rows][outer])
    values[outer] *= distance**power * _tail(power, distance)
    matrix = csr_array((values, (rows, np.arange(len(points)))), (len(omega), len(points)))
    return points, matrix


def _tail(power: int, first: Real) -> Real:
    """Sum of 1 / (first + m)^power over m = 0, 1, ..; of power 1, which has none, the first term
    alone.
    """
    return np.asarray(zeta(power, first) if power > 1 else 1 / first)
