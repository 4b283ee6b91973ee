"""Criteria of practical identifiability on published numbers."""

import re
import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, strategies as st

from disting.errors import InputError
from disting.statistics.covariance import equal
from disting.statistics.practical import (
    Thresholds,
    collinearity_by_subset,
    collinearity_index,
    condition_indices,
    covariance,
    importance,
    practical,
    standard_errors,
    worst_direction,
)
from tests.measurement.bench_data import measured_data

# Longley 1967, J. Am. Stat. Assoc. 62, 819-841: GNP deflator, GNP, unemployment, armed forces,
# population, year.
LONGLEY = np.array([
    [83.0, 234289, 2356, 1590, 107608, 1947], [88.5, 259426, 2325, 1456, 108632, 1948],
    [88.2, 258054, 3682, 1616, 109773, 1949], [89.5, 284599, 3351, 1650, 110929, 1950],
    [96.2, 328975, 2099, 3099, 112075, 1951], [98.1, 346999, 1932, 3594, 113270, 1952],
    [99.0, 365385, 1870, 3547, 115094, 1953], [100.0, 363112, 3578, 3350, 116219, 1954],
    [101.2, 397469, 2904, 3048, 117388, 1955], [104.6, 419180, 2822, 2857, 118734, 1956],
    [108.4, 442769, 2936, 2798, 120445, 1957], [110.8, 444546, 4681, 2637, 121950, 1958],
    [112.6, 482704, 3813, 2552, 123366, 1959], [114.2, 502601, 3931, 2514, 125368, 1960],
    [115.7, 518173, 4806, 2572, 127852, 1961], [116.9, 554894, 4007, 2827, 130081, 1962],
])  # fmt: skip


def test_longley_with_a_constant():
    expected = [1, 9.1417205, 12.255735, 25.336607, 230.42395, 1048.0803, 43275.0436]
    np.testing.assert_allclose(
        condition_indices(np.column_stack([np.ones(16), LONGLEY])), expected, rtol=1e-7
    )


def test_longley_without_a_constant():
    assert collinearity_index(LONGLEY) == pytest.approx(448.1162867, rel=1e-9)


def test_belsley_consumption_function():
    matrix = np.loadtxt(measured_data("belsley1991_consumption_X.csv"), delimiter=",", skiprows=1)
    np.testing.assert_allclose(
        condition_indices(matrix), [1.000, 4.143, 7.799, 39.406, 375.614], atol=1e-3
    )


def test_the_examples_of_fme():
    assert collinearity_index(np.outer(np.arange(1.0, 6.0), [1, 2])) == np.inf
    matrix = np.array([[-0.400, -0.374], [0.255, 0.797], [0.690, -0.472], [-0.546, 0.049]])
    assert collinearity_index(matrix) == pytest.approx(1.000200609, abs=1e-9)


@given(st.integers(0, 10**6), st.floats(1e-6, 1e6))
def test_scaling_of_columns_changes_neither_collinearity_nor_condition(seed, factor):
    matrix = np.random.default_rng(seed).normal(size=(9, 4))
    scaled = matrix * [1.0, factor, 1.0, 1.0 / factor]
    np.testing.assert_allclose(condition_indices(scaled), condition_indices(matrix), rtol=1e-6)
    np.testing.assert_allclose(importance(scaled)[1], factor * importance(matrix)[1])


def test_subsets_are_never_more_collinear_than_the_whole():
    matrix = np.random.default_rng(1).normal(size=(9, 4))
    subsets = dict(collinearity_by_subset(matrix))
    assert len(subsets) == 11 and max(subsets.values()) == subsets[0, 1, 2, 3] == pytest.approx(
        collinearity_index(matrix)
    )


def test_the_covariance_is_that_of_linear_regression():
    matrix = np.random.default_rng(2).normal(size=(30, 3)) * [1.0, 100.0, 0.01]
    expected = 7.0 / 27 * np.linalg.inv(matrix.T @ matrix)
    np.testing.assert_allclose(covariance(matrix, equal(7.0, 30, 3)), expected, rtol=1e-9)
    assert np.isinf(covariance(np.outer(np.arange(4.0), [1, 2]), equal(1.0, 4, 2))).all()


def test_the_worst_direction_names_the_parameters_that_trade():
    matrix = np.random.default_rng(3).normal(size=(20, 3))
    matrix[:, 2] = -matrix[:, 0] + 1e-4 * matrix[:, 2]
    found = worst_direction(matrix, ["a", "b", "c"])
    assert set(found) == {"a", "c"} and found["a"] == pytest.approx(found["c"], rel=1e-2)


def test_reasons_name_criterion_value_threshold_and_parameters():
    matrix = np.random.default_rng(4).normal(size=(20, 3)) * [1.0, 1.0, 1e-5]
    matrix[:, 1] = matrix[:, 0] + 1e-3 * matrix[:, 1]
    reasons = Thresholds().reasons(practical(matrix, ["m1", "m2", "k12"], equal(1.0, 20, 3)))
    assert [re.sub(r"[\d.e+]+ exceeds", "x exceeds", reason) for reason in reasons] == [
        "badly determined together: m1, m2 (condition index x exceeds 30)",
        "with little effect: k12 (PII ratio x exceeds 1000)",
        "made up for by each other: m1, m2 (collinearity index x exceeds 20)",
    ]
    assert (
        Thresholds(np.inf, np.inf, np.inf).reasons(
            practical(matrix, ["m1", "m2", "k12"], equal(1.0, 20, 3))
        )
        == ()
    )


@pytest.mark.parametrize("bad", [np.zeros((3, 0)), np.ones(3), np.array([[1.0, np.nan]])])
def test_what_is_no_matrix_is_refused(bad):
    with pytest.raises(InputError, match="rows and columns of finite numbers"):
        collinearity_index(bad)


def test_what_is_infinite_is_said_by_its_parameters_not_as_a_number():
    matrix = np.random.default_rng(5).normal(size=(20, 3))
    matrix[:, 1] = -2 * matrix[:, 0]
    found = practical(matrix, ["m1", "m2", "k12"], equal(1.0, 20, 3))
    assert Thresholds().reasons(found) == ("these data do not determine m1, m2",)
    assert Thresholds(np.inf, np.inf, np.inf).reasons(found) == () and found.rank == 2


def test_a_value_that_is_no_number_excludes():
    found = replace(practical(np.eye(3), ["a", "b", "c"], equal(1.0, 3, 3)), collinearity=np.nan)
    (reason,) = Thresholds().reasons(found)
    assert reason.endswith("(collinearity index nan exceeds 20)")


def test_errors_of_results_are_those_of_the_covariance_and_infinite_across_what_is_not_determined():
    matrix, slopes = (
        np.random.default_rng(6).normal(size=(30, 4)),
        np.random.default_rng(7).normal(size=(5, 4)),
    )
    expected = np.sqrt(np.diag(slopes @ covariance(matrix, equal(3.0, 30, 4)) @ slopes.T))
    np.testing.assert_allclose(
        standard_errors(slopes, matrix, equal(3.0, 30, 4), 4), expected, rtol=1e-9
    )
    matrix[:, 3] = matrix[:, 2]  # only the sum of the last two is determined
    both, one = standard_errors(
        np.array([[0.0, 0.0, 1.0, 1.0], [0.0, 0.0, 1.0, 0.0]]), matrix, equal(3.0, 30, 4), 3
    )
    assert one == np.inf
    alone = np.sqrt(covariance(matrix[:, :3], equal(3.0, 30, 4))[2, 2])  # one column for the sum
    assert both == pytest.approx(alone, rel=1e-9)
    assert np.isinf(standard_errors(slopes, np.zeros((30, 4)), equal(3.0, 30, 4), 4)).all()


def test_standard_errors_of_a_fine_curve_of_many_lines_take_little_memory():
    draw = np.random.default_rng(3)
    matrix, slopes = draw.normal(size=(4000, 4)), draw.normal(size=(8000, 4))
    noise = equal(3.0, 4000, 4)
    tracemalloc.start()
    found = standard_errors(slopes, matrix, noise, 4)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 20e6  # the product of both would have 256 MB
    assert np.allclose(found[:50], standard_errors(slopes[:50], matrix, noise, 4), rtol=1e-12)
