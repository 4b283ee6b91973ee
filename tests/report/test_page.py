"""The page of a catalogue: complete, closed in itself, safe against hostile text, small and
reproducible.
"""

import json
import re

import pytest
from hypothesis import given, strategies as st

from disting.catalogs import Catalog, catalog
from disting.report import index, page
from disting.report.payload import pack, script_json
from disting.report.words import VIEW_TITLES
from disting.verdict.meaning import meaning_sentence
from disting.verdict.result import View
from tests.report.outline import Outline

HOSTILE = """</script><script>alert("1")</script><img src=x onerror='alert(2)'>&amp;{{ 7*7 }}"""


def _data(text: str) -> dict[str, object]:
    found = re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.DOTALL)
    assert found
    return dict(json.loads(found.group(1)))


@pytest.fixture(scope="module", params=[(1, False), (2, False), (3, True), (4, False)], ids=str)
def shipped(request: pytest.FixtureRequest) -> Catalog:
    return catalog(request.param[0], damped=request.param[1])


@pytest.fixture(scope="module")
def largest() -> str:
    return page(catalog(5, damped=True))


@pytest.fixture(scope="module")
def text(shipped: Catalog) -> str:
    return page(shipped)


@pytest.fixture(scope="module")
def outline(text: str) -> Outline:
    return Outline(text)


def _unpacked(runs: list[int]) -> list[int]:
    """Independent of `pack`: a negative number repeats what is before it."""
    found: list[int] = []
    for number in runs:
        found += [number] if number >= 0 else [found[-1]] * -number
    return found


@pytest.mark.full
def test_it_holds_every_pair_in_every_view(shipped: Catalog, text: str) -> None:
    size = len(shipped.family)
    if size == 1:
        assert 'id="data"' not in text
        return
    data = _data(text)
    entries, texts = data["entries"], data["texts"]
    for view in VIEW_TITLES:
        numbers = _unpacked(data["views"][view])  # type: ignore[index]
        assert len(numbers) == size * (size - 1) // 2
        undecided = sum(texts[entries[n][0]] == "undecided" for n in numbers)  # type: ignore[index]
        assert undecided == shipped.counts(view)[""]


@given(st.lists(st.integers(0, 3)))
def test_packed_numbers_come_back(numbers: list[int]) -> None:
    assert _unpacked(pack(numbers)) == numbers and len(pack(numbers)) <= len(numbers)


def test_ids_are_unique_and_links_lead_somewhere(outline: Outline) -> None:
    ids = [a["id"] for _, a in outline.elements if "id" in a]
    assert len(ids) == len(set(ids))
    inner = [
        str(a["href"])[1:] for _, a in outline.elements if str(a.get("href", "")).startswith("#")
    ]
    assert inner and all(target in ids or re.fullmatch(r"\d+-\d+", target) for target in inner)


def test_every_model_has_a_row_and_every_drawing_a_text(shipped: Catalog, outline: Outline) -> None:
    for row in shipped.rows:
        assert outline.count("tr", id=f"row-{row.number}") == 1
    named = [
        a
        for t, a in outline.elements
        if t == "svg" and a.get("role") == "img" and "data-slot" not in a
    ]
    assert all(a.get("aria-label") or a.get("aria-labelledby") == "curves-said" for a in named)


def test_embedded_data_give_the_verdicts_back(shipped: Catalog, text: str) -> None:
    data = _data(text) if len(shipped.family) > 1 else {}
    assert bool(data) == ("createMatrix" in text)
    for left, right, verdict in shipped.pairs(View.MARKOV):
        place = (right - 1) * (right - 2) // 2 + left - 1
        entry = data["entries"][_unpacked(data["views"]["markov"])[place]]  # type: ignore[index]
        relation, by, where, sure, domain, said, why, formula, rule, _, aside = (
            data["texts"][n] for n in entry
        )  # type: ignore[index]
        assert (domain, rule) == ("complex", verdict.rule)
        assert (relation, by, where) == (
            verdict.relation,
            verdict.decided_by,
            verdict.representation,
        )
        named = said.replace("{L}", verdict.left).replace("{R}", verdict.right)
        assert named == meaning_sentence(verdict)
        assert bool(aside) == verdict.has_exceptions and bool(sure) == bool(verdict.sure)
        if verdict.evidence:
            assert (
                why.replace("{L}", verdict.left).replace("{R}", verdict.right) in verdict.sentence
            )
            assert formula == verdict.evidence.formula


@pytest.mark.full
def test_counts_are_printed_as_in_the_paper() -> None:
    text = page(catalog(3, damped=False))
    assert (
        "26 pairs by condition 1, 15 by 4, 2 by 5, 2 by 6 and 10 by 7; none left undecided." in text
    )
    assert "26 pairs by condition 1, 7 by 4, 10 by 5 and 2 by 6; 10 left undecided." in page(
        catalog(3, damped=True)
    )


@pytest.mark.full
def test_hostile_text_stays_text() -> None:
    records = json.loads(json.dumps(list(catalog(3, damped=False).records)))
    records[0]["note"] = HOSTILE
    pair = next(
        r for r in records[12:] if "markov" in r and r["markov"]["evidence"]["kind"] == "forms"
    )
    pair["markov"]["evidence"]["only_left"] = [HOSTILE]
    text = page(Catalog.from_records(records))
    outline, before = Outline(text), Outline(page(catalog(3, damped=False)))
    assert (
        outline.count("script") == before.count("script")
        and outline.count("img") == before.count("img") == 1
    )
    assert HOSTILE in outline.texts["dd"]
    assert any(HOSTILE in str(t) for t in _data(text)["texts"])  # type: ignore[attr-defined]
    assert HOSTILE not in text


def test_script_json_cannot_end_its_element() -> None:
    text = str(script_json([HOSTILE, "<!--", "\u2028"]))
    assert not set("<>&\u2028") & set(text) and json.loads(text) == [HOSTILE, "<!--", "\u2028"]


@pytest.mark.parametrize("render", [page, lambda c: index([c])], ids=["page", "index"])
def test_nothing_is_fetched(render: object) -> None:
    text = render(catalog(3, damped=True))  # type: ignore[operator]
    text = text.replace('"http://www.w3.org/2000/svg"', "")  # a name, which nobody fetches
    text = re.sub(r"'sha256-[^']*'", "", text)  # may have any signs
    assert "http:" not in text and "https:" not in text and "//" not in text.replace("// ", "")
    text = re.sub(r"<noscript>.*?</noscript>", "", text)  # a picture for those without a script
    assert not re.search(
        r"url\((?!#)|@import|\bsrc=|<link(?! rel=.icon. href=.data:)|<iframe|fetch\(|XMLHttp|import\(",
        text,
    )


@pytest.mark.full
def test_the_largest_page_is_small_and_complete(largest: str) -> None:
    assert len(largest.encode()) < 3_000_000
    assert [len(_unpacked(runs)) for runs in _data(largest)["views"].values()] == 5 * [2628]  # type: ignore[attr-defined]


def test_the_same_bytes_again(shipped: Catalog, text: str) -> None:
    assert page(catalog(shipped.n_masses, damped=shipped.damped)) == text


@pytest.mark.full
def test_the_headline_speaks_of_positive_parameters_and_names_the_domain_of_every_count() -> None:
    text = " ".join(Outline(page(catalog(4, damped=False))).text.split())
    assert (
        "Over positive parameters: of 406 pairs of the 29 models, 357 are distinguishable" in text
    )
    assert (
        "48 are indistinguishable: whatever the positive parameters of one, special values aside"
        " where the verdict of a pair states it, some of the other give the same" in text
    )
    assert "For 1 this holds for some positive parameters only" in text
    assert "Over complex parameters: of 406 pairs of the 29 models, 357 are distinguishable" in text
    assert "49 are indistinguishable: whatever the complex parameters of one" in text
    assert text.index("Over positive parameters") < text.index("Over complex parameters")


@pytest.mark.full
def test_groups_are_over_positive_parameters_and_what_depends_on_the_values_has_its_own_sentence() -> (
    None
):
    outline = Outline(page(catalog(4, damped=False)))
    ids = {str(a["id"]) for _, a in outline.elements if "id" in a}
    assert sum(re.fullmatch(r"group-\d+", i) is not None for i in ids) == 8
    assert sum(re.fullmatch(r"complex-group-\d+", i) is not None for i in ids) == 9
    text = " ".join(outline.text.split())
    said = (
        "For some positive parameters no experiment with this force and sensor distinguishes them;"
        " for others one does: A2–A6"
    )
    assert said in text


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_groups_say_where_special_values_are_left_aside(damped: bool) -> None:
    """41 pairs of groups of the undamped models of 4 masses, none of the damped ones."""
    text = " ".join(Outline(page(catalog(4, damped=damped))).text.split())
    head = "The models of one group have the same transfer functions over positive parameters:"
    aside = ", special values aside where the verdict of a pair states it" if not damped else ""
    assert f"{head} whatever those of one{aside}, each of the others has its own" in text


@pytest.mark.parametrize(("n", "damped"), [(2, False), (3, False), (3, True)])
def test_the_start_page_says_it_of_its_example(n: int, damped: bool) -> None:
    shipped = catalog(n, damped=damped)
    low, high = shipped.classes()[0][:2]
    text = " ".join(Outline(index([shipped])).text.split())
    aside = ", special values aside" if shipped.verdict(low, high).has_exceptions else ""
    assert bool(aside) is (n == 3 and not damped)
    assert (
        f"whatever the positive parameters of one{aside}, some parameters of the other give the"
        in text
    )


@pytest.mark.full
def test_the_order_by_groups_puts_what_is_related_side_by_side() -> None:
    """A2 and A6 are no group over positive parameters; over complex ones they are."""
    data = _data(page(catalog(4, damped=False)))
    positive, exact = (data["blocks"][view] for view in ("positive", "exact"))  # type: ignore[index]
    assert [2, 6] in exact and positive.index([6]) == positive.index([2]) + 1
    assert sorted(m for of in positive for m in of) == sorted(m for of in exact for m in of)
    assert data["groups"]["positive"] == [
        list(group) for group in catalog(4, damped=False).classes()
    ]  # type: ignore[index]


@pytest.mark.full
def test_the_first_view_is_that_of_positive_parameters() -> None:
    outline = Outline(page(catalog(4, damped=False)))
    chosen = [a["value"] for t, a in outline.elements if t == "option" and "selected" in a]
    assert chosen == ["exact", "positive"]  # above and below the diagonal
    checked = [
        a["value"]
        for t, a in outline.elements
        if t == "input" and a.get("name") == "domain" and "checked" in a
    ]
    assert checked == ["positive"]
