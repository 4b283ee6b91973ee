"""What a line of Welch's method shows: not G, but its mean under the window of the segments.

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
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from disting.measurement.arrays import Complex, Real

SHIFT = 4.0  # sigma T: what repeats after 2 T is exp(-8) of itself
FINE = 2  # points for each 1/T
REACH = 10  # 1/T to either side of a line, beyond which K is less than 1e-5 of its height
STEPS = 400  # of the integral over T
REMEMBERED = 8  # grids


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
    return _seen(window.duration, omega.tobytes(), order - window.order)


@lru_cache(maxsize=REMEMBERED)
def _seen(duration: float, lines: bytes, steps: int) -> tuple[Complex, csr_array]:
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
