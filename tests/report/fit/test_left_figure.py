"""The figure of the structures that are left: what is drawn is what was fitted, and its equivalents."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.path import Path

from disting.fit.results.loop import Controller, loop_gain
from disting.fit.results.reliance import position_of_load
from disting.fit.select import select
from disting.model.chain import Chain
from disting.report.fit.left_figure import ellipse, left_figure
from tests.fit.drives import response

pytestmark = pytest.mark.full

ROW = Chain(3, damped=True)
VALUES = {"m1": 1.0, "m2": 0.6, "m3": 0.4, "k12": 3e4, "k23": 2e4, "d12": 8.0, "d23": 3.0}
LAW = Controller(P=60.0)


@pytest.fixture(scope="module")
def left():
    train, test = (response(ROW, VALUES, noise=0.01, seed=s) for s in (1, 2))
    return train, select(train, [ROW], test=test, controller=LAW)


def test_every_structure_and_equivalent_is_named_in_the_files(left):
    train, found = left
    drawn = left_figure(found, train)
    assert drawn is not None and drawn.name == "structures"
    for part in (drawn.svg, drawn.png, drawn.pdf, drawn.narrow):
        assert len(part) > 10_000
    assert "3:1" in drawn.title


def test_one_structure_without_equivalents_needs_no_figure(left):
    train, found = left
    alone = replace(found.members[0], twins=())
    assert left_figure(replace(found, members=(alone,), controller=None), train) is None
    assert left_figure(replace(found, members=(), controller=None), train) is None


@pytest.mark.slow
def test_one_structure_with_a_controller_has_a_figure(left):
    train, found = left
    alone = replace(found.members[0], twins=())
    assert left_figure(replace(found, members=(alone,)), train) is not None


def test_the_load_of_a_row_is_its_last_mass():
    omega = np.array([3.0, 50.0])
    s2 = -(omega**2)
    p = np.array(list((VALUES | {"k12": 1e8, "k23": 1e8}).values()))
    rigid = position_of_load(ROW, p, omega)
    np.testing.assert_allclose(rigid, 1 / (2.0 * s2), rtol=1e-3)
    p = np.array(list(VALUES.values()))
    slow = np.array([1e-2])
    np.testing.assert_allclose(loop_gain(ROW, p, LAW, slow), 60 / (2.0 * 1e-2j), rtol=1e-6)


def test_an_ellipse_holds_95_percent_of_what_is_drawn():
    source, root = np.random.default_rng(5), complex(-3.0, 100.0)
    near = [root * np.exp(complex(0.02 * x, 0.01 * x + 0.005 * y))
            for x, y in source.normal(size=(4000, 2))]  # fmt: skip
    corners = ellipse(root, near[:2000])
    hertz = np.array([abs(r) / (2 * np.pi) for r in near[2000:]])
    damping = np.array([-100 * r.real / abs(r) for r in near[2000:]])
    inside = Path(corners.T).contains_points(np.stack([hertz, damping], axis=1))
    assert 0.93 < inside.mean() < 0.97
    assert ellipse(root, near[:3]).size == 0
