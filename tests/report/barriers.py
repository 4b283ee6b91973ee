"""What keeps people from using a page, found by axe-core."""

import pytest


def barriers(tab, **options: object) -> list[tuple[str, str, str]]:  # type: ignore[no-untyped-def]
    """Rule, element and summary of every violation. What axe passes is looked at too, but not
    described, which takes as long again. A page in a frame is judged where it is the page.
    """
    axe = pytest.importorskip(
        "axe_playwright_python.sync_playwright", reason="axe-playwright-python is not installed"
    )
    asked = {"preload": False, "resultTypes": ["violations"], "iframes": False}
    found = axe.Axe().run(tab, options=asked, **options).response["violations"]
    return [(v["id"], v["nodes"][0]["html"][:120], v["nodes"][0]["failureSummary"]) for v in found]
