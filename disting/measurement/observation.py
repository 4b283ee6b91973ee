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

What a line of Welch's method shows: not G, but its mean under the window of the segments.

With r(tau) the autocorrelation of a Hann window of T seconds, r(0) = 1, and an input that is flat
over a few lines, the H1 estimate has the mean

    G_T(omega) = integral_0^T r(tau) h(tau) exp(-j omega tau) d tau,    h = impulse response,
    r(tau) = (1 - x) (2/3 + 1/3 cos 2 pi x) + sin(2 pi x) / (2 pi),     x = |tau| / T,

which forgets what rings longer than T. A model whose line is G_T, not G, is compared with what was
measured, however narrow its resonances are. From G on a line to the right of the imaginary axis,
where no resonance is narrower than its points lie apart (h r = (h exp(-sigma tau)) (r exp(sigma
tau)), the trapezoidal rule over frequencies, whose points 2 pi / (2 T) apart repeat h exp(-sigma
tau) after 2 T):

    G_T(omega) = sum_i K(omega - omega_i) G(sigma + j omega_i) / (2 T),
    K(x) = integral_-T^T r(tau) exp(sigma tau - j x tau) d tau.

How lines show a response: under the window of Welch's method, behind a held input.

Lines are linear combinations of the response at complex frequencies. A fit compares models with the
data through the same combinations, so nothing has to be divided out of the data.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
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
    return _weights_of_hold(hold, np.asarray(omega, dtype=np.complex128).tobytes(), order)


@lru_cache(maxsize=REMEMBERED)
def _weights_of_hold(hold: Hold, lines: bytes, order: int) -> tuple[Complex, csr_array]:
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


SHIFT = 4.0  # sigma T: what repeats after 2 T is exp(-8) of itself
FINE = 2  # points for each 1/T
REACH = 10  # 1/T to either side of a line, beyond which K is less than 1e-5 of its height
STEPS = 400  # of the integral over T


@dataclass(frozen=True, slots=True, eq=False)
class Window:
    """Hann segments of `duration` T [s], of a sensor of this `order` (2: acceleration). `ratio` =
    the H1 estimate divided by the response that was made of it, shape (n_f,), `share` likewise of
    their standard deviations; None where the response is the H1 estimate itself.
    """

    duration: float
    order: int
    ratio: Complex | None = None
    share: Real | None = None

    def of(self, lines: NDArray[np.bool_] | NDArray[np.integer]) -> "Window":
        """That of some of the lines."""
        if self.ratio is None or self.share is None:
            return self
        return Window(self.duration, self.order, self.ratio[lines], self.share[lines])


def line_weights(window: Window, omega: Real, order: int) -> tuple[Complex, csr_array]:
    """Complex angular frequencies omega_i - j sigma, shape (n,), and the weights, shape (n_f, n),
    by which responses of a sensor of `order` there make what lines at `omega` show.
    """
    return _observe_lines(window.duration, omega.tobytes(), order - window.order)


@lru_cache(maxsize=REMEMBERED)
def _observe_lines(duration: float, lines: bytes, steps: int) -> tuple[Complex, csr_array]:
    omega = np.frombuffer(lines)
    apart, reach = np.pi * 2 / (FINE * duration), REACH * FINE
    nearest = np.rint(omega / apart).astype(np.intp)
    near = nearest[:, None] + np.arange(-reach, reach + 1)
    points, at = np.unique(near, return_inverse=True)
    shifted = points * apart - 1j * SHIFT / duration
    weights = _kernel((omega[:, None] - near * apart) * duration) / FINE
    # what was measured of another quantity became this one line by line
    weights = weights * (omega[:, None] / shifted[at.reshape(near.shape)]) ** steps
    ends = np.arange(0, near.size + 1, near.shape[1])
    matrix = csr_array((weights.ravel(), at.ravel(), ends), (len(omega), len(points)))
    return shifted, matrix


def _kernel(x: Real) -> Complex:
    """K / T over x = (omega - omega_i) T."""
    tau = (np.arange(-STEPS, STEPS) + 0.5) / STEPS
    size = np.abs(tau)
    r = (1 - size) * (2 + np.cos(2 * np.pi * size)) / 3 + np.sin(2 * np.pi * size) / (2 * np.pi)
    values, at = np.unique(np.round(x, 9), return_inverse=True)
    transform = np.exp(-1j * np.outer(values, tau)) @ (r * np.exp(SHIFT * tau)) / STEPS
    return np.asarray(transform[at].reshape(x.shape))


@dataclass(frozen=True, slots=True)
class Observation:
    """Segments of Welch's method, `segment` = (duration [s], order of the sensor), and the `hold`
    of the input; None for what a measurement has not.
    """

    segment: tuple[float, int] | None = None
    hold: Hold | None = None

    @property
    def grid(self) -> tuple[float | None, float | None]:
        """All that the complex frequencies of given lines depend on."""
        duration = None if self.segment is None else self.segment[0]
        return duration, None if self.hold is None else self.hold.period

    def weights(self, omega: Real, order: int) -> tuple[Complex, csr_array]:
        """Complex angular frequencies, shape (n,), and the weights, shape (n_f, n), by which
        responses of a sensor of `order` there make what lines at `omega` show.
        """
        return _weights(self, np.asarray(omega, dtype=np.float64).tobytes(), order)


@lru_cache(maxsize=REMEMBERED)
def _weights(observation: Observation, lines: bytes, order: int) -> tuple[Complex, csr_array]:
    omega = np.frombuffer(lines)
    if observation.segment is None:
        assert observation.hold is not None
        return hold_weights(observation.hold, omega.astype(np.complex128), order)
    points, matrix = line_weights(Window(*observation.segment), omega, order)
    if observation.hold is None:
        return points, matrix
    images, held = hold_weights(observation.hold, points, order)
    return images, csr_array(matrix @ held)
