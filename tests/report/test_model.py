"""The page of a model says what the catalogue knows of it, in links that lead somewhere."""

import re

import pytest

from disting.catalogs import Catalog, catalog
from disting.inclusion import Inclusion
from disting.report.model import limits, model_page, told_apart
from disting.verdict import Relation, View
from tests.report.outline import Outline


@pytest.fixture(scope="module", params=[(1, True), (3, False), (3, True)], ids=str)
def shipped(request: pytest.FixtureRequest) -> Catalog:
    return catalog(request.param[0], damped=request.param[1])


def _verdicts(c: Catalog, number: int) -> dict[int, object]:
    return {i: c.verdict(number, i) for i in range(1, len(c.family) + 1) if i != number}


def test_every_indistinguishable_model_is_named_and_no_other(shipped: Catalog) -> None:
    for row in shipped.rows:
        outline = Outline(model_page(shipped, row.number))
        named = {a["id"] for t, a in outline.elements if t == "article"}
        group = next((g for g in shipped.classes(View.EXACT) if row.number in g), (row.number,))
        assert named == {f"A{m}" for m in group if m != row.number}


def test_ids_are_unique_and_texts_are_whole(shipped: Catalog) -> None:
    for row in shipped.rows:
        text = model_page(shipped, row.number)
        outline = Outline(text)
        ids = [a["id"] for _, a in outline.elements if "id" in a]
        assert len(ids) == len(set(ids)) and "None" not in text
        assert outline.count("math") > 2
        assert {str(a["href"])[1:] for t, a in outline.elements if str(a.get("href", "")).startswith("#")} <= set(ids)


def test_what_tells_it_apart_adds_up(shipped: Catalog) -> None:
    for row in shipped.rows:
        found = _verdicts(shipped, row.number)
        apart = sum(v.relation is Relation.DISTINGUISHABLE for v in found.values())  # type: ignore[attr-defined]
        assert sum(count for _, count in told_apart(found)) == apart  # type: ignore[arg-type]


def test_limits_look_the_same_from_both_sides() -> None:
    shipped = catalog(3)
    found = {row.number: limits(row.number, _verdicts(shipped, row.number)) for row in shipped.rows}  # type: ignore[arg-type]
    for number, of in found.items():
        assert all(number in found[other].holds for other in of.inside)
        assert all(number in found[other].inside for other in of.holds)
    one_sided = [v for _, _, v in shipped.pairs() if v.closure in (Inclusion.LEFT_IN_RIGHT, Inclusion.RIGHT_IN_LEFT)]
    assert sum(len(of.inside) for of in found.values()) == len(one_sided) == 32


def test_a_smaller_rank_lies_inside_a_larger_one() -> None:
    shipped = catalog(3)
    rank = {row.number: row.rank for row in shipped.rows}
    for number in rank:
        inside = limits(number, _verdicts(shipped, number)).inside  # type: ignore[arg-type]
        assert all(rank[other] > rank[number] for other in inside)


def test_the_page_of_the_damped_pair_gives_the_map() -> None:
    text = model_page(catalog(3, damped=True), 1)
    assert "No experiment with this force and sensor tells it from" in text
    assert "duality of chains with both ports at the gap" in text
    assert r"m_{3}&#39; &amp;= m_{1} + m_{2} + m_{3}" in text


def test_an_unidentifiable_model_lists_what_can_be_determined() -> None:
    text = model_page(catalog(3, damped=True), 3)
    assert "7 parameters, only 6 determinable:" in text
    assert len(re.findall(r"<li><math>", text)) == 6
