"""Drawings of chains: nothing missing, nothing twice, nothing outside, no two alike.

Drawings of experiments: over any chain, nothing outside, nothing covered, all of it on pages.
"""

import io
import re
from dataclasses import replace
from itertools import product
from xml.etree import ElementTree

import pytest
from hypothesis import given, settings, strategies as st
from PIL import Image

from disting.catalogs import catalog
from disting.catalogs.next_files import next_catalog
from disting.experiments.experiment import Experiment
from disting.experiments.menu import Item
from disting.model.chain import Chain, Quantity
from disting.model.family import Family
from disting.model.kinds import FORCE, KINDS, LOCK, SENSOR
from disting.report import chain_png, chain_svg, describe, model_page
from disting.report.drawing import (
    NOTE,
    Layout,
    additions,
    draw,
    draw_item,
    ground_dampers,
    sketch,
    state,
)
from disting.report.next_steps import advice, found_for, sketches_for_pairs
from disting.report.page import next_page
from disting.report.scene import Circle, Ink, Path, Rect, Text, extent
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


@pytest.mark.full
def test_every_experiment_is_drawn_differently_and_said():
    for chain in CHAINS:
        found = [sketch(1, chain, (item,)) for item in items(chain)]
        assert len({one.label for one in found}) == len(found)
        assert len({draw_item(chain, item) for item in items(chain)}) == len(found)
        for item, one in zip(items(chain), found, strict=True):
            scene = with_item(chain, item)
            assert item.text in one.label and one.size == (scene.width, scene.height)
            assert one.parts[1] == f"more-{draw_item(chain, item).name}"


@pytest.mark.full
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


@pytest.mark.full
def test_what_a_page_shows_it_holds_once():
    pages = [model_page(DAMPED, 2), next_page(DAMPED, next_catalog(3, damped=True))]
    for text in pages:
        ids = re.findall(r'id="([^"]+)"', text)
        shown = re.findall(r'<use href="#([^"]+)"', text)
        assert set(shown) <= set(ids) and len(ids) == len(set(ids))
        assert any(name.startswith("rest-") for name in shown)


@pytest.mark.full
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


few = settings(max_examples=40, deadline=None)  # of 50 and more layers each
FAMILIES = [Family(n, damped) for n, damped in product(range(1, 6), (False, True))]


@st.composite
def chains(pick: st.DrawFn) -> Chain:
    chain = pick(st.sampled_from([c for family in FAMILIES for c in family]))
    dampers = pick(st.sets(st.integers(1, chain.n_masses)))
    lag, dead_time, sensor = (
        pick(st.booleans()),
        pick(st.booleans()),
        pick(st.sampled_from(Quantity)),
    )
    return Chain(*chain.indices, sensor, chain.damped, tuple(dampers), lag, dead_time)


@few
@given(chains())
def test_every_element_is_drawn_exactly_once(chain: Chain) -> None:
    names = [layer.name for layer in draw(chain).layers if layer.name != "ground"]
    assert sorted(names) == sorted([*chain.parameters, "gap", "force", "sensor"])
    assert all(layer.shapes for layer in draw(chain).layers)


@few
@given(chains())
def test_nothing_leaves_the_picture(chain: Chain) -> None:
    scene = draw(chain)
    for shape in scene.shapes:
        left, top, right, bottom = extent(shape)
        assert 0 <= left <= right <= scene.width and 0 <= top <= bottom <= scene.height, shape


@pytest.mark.full
@few
@given(chains())
def test_svg_parses_and_png_decodes(chain: Chain) -> None:
    root = ElementTree.fromstring(chain_svg(chain))
    assert root.findtext("{*}title") == describe(chain)
    image = Image.open(io.BytesIO(chain_png(chain, scale=1)))
    assert image.size == (round(draw(chain).width), round(draw(chain).height))


@pytest.mark.parametrize(
    "family", FAMILIES, ids=lambda f: f"{f.n_masses}-{'damped' if f.damped else 'undamped'}"
)
def test_distinct_chains_have_distinct_drawings_and_descriptions(family: Family) -> None:
    assert (
        len({draw(chain).layers for chain in family})
        == len({describe(chain) for chain in family})
        == len(family)
    )


@few
@given(chains())
def test_letters_do_not_overlap(chain: Chain) -> None:
    boxes = [extent(shape) for shape in draw(chain).shapes if isinstance(shape, Text)]
    for i, (left, top, right, bottom) in enumerate(boxes):
        for a, b, c, d in boxes[i + 1 :]:
            assert right <= a or c <= left or bottom <= b or d <= top


@few
@given(chains())
def test_every_part_carries_its_name_once(chain: Chain) -> None:
    named = {
        layer.name: [s.text for s in layer.shapes if isinstance(s, Text)]
        for layer in draw(chain).layers
        if layer.name in {e.parameter for e in chain.structure.elements}
    }
    assert named == {e.parameter: [e.parameter] for e in chain.structure.elements}


@pytest.mark.full
@few
@given(chains())
def test_no_line_passes_a_name(chain: Chain) -> None:
    shapes = list(draw(chain).shapes)
    for text in (s for s in shapes if isinstance(s, Text) and s.fill in {Ink.LABEL, Ink.MUTED}):
        assert not [s for s in shapes if s is not text and meet(text, s)], text


@few
@given(chains())
def test_upright_lines_keep_clear_of_the_signs(chain: Chain) -> None:
    """The posts, the dampers to the ground and what they are broken by on a page of a family."""
    signs = [s for s in draw(chain).shapes if isinstance(s, Rect | Circle) and s.fill is Ink.PAPER]
    dampers = [s for part in ground_dampers(chain.n_masses) for s in part.layer.shapes]
    moved = NOTE * (chain.lag or chain.dead_time)
    for sign in signs:
        below = replace(sign, y=sign.y - moved)
        assert not any(meet(below, shape) for shape in dampers)


def test_a_force_between_masses_has_two_arrows_and_one_against_ground_has_one() -> None:
    assert _arrow_tips(Chain(3, 1, 1, 3, 1, 2, damped=False)) == [("left", 1), ("right", 3)]
    assert _arrow_tips(Chain(3, 0, 0, 2, 0, 1, damped=False)) == [("right", 2)]


def test_the_sensor_marks_mass_and_reference() -> None:
    relative = _dots(Chain(3, 1, 1, 3, 1, 2, damped=False))
    assert [(dot.x, dot.fill) for dot in relative] == [
        (_middle(Chain(3, damped=False), 1), Ink.PAPER),
        (_middle(Chain(3, damped=False), 2), Ink.SENSOR),
    ]
    assert [dot.fill for dot in _dots(Chain(3, 0, 0, 1, 0, 3, damped=False))] == [Ink.SENSOR]


def test_there_is_no_spring_in_the_gap() -> None:
    assert not {"k12", "d12"} & {
        layer.name for layer in draw(Chain(3, 1, 1, 2, 1, 2, damped=True)).layers
    }


def test_the_wall_is_as_high_as_what_is_fixed_to_it() -> None:
    walls = [
        _wall(chain)
        for chain in (Chain(2, 1, 1, 2, 1, 2, damped=False), Chain(2, 0, 0, 1, 0, 1, damped=False))
    ]
    assert walls[0][0] > walls[1][0] and walls[0][1] < walls[1][1]


def _middle(chain: Chain, mass: int) -> float:
    return Layout(chain).middle(mass)


def _arrow_tips(chain: Chain) -> list[tuple[str, int]]:
    force = next(layer for layer in draw(chain).layers if layer.name == "force")
    heads = [s for s in force.shapes if isinstance(s, Path) and s.fill is Ink.FORCE]
    return [
        ("right" if head.points[0][0] > head.points[1][0] else "left", mass)
        for head in heads
        for mass in range(1, chain.n_masses + 1)
        if abs(head.points[0][0] - _middle(chain, mass)) <= 1
    ]


def _dots(chain: Chain) -> list[Circle]:
    sensor = next(layer for layer in draw(chain).layers if layer.name == "sensor")
    return [shape for shape in sensor.shapes if isinstance(shape, Circle)]


def _wall(chain: Chain) -> tuple[float, float]:
    ground = next(layer for layer in draw(chain).layers if layer.name == "ground")
    _, top, _, bottom = extent(ground.shapes[-1])
    return top, bottom
