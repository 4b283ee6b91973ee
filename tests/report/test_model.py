"""The page of a model says what the catalogue knows of it, in links that lead somewhere."""

import re

import pytest

from disting.catalogs import Catalog, catalog
from disting.conditions.inclusion import Inclusion
from disting.evidence.positive import Share
from disting.report.model import limits, model_page, reasons_apart, relation_from
from disting.report.payload import one_sided_pairs
from disting.verdict.result import Relation, View
from tests.report.outline import Outline


@pytest.fixture(scope="module", params=[(1, True), (3, False), (3, True)], ids=str)
def shipped(request: pytest.FixtureRequest) -> Catalog:
    return catalog(request.param[0], damped=request.param[1])


@pytest.fixture(scope="module")
def outlines(shipped: Catalog) -> dict[int, Outline]:
    """The page of each model."""
    return {row.number: Outline(model_page(shipped, row.number)) for row in shipped.rows}


def _verdicts(c: Catalog, number: int) -> dict[int, object]:
    return {i: c.verdict(number, i) for i in range(1, len(c.family) + 1) if i != number}


def assert_names(
    shipped: Catalog, number: int, outline: Outline, sometimes: tuple[int, ...] = ()
) -> None:
    named = {a["id"] for t, a in outline.elements if t == "article"}
    group = next((g for g in shipped.classes(View.POSITIVE) if number in g), (number,))
    always = {f"A{m}" for m in group if m != number}
    assert named - always == {f"A{m}" for m in sometimes}
    assert always <= named


@pytest.mark.full
def test_every_indistinguishable_model_is_named_and_no_other(
    shipped: Catalog, outlines: dict[int, Outline]
) -> None:
    for number, outline in outlines.items():
        assert_names(shipped, number, outline)


@pytest.mark.full
@pytest.mark.parametrize(
    ("number", "sometimes"), [(2, (6,)), (6, (2,)), (16, (2, 6)), (18, (2, 6)), (4, ()), (11, ())]
)
def test_what_depends_on_the_values_is_named_too(number: int, sometimes: tuple[int, ...]) -> None:
    """2 and 6 of four masses without dampers see each other; 16 and 18, of a smaller rank, may
    behave like either.
    """
    shipped = catalog(4, damped=False)
    assert_names(shipped, number, Outline(model_page(shipped, number)), sometimes)


def test_ids_are_unique_and_texts_are_whole(outlines: dict[int, Outline]) -> None:
    for outline in outlines.values():
        ids = [a["id"] for _, a in outline.elements if "id" in a]
        assert len(ids) == len(set(ids)) and "None" not in outline.text
        assert not any(
            "None" in str(value)
            for _, a in outline.elements
            for value in a.values()
            if value is not None
        )
        assert outline.count("math") > 2
        assert {
            str(a["href"])[1:]
            for t, a in outline.elements
            if str(a.get("href", "")).startswith("#")
        } <= set(ids)


def test_what_tells_it_apart_adds_up(shipped: Catalog) -> None:
    for row in shipped.rows:
        found = _verdicts(shipped, row.number)
        apart = sum(v.relation is Relation.DISTINGUISHABLE for v in found.values())  # type: ignore[attr-defined]
        assert sum(count for _, count in reasons_apart(found)) == apart  # type: ignore[arg-type]


@pytest.mark.full
def test_no_page_says_that_no_experiment_tells_what_some_values_do_tell_apart() -> None:
    """A6 of four masses without dampers: A2 does the same for some of its positive parameters
    only.
    """
    text = Outline(model_page(catalog(4, damped=False), 6)).text
    assert "no experiment with this force and sensor distinguishes it from" not in text.lower()
    words = "The positive parameters determine whether an experiment can distinguish it from A2."
    assert words in text
    assert (
        "only for some positive parameters here, A2 has positive ones with the same response; the reverse"
        " for all." in text
    )
    assert "Over complex parameters, as in the paper\nIndistinguishable from A2." in text
    back = Outline(model_page(catalog(4, damped=False), 2)).text
    assert (
        "for all positive parameters here, A6 has positive ones with the same response; the reverse for"
        " some only." in back
    )


def test_never_and_always_are_said_of_a_pair_only_where_its_verdict_says_so(
    shipped: Catalog, outlines: dict[int, Outline]
) -> None:
    for number, outline in outlines.items():
        always = re.findall(
            r"Whatever its positive parameters(, special values aside)?,"
            r" no experiment.*?distinguishes it from ([^.]*)\.",
            outline.text,
            re.DOTALL,
        )
        named = {int(m) for _, said in always for m in re.findall(r"A(\d+)", said)}
        others = [i for i in range(1, len(shipped.family) + 1) if i != number]
        generic = any(shipped.verdict(number, i).has_exceptions for i in others)
        assert all(bool(aside) is generic for aside, _ in always)
        assert named == {
            i for i in others if shipped.relation(number, i) is Relation.INDISTINGUISHABLE
        }


@pytest.mark.full
def test_a_limit_case_says_what_follows() -> None:
    """A4 of four masses without dampers is distinguishable from all others, and a limit of
    thirteen of them.
    """
    text = " ".join(Outline(model_page(catalog(4, damped=False), 4)).text.split())
    assert "none of the other models of this catalogue has its response" in text
    assert (
        "But over complex parameters it is a limit case of 13: noise may hide the difference."
        in text
    )
    assert "A limit case of 13 models" in text and "come arbitrarily close to its own" in text
    assert (
        "Over complex parameters" in text
        and "this model cannot produce their generic responses" in text
    )


@pytest.mark.full
def test_a_distinguishable_pair_may_be_one_sided() -> None:
    """Some positive models of the smaller rank behave like a larger one: then no experiment
    rules the larger one out.
    """
    shipped = catalog(4, damped=False)
    sides = list(one_sided_pairs(shipped))
    assert len(sides) == 4 and {x.share for x in sides} == {Share.SOMETIMES}
    for x in sides:
        verdict = shipped.verdict(x.given, x.other)
        assert verdict.relation is Relation.DISTINGUISHABLE
        assert relation_from(x.given, x.other, verdict) is Relation.SOMETIMES
        assert relation_from(x.other, x.given, verdict) is Relation.DISTINGUISHABLE
        assert (
            f"generic ones of A{x.other} have none here"
            in Outline(model_page(shipped, x.given)).text
        )


def test_limits_look_the_same_from_both_sides() -> None:
    shipped = catalog(3, damped=False)
    found = {row.number: limits(row.number, _verdicts(shipped, row.number)) for row in shipped.rows}  # type: ignore[arg-type]
    for number, of in found.items():
        assert all(number in found[other].holds for other in of.inside)
        assert all(number in found[other].inside for other in of.holds)
    one_sided = [
        v
        for _, _, v in shipped.pairs()
        if v.closure in (Inclusion.LEFT_IN_RIGHT, Inclusion.RIGHT_IN_LEFT)
    ]
    assert sum(len(of.inside) for of in found.values()) == len(one_sided) == 32


def test_a_smaller_rank_lies_inside_a_larger_one() -> None:
    shipped = catalog(3, damped=False)
    rank = {row.number: row.rank for row in shipped.rows}
    for number in rank:
        inside = limits(number, _verdicts(shipped, number)).inside  # type: ignore[arg-type]
        assert all(rank[other] > rank[number] for other in inside)


def test_the_page_of_the_damped_pair_gives_the_map() -> None:
    text = model_page(catalog(3, damped=True), 1)
    assert (
        "Whatever its positive parameters, no experiment with this force and sensor distinguishes it from"
        in text
    )
    assert "duality of chains with both ports at the gap" in text
    assert r"m_{3}&#39; &amp;= m_{1} + m_{2} + m_{3}" in text


def test_an_unidentifiable_model_lists_what_can_be_determined() -> None:
    text = model_page(catalog(3, damped=True), 3)
    assert "7 parameters, only 6 determinable:" in text
    assert len(re.findall(r"<li><math>", text)) == 6
