"""Data at the ends of what floating point holds: fitted without a warning, or refused in a
sentence.
"""

import warnings

import numpy as np
import pytest

from disting import Chain, InputError
from disting.fit import select
from disting.fit.networks import fit_networks
from disting.measurement import FrequencyResponse
from disting.network import network_of
from tests.fit.drives import response as drive

OMEGA = np.linspace(10.0, 100.0, 30)
TWO = Chain(2, damped=True)
VALUES = {"m1": 1.0, "m2": 0.5, "k12": 1e3, "d12": 2.0}  # resonance at 55 rad/s
RESPONSE = drive(TWO, VALUES, OMEGA, noise=0.01).G
REFUSED = {
    "huge": (OMEGA, RESPONSE * 1e306),
    "denormal": (OMEGA, RESPONSE * 1e-318),
    "slow": (OMEGA * 1e-301, RESPONSE),
    "fast": (OMEGA * 1e298, RESPONSE),
    "wide": (OMEGA, RESPONSE * np.logspace(-150, 150, 30)),
}
TAKEN = {
    "large": (OMEGA, RESPONSE * 1e26),
    "small": (OMEGA, RESPONSE * 1e-26),
    "constant": (OMEGA, np.ones(30, complex)),
    "wide": (OMEGA, RESPONSE * np.logspace(-25, 25, 30)),
    "slow": (OMEGA * 1e-28, RESPONSE),
    "fast": (OMEGA * 1e26, RESPONSE),
    "8 lines": (OMEGA[::4], RESPONSE[::4]),
    "10 lines": (OMEGA[::3], RESPONSE[::3]),  # fewer than lie near a line
}


def fitted(omega, response):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return select(FrequencyResponse(omega, response), [Chain(1, damped=False), TWO])


@pytest.mark.parametrize("data", REFUSED.values(), ids=REFUSED)
def test_numbers_that_floating_point_cannot_square_are_refused(data):
    with pytest.raises(InputError, match="choose other units"):
        fitted(*data)


@pytest.mark.parametrize("data", REFUSED.values(), ids=REFUSED)
def test_networks_refuse_them_too(data):
    with pytest.raises(InputError, match="choose other units"):
        fit_networks(FrequencyResponse(*data), [network_of("R0-p(R1,C1)")])


@pytest.mark.sampled(3)
@pytest.mark.full
@pytest.mark.parametrize(
    "name",
    [pytest.param(n, marks=pytest.mark.slow) if n in ("wide", "10 lines") else n for n in TAKEN],
)
def test_other_numbers_are_fitted_without_a_warning(name):
    """What only the units make large or small is explained as it is in other units."""
    found = fitted(*TAKEN[name])
    assert all(np.isfinite(c.estimate.j) for c in found.candidates)
    few = name.endswith("lines")  # too few to judge the structure that is selected
    assert found.explanation.too_few is few
    assert found.explanation.explains == (name != "wide" and not few)
