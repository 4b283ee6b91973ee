"""The command that gives the same fit as the page, and requests that are refused."""

import pytest

from disting.app.fitting import _chain_words, _command, _option_words, _ranges, fit
from disting.app.workers import Setting
from disting.errors import InputError

FIRST = {"file": "a.csv", "reading": {"quantity": "velocity"}}


@pytest.fixture
def project(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "data").mkdir()
    for name in ("a.csv", "b 2.csv"):
        (tmp_path / "data" / name).write_text("1,2\n")
    return tmp_path


def test_test_data_known_values_ranges_and_controller_are_options(project):
    request = {
        "measurements": [FIRST | {"sensor": "2"}],
        "test": "b 2.csv",
        "fix": {"Td": 3e-4, "m1": 0.02},
        "bound": {"k12": [0, 500.0]},
        "controller": "P=2,I=30",
    }
    assert _command(request, _option_words(request)) == (
        "disting fit data/a.csv --quantity velocity --test 'data/b 2.csv' --sensor 2"
        " --fix Td=0.0003 --fix m1=0.02 --bound k12=0..500.0 --controller P=2,I=30"
    )


def test_a_further_measurement_is_an_experiment_if_it_is_read_alike(project):
    other = {"file": "b 2.csv", "change": "lock=2"}
    request = {"measurements": [FIRST, other | {"reading": {"quantity": "velocity", "column": 4}}]}
    assert _command(request, []).endswith("--experiment 'data/b 2.csv:lock=2,column=4'")
    request = {"measurements": [FIRST, other | {"reading": {}}]}
    assert _command(request, []) == ""


def test_what_an_earlier_fit_left_is_named_in_place_of_masses(project):
    request = {"measurements": [FIRST], "masses": [1, 2], "left": 3}
    with pytest.raises(InputError, match="the project has no fit 3"):
        _chain_words(request)
    (project / "fits" / "3").mkdir(parents=True)
    (project / "fits" / "3" / "fit.json").touch()
    assert _chain_words(request) == ["--left", "fits/3/fit.json"]
    del request["left"]
    assert _chain_words(request) == ["--masses", "1,2"]


def test_a_range_that_ends_before_it_begins_is_refused():
    assert _ranges({"bound": {"k12": [0, 5]}}) == {"k12": (0, 5)}
    with pytest.raises(InputError, match="the range of k12 begins at 5 and ends at 1; swap them"):
        _ranges({"bound": {"k12": [5, 1]}})


def test_models_are_fitted_without_test_data(project):
    request = {"measurements": [FIRST], "masses": [1], "models": ["R1"], "test": "b 2.csv"}
    with pytest.raises(InputError, match="without test data"):
        fit(request, lambda *_: None, Setting(project))
