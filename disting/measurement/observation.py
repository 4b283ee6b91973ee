"""How lines show a response: under the window of Welch's method, behind a held input.

Lines are linear combinations of the response at complex frequencies. A fit compares models with the
data through the same combinations, so nothing has to be divided out of the data.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.sparse import csr_array

from disting.measurement.arrays import Complex, Real
from disting.measurement.hold import Hold, hold_weights
from disting.measurement.window import Window, line_weights

REMEMBERED = 8  # grids


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
