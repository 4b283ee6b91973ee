"""Intervals of fitted networks, and the values of those that cannot be told from them."""

import json

import numpy as np
import pytest

from disting.fit.networks import fit_networks
from disting.measurement import FrequencyResponse, write_csv
from disting.network import network_of
from disting.report.fit.network_words import interval_words
from disting.verdict.model_equivalents import model_equivalents
from tests.cli.process import called

OMEGA = np.logspace(0, 4, 40)
VOIGT = "R0-p(R1,C1)-p(R2,C2)"
LADDER = "R0-p(C1,R1-p(R2,C2))"
CLEAN = 1 + 2 / (1 + 0.02j * OMEGA)  # R0 = 1, R1 = 2, C1 = 0.01


def measured(clean, seed, noise=1e-2):
    draw = np.random.default_rng(seed)
    noisy = clean * (1 + noise * draw.normal(size=(len(OMEGA), 2)) @ [1, 1j])
    return FrequencyResponse(OMEGA, noisy, quantity="position", is_impedance=True)


@pytest.mark.slow
def test_intervals_hold_the_truth_as_often_as_they_say():
    """60 fits of 3 values: 0.95 * 180 = 171 +- 3 hits if they are independent."""
    truth = {"R0": 1.0, "R1": 2.0, "C1": 0.01}
    hits = 0
    for seed in range(60):
        (fit,) = fit_networks(measured(CLEAN, seed), [network_of("R0-p(R1,C1)")]).fits
        hits += sum(low <= truth[n] <= high for n, (low, high) in fit.intervals.items())
    assert 160 <= hits <= 178


@pytest.mark.full
def test_an_element_that_the_data_do_not_show_has_an_end_on_one_side():
    """A second capacitor where the data show one: small enough, it may be none."""
    network = network_of("p(R0,C0)-p(R1,C1)")
    (fit,) = fit_networks(measured(CLEAN, 1), [network]).fits
    small = min(("C0", "C1"), key=fit.values.get)
    low, high = fit.intervals[small]
    assert low == 0 and high < 1e-4
    assert interval_words((low, high)).startswith("below ")
    assert all(0 < a < b < np.inf for n, (a, b) in fit.intervals.items() if n != small)


@pytest.mark.full
def test_an_element_that_has_vanished_comes_back_for_the_intervals():
    """W1 goes to 1e-30 in the fit; it is bounded by what the data would show, and so are the
    others with it: the true values, W1 = 0.01 among them, lie inside.
    """
    truth = {"R0": 1.0, "R1": 2.0, "C1": 0.01, "W1": 0.01}
    s = 1j * OMEGA
    clean = 1 + 1 / (0.01 * s + 1 / (2 + 0.01 / np.sqrt(s)))
    seen = 0
    for seed in range(12):
        (fit,) = fit_networks(measured(clean, seed), [network_of("R0-p(R1-W1,C1)")]).fits
        low, high = fit.intervals["W1"]
        assert low < 0.5 and high < 0.5, (seed, fit.intervals)
        if fit.values["W1"] < 1e-6:
            seen += 1
            assert low == 0
        for name, value in truth.items():
            low, high = fit.intervals[name]
            assert low * 0.98 <= value <= high * 1.02, (seed, name, fit.intervals)
    assert seen >= 2


@pytest.mark.full
def test_what_only_a_sum_determines_is_known_up_to_the_sum():
    """R0 - R2 - C1: each resistance may be anything up to the sum 3."""
    clean = 3 + 1 / (0.01j * OMEGA)
    (fit,) = fit_networks(measured(clean, 2), [network_of("R0-R2-C1")]).fits
    for name in ("R0", "R2"):
        low, high = fit.intervals[name]
        assert low == 0 and high == pytest.approx(3, rel=0.02)
    low, high = fit.intervals["C1"]
    assert low < 0.01 < high < 1.02 * low


@pytest.mark.full
def test_twins_have_the_values_of_the_explicit_map():
    two = CLEAN + 0.5 / (1 + 0.001j * OMEGA)
    selection = fit_networks(measured(two, 3, 1e-3), list(map(network_of, (VOIGT, LADDER))))
    (fit,) = selection.left
    (twin,) = fit.twins
    assert twin.network.name == LADDER and twin.free_choices == 0
    texts = {name: repr(value) for name, value in fit.values.items()}
    (found,) = model_equivalents(network_of(VOIGT), [network_of(LADDER)], texts)
    exact = [{n: float(x) for n, x in e.values.items()} for e in found.values.equivalents]
    assert any(twin.values == pytest.approx(values, rel=1e-6) for values in exact)
    assert twin.intervals.keys() == twin.values.keys()
    # a value that both share has one interval
    assert twin.intervals["R0"] == pytest.approx(fit.intervals["R0"], rel=1e-5)


@pytest.mark.full
def test_a_twin_with_a_free_choice_is_told_as_such(tmp_path):
    write_csv(measured(CLEAN, 4), tmp_path / "cell.csv")
    done = called(
        "fit", tmp_path / "cell.csv", "--models", "R0-p(R1,C1)", "R0-p(R1,R2-C1)", "R1-C1",
        "--json", tmp_path / "fit.json",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "R0-p(R1,R2-C1), the same responses, one of infinitely many sets" in done.stdout
    plain = json.loads((tmp_path / "fit.json").read_text(encoding="utf-8"))
    best = plain["fits"][0]
    assert best["twins"][0]["free_choices"] == 1 and len(best["intervals"]) == 3
    assert plain["fits"][-1]["intervals"] == {}


@pytest.mark.full
def test_data_may_stand_behind_the_networks(tmp_path):
    """--models takes all words up to the next option; a file of data is none of them."""
    write_csv(measured(CLEAN, 5), tmp_path / "cell.csv")
    before = called("fit", tmp_path / "cell.csv", "--models", "R0-p(R1,C1)", "R1-C1")
    behind = called("fit", "--models", "R0-p(R1,C1)", "R1-C1", tmp_path / "cell.csv")
    assert before.returncode == behind.returncode == 0
    assert before.stdout == behind.stdout
    wrong = called("fit", tmp_path / "cell.csv", "--models", "R0-p(R1,C1)", "R0-p(R1)", "R1-C1")
    assert wrong.returncode == 2 and "'R0-p(R1)'" in wrong.stderr
