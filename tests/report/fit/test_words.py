"""Numbers, units and names as a reader expects them."""

from math import inf, nan

import numpy as np
import pytest

from disting.measurement import FrequencyResponse
from disting.model.chain import Chain
from disting.report.fit.style import spread
from disting.report.fit.words import name, percent, readable, unit_of, with_error


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (0.0, "0"),
        (1.0, "1"),
        (0.001, "0.001"),
        (0.00099, "9.9·10⁻⁴"),
        (9999.0, "10000"),
        (10000.0, "10⁴"),
        (-2.5e-7, "-2.5·10⁻⁷"),
        (99.96, "100"),
        (inf, "∞"),
        (nan, "–"),
    ],
)
def test_numbers(value: float, said: str) -> None:
    assert readable(value) == said


def test_columns_keep_their_digits() -> None:
    assert [readable(v, 4, all_digits=True) for v in (0.63, 0.6299, 3.0)] == [
        "0.6300",
        "0.6299",
        "3.000",
    ]


@pytest.mark.parametrize(
    ("value", "error", "said"),
    [
        (123456.0, 789.0, "(1.2346 ± 0.0079)·10⁵"),
        (1.0, 0.2, "1.00 ± 0.20"),
        (5.0, 100.0, "5 (not determined)"),
        (5.0, nan, "5 (not determined)"),
        (0.017, 1e-15, "0.017"),
        (0.0, 0.0, "0"),
    ],
)
def test_values_with_errors(value: float, error: float, said: str) -> None:
    assert with_error(value, error) == said


def test_shares() -> None:
    assert [percent(v) for v in (0.0, 1e-12, 0.0101, 12.0)] == ["0 %", "< 10⁻⁵ %", "1 %", "1200 %"]


def test_names_tell_all_that_differs() -> None:
    chains = [
        Chain(3, g, a, b, c, d, damped=False)
        for g, a, b, c, d in [(0, 0, 1, 0, 1), (0, 0, 1, 0, 3), (1, 1, 2, 1, 3), (2, 2, 3, 1, 3)]
    ]
    assert [name(c) for c in chains] == [
        "3 masses",
        "3 masses, force 1, sensor 3",
        "3 masses, gap 1–2, force 1–2, sensor 1–3",
        "3 masses, gap 2–3, force 2–3, sensor 1–3",
    ]


@pytest.mark.parametrize(
    ("sensor", "given", "shown", "units"),
    [
        ("position", "N", "m", ["kg", "N/m", "N s/m"]),
        ("acceleration", "A", "rad/s^2", ["A/(rad/s²)", "A/rad", "A/(rad/s)"]),
        (
            "velocity",
            "",
            "rad/s",
            ["input per acceleration", "input per position", "input per velocity"],
        ),
        ("velocity", "V", "counts", ["input per acceleration", "input per position", "V/counts"]),
    ],
)
def test_units_follow_from_those_of_the_data(
    sensor: str, given: str, shown: str, units: list[str]
) -> None:
    signals = {"input": ("", given), "output": ("", shown)}
    measured = FrequencyResponse(
        np.arange(1.0, 9.0), np.ones(8, complex), quantity=sensor, **signals
    )  # type: ignore[arg-type]
    assert [unit_of(kind, measured) for kind in "mkd"] == units
    assert unit_of("T", measured) == "s"


@pytest.mark.parametrize(
    "places", [[], [0.3], [0.1, 0.1, 0.1, 0.9], [0.0, 0.01, 0.5, 0.52, 0.53, 1.0]]
)
def test_labels_keep_their_distance(places: list[float]) -> None:
    moved = spread(places, 0.08)
    assert np.all(np.diff(moved) >= 0.08 - 1e-12)
    assert np.all(np.abs(moved - places) <= 0.08 * max(len(places) - 1, 0) + 1e-12)
