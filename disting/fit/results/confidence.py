"""What a fitted candidate says of the response: its values, how sure they are, and how much of the
data they reproduce.

With g = d ln G / d ln p, shape (n_p,) at each frequency, ln |G| and arg G have by the chain rule
the standard errors

    s_1 = sqrt(Re g' C Re g),    s_2 = sqrt(Im g' C Im g)    [1, rad]

with the covariance C of the logarithms of the parameters from which their own standard errors
follow (`covariance`): the band |G| exp(-+1.96 s_1), arg G -+ 1.96 s_2 holds the true response at
each frequency with 95 %, if the structure is the true one.
"""

from dataclasses import dataclass

import numpy as np

from disting.fit.judge.candidate import Candidate
from disting.fit.judge.practical import standard_errors
from disting.fit.search.estimate import Task
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real

ROUNDING = 1e-12  # share of a response below which its changes are rounding


@dataclass(frozen=True, slots=True, eq=False)
class Confidence:
    """Standard errors of ln |G| and of arg G [rad] of a model, shape (n_f,) each; infinite
    where the data do not tell.
    """

    amplitude: Real
    phase: Real


def response_of(candidate: Candidate, task: Task, omega: Real, at: int = 0) -> Complex:
    """Fitted response, shape (n_f,), at angular frequencies [rad/s], with the sign of the fit;
    `at` = which one of several.
    """
    plant = task.plant(candidate.chain).at(omega, at)
    return plant.response(_values(candidate, task))


def confidence(candidate: Candidate, task: Task, omega: Real, at: int = 0) -> Confidence:
    """Standard errors of the fitted response at angular frequencies [rad/s]; zero where all
    parameters are given.
    """
    p, free = _values(candidate, task), task.box(task.names(candidate.chain)).free
    if not free.any():
        return Confidence(np.zeros(len(omega)), np.zeros(len(omega)))
    plant = task.plant(candidate.chain)
    columns = task.cost.of(plant, p)[1][:, free]
    slopes = (plant.at(omega, at).logarithmic_gradient(p)[1] * p[:, None])[free].T
    both = np.concatenate([slopes.real, slopes.imag])
    errors = standard_errors(both, columns, candidate.noise, candidate.practical.rank)
    return Confidence(*np.split(errors, 2))


def fit_percent(
    candidate: Candidate, task: Task, measured: FrequencyResponse, at: int = 0
) -> float:
    """100 (1 - |G - G_m| / |G - mean G|) over the lines, G measured and G_m fitted, norms over the
    complex numbers; `at` = which of several responses.

    The normalised root mean square that MATLAB's `compare` prints: 100 for a perfect fit, 0 for
    one no better than a constant. It weighs lines by their amplitude, so it tells of the
    resonances and hardly of what lies 40 dB below them. Not a number where the data are constant.
    """
    missed = np.linalg.norm(measured.G - response_of(candidate, task, measured.omega, at))
    moved = np.linalg.norm(measured.G - measured.G.mean())
    return (
        float(100 * (1 - missed / moved))
        if moved > ROUNDING * np.linalg.norm(measured.G)
        else float("nan")
    )


def _values(candidate: Candidate, task: Task) -> Real:
    return np.array([candidate.estimate.parameters[name] for name in task.names(candidate.chain)])
