"""A real browser for the tests of pages, started once a process; a test module gives `site`, the
folder with the pages.
"""

import re
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

CHROMIUM = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None
)


@pytest.fixture(scope="session")
def browser() -> Iterator[object]:
    playwright = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
    with playwright.sync_playwright() as p:
        if not CHROMIUM and not Path(p.chromium.executable_path).exists():
            pytest.skip("no Chromium found, neither the system's nor Playwright's own")
        chromium = p.chromium.launch(
            executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"]
        )
        yield chromium
        chromium.close()


@pytest.fixture(scope="module")
def window(browser) -> Iterator[object]:  # type: ignore[no-untyped-def]
    """Where the tests of a module open a tab each: a window for each test costs a second more.
    An empty tab keeps it open. The pages keep nothing between visits: no cookies, no storage.
    """
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    context.new_page()
    yield context
    assert context.storage_state() == {"cookies": [], "origins": []}
    context.close()


@pytest.fixture
def visit(window, site: Path) -> Iterator[object]:  # type: ignore[no-untyped-def]
    """Open a page of the site; at the end of the test: no message on the console, no request
    but for the site's files.
    """
    tab, troubles, requests = window.new_page(), [], []
    tab.on("console", lambda message: troubles.append(message.text))
    tab.on("pageerror", lambda error: troubles.append(str(error)))
    tab.on("request", lambda request: requests.append(request.url.split("#")[0]))

    def go(path: str, width: int = 1280, scheme: str = "light") -> object:
        tab.set_viewport_size({"width": width, "height": 844 if width < 500 else 800})
        tab.emulate_media(color_scheme=scheme)
        tab.goto(f"{site.as_uri()}/{path}")
        return tab

    yield go
    tab.close()
    assert troubles == []
    assert all(
        re.fullmatch(
            re.escape(site.as_uri())
            + r"/(search\.js|[\w-]+\.html|(?:models|guide)/style\.css|guide/[\w-]+\.html|models/[\w-]+/\d+\.html)",
            r,
        )
        for r in requests
    )
