"""How soon does a page show something, of every kind, at every size of window?

In milliseconds, the middle one of three visits, from the request to the first contentful paint and
until the page is drawn with what its scripts add.
"""

from pathlib import Path
from statistics import median

import pytest

from tests.bench.measure import table
from tests.conftest import CHROMIUM
from tests.report.page_kinds import SIGHTS, kinds, write_all

pytestmark = pytest.mark.bench
MASSES, VISITS = 5, 3
PAINTED = """() => new Promise((done) => {
  const told = (list) => list.getEntriesByName("first-contentful-paint").forEach((e) => done(e.startTime));
  new PerformanceObserver(told).observe({ type: "paint", buffered: true });
})"""
DRAWN = """() => new Promise((done) => requestAnimationFrame(() => setTimeout(() => done(performance.now()))))"""


def visited(browser, address: str, sight: tuple[int, int]) -> tuple[float, float]:  # type: ignore[no-untyped-def]
    """Milliseconds to the first paint and until the page is drawn."""
    tab = browser.new_page(viewport=dict(zip(("width", "height"), sight, strict=True)))
    tab.goto(address)
    drawn, painted = tab.evaluate(DRAWN), tab.evaluate(PAINTED)
    tab.close()
    return painted, drawn


def test_pages(tmp_path: Path) -> None:
    playwright = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
    write_all(tmp_path, MASSES, whole=False)
    rows = []
    with playwright.sync_playwright() as p:
        browser = p.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        for kind, page in kinds(MASSES).items():
            row = [kind]
            for sight in SIGHTS:
                found = [
                    visited(browser, f"{tmp_path.as_uri()}/{page}", sight) for _ in range(VISITS)
                ]
                row.append(" / ".join(f"{median(times):.0f}" for times in zip(*found, strict=True)))
            rows.append(tuple(row))
        browser.close()
    sizes = tuple(f"{width}x{height}" for width, height in SIGHTS)
    table("first paint / drawn [ms]", ("kind of page", *sizes), rows)
