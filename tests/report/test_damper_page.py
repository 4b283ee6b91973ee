"""The page of a family with ground dampers: complete, small, reproducible; its drawings are
those of the single chains.
"""

import json
import re
from dataclasses import replace

import numpy as np
import pytest

from disting.catalogs import catalog
from disting.catalogs.dampers import DamperFamily, DamperSets, damper_catalog, damper_family
from disting.errors import InputError
from disting.report import damper_page
from disting.report.damper_page import bits, counts, mirror, number_classes, payload
from disting.report.drawing import Drawing, draw, ground_dampers, share
from disting.report.index import runs
from disting.report.scene import PAGE_PALETTE, Ink, draw_layer
from disting.report.search import families
from disting.verdict.result import Relation


@pytest.fixture(scope="module")
def found() -> DamperFamily:
    return damper_catalog(3, damped=True)


@pytest.fixture(scope="module")
def text(found: DamperFamily) -> str:
    return damper_page(found, beside=families([catalog(3, damped=True)]))


def _opened(found: DamperFamily) -> DamperFamily:
    """The same, as if the largest class and the next were not decided."""
    by_size = number_classes(found.found)
    a, b = sorted(int(found.found.group[i]) for i in by_size.first[:2])
    columns = found.found.columns.copy()
    for group in (a, b):
        columns[found.found.group == group] = -1
    return replace(
        found, found=replace(found.found, columns=columns, open_groups=frozenset({(a, b)}))
    )


def test_classes_are_numbered_by_size(found: DamperFamily) -> None:
    by_size = number_classes(found.found)
    sizes = [len(by_size.members(g)) for g in range(len(by_size.sizes))]
    assert sizes == sorted(sizes, reverse=True) == by_size.sizes.tolist() and sum(sizes) == 88
    assert sorted(by_size.members(g) for g in range(by_size.several)) == sorted(
        found.found.classes()
    )


def test_classes_whose_buckets_disagree_are_refused(found: DamperFamily) -> None:
    columns = found.found.columns.copy()
    columns[found.found.classes()[0][0], 0] += 1
    with pytest.raises(InputError):
        number_classes(replace(found.found, columns=columns))


@pytest.mark.full
def test_no_pair_is_sent(found: DamperFamily, text: str) -> None:
    assert len(payload(found)) < 4000
    assert len(text.encode()) < 160_000


def test_sets_are_bits() -> None:
    assert [bits(masses) for masses in DamperSets.ALL.of(2)] == [0, 2, 4, 6]


def test_the_mirror_is_the_one_of_the_free_part(found: DamperFamily) -> None:
    """Force and sensor at the middle mass: of three free masses (A4), and of one that is free
    alone.
    """
    assert {n: mirror(found.family[n]) for n in range(1, 12) if mirror(found.family[n])} == {
        4: 4,
        8: 6,
        9: 6,
        10: 6,
        11: 6,
    }


def test_shared_drawings_are_the_single_ones(found: DamperFamily) -> None:
    drawings = [Drawing(number, draw(chain)) for number, chain in enumerate(found.family, 1)]
    *lines, _ = f"{share(drawings)}\n".split("\n")
    parts = dict(
        re.fullmatch(r'<g id="(part-\d+)">(.*)</g>', line).groups()
        for line in lines[: -len(drawings)]
    )  # type: ignore[union-attr]
    assert len(set(parts.values())) == len(parts) < sum(len(d.scene.layers) for d in drawings) / 2
    for drawing, line in zip(drawings, lines[-len(drawings) :], strict=True):
        single = [draw_layer(layer, PAGE_PALETTE) for layer in drawing.scene.layers]
        assert [parts[name] for name in re.findall(r'href="#(.*?)"', line)] == single


def test_ground_dampers_are_those_of_a_single_chain(found: DamperFamily) -> None:
    single = {
        layer.name: layer.shapes
        for layer in draw(replace(found.family[5], ground_dampers=(1, 3))).layers
    }
    for mass, part in enumerate(ground_dampers(3), start=1):
        broken, *shapes = part.layer.shapes
        assert part.name == f"ground-{mass}" and broken.stroke is Ink.PAPER  # type: ignore[union-attr]
        if mass != 2:
            assert tuple(shapes) == single[f"b{mass}"]


def test_counts_are_those_of_the_classes(found: DamperFamily) -> None:
    rows = counts(found)
    for relation in Relation:
        assert sum(
            row.number for row in rows if row.relation is relation
        ) == found.found.counts().get(relation, 0)
    exact = [(row.relation.value, row.number) for row in rows if row.sign == "E"]
    looked_up = [r.value for _, _, r, rule in found.found.pairs() if rule == "exact"]
    assert exact == [(r, looked_up.count(r)) for r in ("distinguishable", "indistinguishable")]


@pytest.mark.full
def test_what_is_undecided_is_said(found: DamperFamily, text: str) -> None:
    assert "undecided</strong>" not in text and "Undecided</h3>" not in text
    opened = damper_page(_opened(found))
    assert "<strong>64</strong> are undecided" in opened
    assert re.findall(r'class="pairlink" href="([^"]*)"', opened) == ["#2+b1+b2/9"]
    assert counts(_opened(found))[-1].number == 64


@pytest.mark.full
def test_the_thumbnail_shows_what_any_two_sets_are(found: DamperFamily) -> None:
    fields = {(x + k, y): r for r, x, y, count in runs(_opened(found)) for k in range(count)}
    relations: dict[tuple[int, int], set[Relation]] = {}
    for i, j, relation, _ in _opened(found).found.pairs():
        relations.setdefault((i // 8, j // 8), set()).add(relation)
    rank = (Relation.INDISTINGUISHABLE, Relation.UNDECIDED)
    expected = {place: next((r for r in rank if r in of), None) for place, of in relations.items()}
    assert fields == {place: r for place, r in expected.items() if r}


def test_every_structure_has_a_row_and_ids_are_unique(text: str) -> None:
    ids = re.findall(r'\sid="([^"]+)"', text)
    assert len(ids) == len(set(ids)) and {f"row-{n}" for n in range(1, 12)} <= set(ids)
    assert set(re.findall(r'<use href="#([\w-]+)"', text)) <= set(ids)


def test_links_to_other_pages_only_where_they_are(found: DamperFamily, text: str) -> None:
    assert 'href="models/3-damped/11.html"' in text and 'href="chains-3-damped.html"' in text
    alone = damper_page(found)
    assert "models/3-damped/" not in re.sub(r"<script>.*?</script>", "", alone, flags=re.DOTALL)
    assert 'href="chains-3-damped.html"' not in alone


def test_nothing_is_fetched_and_data_are_safe(text: str) -> None:
    assert "http:" not in text.replace("http://www.w3.org", "") and "https:" not in text
    assert not re.search(
        r"url\(|@import|\bsrc=|<link(?! rel=.icon. href=.data:)|<iframe|fetch\(|XMLHttp|import\(",
        text,
    )
    data = re.search(r'id="data">(.*?)</script>', text)
    assert (
        data
        and not set("<>&") & set(data[1])
        and json.loads(data[1])["sets"] == [0, 2, 4, 8, 6, 10, 12, 14]
    )


def test_the_same_bytes_again(found: DamperFamily, text: str) -> None:
    again = replace(found, found=replace(found.found, columns=np.array(found.found.columns)))
    assert damper_page(again, beside=families([catalog(3, damped=True)])) == text


def test_one_mass_has_a_page_too() -> None:
    assert "<strong>2 models</strong>" in damper_page(damper_family(1, damped=False))
