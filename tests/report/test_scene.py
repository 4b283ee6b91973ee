"""Scenes as SVG and PNG: well formed, of the right size, and the same picture."""

import io
from xml.etree import ElementTree

import pytest
from PIL import Image

from disting.report.png import png
from disting.report.scene import (
    FILE_PALETTE,
    NAMESPACE,
    PAGE_PALETTE,
    Circle,
    Ink,
    Layer,
    Path,
    Rect,
    Scene,
    Text,
    arrow,
    extent,
    svg,
)

SCENE = Scene(
    40,
    30,
    (
        Layer("box <&>", (Rect(2, 2, 10, 10, Ink.FORCE), Circle(30, 7, 4, Ink.SENSOR))),
        Layer(
            "line",
            (Path(((2, 25), (20, 25))), Path(((22, 20), (30, 20), (26, 28)), Ink.NONE, Ink.FORCE)),
        ),
        Layer("text", (Text(20, 15, '<&">', bold=True),)),
    ),
    "a <scene> & more",
)


def test_svg_parses_and_escapes() -> None:
    root = ElementTree.fromstring(svg(SCENE))
    assert root.findtext(f"{{{NAMESPACE}}}title") == "a <scene> & more"
    assert [t.text for t in root.iter(f"{{{NAMESPACE}}}text")] == ['<&">']
    assert [g.get("data-part") for g in root.iter() if g.get("data-part")] == [
        "box <&>",
        "line",
        "text",
    ]


def test_neighbours_of_one_style_share_a_group() -> None:
    same = Scene(9, 9, (Layer("row", tuple(Rect(x, 0, 1, 1, Ink.FORCE) for x in range(9))),))
    assert svg(same).count(FILE_PALETTE[Ink.FORCE]) == 1


@pytest.mark.parametrize("scale", [1, 2, 2.5])
def test_png_has_the_asked_size(scale: float) -> None:
    image = Image.open(io.BytesIO(png(SCENE, scale=scale)))
    image.load()
    assert image.format == "PNG" and image.size == (40 * scale, 30 * scale)


def test_png_shows_the_shapes_where_they_are() -> None:
    image = Image.open(io.BytesIO(png(SCENE, scale=4))).convert("RGB")
    colours = {
        ink: tuple(bytes.fromhex(code[1:]))
        for ink, code in FILE_PALETTE.items()
        if code.startswith("#")
    }
    found = {
        place: image.getpixel((place[0] * 4, place[1] * 4))
        for place in [(7, 7), (30, 7), (10, 25), (26, 22), (35, 25)]
    }
    inks = (Ink.FORCE, Ink.SENSOR, Ink.LINE, Ink.FORCE, Ink.PAPER)
    assert list(found.values()) == [colours[ink] for ink in inks]


def test_both_backends_give_the_same_bytes_again() -> None:
    assert svg(SCENE) == svg(SCENE) and png(SCENE) == png(SCENE)


def test_palettes_know_every_ink() -> None:
    assert set(FILE_PALETTE) == set(PAGE_PALETTE) == set(Ink)


@pytest.mark.parametrize(
    ("ground", "letters"),
    [
        (Ink.DISTINGUISHABLE, Ink.ON_DISTINGUISHABLE),
        (Ink.INDISTINGUISHABLE, Ink.ON_INDISTINGUISHABLE),
        *((Ink.PAPER, ink) for ink in (Ink.LINE, Ink.MUTED, Ink.FORCE, Ink.SENSOR)),
    ],
)
def test_letters_are_readable(ground: Ink, letters: Ink) -> None:
    bright, dark = sorted(
        (_luminance(FILE_PALETTE[ground]), _luminance(FILE_PALETTE[letters])), reverse=True
    )
    assert (bright + 0.05) / (dark + 0.05) >= 4.5


def test_relations_differ_in_grey_too() -> None:
    first, second = (
        _luminance(FILE_PALETTE[ink]) for ink in (Ink.DISTINGUISHABLE, Ink.INDISTINGUISHABLE)
    )
    assert (second + 0.05) / (first + 0.05) > 2


def test_an_arrow_ends_where_it_points() -> None:
    shaft, head = arrow((0, 0), (20, 0), Ink.FORCE)
    assert shaft.points[0] == (0, 0) and head.points[0] == (20, 0)
    assert extent(head) == pytest.approx((12, -3.6, 20, 3.6))


def _luminance(code: str) -> float:
    channels = (value / 255 for value in bytes.fromhex(code[1:]))
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
