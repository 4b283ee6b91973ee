"""The matrix figure: one field for each pair and view, labelled with what decided."""

import io
from collections import Counter
from xml.etree import ElementTree

import pytest
from PIL import Image

from disting.catalogs import Catalog, catalog
from disting.report import matrix_png, matrix_svg
from disting.report.index import thumbnail
from disting.report.matrix import WIDEST_PNG, figure, has_slides, sign, slide, slide_png
from disting.report.scene import Ink, Rect, Text, extent
from disting.report.words import VIEW_TITLES, totals
from disting.verdict.result import Relation, View
from tests.report.shapes import meet


@pytest.fixture(params=[(1, False), (2, True), (3, False)], ids=str)
def shipped(request: pytest.FixtureRequest) -> Catalog:
    return catalog(request.param[0], damped=request.param[1])


def test_every_pair_has_a_field_in_every_view(shipped: Catalog) -> None:
    size = len(shipped.family)
    for view in VIEW_TITLES:
        layer = next(layer for layer in figure(shipped).layers if layer.name == f"{view}-fields")
        assert sum(isinstance(shape, Rect) for shape in layer.shapes) == size * (size - 1) // 2


def test_the_numbers_are_the_counts_of_the_catalogue(shipped: Catalog) -> None:
    for view in VIEW_TITLES:
        layer = next(layer for layer in figure(shipped).layers if layer.name == f"{view}-numbers")
        shown = Counter(shape.text for shape in layer.shapes if isinstance(shape, Text))
        assert shown == {sign(name): n for name, n in shipped.counts(view).items() if name and n}


def test_nothing_leaves_the_figure(shipped: Catalog) -> None:
    scene = figure(shipped)
    for shape in scene.shapes:
        left, top, right, bottom = extent(shape)
        assert 0 <= left <= right <= scene.width and 0 <= top <= bottom <= scene.height, shape


@pytest.mark.full
def test_files_are_readable_and_reproducible(shipped: Catalog) -> None:
    text, scene = matrix_svg(shipped), figure(shipped)
    assert ElementTree.fromstring(text).get("width") == f"{scene.width:.2f}".rstrip("0").rstrip(".")
    image = Image.open(io.BytesIO(matrix_png(shipped)))
    scale = min(2.0, WIDEST_PNG / scene.width)
    assert image.size == (round(scale * scene.width), round(scale * scene.height))
    assert matrix_svg(shipped) == text


@pytest.mark.full
def test_a_wide_figure_has_a_slide_for_each_view() -> None:
    assert [has_slides(catalog(n, damped=False)) for n in (1, 2, 3, 4, 5)] == [False] * 3 + [
        True
    ] * 2
    for shipped, view in (
        (catalog(5, damped=True), View.POSITIVE),
        (catalog(4, damped=False), View.TF),
    ):
        scene = slide(shipped, view)
        letters = [shape for shape in scene.shapes if isinstance(shape, Text)]
        assert min(shape.size for shape in letters) >= 12  # pixels of a projector
        counted = Counter(
            shape.text
            for layer in scene.layers
            for shape in layer.shapes
            if isinstance(shape, Text) and layer.name == f"{view}-numbers"
        )
        assert counted == {sign(name): n for name, n in shipped.counts(view).items() if name and n}
        for shape in scene.shapes:
            left, top, right, bottom = extent(shape)
            assert 0 <= left <= right <= 1920 and 0 <= top <= bottom <= 1080, shape
        fields = [s for s in scene.shapes if isinstance(s, Rect)]
        heads = next(layer.shapes for layer in scene.layers if layer.name == "head")
        assert not any(meet(head, field) for head in heads for field in fields)
    image = Image.open(io.BytesIO(slide_png(catalog(4, damped=False), View.POSITIVE)))
    assert image.size == (1920, 1080)


@pytest.mark.full
def test_the_thumbnail_covers_what_is_not_distinguishable() -> None:
    shipped = catalog(4, damped=True)
    cell = 168 / 28
    areas = {Ink.INDISTINGUISHABLE: 0.0, Ink.OPEN: 0.0}
    for shape in thumbnail(shipped).shapes:
        if isinstance(shape, Rect):
            areas[shape.fill] += shape.width * shape.height / cell**2
    found = totals(shipped)
    assert areas[Ink.INDISTINGUISHABLE] == pytest.approx(found[Relation.INDISTINGUISHABLE])
    assert areas[Ink.OPEN] == pytest.approx(found[Relation.UNDECIDED])
