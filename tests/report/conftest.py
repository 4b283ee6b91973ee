"""A real browser for the tests of pages, started once a process; a test module gives `site`, the
folder with the pages.
"""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def window(browser) -> Iterator[object]:  # type: ignore[no-untyped-def]
    """The one tab of a process: another one for each test costs as much as a page. The pages keep
    nothing between visits: no cookies, no storage.
    """
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    yield context.new_page()
    assert context.storage_state() == {"cookies": [], "origins": []}
    context.close()


@pytest.fixture
def tab(window) -> object:  # type: ignore[no-untyped-def]
    """The tab as it was when it was opened: empty, light, on a desk; nothing moves by itself."""
    if window.url != "about:blank":
        window.goto("about:blank")
    window.set_viewport_size({"width": 1280, "height": 800})
    window.emulate_media(media="null", color_scheme="null", reduced_motion="reduce")
    window.mouse.move(0, 0)
    return window


@contextmanager
def heard(tab) -> Iterator[tuple[list[str], list[str]]]:  # type: ignore[no-untyped-def]
    """Messages on the console, and addresses that are asked for, in the meantime."""
    troubles, requests = list[str](), list[str]()
    listeners = {
        "console": lambda message: troubles.append(message.text),
        "pageerror": lambda error: troubles.append(str(error)),
        "request": lambda request: requests.append(request.url),
    }
    for event, listener in listeners.items():
        tab.on(event, listener)
    try:
        yield troubles, requests
    finally:
        for event, listener in listeners.items():
            tab.remove_listener(event, listener)


@pytest.fixture
def visit(tab, site: Path) -> Iterator[object]:  # type: ignore[no-untyped-def]
    """Open a page of the site; at the end of the test: no message on the console, no request
    but for the site's files.
    """

    def go(path: str, width: int = 1280, scheme: str = "light") -> object:
        tab.set_viewport_size({"width": width, "height": 844 if width < 500 else 800})
        tab.emulate_media(color_scheme=scheme)
        tab.goto(f"{site.as_uri()}/{path}")
        return tab

    with heard(tab) as (troubles, requests):
        yield go
        tab.goto("about:blank")  # what is said at the end is heard too
    assert troubles == []
    assert all(
        re.fullmatch(
            re.escape(site.as_uri())
            + r"/(search\.js|[\w-]+\.html|(?:models|guide)/style\.css|guide/[\w-]+\.(?:html|webp)|models/[\w-]+/\d+\.html)",
            request.split("#")[0],
        )
        for request in requests
    )
