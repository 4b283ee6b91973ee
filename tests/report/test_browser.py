"""The site in a real browser: select, move, search, filter, link; nothing is fetched, nothing
goes wrong, all can use it.
"""

import json
import re
import shlex
from dataclasses import replace
from pathlib import Path

import pytest

import disting
from disting.catalogs import catalog
from disting.report import page, write_report
from disting.verdict.meaning import meaning_sentence
from disting.verdict.result import View
from tests.cli.process import called
from tests.report.links import follow_link

pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
CURSOR = '[role="gridcell"]'
SMALL, LARGE, START = "chains-3-damped.html", "chains-4-damped.html", "index.html"


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    (folder / LARGE).write_text(page(catalog(4, damped=True)), encoding="utf-8")
    write_report([catalog(3, damped=False), catalog(3, damped=True)], folder)
    return folder


def _place(tab, row: int, column: int) -> dict[str, float]:  # type: ignore[no-untyped-def]
    """Middle of a field on the page, from the size of the fields and the cursor's place."""
    box = tab.locator("#matrix").bounding_box()
    side = float(tab.get_attribute("#matrix", "data-cell"))
    return {"x": box["x"] + 42 + (column - 0.5) * side, "y": box["y"] + 42 + (row - 0.5) * side}


def _settle(tab) -> None:  # type: ignore[no-untyped-def]
    tab.evaluate(
        "() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
    )


def _colour(tab, row: int, column: int) -> tuple[int, ...]:  # type: ignore[no-untyped-def]
    """Colour near the upper left corner of a field, where neither number nor mark is."""
    _settle(tab)
    return tuple(
        tab.evaluate(
            """([row, column]) => {
              const host = document.getElementById("matrix"), side = +host.dataset.cell;
              const at = (place) => Math.round((42 + (place - 1) * side + side * 0.2) * devicePixelRatio);
              const one = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
              one.drawImage(host.querySelector("canvas"), -at(column), -at(row));
              return [...one.getImageData(0, 0, 1, 1).data.slice(0, 3)];
            }""",
            [row, column],
        )
    )


BLUE, ORANGE = (0, 114, 178), (240, 168, 24)


@pytest.mark.full
def test_a_click_shows_both_chains_and_the_reason(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL)
    assert not tab.is_visible("#detail")
    tab.mouse.click(**_place(tab, 4, 1))
    verdict = catalog(3, damped=True).verdict(1, 4)
    assert verdict.evidence is not None
    assert tab.inner_text("#detail h3") == "A1 and A4"
    here = replace(verdict, left="A1", right="A4")  # as a page of one size calls them
    assert tab.inner_text("#detail .shown") == meaning_sentence(here)
    assert not tab.is_visible("#detail .why")
    tab.click("#detail summary")
    assert tab.inner_text("#detail .why") == verdict.evidence.sentence("A1", "A4")
    assert tab.inner_text("#detail .formula") == verdict.evidence.formula
    for side, number in (("left", 1), ("right", 4)):
        box = tab.locator(f'#detail svg[data-slot="{side}"]').bounding_box()
        assert box["width"] > 150 and box["height"] > 50
        assert tab.get_attribute(f'#detail [data-slot="{side}"] use', "href") == f"#chain-{number}"
    assert tab.url.endswith("#1-4")
    shell = tab.inner_text('#detail [data-slot="shell"]')
    assert called(*shlex.split(shell)[1:]).stdout.startswith(verdict.relation.upper())
    python = tab.inner_text('#detail [data-slot="python"]')
    assert eval(python, {"disting": disting}).relation is verdict.relation
    cited = tab.inner_text('#detail [data-slot="cited"]')
    assert str(verdict.relation) in cited and cited.endswith(tab.url)


TOLD = """async (pairs) => {
  const told = [], at = (selector) => document.querySelector(selector);
  for (const pair of pairs) {
    const heard = new Promise((done) => addEventListener("hashchange", () => setTimeout(done), { once: true }));
    location.hash = pair;
    await heard;
    const curves = at("[data-slot=curves]").checkVisibility() ? at("#curves-said").innerText : "";
    told.push([at("[data-slot=title]").textContent, curves, at("[data-slot=shown]").innerText]);
  }
  return told;
}"""


@pytest.mark.full
def test_two_curves_fall_as_the_sentence_says(visit) -> None:  # type: ignore[no-untyped-def]
    """Where the curves fall unequally towards high frequencies, both are drawn with example values;
    what they do is computed from the curves, the sentence from degrees.
    """
    tab, drawn = visit(SMALL), {}
    pairs = list(catalog(3, damped=True).pairs(View.POSITIVE))
    texts = tab.evaluate(TOLD, [f"{low}-{high}" for low, high, _ in pairs])
    for (low, high, found), (title, curves, said) in zip(pairs, texts, strict=True):
        assert title == f"A{low} and A{high}"
        if curves:
            assert found.decided_by == "1"
            drawn[low, high] = curves
        else:
            assert "a decade more" not in said, (low, high)
    ends = r"stays level|falls by (\d+) dB a decade"
    falls = {pair: [int(fall or 0) for fall in re.findall(ends, drawn[pair])] for pair in drawn}
    ranks = {row.number: row for row in catalog(3, damped=True).rows}
    assert len(drawn) == 26 and all(
        fall == 20 * (ranks[number].denominator_degree - ranks[number].numerator_degree)
        for pair, both in falls.items()
        for number, fall in zip(pair, both, strict=True)
    )
    assert tab.locator("#curves path.curve").count() == 2


@pytest.mark.full
def test_below_and_above_the_diagonal_are_two_views(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL)
    tab.mouse.click(**_place(tab, 2, 5))
    assert "over complex parameters (condition 6" in tab.inner_text("#detail .badges")
    tab.mouse.click(**_place(tab, 5, 2))
    assert "over positive parameters (equivalents with positive parameters)" in tab.inner_text(
        "#detail .badges"
    )
    tab.select_option("#below", "tf")
    tab.mouse.click(**_place(tab, 4, 1))
    assert tab.inner_text("#detail .badge") == "undecided"


@pytest.mark.full
def test_the_drawing_shows_the_relations(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL)
    shipped = catalog(3, damped=True)
    for row, column in ((5, 2), (2, 5), (11, 1), (10, 9), (3, 1), (1, 3), (8, 6)):
        same = shipped.relation(row, column, View.EXACT).value == "indistinguishable"
        assert _colour(tab, row, column) == (ORANGE if same else BLUE)


@pytest.mark.full
def test_a_filter_dims_what_is_not_asked_for(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL)
    tab.uncheck('input[name="distinguishable"]')
    assert _colour(tab, 5, 2) == ORANGE and _colour(tab, 3, 1) != BLUE
    tab.check('input[name="distinguishable"]')
    tab.select_option("#group", "1")
    assert (
        _colour(tab, 11, 1) == ORANGE
        and _colour(tab, 5, 2) != ORANGE
        and _colour(tab, 3, 1) != BLUE
    )


@pytest.mark.full
def test_the_order_by_group_puts_blocks_on_the_diagonal(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit("chains-3-undamped.html")
    largest = max(len(g) for g in catalog(3, damped=False).classes())
    tab.check('input[value="group"]', force=True)
    for row in range(1, largest + 1):
        assert all(_colour(tab, row, column) == ORANGE for column in range(1, row))
    assert _colour(tab, largest + 1, 1) == BLUE


@pytest.mark.full
def test_the_keyboard_moves_opens_zooms_and_closes(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL)
    tab.focus(CURSOR)
    assert tab.get_attribute(CURSOR, "aria-label").startswith("A1 and A2: distinguishable")
    for key in (
        "ArrowDown",
        "ArrowDown",
        "ArrowRight",
        "End",
        "ArrowLeft",
        "Control+End",
        "Home",
        "ArrowUp",
        "ArrowRight",
    ):
        tab.keyboard.press(key)
    label = "document.activeElement.getAttribute('aria-label')"
    assert tab.evaluate(label).startswith("A2 and A10: distinguishable")
    assert tab.get_attribute(CURSOR, "aria-colindex") == "2"
    assert tab.get_attribute('[role="row"]', "aria-rowindex") == "10"
    tab.keyboard.press("Enter")
    assert tab.inner_text("#detail h3") == "A2 and A10"
    size = float(tab.get_attribute("#matrix", "data-cell"))
    tab.keyboard.press("+")
    _settle(tab)
    assert float(tab.get_attribute("#matrix", "data-cell")) > size
    tab.keyboard.press("0")
    tab.keyboard.press("Escape")
    assert not tab.is_visible("#detail") and "#" not in tab.url
    assert tab.evaluate(label).startswith("A2 and A10")


@pytest.mark.full
def test_the_focus_is_seen(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL)
    tab.focus(CURSOR)
    tab.keyboard.press("ArrowDown")
    assert tab.evaluate("getComputedStyle(document.activeElement).outlineStyle") == "solid"
    field, cursor = _place(tab, 3, 1), tab.locator(CURSOR).bounding_box()
    assert cursor["x"] < field["x"] < cursor["x"] + cursor["width"]
    assert cursor["y"] < field["y"] < cursor["y"] + cursor["height"]


@pytest.mark.full
def test_the_wheel_zooms_where_the_pointer_is_and_dragging_moves(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(LARGE)
    tab.evaluate("document.getElementById('matrix').scrollIntoView({behavior: 'instant'})")
    tab.mouse.click(**_place(tab, 25, 12))
    size, at = float(tab.get_attribute("#matrix", "data-cell")), _place(tab, 25, 12)
    tab.mouse.move(**at)
    for _ in range(4):
        tab.mouse.wheel(0, -200)
    _settle(tab)
    assert float(tab.get_attribute("#matrix", "data-cell")) > 2 * size
    tab.mouse.click(**at)
    assert tab.inner_text("#detail h3") == "A12 and A25"
    tab.mouse.down()
    tab.mouse.move(at["x"] + 60, at["y"] + 3, steps=4)
    tab.mouse.up()
    assert tab.inner_text("#detail h3") == "A12 and A25"
    tab.mouse.click(at["x"] + 60, at["y"] + 3)
    assert tab.inner_text("#detail h3") == "A12 and A25"


@pytest.mark.full
def test_a_deep_link_selects(visit) -> None:  # type: ignore[no-untyped-def]
    for fragment in ("#9-10", "#10-9", "#A9-A10", "#3:9-3:10", "#3%3A10-A9"):
        tab = visit(SMALL + fragment)
        tab.reload()
        assert tab.inner_text("#detail h3") == "A9 and A10"
        assert tab.inner_text("#detail .badge") == "indistinguishable"


@pytest.mark.full
def test_other_fragments_select_nothing_and_say_why_where_they_name_models(visit) -> None:  # type: ignore[no-untyped-def]
    for fragment, said in (
        ("#0-3", "There is no model 3:0: the models of 3 masses are 3:1 to 3:11."),
        ("#1-99", "There is no model 3:99"),
        ("#models", ""),
        ("#%", ""),
        ("#1-2-3", "Type a model such as 3:2"),
        ("#A0", "There is no model 3:0"),
        ("#A12", "There is no model 3:12"),
        ("#9:10", "There is no catalogue of 9 masses"),
        ("#3:1-4:5", "a command answers: disting compare 3:1 4:5 --damped"),
    ):
        tab = visit(SMALL + fragment)
        assert not tab.is_visible("#detail"), fragment
        told = tab.inner_text("#trouble")
        assert said in told if said else not told, fragment


@pytest.mark.full
def test_what_was_selected_is_closed_by_an_address_that_names_nothing(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL + "#1-4")
    visit(SMALL + "#1-99")
    assert not tab.is_visible("#detail") and tab.inner_text("#trouble")
    visit(SMALL + "#1-4")
    assert tab.is_visible("#detail") and not tab.inner_text("#trouble")


@pytest.mark.full
def test_a_deep_link_to_a_model_leads_on_to_its_page(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL + "#A5")
    assert tab.inner_text("#detail h3") == "A5"
    assert "indistinguishable from 1 (A2)" in tab.inner_text("#detail .shown")
    follow_link(tab, '#detail [data-slot="link"] a')
    assert tab.inner_text("h1").startswith("Model A5")
    follow_link(tab, "text=Verdict and evidence")
    assert tab.inner_text("#detail h3") == "A2 and A5"


@pytest.mark.full
def test_the_search_finds_models_and_pairs(visit) -> None:  # type: ignore[no-untyped-def]
    tab, pair = visit(SMALL), "A2 and A5"
    for typed, found in (
        ("3:7", "A7"),
        ("8", "A8"),
        ("a9", "A9"),
        ("3:2 3:5", pair),
        ("7 3", "A3 and A7"),
        ("2-5", pair),
        ("3:2 A5", pair),
    ):
        tab.fill("#find", typed)
        tab.press("#find", "Enter")
        assert tab.inner_text("#detail h3") == found


@pytest.mark.full
def test_the_search_says_what_it_does_not_find(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL)
    for typed in ("", "x", "3:12", "2 99", "3:1 4:1", "0"):
        tab.fill("#find", typed)
        tab.press("#find", "Enter")
        assert tab.inner_text("#trouble") and not tab.is_visible("#detail"), typed


@pytest.mark.full
def test_the_search_says_where_what_no_page_shows_is_answered(visit) -> None:  # type: ignore[no-untyped-def]
    for address, field, said in ((SMALL, "#find", "#trouble"), (START, "#models", "#said")):
        tab = visit(address)
        for typed, command in (
            ("3:1 4:5", "disting compare 3:1 4:5 --damped"),
            ("3:1+lag+b2 3:4+delay", "disting compare 3:1+b2+lag 3:4+delay --damped"),
            ("3:1+delay", "disting compare 3:1+delay 3:.. --damped"),
        ):
            tab.fill(field, typed)
            tab.press(field, "Enter")
            assert tab.inner_text(said).endswith(f"a command answers: {command}"), typed


@pytest.mark.full
def test_the_search_leads_to_other_catalogues(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL)
    tab.fill("#find", "4:17 4:23")
    tab.press("#find", "Enter")
    tab.wait_for_url(f"**/{LARGE}#17-23")
    assert tab.inner_text("#detail h3") == "A17 and A23"


@pytest.mark.full
def test_the_start_page_leads_to_a_model_and_to_a_pair(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(START)
    tab.fill("#models", "3:5")
    tab.press("#models", "Enter")
    tab.wait_for_url("**/models/3-damped/5.html")
    tab = visit(START)
    tab.check('input[value="undamped"]', force=True)
    tab.fill("#models", "3:11 3:1")
    tab.click("text=Go")
    tab.wait_for_url("**/chains-3-undamped.html#1-11")
    assert tab.inner_text("#detail h3") == "A1 and A11"


@pytest.mark.full
def test_the_start_page_says_what_it_does_not_find(visit) -> None:  # type: ignore[no-untyped-def]
    tab, said = visit(START), set()
    for typed in ("", "5", "9:1", "3:12", "3:1 2:1"):
        tab.fill("#models", typed)
        tab.press("#models", "Enter")
        said.add(tab.inner_text("#said"))
    assert len(said) == 5 and "" not in said and tab.url.endswith(START)


@pytest.mark.full
def test_one_click_leads_from_the_start_to_the_reason(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(START)
    follow_link(tab, ".example figcaption a >> nth=0")
    assert tab.inner_text("#detail .badge") == "indistinguishable"


@pytest.mark.full
def test_links_to_undecided_pairs_open_them(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL)
    follow_link(tab, ".pairlink >> nth=0")
    assert tab.inner_text("#detail .badge") == "distinguishable"
    assert "exact decision" in tab.inner_text("#detail")
    assert tab.text_content('[data-slot="in-combined"]') == "undecided"


@pytest.mark.full
def test_mathematics_is_typeset_without_a_script(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit("models/3-damped/1.html")
    box = tab.locator(".display math").bounding_box()
    assert box["height"] > 30 and box["width"] > 100  # a fraction, not a line of letters
    tab.click(".latex summary >> nth=-1")
    tab.click("[data-copy] >> nth=-1")
    assert "Cop" in tab.inner_text("[data-copy] >> nth=-1") or "Ctrl" in tab.inner_text(
        "[data-copy] >> nth=-1"
    )


@pytest.mark.full
@pytest.mark.parametrize("masses", [4, pytest.param(5, marks=pytest.mark.slow)])
@pytest.mark.parametrize("width", [320, 390])
def test_the_names_of_the_last_fields_are_whole(visit, site: Path, width: int, masses: int) -> None:  # type: ignore[no-untyped-def]
    shown, name = catalog(masses, damped=True), f"last-{masses}.html"
    (site / name).write_text(page(shown), encoding="utf-8")
    tab, last = visit(name, width), len(shown.family)
    tab.evaluate(
        """() => {
          window.written = [];
          const of = CanvasRenderingContext2D.prototype, fill = of.fillText;
          of.fillText = function (text, ...rest) {
            const { e, f } = this.getTransform();
            window.written.push([text, this.canvas.width - e, this.canvas.height - f]);
            fill.call(this, text, ...rest);
          };
        }"""
    )
    tab.evaluate("(pair) => { location.hash = pair; }", f"#{last - 1}-{last}")
    _settle(tab)
    written = [one for one in tab.evaluate("window.written") if one[0].startswith("A")]
    assert {f"A{last - 1}", f"A{last}"} <= {text for text, _, _ in written}
    half = 5.5 * tab.evaluate("devicePixelRatio")  # of a name's height
    assert all(right >= half and below >= half for _, right, below in written)


@pytest.mark.full
@pytest.mark.parametrize("width", [390, 1280])
def test_a_deep_link_stays_in_sight(visit, width: int) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL + "#9-10", width)
    _settle(tab)
    field, sheet = (tab.locator(s).bounding_box() for s in (CURSOR, "#detail"))
    below = sheet["y"] if width == 390 else 800
    assert field["y"] > 0 and field["y"] + field["height"] < below


@pytest.mark.full
def test_printing_shows_the_matrix_and_no_controls(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(SMALL + "#1-4")
    tab.emulate_media(media="print")
    assert tab.is_visible("#matrix canvas") and tab.is_visible("#groups")
    assert tab.is_visible("#relations .key >> nth=0")
    assert not any(
        tab.is_visible(s)
        for s in ("#detail", ".tools", "#relations input >> nth=0", "#group", "#keys")
    )


@pytest.mark.full
def test_without_script_everything_static_is_there(browser, site: Path) -> None:  # type: ignore[no-untyped-def]
    context = browser.new_context(java_script_enabled=False)
    tab = context.new_page()
    tab.goto(f"{site.as_uri()}/{SMALL}")
    assert tab.is_visible(".still") and tab.locator(".still").evaluate("e => e.naturalWidth") > 100
    assert not tab.is_visible(".tools") and tab.is_visible("#row-11 .chain")
    context.close()


@pytest.mark.full
def test_no_field_of_millions_is_lost(visit, site: Path) -> None:  # type: ignore[no-untyped-def]
    """2336 models on a few hundred pixels: the one indistinguishable pair is seen, found and
    opened.
    """
    text, low, high, models = (site / SMALL).read_text(encoding="utf-8"), 1001, 2002, 2336
    found = re.search(r'(?<=id="data">).*?(?=</script>)', text)
    assert found
    data = json.loads(found[0])
    kinds = [data["texts"][entry[0]] for entry in data["entries"]]
    apart, same = kinds.index("distinguishable"), kinds.index("indistinguishable")
    before, after = (high - 1) * (high - 2) // 2 + low - 1, models * (models - 1) // 2
    runs = [apart, -(before - 1), same, apart, -(after - before - 2)]
    data |= {
        "models": models,
        "sizes": [[3, models]],
        "groups": {domain: [[low, high]] for domain in data["groups"]},
        "views": dict.fromkeys(data["views"], runs),
    }
    (site / "chains-9-damped.html").write_text(
        text.replace(found[0], json.dumps(data)), encoding="utf-8"
    )
    tab = visit("chains-9-damped.html")
    seen = """() => {
      const canvas = document.querySelector("#matrix canvas");
      const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true });
      copy.drawImage(canvas, 0, 0);
      const pixels = copy.getImageData(0, 0, canvas.width, canvas.height).data;
      let count = 0;
      for (let i = 0; i < pixels.length; i += 4) count += pixels[i] === 240 && pixels[i + 1] === 168 && pixels[i + 2] === 24;
      return count;
    }"""
    assert float(tab.get_attribute("#matrix", "data-cell")) < 1
    assert tab.evaluate(seen) >= 2
    tab.fill("#find", f"{low} {high}")
    tab.press("#find", "Enter")
    assert tab.inner_text("#detail .badge") == "indistinguishable"


@pytest.mark.full
def test_the_keyboard_walks_a_large_family(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit(LARGE + "#12-14")
    assert tab.inner_text("#detail h3") == "A12 and A14"
    tab.focus(CURSOR)
    for _ in range(12):
        tab.keyboard.press("ArrowDown")
    assert tab.evaluate("document.activeElement.getAttribute('aria-label')").startswith(
        "A12 and A26:"
    )
