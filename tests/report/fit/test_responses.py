"""Pages of fits with several responses: each one drawn, with its residuals and how much fits."""

import re
from dataclasses import replace

import numpy as np
import pytest

from disting.fit.judge.explanation import Miss
from disting.fit.judge.modes import physical
from disting.fit.results.selection import fit_percent
from disting.fit.search.cost import Cost
from disting.fit.search.joint import FurtherResponse, JointCost
from disting.fit.search.setup import Setup
from disting.fit.select import select
from disting.measurement import FrequencyResponse
from disting.report.fit.residuals import misfits, misses_of, residuals
from disting.report.fit.responses import in_response, responses, with_all_sensors
from disting.report.fit.selection_page import fit_page
from disting.report.fit.words import fit_in_words, fits_of
from tests.report.fit.conftest import DRIVE, VALUES

pytestmark = pytest.mark.full

OMEGA = 2 * np.pi * np.geomspace(10.0, 150.0, 40)
SETUPS = (Setup(), Setup("2"), Setup(locked=("2",)), Setup("2", inertias=(("1", 0.01),)))


def data(setup, seed, noise):
    """What the drive shows under a setup, with relative noise."""
    blank = FrequencyResponse(OMEGA, np.ones(len(OMEGA)))
    plant = JointCost((Cost(blank),), (setup,)).plant(DRIVE.structure, 1)
    exact = plant.response(np.array([VALUES[n] for n in DRIVE.parameters]))
    error = np.random.default_rng(seed).normal(size=(2, len(OMEGA)))
    return FrequencyResponse(OMEGA, exact * (1 + noise * (error[0] + 1j * error[1])))


@pytest.fixture(scope="module")
def joint():
    further = [
        FurtherResponse(data(setup, 2 * k, 0.01), setup, data(setup, 2 * k + 1, 0.03))
        for k, setup in enumerate(SETUPS[1:], 1)
    ]
    train, test = data(SETUPS[0], 10, 0.01), data(SETUPS[0], 11, 0.03)
    friction = replace(DRIVE, ground_dampers=(1, 2))
    return select(train, [DRIVE, friction], test=test, further=further), train, test


def test_each_response_has_its_data(joint):
    found = responses(*joint)
    assert [one.setup for one in found] == list(SETUPS)
    assert found[0].train is joint[1] and found[0].test is joint[2]
    assert not np.array_equal(found[2].train.G, found[2].test.G)
    (alone,) = responses(joint[0], joint[1], None)[:1]
    assert alone.test is None


def test_residuals_of_each_response_are_its_own(joint):
    selection = joint[0]
    for one in responses(*joint):
        train, test = misfits(selection, one.train, one.test, one.at)
        assert np.median(np.abs(train.amplitude)) < 0.02
        # judged by what training and test differ by, of this response
        lines = selection.explanation.scatter.rho[40 * one.at : 40 * (one.at + 1)]
        np.testing.assert_array_equal(test.series.scatter.rho, lines)
        assert train.outside < 0.15


def test_a_range_that_one_response_misses_is_not_marked_in_another(joint):
    selection = joint[0]
    here = Miss(20.0, 30.0, 0.5, 0.1, 0.9, response="sensor 2")
    told = replace(selection.explanation, misses=(here,))
    wrong = replace(selection, explanation=told)
    assert [misses_of(wrong, at) for at in range(3)] == [[], [here], []]


def test_the_page_shows_every_response(joint):
    selection, train, test = joint
    results = physical(selection.described, selection.task)
    further = residuals(selection, selection.task.cost.parts[1].measured, None, 1)
    assert further.name == "residuals-2" and "sensor 2" in further.title
    figures = [further] * 9  # two of each response, one beside them
    page = fit_page(selection, results, figures, train, test)
    assert page.count('<figure class="panel">') == 9
    titles = re.findall(r'<h3 class="response" id="response-\d">(.*?)</h3>', page)
    assert titles == [
        "1: the first response",
        "2: sensor 2",
        "3: mass 2 locked",
        "4: sensor 2, inertia 0.01 at mass 1",
    ]
    for at, part in enumerate(selection.task.cost.parts):
        size = fit_percent(selection.described, selection.task, part.measured, at)
        assert size > 90 and page.count(f"{size:.4g} %") >= 2  # below its title, in the set
    for m in selection.members:
        assert page.count(f'aria-label="Responses that {m.name} reproduces"') == 1


def test_fits_are_named_by_their_responses(joint):
    selection, train, test = joint
    assert [name for name, _ in fits_of(selection, selection.described)] == [s.text for s in SETUPS]
    said = fit_in_words(selection, train, test, 0)
    assert "of the training data of the first response" in said


def test_sensors_are_drawn_where_they_are_read(joint):
    selection = joint[0]
    both = {layer.name for layer in with_all_sensors(DRIVE, selection).layers}
    assert {"sensor", "sensor y2"} <= both and not any(name.startswith("lock") for name in both)
    assert with_all_sensors(DRIVE, selection).title.endswith("y2: sensor at mass 2.")
    drawn = [in_response(DRIVE, selection, one) for one in responses(*joint)]
    names = [{layer.name for layer in scene.layers} for scene in drawn]
    assert [("sensor" in own, "sensor y2" in own) for own in names] == [
        (True, False),
        (False, True),
        (True, False),
        (False, True),
    ]
    assert "lock 2" in names[2] and "inertia 1" in names[3]
    assert drawn[2].title.endswith("measured here: mass 2 locked.")


def test_one_response_is_shown_as_ever(selection, train, test):
    assert fits_of(selection, selection.described) == []
    assert len(responses(selection, train, test)) == 1
    assert with_all_sensors(DRIVE, selection).title.count("sensor") == 0
