"""Links of pages: where they lead, and how a reader follows them."""

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from urllib.parse import unquote, urlsplit

from disting.model.family import Family
from tests.report.outline import Outline

REPORTS = Path(__file__).parents[2] / "reports"
COPIED = "paper"  # takes minutes, so tests take it from the shipped site, within which it leads
# what `reports/.gitignore` leaves to `disting report 1 2 3 4 5`
LEFT_OUT = re.compile(
    r"models/\d-(?:un)?damped/(?!1\.)\d+\.html|chains-[45]-\w+\.json|chains-5-\w+-matrix\.svg"
    r"|dampers-5-\w+\.html|(?:motion|next)-[45]-\w+\.html"
)
NUMBER = r"(?:A?\d+)"
SETS = rf"{NUMBER}(?:\+b\d)*"
# what the scripts of a page understand beside the names of its parts
UNDERSTOOD = {
    "chains-": rf"{NUMBER}|{NUMBER}[-:]{NUMBER}",
    "sizes-": rf"\d:{NUMBER}(?:-\d:{NUMBER})?",
    "list-": rf"{NUMBER}|{NUMBER}-{NUMBER}",
    "dampers-": rf"{SETS}|{SETS}/{SETS}|group-\d+",
    "motion-": rf"{NUMBER}-{NUMBER}(?:,present)?",
    "index": r"machine=[\w,]+",
}


@cache
def outline(page: Path) -> Outline:
    """What stands in a page, read once."""
    return Outline(page.read_text(encoding="utf-8"))


def is_there(page: Path, link: str) -> bool:
    """Whether a link of a page leads to a file, and within it to a part or to what its script
    understands.
    """
    address = urlsplit(link)
    if page.parent.name == COPIED:
        page = REPORTS / COPIED / page.name
    target = (page.parent / unquote(address.path)).resolve() if address.path else page.resolve()
    if page.parent.name == COPIED and is_written_later(_in_reports(target)):
        return True
    if address.scheme not in ("", "data") or not (address.scheme or target.is_file()):
        return False
    if not address.fragment:
        return True
    understood = next((u for name, u in UNDERSTOOD.items() if target.name.startswith(name)), "(?!)")
    fragment = unquote(address.fragment)
    return fragment in _anchors(target) or re.fullmatch(understood, fragment) is not None


def is_written_later(address: str) -> bool:
    """Return True for a file that the repository leaves out, and that the command writes: the page
    of a model that there is.
    """
    if model := re.fullmatch(r"models/(\d)-(?:un)?damped/(\d+)\.html", address):
        return 1 < int(model[2]) <= len(Family(int(model[1])))
    return bool(LEFT_OUT.fullmatch(address))


def _in_reports(target: Path) -> str:
    """Address of a file within the shipped site; "" outside."""
    return target.relative_to(REPORTS).as_posix() if target.is_relative_to(REPORTS) else ""


@cache
def _anchors(page: Path) -> frozenset[str]:
    return frozenset(str(a["id"]) for _, a in outline(page).elements if "id" in a)


def dead_links(page: Path) -> Iterator[str]:
    """Links and sources of a page that lead nowhere."""
    for tag, attributes in outline(page).elements:
        link = attributes.get("href") or attributes.get("src")
        if link and tag not in ("use", "mpath") and not is_there(page, link):
            yield link


def follow_link(tab, link: str) -> None:  # type: ignore[no-untyped-def]
    """Click; wait for the other page to be loaded or, for a link within the page, for its
    scripts to have heard of it.
    """
    target = tab.locator(link).evaluate("(a) => a.href")
    if tab.url.split("#")[0] != target.split("#")[0]:
        with tab.expect_navigation():
            tab.click(link)
    elif tab.url != target:  # the browser tells the scripts in a task of its own, after the click
        tab.evaluate(
            "() => { window.heard = new Promise((done) => addEventListener('hashchange', () =>"
            " done(), { once: true })); }"
        )
        tab.click(link)
        tab.evaluate("() => window.heard")
    else:
        tab.click(link)
