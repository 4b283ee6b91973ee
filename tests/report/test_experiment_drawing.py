"""Drawings of experiments: over any chain, nothing outside, nothing covered, all of it on pages."""

import re
from dataclasses import replace
from itertools import product

import pytest

from disting.catalogs import catalog
from disting.catalogs.next_files import next_catalog
from disting.experiments.experiment import Experiment
from disting.experiments.menu import Item
from disting.model.chain import Chain
from disting.model.family import Family
from disting.model.kinds import FORCE, KINDS, LOCK, SENSOR
from disting.report import model_page
from disting.report.drawing import draw
from disting.report.experiment_drawing import additions, draw_item, sketch, state
from disting.report.next_steps import advice, found_for, sketches_for_pairs
from disting.report.page import next_page
from disting.report.scene import Text, extent
from tests.report.shapes import meet

CHAINS = [
    *(c for n, damped in product(range(1, 5), (False, True)) for c in Family(n, damped)),
    Chain(3, damped=True, ground_dampers=(1, 2, 3), lag=True),
]
DAMPED = catalog(3, damped=True)


def items(chain):
    """Of every kind, those that are on a menu only where their cost is named too."""
    kinds = [k for k in KINDS if chain.n_masses > 1 or not k.holds]
    return [Item(k, at) for k in kinds for at in range(1, chain.n_masses + 1)]


def with_item(chain, item):
    """The drawing of a chain that a page holds, with what an item adds."""
    below = draw(chain, item.kind == SENSOR)
    kept = below.layers[:-1] if item.kind == FORCE else below.layers
    return replace(below, layers=(*kept, draw_item(chain, item)))


@pytest.mark.full
def test_nothing_leaves_the_picture_and_no_letters_overlap():
    for chain in CHAINS:
        for item in items(chain):
            scene = with_item(chain, item)
            for shape in scene.shapes:
                left, top, right, bottom = extent(shape)
                assert 0 <= left <= right <= scene.width, (chain, item, shape)
                assert 0 <= top <= bottom <= scene.height, (chain, item, shape)
            texts = [extent(s) for s in scene.shapes if isinstance(s, Text)]
            for k, (left, top, right, bottom) in enumerate(texts):
                for a, b, c, d in texts[k + 1 :]:
                    apart = right <= a or c <= left or bottom <= b or d <= top
                    assert apart, (chain, item, texts)


def test_every_experiment_is_drawn_differently_and_said():
    for chain in CHAINS:
        found = [sketch(1, chain, (item,)) for item in items(chain)]
        assert len({one.label for one in found}) == len(found)
        assert len({draw_item(chain, item) for item in items(chain)}) == len(found)
        for item, one in zip(items(chain), found, strict=True):
            scene = with_item(chain, item)
            assert item.text in one.label and one.size == (scene.width, scene.height)
            assert one.parts[1] == f"more-{draw_item(chain, item).name}"


def test_parts_of_one_name_are_the_same_for_all_chains_of_a_size():
    for n in range(1, 5):
        parts = {}
        for chain in (c for damped in (False, True) for c in Family(n, damped)):
            for item in items(chain):
                layer = draw_item(chain, item)
                assert parts.setdefault(layer.name, layer) == layer


@pytest.mark.full
def test_what_an_experiment_adds_covers_no_name_and_no_sign():
    for chain in CHAINS:
        for item in items(chain):
            if item.kind == FORCE:
                continue  # stands in the place of the first one
            shapes = draw(chain, item.kind == SENSOR).shapes
            signs = [s for s in shapes if isinstance(s, Text) and s.text[0] != "m"]
            for shape in draw_item(chain, item).shapes:
                assert not any(meet(sign, shape) for sign in signs), (chain, item, shape)


def test_what_is_added_to_one_mass_stands_on_one_another():
    changes = Experiment(inertias={1: 1, 2: 1}, springs={1: 2}, brakes={1: 3}, locked=2).changes
    for chain in (Chain(2), Chain(3, ground_dampers=(1, 2, 3), lag=True)):
        scene = state(chain, {"y": (2, 0)}, changes)
        blocks = [s for s in scene.shapes if isinstance(s, Text) and s.text[0] == "+"]
        assert sorted(s.text for s in blocks) == ["+J", "+J", "+c", "+k"]
        for k, shape in enumerate(blocks):
            left, top, right, bottom = extent(shape)
            assert 0 <= left <= right <= scene.width and 0 <= top <= bottom <= scene.height
            assert not any(meet(shape, other) for other in blocks[k + 1 :])


def test_two_things_at_once_are_one_drawing():
    found = sketch(5, Chain(3, damped=False), (Item(FORCE, 3), Item(LOCK, 2)))
    assert found.parts == ("rest-5", "more-force-3", "more-lock-2")
    assert found.label == "A5: the force moved to mass 3 and mass 2 locked"
    assert sketch(5, Chain(3, damped=False), (Item(LOCK, 2),)).parts == ("chain-5", "more-lock-2")


def test_what_a_page_shows_it_holds_once():
    pages = [model_page(DAMPED, 2), next_page(DAMPED, next_catalog(3, damped=True))]
    for text in pages:
        ids = re.findall(r'id="([^"]+)"', text)
        shown = re.findall(r'<use href="#([^"]+)"', text)
        assert set(shown) <= set(ids) and len(ids) == len(set(ids))
        assert any(name.startswith("rest-") for name in shown)


def test_every_experiment_that_is_worth_it_is_drawn_with_a_text_alternative():
    told = advice(found_for(DAMPED), 2)
    text = model_page(DAMPED, 2)
    for item in told.items:
        assert f'aria-label="A2: {item.text}"' in text
    assert text.count('class="chain small"') == len(told.items) > 5
    silent = [c for _, _, cells in told.rows for c in cells if c.text.startswith("tells nothing")]
    assert silent and not any(cell.sketch for cell in silent)


def test_a_pair_shows_the_sets_that_are_enough():
    found = sketches_for_pairs(next_catalog(3, damped=True))
    assert found.keys() == {"1-11", "2-5", "9-10"}
    labels = [one.label for one in found["1-11"]]
    assert labels[:2] == ["A1: a sensor at mass 2", "A1: a sensor at mass 3"]
    assert any(label.startswith("A11: ") for label in labels)
    assert sketches_for_pairs(None) == {}


def test_definitions_are_in_one_order():
    used = [(Chain(2, damped=False), Item(LOCK, 2)), (Chain(2, damped=False), Item(FORCE, 2))]
    assert additions(used) == additions(used[::-1]) == additions(used * 2)
