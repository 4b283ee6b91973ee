"""Every kind of page in a real browser: all of it can be seen and reached by everyone, nothing is
fetched, nothing goes wrong, every link leads somewhere, and the way to help is the same.

By default on the smallest phone and on a desk; all sizes and schemes, with the largest catalogue,
by hand.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

from disting.files import __version__
from tests.report.barriers import barriers
from tests.report.conftest import heard
from tests.report.links import dead_links, is_there, is_written_later, outline
from tests.report.page_kinds import LONG, REPORTS, SCHEMES, SHIPPED, SIGHTS, kinds, write_all
from tests.report.sight import out_of_sight
from tests.report.test_model_list import HOSTILE

pytestmark = pytest.mark.full

pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
KINDS, LARGEST = kinds(3), kinds(5)
# axe takes seconds: by default it looks at one page of each template
JUDGED = (
    "start, a machine described", "catalogue, a pair", "list of models",
    "family of networks, a model", "model", "sizes",
    "dampers, a pair", "next", "motion", "motion, presented", "guide, glossary", "guide, commands",
    "guide, notebook-bench-commissioned", "fit",
)  # fmt: skip
WITHOUT_SITE = ("alone",)  # folders of pages that lie anywhere
TALL = 12_000  # pixels: what is longer is folded or on several pages
TALL_GUIDE = 8_000  # a page of the guide that is longer is split by subject
SETTLED = "() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"


@dataclass(frozen=True, slots=True)
class View:
    """A window's width and height, its colours, and whether axe judges what it shows."""

    sight: tuple[int, int]
    scheme: str
    axe: bool = True


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("pages")
    write_all(folder, 3, whole=False)
    return folder


@pytest.fixture(scope="module")
def largest(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("largest")
    write_all(folder, 5, whole=True)
    return folder


def look(tab, address: str, views: Sequence[View]) -> list[object]:  # type: ignore[no-untyped-def]
    """What is wrong with a page as it is shown in one window after the other."""
    with heard(tab) as (troubles, requests):
        wrong = _seen(tab, address, views)
    return [*wrong, *troubles, *(url for url in requests if not url.startswith("file:"))]


def _seen(tab, address: str, views: Sequence[View]) -> list[object]:  # type: ignore[no-untyped-def]
    wrong = list[object]()
    for view in views:
        tab.set_viewport_size(dict(zip(("width", "height"), view.sight, strict=True)))
        tab.emulate_media(color_scheme=view.scheme, reduced_motion="reduce")
        if view is views[0]:
            tab.goto(address)
        if "motion-" in address:  # until machine 2 is found
            tab.wait_for_function(
                "() => document.getElementById('how').textContent", timeout=120_000
            )
        tab.evaluate(SETTLED)
        wrong += [(view, one) for one in out_of_sight(tab)]
        wrong += [(view, one) for one in barriers(tab)] if view.axe else []
    here = Path(tab.evaluate("decodeURIComponent(location.pathname)"))
    links = tab.eval_on_selector_all("a[href]", "all => all.map((a) => a.getAttribute('href'))")
    return [*wrong, *(link for link in set(links) if not is_there(here, link))]


@pytest.mark.parametrize("kind", KINDS)
def test_all_can_be_seen_and_reached(tab, site: Path, kind: str) -> None:  # type: ignore[no-untyped-def]
    turn = list(KINDS).index(kind) % 2 if kind in JUDGED else None
    views = [View(SIGHTS[0], "light", turn == 0), View(SIGHTS[-1], "dark", turn == 1)]
    assert look(tab, f"{site.as_uri()}/{KINDS[kind]}", views) == []


@pytest.mark.slow
@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("sight", SIGHTS, ids=str)
@pytest.mark.parametrize("kind", LARGEST)
def test_all_can_be_seen_and_reached_everywhere(
    tab, largest: Path, kind: str, sight, scheme: str
) -> None:  # type: ignore[no-untyped-def]
    assert look(tab, f"{largest.as_uri()}/{LARGEST[kind]}", [View(sight, scheme)]) == []


def test_no_other_page_scrolls_sideways_on_a_phone(tab, site: Path) -> None:  # type: ignore[no-untyped-def]
    tab.set_viewport_size({"width": 320, "height": 640})
    wide = []
    guide = [page for page in site.glob("guide/*.html") if page.stem not in (*LONG, "index")]
    assert len(guide) > 30
    for page in (*guide, *sorted(site.glob("models/*/*.html"))[::9]):
        tab.goto(page.as_uri())
        wide += [(page.name, one) for one in out_of_sight(tab)]
    assert wide == []


def heights(tab, pages: Sequence[Path]) -> dict[str, int]:  # type: ignore[no-untyped-def]
    """How tall pages are, in pixels, on a desk."""
    found = {}
    for page in pages:
        tab.goto(page.as_uri())
        found[f"{page.parent.name}/{page.name}"] = tab.evaluate(
            "document.documentElement.scrollHeight"
        )
    return found


def test_no_page_is_endless(tab, site: Path) -> None:  # type: ignore[no-untyped-def]
    written = [page for page in site.rglob("*.html") if page.parent.name not in SHIPPED]
    pages = sorted(written, key=lambda page: page.stat().st_size)[-6:]
    assert {name: high for name, high in heights(tab, pages).items() if high > TALL} == {}


def test_no_page_of_the_guide_is_higher_than_a_reader_scrolls(tab, site: Path) -> None:  # type: ignore[no-untyped-def]
    pages = sorted(site.glob("guide/*.html"), key=lambda page: -page.stat().st_size)
    assert len(pages) > 50
    found = heights(tab, pages[:15])
    assert {name: high for name, high in found.items() if high > TALL_GUIDE} == {}


@pytest.mark.slow
def test_no_shipped_page_is_endless(tab) -> None:  # type: ignore[no-untyped-def]
    found = heights(tab, sorted(REPORTS.rglob("*.html")))
    assert len(found) > 100
    assert {name: high for name, high in found.items() if high > TALL} == {}


def test_what_is_folded_opens_where_an_address_names_it_and_on_paper(tab, site: Path) -> None:  # type: ignore[no-untyped-def]
    for address in (
        "guide/python-disting.html#Chain.parameters",
        "guide/commands.html#disting-fit--masses",
    ):
        tab.goto(f"{site.as_uri()}/{address}")
        assert tab.locator(f"[id='{address.partition('#')[2]}']").is_visible(), address
        assert tab.locator("details.fold:not([open])").count() > 5
        tab.evaluate("dispatchEvent(new Event('beforeprint'))")
        assert tab.locator("details.fold:not([open])").count() == 0
        assert tab.evaluate("document.documentElement.scrollHeight") > TALL
    tab.goto(f"{site.as_uri()}/paper/index.html")
    tab.locator("#differing a").first.click()
    assert tab.locator(".claim:target").is_visible()


def test_what_is_wrong_would_be_found(tab, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    wrong = {
        "a button": ("<button></button>", "button-name"),
        "words": ('<p style="width: 4em; overflow: hidden">incomprehensibilities</p>', "cut off"),
        "a box": ('<p style="margin-left: -5em">words</p>', "before the page"),
        "a wide box": ('<p style="width: 99em">words</p>', "scrolls sideways"),
        "a covered one": ('<p style="position: fixed; top: 99vh">words<br>more</p>', "beyond"),
        "a field": (
            '<input type="text" style="width: 3em" aria-label="f" value="abcdefgh">',
            "cut",
        ),
        "a drawing": (
            '<svg width="40" height="20"><text x="30" y="9">long</text></svg>',
            "drawing",
        ),
        "a low box": ('<div style="height: 1em"><p>words<br>on<br>words</p></div>', "spills over"),
        "letters": ('<svg width="9" viewBox="0 0 99 30"><text y="20">m1</text></svg>', "too small"),
        "a link": ('<a href="nowhere.html">there</a>', "nowhere.html"),
        "an anchor": ('<a href="#nowhere">there</a>', "#nowhere"),
        "a script": ("<script>console.log('oh')</script>", "oh"),
        "a request": ('<img alt="i" src="http://localhost:9/i.png">', "localhost"),
    }
    bodies = "".join(body for body, _ in wrong.values())
    page = tmp_path / "page.html"
    page.write_text(
        f'<!doctype html><html lang="en"><title>t</title><main><h1>t</h1>{bodies}</main></html>',
        encoding="utf-8",
    )
    found = list(map(str, look(tab, page.as_uri(), [View((320, 640), "light")])))
    assert [
        name for name, (_, said) in wrong.items() if not any(said in one for one in found)
    ] == []


def test_no_link_of_any_page_is_dead_and_no_name_is_given_twice(site: Path) -> None:
    pages = [page for page in site.rglob("*.html") if "joint" not in page.parts]
    assert len(pages) > 50
    for page in pages:
        assert list(dead_links(page)) == [], page
        ids = [a["id"] for _, a in outline(page).elements if "id" in a]
        assert len(ids) == len(set(ids)), page


def test_a_page_that_is_left_out_is_one_that_the_command_writes() -> None:
    assert is_written_later("models/3-undamped/11.html") and is_written_later("next-5-damped.html")
    others = ("models/3-undamped/12.html", "models/3-undamped/1.html", "next-3-damped.html")
    assert not any(map(is_written_later, others))


def test_notebooks_are_listed_where_they_are(site: Path) -> None:
    names = sorted(path.stem for path in (site / "notebooks").glob("*.ipynb"))
    for address, root in (("index.html", "guide/"), ("guide/gallery.html", "")):
        links = {str(a["href"]) for _, a in outline(site / address).elements if "href" in a}
        assert [name for name in names if f"{root}notebook-{name}.html" not in links] == []
    assert len(names) == 6


def test_every_page_has_its_sign_the_product_and_help(site: Path) -> None:
    pages = [page for page in site.rglob("*.html") if page.parent.name != "paper"]
    alone = 0
    for page in pages:
        found, way = outline(page), page.relative_to(site).parts
        links = [str(a["href"]) for _, a in found.elements if "href" in a]
        assert found.count("link", rel="icon") == 1 and f"disting {__version__}" in found.text
        if way[0] in WITHOUT_SITE:
            alone += 1
            assert "Guide and glossary: disting report 3" in found.text and "--help" in found.text
            assert not any("index.html" in link for link in links)
            continue
        for name in ("index", "guide/start", "guide/index", "guide/glossary"):
            assert f"{'../' * (len(way) - 1)}{name}.html" in links, page
    assert alone == 8 + len(HOSTILE)  # fits, the question for the quantity, a plan, two looks


def test_coefficients_stay_inside_in_a_font_that_is_wider(tab, site: Path) -> None:  # type: ignore[no-untyped-def]
    """Which font for formulas a phone has is not known: letters of 1.4 times the width."""
    tab.goto(f"{site.as_uri()}/models/3-damped/8.html")
    for width in (320, 361, 390, 480):
        tab.set_viewport_size({"width": width, "height": 800})
        tab.evaluate(
            "document.querySelectorAll('.coefficients math').forEach((m) => {"
            " m.style.fontSize = '';"
            " m.style.fontSize = `${1.4 * parseFloat(getComputedStyle(m).fontSize)}px`; })"
        )
        assert tab.evaluate("document.documentElement.scrollWidth") <= width
        wider = "(d) => d.some((one) => one.scrollWidth > one.clientWidth)"
        assert tab.eval_on_selector_all(".coefficients dd", wider) or width > 320
