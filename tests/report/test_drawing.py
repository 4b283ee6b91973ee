"""Drawings of chains: nothing missing, nothing twice, nothing outside, no two alike."""

import io
from dataclasses import replace
from itertools import product
from xml.etree import ElementTree

import pytest
from hypothesis import given, settings, strategies as st
from PIL import Image

from disting.model.chain import Chain, Sensor
from disting.model.family import Family
from disting.report import chain_png, chain_svg, describe
from disting.report.drawing import NOTE, Layout, draw
from disting.report.page_drawing import ground_dampers
from disting.report.scene import Circle, Ink, Path, Rect, Text, extent
from tests.report.shapes import meet

few = settings(max_examples=40, deadline=None)  # of 50 and more layers each
FAMILIES = [Family(n, damped) for n, damped in product(range(1, 6), (False, True))]


@st.composite
def chains(pick: st.DrawFn) -> Chain:
    chain = pick(st.sampled_from([c for family in FAMILIES for c in family]))
    dampers = pick(st.sets(st.integers(1, chain.n_masses)))
    lag, dead_time, sensor = pick(st.booleans()), pick(st.booleans()), pick(st.sampled_from(Sensor))
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
