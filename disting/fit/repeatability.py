"""How much two candidates may differ on test data by chance.

With residuals r_a, r_b (shape (n_y,)) and noise of covariance C in them, J_a - J_b = (r_a -
r_b)'(r_a + r_b) has the standard deviation 2 sqrt((r_a - r_b)' C (r_a - r_b)).

For the paper's selection rho of amplitude and phase of each test line comes from what is known, in
this order: lines that training and test share (the response measured twice, with different
amplitudes or not); the standard deviations that come with the test data; the residuals of the best
candidate.
"""

from math import sqrt

import numpy as np

from disting.fit.plant import Real
from disting.fit.practical import Seen
from disting.fit.scatter import Scatter, between, shared
from disting.measurement import FrequencyResponse

DEVIATIONS = 2.0  # standard deviations that a candidate with more parameters must win by


def repeatability(train: FrequencyResponse, test: FrequencyResponse, best: Real) -> Scatter:
    """What training data, test data and the residuals `best` of the best candidate tell of the
    noise.
    """
    n_f = len(test.omega)
    rho = between(train, test)
    if rho is not None:
        return Scatter(
            np.full(n_f, rho),
            f"{int(shared(train, test)[1].sum())} lines that training and test share",
        )
    if test.deviation is not None:
        return Scatter(
            np.asarray(test.deviation / np.abs(test.G) / sqrt(2)),
            "the standard deviations of the test data",
        )
    return Scatter(
        np.full(n_f, sqrt(float(np.mean(best**2)))), "the residuals of the best candidate"
    )


def margin(one: Real, other: Real, noise: Seen) -> float:
    """Difference of two test costs that noise alone may make, from both residuals, shape (n_y,)."""
    return DEVIATIONS * 2.0 * float(np.linalg.norm(noise.seen((one - other)[:, None])))
