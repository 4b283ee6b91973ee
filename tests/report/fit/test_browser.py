"""The page of a fit in a real browser: sort, scroll, print; nothing is fetched and nothing goes
wrong.
"""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from disting.fit.judge.members import Twin
from disting.fit.results.selection import Selection
from disting.measurement import FrequencyResponse
from disting.model.chain import Chain
from disting.report.fit import fit_page
from disting.report.fit.links import Site, next_steps
from disting.report.fit.style import FigureFiles
from tests.report.conftest import heard
from tests.report.links import follow_link

REPORTS = Path(__file__).parents[3] / "reports"


@pytest.fixture(scope="module")
def page(
    selection: Selection,
    train: FrequencyResponse,
    starts: FigureFiles,
    tmp_path_factory: pytest.TempPathFactory,
) -> Path:
    path = tmp_path_factory.mktemp("browser") / "fit.html"
    path.write_text(fit_page(selection, [], [starts], train), encoding="utf-8")
    return path


@pytest.fixture
def opened(tab, page: Path) -> Iterator[object]:  # type: ignore[no-untyped-def]
    """The page; at the end of the test: no message on the console, no request but for the file."""
    with heard(tab) as (troubles, requests):
        tab.goto(page.as_uri())
        yield tab
    assert troubles == []
    assert requests == [page.as_uri()]


@pytest.mark.full
def test_columns_sort_both_ways_infinite_numbers_last(opened, selection: Selection) -> None:  # type: ignore[no-untyped-def]
    def column(n: int) -> list[float]:
        cells = opened.locator(f".candidates tbody tr td:nth-child({n})").all()
        return [float(cell.get_attribute("data-value") or cell.inner_text()) for cell in cells]

    for n, head in ((3, "J cross-validated"), (5, "J train"), (6, "Parameters"), (8, "PII ratio")):
        before = column(n)
        opened.get_by_role("button", name=head).click()
        assert column(n) == sorted(before)
        assert opened.locator('th[aria-sort="ascending"]').inner_text().count(head) == 1
        opened.get_by_role("button", name=head).click()
        assert column(n) == sorted(before, reverse=True)
    opened.get_by_role("button", name="Rank").click()
    assert column(1) == list(range(1, len(selection.candidates) + 1))


@pytest.mark.full
def test_figures_follow_light_and_dark(opened) -> None:  # type: ignore[no-untyped-def]
    def paper() -> str:
        return str(opened.evaluate("getComputedStyle(document.querySelector('.plot path')).fill"))

    light = paper()
    opened.emulate_media(color_scheme="dark")
    assert (light, paper()) == ("rgb(255, 255, 255)", "rgb(26, 33, 41)")


@pytest.mark.full
def test_reasons_open_on_demand(opened) -> None:  # type: ignore[no-untyped-def]
    reasons = opened.locator(".candidates details").first
    assert not reasons.locator("span").first.is_visible()
    reasons.locator("summary").click()
    assert "exceeds" in reasons.locator("span").first.inner_text()


@pytest.mark.full
def test_a_command_is_copied_whole(opened, selection: Selection) -> None:  # type: ignore[no-untyped-def]
    opened.context.grant_permissions(["clipboard-read", "clipboard-write"])
    button = opened.locator("#next .command button").first
    button.click()
    opened.wait_for_function(
        "document.querySelector('#next .command button').textContent !== 'Copy'"
    )
    assert opened.evaluate("getSelection().toString()") == next_steps(selection)[0].command
    opened.context.clear_permissions()


@pytest.mark.full
def test_commands_break_between_their_words(opened) -> None:  # type: ignore[no-untyped-def]
    """On a phone --damped stays one word, and the command is read to its end."""
    opened.set_viewport_size({"width": 390, "height": 844})
    code = opened.locator("#next .command code").first
    heights = code.evaluate(
        "(e) => [...e.children].slice(0, 4).map((word) => word.getClientRects().length)"
    )
    assert heights == [1, 1, 1, 1]
    assert code.evaluate("(e) => e.scrollWidth - e.clientWidth") <= 0


@pytest.mark.full
def test_structures_lead_to_the_catalogue(
    tab,  # type: ignore[no-untyped-def]
    selection: Selection,
    train: FrequencyResponse,
    starts: FigureFiles,
    tmp_path: Path,
) -> None:
    """To the model's page, and to the model among those with ground dampers."""
    (first,) = selection.members
    loaded = Twin(Chain(3, damped=True, ground_dampers=(2,)), {})
    found = replace(selection, members=(replace(first, twins=(loaded,)),))
    text = fit_page(found, [], [starts], train, site=Site(REPORTS, tmp_path))
    (tmp_path / "fit.html").write_text(text, encoding="utf-8")
    for link, title in ((".member h3 a", "Model A1"), (".same a", "1+b2")):
        tab.goto((tmp_path / "fit.html").as_uri())
        follow_link(tab, link)
        tab.wait_for_selector(f"h1:has-text('{title}'), #detail h3:has-text('{title}')")
    assert tab.url.endswith("dampers-3-damped.html#1+b2")
