"""Drawings of networks: all of it, once, within the picture, readable; a circuit drawn is the
circuit that was written.
"""

import io
from fractions import Fraction
from itertools import pairwise
from pathlib import Path as File
from xml.etree import ElementTree

import pytest
from hypothesis import HealthCheck, given, settings, strategies as st
from PIL import Image

from disting import Network, network_of
from disting.model.chain import Chain
from disting.network.families import FAMILIES
from disting.report import network_png, network_svg
from disting.report.network_drawing import (
    RADIUS,
    Part,
    describe_network,
    draw_network,
    scene_of,
    series_parallel,
)
from disting.report.scene import Ink, Path, Text, extent
from tests.cli.process import called
from tests.network.drawn import built, descriptions
from tests.oracles.plain_network import response

# a family is listed when one of its networks is drawn first, which a busy machine does slowly
few = settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow])
SHOWN = ("machines-2-damped", "machines-3-damped", "trees-4", "circuits-5", "cells-4", "compartments-3")  # fmt: skip
HARD = (
    "1=2=3=4=1, 1=3, 2=4; F1; S3", "1=2*i, 2~3, 3=#, 3-1; F1; S1 S3", "1=2, 3=4, 4~#; F1:3; S2:4",
    "R1 1 2; L1 1 3; C1 2 3; R2 2 0; C2 3 0; W1 2 0; port 1 0", "1<>2, 1<>3, 1<>4, 4>0; in 1, 2; out 1",
    "1~2, 2~3, 3~4, 4~5, 5~6, 6~7, 3~8, 8~9, 2~10; F1; S7",
)  # fmt: skip


@st.composite
def networks(pick: st.DrawFn) -> Network:
    texts = [n.name for n in FAMILIES[pick(st.sampled_from(SHOWN))].networks]
    return network_of(pick(st.sampled_from([*HARD, pick(st.sampled_from(texts))])))


@pytest.mark.full
@few
@given(networks())
def test_every_element_is_drawn_and_named_once(drawn: Network) -> None:
    layers = [layer.name for layer in draw_network(drawn).layers]
    values = [e.value for e in drawn.elements if e.kind.ends == 2]
    assert sorted(name for name in layers if name in values) == sorted(values)
    texts = [s.text.split(" ")[0] for s in draw_network(drawn).shapes if isinstance(s, Text)]
    for value in (e.value for e in drawn.elements if e.value):
        assert texts.count(value) == 1, value


@pytest.mark.full
@few
@given(networks())
def test_all_lies_in_the_picture_and_no_letters_on_others(drawn: Network) -> None:
    scene = draw_network(drawn)
    for shape in scene.shapes:
        left, top, right, bottom = extent(shape)
        assert 0 <= left <= right <= scene.width and 0 <= top <= bottom <= scene.height, shape
    boxes = [extent(shape) for shape in scene.shapes if isinstance(shape, Text)]
    for i, (left, top, right, bottom) in enumerate(boxes):
        for a, b, c, d in boxes[i + 1 :]:
            assert right <= a or c <= left or bottom <= b or d <= top


@pytest.mark.full
@few
@given(networks())
def test_no_joint_passes_a_node_between_its_ends(drawn: Network) -> None:
    scene = draw_network(drawn)
    nodes = {
        int(layer.name[5:]): extent(layer.shapes[0])
        for layer in scene.layers
        if layer.name.startswith("node-")
    }
    reach = RADIUS[drawn.sort] + 4
    for e in drawn.elements:
        lines = [s for la in scene.layers if la.name == e.value for s in la.shapes if isinstance(s, Path)]  # fmt: skip
        pieces = [piece for path in lines for piece in pairwise(path.points)]
        for i, (left, top, right, bottom) in nodes.items():
            middle = ((left + right) / 2, (top + bottom) / 2)
            if i not in e.nodes:
                assert all(_distance(middle, piece) > reach for piece in pieces), (e.value, i)


def _distance(p: tuple[float, float], piece) -> float:  # type: ignore[no-untyped-def]
    (x0, y0), (x1, y1) = piece
    dx, dy = x1 - x0, y1 - y0
    t = ((p[0] - x0) * dx + (p[1] - y0) * dy) / ((dx * dx + dy * dy) or 1)
    t = min(1, max(0, t))
    return float(((x0 + t * dx - p[0]) ** 2 + (y0 + t * dy - p[1]) ** 2) ** 0.5)


@pytest.mark.full
@few
@given(descriptions().map(built).filter(lambda made: isinstance(made, Network)))
def test_any_network_is_drawn_whole(drawn: Network) -> None:
    scene = draw_network(drawn)
    named = {layer.name for layer in scene.layers if layer.shapes}
    assert {e.value for e in drawn.elements if e.kind.ends == 2} <= named
    assert all(extent(s)[0] >= 0 and extent(s)[3] <= scene.height for s in scene.shapes)
    assert ElementTree.fromstring(network_svg(drawn)) is not None


def impedance(part: Part, values: dict[str, Fraction], s: Fraction) -> Fraction:
    """Of parts in series and parallel, from those of the elements."""
    if part.element:
        p = values[part.element.value]
        return {"R": p, "L": p * s, "C": 1 / (p * s)}[part.element.letter]
    inner = [impedance(p, values, s) for p in part.parts]
    return sum(inner, Fraction(0)) if part.form == "series" else 1 / sum(1 / z for z in inner)


def test_a_circuit_that_is_drawn_has_the_impedance_of_what_was_written() -> None:
    """Against the nodal equations, by exact numbers."""
    for drawn in FAMILIES["circuits-5"].networks[::7]:
        whole = series_parallel(drawn)
        bridge = ";" in drawn.name
        assert (whole is None) == bridge
        if whole:
            values = {p: Fraction(i + 2, i + 1) for i, p in enumerate(drawn.parameters)}
            root = Fraction(3, 7)
            assert [[impedance(whole, values, root**2)]] == response(drawn, values, root)


def _shape(part: Part) -> object:
    return part.element.value if part.element else (part.form, *map(_shape, part.parts))


def test_parts_stand_as_they_are_written() -> None:
    found = series_parallel(network_of("p(R2,C2)-R0-p(C1,R1-p(R3,C3))-W1"))
    assert found is not None
    assert _shape(found) == (
        "series", ("parallel", "R2", "C2"), "R0",
        ("parallel", "C1", ("series", "R1", ("parallel", "R3", "C3"))), "W1",
    )  # fmt: skip
    turned = network_of("C1 1 2; R1 2 0; port 0 1")
    assert _shape(series_parallel(turned)) == ("series", "R1", "C1")
    for text in ("R1 1 2; C1 2 0; R2 2 3; port 1 0", "1~2; F1; S1"):  # R2 hangs; no circuit
        assert series_parallel(network_of(text)) is None


@pytest.mark.parametrize("text", HARD)
def test_svg_parses_and_png_decodes(text: str) -> None:
    drawn = network_of(text)
    root = ElementTree.fromstring(network_svg(drawn))
    assert root.findtext("{*}title") == describe_network(drawn)
    size = Image.open(io.BytesIO(network_png(drawn, scale=1))).size
    scene = draw_network(drawn)
    assert size == (round(scene.width), round(scene.height))


def test_words_say_what_is_where() -> None:
    assert describe_network(network_of("1=2*i, 2-#; F1:2; S1; velocity")) == (
        "2 masses: k12 between 1 and 2, ratio i, d12 between 1 and 2, ratio i, b2 between 2 and the"
        " ground; F at 1 against 2; y (velocity) at 1."
    )
    assert describe_network(network_of("R0-C1")) == (
        "2 elements: R0 between 1 and 2, C1 between 2 and 0; port between 1 and 0."
    )


def test_forces_point_at_their_mass_and_sensors_mark_theirs() -> None:
    layers = {la.name: la.shapes for la in draw_network(network_of("1~2; F1; S2:1")).layers}
    heads = [s for s in layers["forceF"] if isinstance(s, Path) and s.fill is Ink.FORCE]
    left, top, right, bottom = extent(layers["node-1"][0])
    (x, y) = heads[0].points[0]
    assert left - 1 <= x <= right + 1 and top - 1 <= y <= bottom + 1
    dots = [layers[f"sensor{sign}"][1].fill for sign in ("y", "-y")]
    assert dots == [Ink.SENSOR, Ink.PAPER]


@pytest.mark.full
def test_a_network_of_the_largest_size_is_drawn() -> None:
    masses = ", ".join(f"{i}~{i + 1}" for i in range(1, 40))
    assert len(draw_network(network_of(f"{masses}; F1; S40")).layers) > 100


def test_a_chain_is_drawn_as_a_chain_and_a_formula_not_at_all() -> None:
    from disting import Model

    chain = Chain(2)
    assert scene_of(chain) == scene_of(Model.from_chain(chain)) is not None
    assert scene_of(Model.from_transfer_function(["k"], ["T", "1"])) is None


@pytest.mark.full
def test_the_command_writes_pictures_and_says_what_it_cannot(tmp_path: File) -> None:
    done = called("draw", "1=2=3, 2=4; F1; S4", "--svg", tmp_path / "a.svg", "--png", tmp_path / "a.png")  # fmt: skip
    assert done.returncode == 0 and done.stdout.startswith("4 masses: k12 between 1 and 2")
    assert (tmp_path / "a.svg").read_text("utf-8") == network_svg(network_of("1=2=3, 2=4; F1; S4"))
    assert Image.open(tmp_path / "a.png").width > 300
    done = called("draw", "3:11", "--svg", "-")
    assert done.returncode == 0 and ElementTree.fromstring(done.stdout) is not None
    (tmp_path / "m.json").write_text('{"models": [{"name": "lag", "num": ["k"], "den": ["T", 1]}]}')
    for arguments, cause in (
        (("3:1",), "give a file for the drawing"),
        (("3:1", "--png", "-"), "a picture as PNG goes to a file"),
        (("R0-p(R1", "--svg", "-"), "ends too early"),
        ((f"{tmp_path}/m.json:lag", "--svg", "-"), "is a transfer function or a state space"),
    ):
        done = called("draw", *arguments)
        assert done.returncode == 2 and cause in done.stderr and "Traceback" not in done.stderr
