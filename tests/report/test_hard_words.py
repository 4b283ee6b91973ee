"""No page uses a word of the trade without saying what it means: a link to the glossary, or an
explanation on the page itself where it has no site around it.
"""

import re
from html.parser import HTMLParser
from pathlib import Path

import pytest

from disting.catalogs import catalog
from disting.fit.judge.modes import physical
from disting.fit.results.selection import Selection
from disting.measurement import FrequencyResponse
from disting.report import index, model_page, page
from disting.report.fit import fit_page
from disting.report.fit.style import FigureFiles
from disting.report.guide import guide
from disting.report.markdown import HARD, PAGE, hard_words

from .fit.conftest import selection, starts, test, train  # noqa: F401

UNREAD = {"script", "style", "code", "pre", "svg", "math", "title"}
OWN = {"circuits": ("machine", "curve"), "compartments": ("machine", "curve")}


class Read(HTMLParser):
    """The words of a page that people read, without code, and where it leads."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.words, self.open, self.explained = list[str](), list[str](), set[str]()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = dict(attrs)
        self.open += [tag] if tag in UNREAD else []
        target = found.get("href") or ""
        if f"{PAGE}.html#" in target:
            self.explained.add(target.partition("#")[2])
        if (found.get("id") or "").startswith("word-"):
            self.explained.add(str(found["id"]).removeprefix("word-"))

    def handle_endtag(self, tag: str) -> None:
        if self.open and self.open[-1] == tag:
            self.open.pop()

    def handle_data(self, data: str) -> None:
        self.words += [] if self.open else [data]


def unexplained(text: str) -> set[str]:
    """Hard words of a page that lead nowhere."""
    found = Read(text)
    return {w for w, a in hard_words(" ".join(found.words)).items() if a not in found.explained}


def test_what_is_looked_for_is_found() -> None:
    assert unexplained("<p>A generic fibre.</p><code>matroid</code>") == {"generic", "fibre"}
    assert unexplained(f'<p>A <a href="../guide/{PAGE}.html#fibre">fibre</a>.</p>') == set()
    assert unexplained('<dt id="word-hit-rate">Hit rate</dt>') == set()


@pytest.mark.full
def test_every_hard_word_is_in_the_glossary() -> None:
    pages = {one.name: one for part in guide() for one in part.pages}
    known = {section.anchor for section in pages[PAGE].sections}
    assert set(HARD.values()) <= known and len(HARD) > 20


@pytest.mark.full
def test_pages_of_the_guide_link_the_first_use() -> None:
    pages = [one for part in guide() for one in part.pages]
    own = [one for one in pages if not one.name.startswith(("python-", "commands", PAGE))]
    assert len(own) > 25
    assert {one.name: unexplained(one.body) for one in own if unexplained(one.body)} == {}
    assert sum(one.body.count('class="term"') for one in own) > 40


@pytest.mark.full
def test_pages_of_catalogues_and_the_start_page() -> None:
    found = catalog(3, damped=True)
    texts = (index([found]), page(found), model_page(found, 3), model_page(found, 1))
    assert [unexplained(text) for text in texts] == [set()] * 4


@pytest.mark.full
def test_the_page_of_a_fit(
    selection: Selection,  # noqa: F811
    train: FrequencyResponse,  # noqa: F811
    starts: FigureFiles,  # noqa: F811
) -> None:
    text = fit_page(selection, physical(selection.described, selection.task), [starts], train)
    assert unexplained(text) == set()
    assert {"chi2-per-line", "akaike-weight", "hit-rate", "j-train"} <= Read(text).explained


@pytest.mark.parametrize("name", OWN)
def test_circuits_and_compartments_have_their_own_words(name: str) -> None:
    """What they have is an impedance or a content, not a machine or its curve."""
    import disting

    text = (Path(disting.__file__).parent / "guide" / f"{name}.md").read_text(encoding="utf-8")
    said = re.sub(r"```.*?```|`[^`]*`|\]\([^)]*\)", "", text, flags=re.DOTALL).lower()
    assert [word for word in OWN[name] if re.search(rf"\b{word}s?\b", said)] == []
