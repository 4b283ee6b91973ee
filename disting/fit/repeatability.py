"""How much two candidates may differ on test data by chance.

The relative standard deviation rho_k of amplitude and phase of each test line comes from what is known, in this order: lines
that training and test share (the response measured twice, with different amplitudes or not); the standard deviations that come
with the test data; the residuals of the best candidate. With residuals r_a, r_b (shape (n_y,)) and noise of deviation w rho in
them, J_a - J_b = (r_a - r_b)'(r_a + r_b) has the standard deviation 2 |(r_a - r_b) w rho|.
"""

from dataclasses import dataclass
from math import sqrt

import numpy as np

from disting.fit.cost import Cost
from disting.fit.plant import Real
from disting.measurement import FrequencyResponse

COMMON = 8  # lines that training and test must share
SAME = 1e-6  # relative distance of two frequencies that count as one
DEVIATIONS = 2.0  # standard deviations that a candidate with more parameters must win by


@dataclass(frozen=True, eq=False)
class Repeatability:
    """rho of every test line, shape (n_f,), and in words where it comes from."""

    rho: Real
    source: str

    @property
    def typical(self) -> float:
        """Root mean square of rho: 0.01 means 1 % in amplitude, 0.01 rad in phase."""
        return sqrt(float(np.mean(self.rho**2)))


def repeatability(train: FrequencyResponse, test: FrequencyResponse, best: Real) -> Repeatability:
    """What training data, test data and the residuals `best` of the best candidate tell of the noise."""
    n_f = len(test.omega)
    if train is not test:
        at = np.clip(np.searchsorted(train.omega, test.omega), 1, len(train.omega) - 1)
        at -= test.omega - train.omega[at - 1] < train.omega[at] - test.omega
        common = np.abs(train.omega[at] - test.omega) <= SAME * test.omega
        if common.sum() >= COMMON:
            ratio = np.log(test.G[common] / train.G[at[common]])
            rho = sqrt(float(np.mean(np.abs(ratio) ** 2)) / 4)  # two measurements, two components
            return Repeatability(np.full(n_f, rho), f"{common.sum()} lines that training and test share")
    if test.deviation is not None:
        return Repeatability(np.asarray(test.deviation / np.abs(test.G) / sqrt(2)), "the standard deviations of the test data")
    return Repeatability(np.full(n_f, sqrt(float(np.mean(best**2)))), "the residuals of the best candidate")


def margin(one: Real, other: Real, cost: Cost, noise: Repeatability) -> float:
    """Difference of two test costs that noise alone may make, from both residuals, shape (n_y,)."""
    scatter = cost.scatter(noise.rho)
    return DEVIATIONS * 2.0 * float(np.linalg.norm((one - other) * scatter))
