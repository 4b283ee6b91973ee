"""The guide: pages of Markdown in the package and pages made from its code, in four parts.

The page named "index" lists the pages of Markdown under the headings of their parts; the order
there is that of the navigation. The last part is the reference: what is made from the code follows
there (`disting.report.reference`).
"""

import argparse
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib.resources import files

from disting.report.environment import render, source
from disting.report.executed_notebook import PREFIX, notebook_page
from disting.report.markdown import ADDRESS, NOTHING, GuidePage, guide_page
from disting.report.reference.commands import command_page
from disting.report.reference.python_pages import python_pages

LISTING = "index"
PART = re.compile(r"^## (.+)$", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Part:
    """A part of the guide: its title and its pages; that of the listing itself has no title."""

    title: str
    pages: tuple[GuidePage, ...]


def guide(
    commands: argparse.ArgumentParser | None = None, notebooks: Mapping[str, str] = NOTHING
) -> tuple[Part, ...]:
    """All pages, part by part, the listing first; `commands`: the command line, whose reference
    is the last page then; `notebooks`: texts of executed notebooks by name, a part of their own.
    """
    texts = guide_texts()
    drawings = _files(".svg")
    known = {*texts, *(PREFIX + name for name in notebooks)}
    pages = {name: guide_page(name, text, known, drawings) for name, text in texts.items()}
    made = (*python_pages(), *([command_page(commands)] if commands else []))
    *parts, last = [
        Part(title, tuple(pages[name] for name in names)) for title, names in guide_parts(texts)
    ]
    executed = tuple(notebook_page(name, text, known) for name, text in notebooks.items())
    parts += [Part("Notebooks", executed)] if executed else []
    return (Part("", (pages[LISTING],)), *parts, Part(last.title, last.pages + made))


def guide_files(parts: tuple[Part, ...]) -> Iterator[tuple[str, bytes]]:
    """Address below the site's folder and content of every page, and of their style sheet."""
    pages = [page for part in parts for page in part.pages]
    around = zip([None, *pages], pages, [*pages[1:], None], strict=False)
    for before, page, after in around:
        html = render("guide.html", page=page, parts=parts, before=before, after=after)
        yield f"guide/{page.name}.html", html.encode()
    yield "guide/style.css", (source("style.css") + source("guide.css")).encode()


def guide_texts() -> dict[str, str]:
    """Markdown of every page by its name, the listing first."""
    found = {name.removesuffix(".md"): text for name, text in _files(".md").items()}
    return {LISTING: found[LISTING]} | found


def _files(ending: str) -> dict[str, str]:
    """Texts beside the pages, by name."""
    return {
        path.name: path.read_text(encoding="utf-8")
        for path in sorted((files("disting") / "guide").iterdir(), key=lambda path: path.name)
        if path.name.endswith(ending)
    }


def guide_parts(texts: dict[str, str]) -> list[tuple[str, list[str]]]:
    """Titles of the parts, and the pages that the listing names below each; the last one has
    those too that it does not name.

    >>> listing = "# G\\n\\n## A\\n\\n[b](b.md) [b](b.md#x)\\n\\n## C\\n"
    >>> guide_parts({"index": listing, "b": "", "d": ""})
    [('A', ['b']), ('C', ['d'])]
    """
    _, *found = PART.split(texts[LISTING])
    parts = [
        (title, [m[1] for m in ADDRESS.finditer(text) if m[1] in texts])
        for title, text in zip(found[::2], found[1::2], strict=True)
    ]
    listed = {LISTING}.union(*(names for _, names in parts))
    parts[-1][1].extend(name for name in texts if name not in listed)
    return [(title, list(dict.fromkeys(names))) for title, names in parts]
