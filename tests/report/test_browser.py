"""The page in a real browser: select, move, switch, link; nothing is fetched and nothing goes wrong."""

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from disting.catalogs import catalog
from disting.report import page
from disting.report.words import VIEW_TITLES

playwright = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
pytestmark = pytest.mark.xdist_group("browser")
FIELD = '.view[data-view="{}"] .matrix tbody tr:nth-child({}) td:nth-child({})'


@pytest.fixture(scope="module")
def browser() -> Iterator[object]:
    with playwright.sync_playwright() as p:
        if not CHROMIUM and not Path(p.chromium.executable_path).exists():
            pytest.skip("no Chromium found, neither the system's nor Playwright's own")
        chromium = p.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
        yield chromium
        chromium.close()


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("report") / "small.html"
    path.write_text(page(catalog(3, damped=True)), encoding="utf-8")
    return path


@pytest.fixture
def visit(browser) -> Iterator[object]:  # type: ignore[no-untyped-def]
    """Open a file; at the end of the test: no message on the console, no request but for the file."""
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    tab, troubles, requests = context.new_page(), [], []
    tab.on("console", lambda message: troubles.append(message.text))
    tab.on("pageerror", lambda error: troubles.append(str(error)))
    tab.on("request", lambda request: requests.append(request.url.split("#")[0]))

    def go(path: Path, fragment: str = "", width: int = 1280) -> object:
        tab.set_viewport_size({"width": width, "height": 800})
        tab.goto(path.as_uri() + fragment)
        return tab

    yield go
    assert troubles == []
    assert set(requests) == {tab.url.split("#")[0]}
    context.close()


def _field(view: str, low: int, high: int) -> str:
    return FIELD.format(view, high - 1, low + 1)


def test_a_click_shows_both_chains_and_the_reason(visit, small: Path) -> None:  # type: ignore[no-untyped-def]
    tab = visit(small)
    assert not tab.is_visible("#detail")
    tab.check('input[value="all"]')
    tab.click(_field("markov", 1, 4))
    verdict = catalog(3, damped=True).verdict(1, 4)
    assert verdict.evidence is not None
    assert tab.inner_text("#detail h3") == "A1 and A4"
    assert tab.inner_text("#detail .why") == verdict.evidence.sentence("A1", "A4")
    assert tab.inner_text("#detail .formula") == verdict.evidence.formula
    for side, number in (("left", 1), ("right", 4)):
        box = tab.locator(f'#detail [data-slot="{side}"]').bounding_box()
        assert box["width"] > 150 and box["height"] > 50
        assert tab.get_attribute(f'#detail [data-slot="{side}"] use', "href") == f"#chain-{number}"
    assert tab.url.endswith("#1:4")
    assert tab.get_attribute(_field("tf", 1, 4), "aria-selected") == "true"


def test_the_keyboard_moves_opens_and_closes(visit, small: Path) -> None:  # type: ignore[no-untyped-def]
    tab = visit(small)
    tab.check('input[value="all"]')
    tab.focus(_field("tf", 1, 2))
    for key in ("ArrowDown", "ArrowDown", "ArrowRight", "End", "ArrowRight", "Control+End", "Home", "ArrowUp", "ArrowRight"):
        tab.keyboard.press(key)
    assert tab.evaluate("document.activeElement.getAttribute('aria-label')").startswith("A2 and A10: distinguishable")
    assert tab.locator('.view[data-view="tf"] td[tabindex="0"]').count() == 1
    tab.keyboard.press("Enter")
    assert tab.inner_text("#detail h3") == "A2 and A10"
    tab.keyboard.press("Escape")
    assert not tab.is_visible("#detail") and "#" not in tab.url
    assert tab.evaluate("document.activeElement.cellIndex") == 2


@pytest.mark.parametrize("fragment", ["#9:10", "#10:9", "#9%3A10"])
def test_a_deep_link_selects(visit, small: Path, fragment: str) -> None:  # type: ignore[no-untyped-def]
    tab = visit(small, fragment)
    assert tab.inner_text("#detail h3") == "A9 and A10"
    assert tab.inner_text("#detail .badge") == "indistinguishable"


@pytest.mark.parametrize("fragment", ["#0:3", "#4:4", "#1:99", "#models", "#%", "#1:2:3"])
def test_other_fragments_select_nothing(visit, small: Path, fragment: str) -> None:  # type: ignore[no-untyped-def]
    assert not visit(small, fragment).is_visible("#detail")


def test_links_to_undecided_pairs_open_them(visit, small: Path) -> None:  # type: ignore[no-untyped-def]
    tab = visit(small)
    tab.click(".pairlink >> nth=0")
    assert tab.inner_text("#detail .badge") == "distinguishable"
    assert "exact decision" in tab.inner_text("#detail")
    assert tab.inner_text('[data-slot="in-combined"]') == "undecided"


def test_the_views_switch(visit, small: Path) -> None:  # type: ignore[no-untyped-def]
    tab = visit(small, "#1:4")

    def visible() -> list[str]:
        return [view for view in VIEW_TITLES if tab.is_visible(f'[data-view="{view}"]')]

    assert visible() == ["exact", "positive"]
    assert tab.inner_text("#detail .badge") == "distinguishable"
    tab.check('input[value="tf"]')
    assert visible() == ["tf"]
    assert tab.inner_text("#detail .badge") == "undecided"
    tab.check('input[value="combined"]')
    assert visible() == ["combined"]
    assert tab.inner_text("#detail .badge") == "distinguishable"
    tab.check('input[value="all"]')
    assert visible() == list(VIEW_TITLES)


@pytest.mark.parametrize("width", [390, 1280])
def test_the_page_never_scrolls_sideways(visit, small: Path, width: int) -> None:  # type: ignore[no-untyped-def]
    tab = visit(small, "#2:5", width)
    assert tab.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0


def test_a_deep_link_stays_in_sight_on_a_phone(visit, small: Path) -> None:  # type: ignore[no-untyped-def]
    tab = visit(small, "#2:5", 390)
    tab.wait_for_timeout(100)
    field, sheet = (tab.locator(s).bounding_box() for s in (_field("exact", 2, 5), "#detail"))
    assert field["y"] > 0 and field["y"] + field["height"] < sheet["y"]


def test_printing_shows_all_views_and_no_controls(visit, small: Path) -> None:  # type: ignore[no-untyped-def]
    tab = visit(small, "#1:4")
    tab.check('input[value="tf"]')
    tab.emulate_media(media="print")
    assert all(tab.is_visible(f'[data-view="{v}"]') for v in VIEW_TITLES)
    assert not any(tab.is_visible(s) for s in ("#detail", ".controls", ".hint"))


def test_without_script_everything_static_is_there(browser, small: Path) -> None:  # type: ignore[no-untyped-def]
    context = browser.new_context(java_script_enabled=False)
    tab = context.new_page()
    tab.goto(small.as_uri())
    assert all(tab.is_visible(f'[data-view="{v}"]') for v in VIEW_TITLES)
    assert not tab.is_visible(".controls") and tab.is_visible("#A11 .chain")
    context.close()


def test_the_keyboard_walks_the_largest_family(visit, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    path = tmp_path / "large.html"
    path.write_text(page(catalog(5, damped=True)), encoding="utf-8")
    tab = visit(path, "#20:36")
    assert tab.inner_text("#detail h3") == "A20 and A36"
    tab.focus(_field("exact", 20, 36))
    tab.evaluate(
        """() => {
          for (let i = 0; i < 30; i++) {
            document.activeElement.dispatchEvent(new KeyboardEvent("keydown", {key: "ArrowDown", bubbles: true}));
          }
        }"""
    )
    assert tab.evaluate("document.activeElement.getAttribute('aria-label')").startswith("A20 and A66:")
