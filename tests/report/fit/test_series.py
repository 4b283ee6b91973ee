"""Bands are drawn by as few corners as show what they are."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from disting.report.fit.series import FINE, corners

X = np.linspace(0.0, 3.0, 700)


@pytest.mark.full
@given(st.floats(0.003, 0.3), st.floats(0.2, 2.8), st.floats(-5, 5))
def test_straight_lines_between_the_corners_are_the_curves(width, place, slope):
    peak = np.log1p(1 / ((X - place) ** 2 + width**2)) + slope * X
    lower = peak - 0.1 * np.abs(np.sin(X))
    at = corners(X, lower, peak)
    for curve in (lower, peak):
        assert np.abs(np.interp(X, X[at], curve[at]) - curve).max() <= FINE * np.ptp(curve) * (
            1 + 1e-9
        )
    assert {0, len(X) - 1} <= set(at) and len(at) < 200


def test_a_straight_band_has_its_ends_alone():
    assert list(corners(X, X, 2 * X + 1)) == [0, len(X) - 1] == list(corners(X, np.ones_like(X)))
