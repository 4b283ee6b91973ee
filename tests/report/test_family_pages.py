"""Pages of a family of networks in a real browser: found, drawn, told, saved."""

import io
from pathlib import Path
from xml.etree import ElementTree

import pytest
from PIL import Image

from disting import network_of
from disting.catalogs import catalog
from disting.catalogs.network_files import recall
from disting.general.any_model import of_network
from disting.general.model_files import ModelList
from disting.network.families import FAMILIES
from disting.report import network_svg, write_report
from disting.report.listing import Listing, judge
from disting.report.model_list import write_model_list
from disting.verdict.engine import Engine
from disting.verdict.result import View

PAIR_OF = "R1-p(R2,C1)", "p(R1,R2-C1)"
# some of the family, which has many pages
SOME = [n for n in FAMILIES["circuits-4"].networks if n.name in PAIR_OF or n.name.count("R") == 1]
PAIR = tuple([n.name for n in SOME].index(name) + 1 for name in PAIR_OF)


@pytest.fixture(scope="module")
def family():  # type: ignore[no-untyped-def]
    engine = Engine()
    recall("circuits-4", engine)  # as `disting report circuits-4` does
    return judge(ModelList(tuple(map(of_network, SOME))), engine)


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory, family) -> Path:  # type: ignore[no-untyped-def]
    folder = tmp_path_factory.mktemp("family")
    write_model_list(Listing(family, "Circuits & co", "list-circuits-4"), folder, site=True)
    write_report([catalog(2, damped=True)], folder)
    return folder


@pytest.mark.full
def test_a_pair_is_drawn_named_and_told(visit, family) -> None:  # type: ignore[no-untyped-def]
    low, high = PAIR
    tab = visit("list-circuits-4.html")
    tab.fill("#find", f"A{low}, p(R1,R2-C1)")
    tab.press("#find", "Enter")
    assert tab.url.endswith(f"#{low}-{high}")
    assert tab.inner_text("#detail h3") == f"A{low} and A{high}"
    assert tab.inner_text('[data-slot="left-name"]') == f"A{low}: R1-p(R2,C1)"
    assert tab.inner_text("#detail .badge") == "indistinguishable"
    assert tab.locator("#detail figure:visible svg.chain").count() == 2
    box = tab.locator('#detail [data-slot="left"] use').bounding_box()
    assert box["width"] > 80  # it refers to a drawing that is there
    assert tab.inner_text('[data-slot="shell"]') == 'disting compare "R1-p(R2,C1)" "p(R1,R2-C1)"'
    assert family.verdict(low, high, View.POSITIVE).relation.value == "indistinguishable"
    tab.click('[data-slot="left-name"]')
    assert tab.inner_text("h1") == f"Model A{low} R1-p(R2,C1)"
    assert tab.locator(f"#A{high} math").count() >= 3


@pytest.mark.full
def test_the_search_and_the_start_page_find_them(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit("index.html")
    assert tab.locator('a[href="list-circuits-4.html"]').count() == 1
    tab.fill("#finder", "p(r1,r2-c1)")
    tab.locator("#finds li").first.wait_for()
    assert tab.locator("#finds .what").first.inner_text() == "p(R1,R2-C1)"
    tab.locator("#finds li").first.click()
    tab.wait_for_url(f"**/models/list-circuits-4/{PAIR[1]}.html")


@pytest.mark.full
def test_no_page_is_endless(visit) -> None:  # type: ignore[no-untyped-def]
    for address in ("list-circuits-4.html", f"models/list-circuits-4/{PAIR[0]}.html"):
        for width in (1280, 390):
            tab = visit(address, width)
            assert tab.evaluate("document.documentElement.scrollHeight") < 12_000


@pytest.mark.full
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_drawing_is_saved_as_it_is_on_white_paper(visit, tmp_path: Path, scheme: str) -> None:  # type: ignore[no-untyped-def]
    tab = visit(f"models/list-circuits-4/{PAIR[0]}.html", scheme=scheme)
    for kind in ("svg", "png"):
        with tab.expect_download() as download:
            tab.click(f"text=Save {kind.upper()}")
        download.value.save_as(tmp_path / f"a.{kind}")
        assert download.value.suggested_filename == f"list-circuits-4-{PAIR[0]}.{kind}"
    written = (tmp_path / "a.svg").read_text("utf-8")
    assert "var(" not in written and "currentColor" not in written and "<use" not in written
    own = network_svg(network_of("R1-p(R2,C1)"))
    count = [sum(1 for _ in ElementTree.fromstring(t).iter(P)) for t in (written, own)]
    assert count[0] == count[1] > 5
    image = Image.open(io.BytesIO((tmp_path / "a.png").read_bytes())).convert("RGB")
    assert image.getpixel((1, 1)) == (255, 255, 255) and image.convert("L").getextrema()[0] < 80


P = "{http://www.w3.org/2000/svg}path"


@pytest.mark.full
def test_a_pair_is_saved_side_by_side(visit, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    tab = visit(f"list-circuits-4.html#{PAIR[0]}-{PAIR[1]}")
    with tab.expect_download() as download:
        tab.click("#detail >> text=Save SVG")
    download.value.save_as(tmp_path / "pair.svg")
    texts = [t.text for t in ElementTree.parse(tmp_path / "pair.svg").iter(P.replace("path", "text"))]  # fmt: skip
    assert sorted(t for t in texts if t not in "+-") == sorted(["R1", "R2", "C1"] * 2)
