"""What to measure next, on pages."""

from pathlib import Path

import pytest

from disting.catalogs import catalog
from disting.catalogs.next_files import next_catalog
from disting.report import model_page, write_report
from disting.report.next_steps import advice, for_pairs, found_for
from disting.report.page import next_page

DAMPED = catalog(3, damped=True)


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    write_report([DAMPED], folder)
    return folder


def test_a_table_of_a_model_says_what_the_truth_is():
    told = advice(found_for(DAMPED), 2)
    assert told is not None and told.others == (5,)
    cells = {title: [cell.text for cell in cells] for title, _, cells in told.rows}
    assert cells["known inertia added there"] == [
        "not if that is mass 3 of A5",
        "not if that is mass 2 of A5",
        "not if that is mass 1 of A5",
    ]
    assert cells["sensor there, one more or moved"] == ["surely", "tells nothing new", "surely"]


def test_a_model_that_is_alone_has_no_section():
    assert advice(found_for(DAMPED), 3) is None
    assert "What to measure next" not in model_page(DAMPED, 3)
    assert "What to measure next" in model_page(DAMPED, 2)


def test_every_pair_of_a_group_has_a_sentence():
    assert for_pairs(next_catalog(3, damped=True)).keys() == {"1-11", "2-5", "9-10"}
    assert len(for_pairs(next_catalog(3, damped=False))) == 12
    assert for_pairs(None) == {}


def test_the_page_names_every_structure_of_a_group_once():
    text = next_page(DAMPED, next_catalog(3, damped=True))
    assert [text.count(f'id="A{m}"') for m in range(1, 12)] == [1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 1]


def test_a_catalogue_with_other_groups_says_nothing():
    assert found_for(catalog(1, damped=False)) is None


@pytest.mark.full
def test_the_panel_says_what_to_measure_next(visit):
    page = visit("chains-3-damped.html#2-5")
    line = page.locator('[data-slot="next"]')
    assert line.inner_text().startswith("To measure next: A sensor at any further mass")
    page = visit("chains-3-damped.html#2-4")
    assert page.locator('[data-slot="next"]').inner_text() == ""


@pytest.mark.full
def test_a_link_to_a_structure_opens_its_group_and_lands_there(visit):
    page = visit("next-3-damped.html#A10")
    assert page.evaluate("document.getElementById('A10').closest('details').open")
    assert page.locator("details[open]").count() == 1
    box = page.locator("#A10").bounding_box()
    assert 0 <= box["y"] < 800 - min(box["height"], 700)
    page.click(".numbers >> text=A2")
    assert page.locator("#A2").is_visible() and not page.locator("#A11").is_visible()


@pytest.mark.full
@pytest.mark.parametrize("masses", [4, pytest.param(5, marks=pytest.mark.slow)])
def test_the_page_of_a_large_catalogue_is_short_and_its_tables_fit(tab, tmp_path: Path, masses):
    page = next_page(catalog(masses, damped=False), next_catalog(masses, damped=False))
    (tmp_path / "next.html").write_text(page, "utf-8")
    for width in (1280, 390):
        tab.set_viewport_size({"width": width, "height": 800})
        tab.goto((tmp_path / "next.html").as_uri())
        assert tab.evaluate("document.documentElement.scrollHeight") < 12_000
    tab.set_viewport_size({"width": 1280, "height": 800})
    tab.goto((tmp_path / "next.html").as_uri() + "#A7")
    tab.reload()
    table = tab.locator("#A7 .scroll")
    assert table.evaluate("(box) => box.scrollWidth <= box.clientWidth")


@pytest.mark.full
@pytest.mark.parametrize("width", [1280, 390])
def test_the_panel_draws_what_it_proposes(visit, width):
    page = visit("chains-3-damped.html#2-5", width=width)
    drawings = page.locator('[data-slot="sketches"] svg')
    assert drawings.first.get_attribute("aria-label").startswith("A2: a sensor at mass ")
    assert drawings.count() >= 4 and drawings.first.bounding_box()["width"] > 100
    page = visit("chains-3-damped.html#2-4", width=width)
    assert page.locator('[data-slot="sketches"] svg').count() == 0
