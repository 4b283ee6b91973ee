"""The page of models of several sizes: its counts, its fields, its words; in a browser: addresses,
searches, the panel, and no barrier.
"""

import io
import json
import re
import shlex
from itertools import combinations
from pathlib import Path

import pytest
from PIL import Image

import disting
from disting.catalogs import catalog
from disting.catalogs.sizes import SizesCatalog, sizes_catalog
from disting.conditions.inclusion import Inclusion
from disting.report import write_report
from disting.report.search import families
from disting.report.sizes import (
    LEFT_INSIDE,
    NO_LIMIT,
    NOT_KNOWN,
    between,
    limit,
    limits,
    sizes_page,
)
from disting.verdict.meaning import meaning_sentence
from disting.verdict.result import View
from tests.cli.process import called
from tests.report.barriers import barriers
from tests.report.links import follow_link

PAGE = "sizes-undamped.html"


@pytest.fixture(scope="module")
def whole() -> SizesCatalog:
    return sizes_catalog(damped=False)


@pytest.fixture(scope="module")
def found(whole: SizesCatalog) -> SizesCatalog:
    """Of 1 to 3 masses: 15 models."""
    return SizesCatalog(whole.catalogs[:3], whole.records)


@pytest.fixture(scope="module")
def opened(found: SizesCatalog) -> SizesCatalog:
    """The same; of 2:1 in 3:3 it is not known whether it is a limit."""
    unknown = {
        "inclusion": "unknown",
        "certainty": "",
        "safety": 0,
        "evidence": {},
        "reason": "no {limit} is known",
    }
    records = [
        r | {"inclusions": {"closure": unknown}}
        if (r.get("left"), r.get("right")) == ("2:1", "3:3")
        else r
        for r in found.records
    ]
    return SizesCatalog(found.catalogs, tuple(records))


def _unpacked(runs: list[int]) -> list[int]:
    told: list[int] = []
    for number in runs:
        told += [number] if number >= 0 else [told[-1]] * -number
    return told


def _across(found: SizesCatalog) -> list[tuple[int, int]]:
    numbers = range(1, len(found.family) + 1)
    return [(i, j) for i, j in combinations(numbers, 2) if found.size(i) != found.size(j)]


@pytest.mark.full
def test_counts_are_those_of_the_pairs(found: SizesCatalog) -> None:
    rows = {(b.small, b.large): (b.inside, b.outside, b.unknown) for b in between(found)}
    assert rows == {(1, 2): (3, 0, 0), (1, 3): (11, 0, 0), (2, 3): (31, 2, 0)}


@pytest.mark.full
def test_every_pair_has_its_limit_in_words(found: SizesCatalog) -> None:
    told = limits(found)
    entries, of = told["entries"], _unpacked(told["of"])  # type: ignore[arg-type]
    kinds = {Inclusion.LEFT_IN_RIGHT: 1, Inclusion.RIGHT_IN_LEFT: 2, Inclusion.NEITHER: 3}
    assert len(of) == 15 * 14 // 2
    for high in range(2, 16):
        for low in range(1, high):
            v = found.verdict(low, high, View.EXACT)
            kind, said, why = entries[of[(high - 1) * (high - 2) // 2 + low - 1]]  # type: ignore[index]
            assert kind == kinds.get(v.closure, 0)
            if v.inclusions is not None and v.inclusions.closure.evidence:
                assert why.startswith(v.inclusions.closure.evidence.sentence("{L}", "{R}"))
            if found.size(low) != found.size(high):
                assert ("{L} is a limit of {R}" in said) == (kind == LEFT_INSIDE)
                assert ("Neither is a limit" in said) == (kind == NO_LIMIT) and why


@pytest.mark.full
def test_the_page_says_it_in_words(found: SizesCatalog) -> None:
    text = sizes_page(found)
    assert "Chains of 1 to 3 masses, undamped" in text
    assert "disting verdicts 1-3 --undamped --json FILE" in text
    outside = [
        (found.names[i - 1], found.names[j - 1])
        for i, j in _across(found)
        if found.verdict(i, j, View.EXACT).closure is Inclusion.NEITHER
    ]
    assert outside == [("2:1", "3:3"), ("2:3", "3:3")]
    for left, right in outside:
        assert f'<a class="pairlink" href="#{left}-{right}">{left} in {right}</a>' in text
    assert "unknown; in the others" not in text and 'id="open"' not in text


@pytest.mark.full
def test_what_is_not_known_is_said(opened: SizesCatalog) -> None:
    text = sizes_page(opened)
    assert "for <strong>1</strong> this is\nunknown" in text
    assert "No (limit) is known." in text and 'id="open"' in text
    assert [b.unknown for b in between(opened)] == [0, 0, 1]
    assert NOT_KNOWN in {kind for kind, *_ in limits(opened)["entries"]}  # type: ignore[attr-defined]


@pytest.mark.slow
def test_the_page_of_all_sizes_is_no_larger_than_those_of_one(whole: SizesCatalog) -> None:
    assert len(sizes_page(whole).encode()) < 700_000


@pytest.fixture(scope="module")
def site(
    found: SizesCatalog, opened: SizesCatalog, tmp_path_factory: pytest.TempPathFactory
) -> Path:
    folder = tmp_path_factory.mktemp("sizes")
    write_report([catalog(3, damped=False)], folder, across=[found])
    beside = families(found.catalogs[2:])
    (folder / "opened.html").write_text(sizes_page(opened, beside=beside), encoding="utf-8")
    return folder


def _fits(tab) -> bool:  # type: ignore[no-untyped-def]
    return bool(tab.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0)


@pytest.mark.full
def test_a_pair_is_explained_and_can_be_taken_away(visit, found: SizesCatalog) -> None:  # type: ignore[no-untyped-def]
    tab = visit(PAGE + "#3:4-2:1")
    verdict = found.verdict(2, 8)
    assert tab.inner_text("#detail h3") == "2:1 and 3:4"
    assert tab.inner_text('#detail [data-slot="shown"]') == meaning_sentence(verdict)
    assert "2:1 is a limit of 3:4" in tab.inner_text('#detail [data-slot="limit"]')
    tab.click("#detail [data-slot=limits] summary")
    assert verdict.inclusions is not None and verdict.inclusions.closure.evidence
    why = verdict.inclusions.closure.evidence.sentence("2:1", "3:4")
    assert tab.inner_text('#detail [data-slot="reason"]').startswith(why)
    for side in ("left", "right"):
        assert tab.locator(f'#detail svg[data-slot="{side}"]').bounding_box()["width"] > 100
    shell = tab.inner_text('#detail [data-slot="shell"]')
    assert shell == "disting compare 2:1 3:4 --undamped"
    assert called(*shlex.split(shell)[1:]).stdout.startswith("DISTINGUISHABLE")
    python = tab.inner_text('#detail [data-slot="python"]')
    assert eval(python, {"disting": disting}).closure is Inclusion.LEFT_IN_RIGHT
    cited = tab.inner_text('#detail [data-slot="cited"]')
    assert f"{verdict.sentence} " in cited and cited.endswith(f"{PAGE}#2:1-3:4")
    follow_link(tab, '#detail [data-slot="right-name"]')
    assert tab.inner_text("h1").startswith("Model A4")


@pytest.mark.full
def test_every_spelling_in_an_address_leads_there(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(PAGE)
    for fragment, title in (
        ("#3%3A4-2%3A1", "2:1 and 3:4"),
        ("#2:A1-3:a4", "2:1 and 3:4"),
        ("#3:1-A4", "3:1 and 3:4"),
        ("#3:4", "3:4"),
        ("#3:4-3:4", "3:4"),
    ):
        visit(PAGE + fragment)
        assert tab.inner_text("#detail h3") == title, fragment
        assert tab.inner_text("#trouble") == ""


@pytest.mark.full
def test_an_address_that_names_no_model_says_so(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(PAGE + "#2:1-3:4")
    for fragment, said in (
        ("#99-3", "Say the number of masses"),
        ("#9:1-3:4", "not of 9"),
        ("#2:1-3:99", "There is no model 3:99"),
        ("#2:0-3:1", "There is no model 2:0"),
        ("#9:1", "no catalogue of 9 masses"),
        ("#2:1-3:4-3:5", "Type a model"),
    ):
        visit(PAGE + fragment)
        assert said in tab.inner_text("#trouble"), fragment
        assert not tab.is_visible("#detail")
    visit(PAGE + "#counts")
    assert tab.inner_text("#trouble") == "" and not tab.is_visible("#detail")


@pytest.mark.full
def test_all_searches_lead_to_two_sizes_and_to_one(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(PAGE)
    for typed, title in (("2:1 3:4", "2:1 and 3:4"), ("3:1 4", "3:1 and 3:4"), ("3:4", "3:4")):
        tab.fill("#find", typed)
        tab.press("#find", "Enter")
        assert tab.inner_text("#detail h3") == title
    for start, field in (("index.html", "#models"), ("chains-3-undamped.html", "#find")):
        tab = visit(start)
        if field == "#models":
            tab.check('input[value="undamped"]', force=True)
        tab.fill(field, "3:4 2:1")
        tab.press(field, "Enter")
        tab.wait_for_url(f"**/{PAGE}#*")
        assert tab.inner_text("#detail h3") == "2:1 and 3:4"
    tab = visit("index.html")
    tab.fill("#finder", "2:1 3:4")
    tab.wait_for_selector("#finds li")
    assert tab.inner_text("#finds li >> nth=0").startswith("2:1 and 3:4, undamped")
    tab.press("#finder", "Enter")
    tab.wait_for_url(f"**/{PAGE}#2:1-3:4")
    assert tab.inner_text("#detail h3") == "2:1 and 3:4"


@pytest.mark.full
def test_the_address_of_a_catalogue_leads_on_to_two_sizes(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit("chains-3-undamped.html#3:4-2:1")
    tab.wait_for_url(f"**/{PAGE}*")
    assert tab.inner_text("#detail h3") == "2:1 and 3:4"
    follow_link(tab, ".path >> text=3 masses")
    follow_link(tab, ".path >> text=Against other sizes")
    assert tab.inner_text("h1").startswith("Chains of 1 to 3 masses")


@pytest.mark.full
def test_a_model_of_no_page_has_no_link(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(PAGE + "#1:1-3:4")
    assert tab.get_attribute('#detail [data-slot="left-name"]', "href") is None
    assert (
        tab.get_attribute('#detail [data-slot="right-name"]', "href") == "models/3-undamped/4.html"
    )


def test_hover_and_keyboard_tell_the_limit(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(PAGE)
    tab.focus('[role="gridcell"]')
    for key in ("Home", "ArrowDown", "ArrowDown"):
        tab.keyboard.press(key)
    said = tab.evaluate("document.activeElement.getAttribute('aria-label')")
    assert said.startswith("1:1 and 2:") and said.endswith(
        "; 1:1 is a limit of " + said.split()[2][:-1]
    )
    assert tab.text_content("#readout") == said
    tab.keyboard.press("Enter")
    assert tab.is_visible("#detail")


@pytest.mark.full
def test_two_sizes_alone_and_what_is_asked_of_limits(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit("opened.html")
    tab.select_option("#only", "1-2")
    assert tab.get_attribute('[role="grid"]', "aria-rowcount") == "4"
    tab.fill("#find", "2:1 3:3")  # outside: all models come back
    tab.press("#find", "Enter")
    assert tab.get_attribute('[role="grid"]', "aria-rowcount") == "15"
    assert "is not known" in tab.inner_text('#detail [data-slot="limit"]')
    tab.select_option("#limit", "4")  # nothing goes wrong
    tab.check('input[value="group"]', force=True)
    tab.select_option("#only", "2-3")
    assert tab.get_attribute('[role="grid"]', "aria-rowcount") == "14"


@pytest.mark.thin(1)
@pytest.mark.parametrize(("width", "scheme"), [(320, "light"), (390, "dark"), (1280, "light")])
def test_the_page_has_no_serious_barrier_and_fits(visit, width: int, scheme: str) -> None:  # type: ignore[no-untyped-def]
    tab = visit("opened.html#2:1-3:4", width, scheme)
    assert _fits(tab)
    if width > 320:
        assert barriers(tab) == []


def test_the_data_of_the_page_is_small_text(found: SizesCatalog) -> None:
    data = re.search(r'id="data">(.*?)</script>', sizes_page(found), re.DOTALL)
    assert data and json.loads(data[1])["sizes"] == [[1, 1], [2, 3], [3, 11]]


SHEET = """() => Object.fromEntries(["limit", "open", "distinguishable", "indistinguishable"].map((name) => {
  const spare = document.createElement("i");
  spare.style.color = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`);
  document.body.append(spare);
  return [name, getComputedStyle(spare).color.match(/\\d+/g).map(Number)];
}))"""


@pytest.mark.full
def test_limits_have_a_colour_of_their_own(visit, found: SizesCatalog) -> None:  # type: ignore[no-untyped-def]
    """What the page is about is seen: fields of two sizes by limit, of one size by relation."""
    tab = visit(PAGE)
    tab.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")  # fmt: skip
    names = {tuple(colour): name for name, colour in tab.evaluate(SHEET).items()}
    cell, gutter, left, top = tab.evaluate(
        "() => ['cell', 'gutter', 'left', 'top'].map((k) => +document.getElementById('matrix').dataset[k])"
    )
    picture = Image.open(io.BytesIO(tab.locator("#matrix canvas").screenshot())).convert("RGB")
    kinds = {LEFT_INSIDE: "limit", NOT_KNOWN: "open", NO_LIMIT: "distinguishable"}
    seen = set()
    for i, j in combinations(range(1, len(found.family) + 1), 2):
        told = limit(found.verdict(i, j, View.EXACT))
        same = found.size(i) == found.size(j)
        wanted = found.relation(i, j, View.EXACT).value if same else kinds[told]
        x, y = (gutter + from_ + (k - 1 + 0.2) * cell for k, from_ in ((j, left), (i, top)))
        assert names[picture.getpixel((round(x), round(y)))] == wanted, (i, j)
        seen.add(wanted)
    assert {"limit", "distinguishable", "indistinguishable"} <= seen
