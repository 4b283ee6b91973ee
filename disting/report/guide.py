"""The guide: pages of Markdown in the package and pages made from its code, in four parts.

The page named "index" lists the pages of Markdown under the headings of their parts; the order
there is that of the navigation. The last part is the reference: what is made from the code follows
there (`disting.report.reference`).

An executed Jupyter notebook is a page too: its words, its code and its outputs. Drawings, tables
and pictures are in the page itself; a formula in LaTeX is shown as its plain text, because nothing
that typesets is loaded.
"""

import argparse
import json
import re
from collections.abc import Container, Iterator, Mapping
from dataclasses import dataclass
from importlib.resources import files

from markupsafe import Markup, escape

from disting.errors import InputError, short
from disting.report.environment import render, source
from disting.report.markdown import ADDRESS, NOTHING, PREFIX as PREFIX, GuidePage, guide_page
from disting.report.reference.commands import command_page
from disting.report.reference.python_pages import python_pages

OPENED = Markup('<p>Jupyter opens it: <a href="../notebooks/{0}.ipynb">{0}.ipynb</a>.</p>\n')
MADE = Markup('<div class="output" tabindex="0" role="group" aria-label="Output">{}</div>\n')
NAMELESS = re.compile(r"<th>\s*</th>")  # the corner of a table heads nothing
PICTURE = Markup('<img alt="Figure that the code above draws" src="data:image/png;base64,{}">')


def notebook_page(name: str, text: str, container: Container[str]) -> GuidePage:
    """The page of a notebook, given as the text of its file; its name is the title where its first
    cell does not begin with one.

    Raises InputError if the text is no notebook of format 4.

    >>> cells = [
    ...     {"cell_type": "markdown", "source": ["# Title\\n", "Words."]},
    ...     {"cell_type": "code", "source": "1 + 1", "outputs": [{"data": {"text/plain": "2"}}]},
    ... ]
    >>> page = notebook_page("a", json.dumps({"cells": cells}), [])
    >>> page.name, page.title
    ('notebook-a', 'Title')
    >>> "<code>1 + 1</code>" in page.body, '<pre>2</pre>' in page.body
    (True, True)
    """
    try:
        cells = json.loads(text)["cells"]
        outputs = {
            f"output {number}": MADE.format(made)
            for number, cell in enumerate(cells)
            if (made := Markup("").join(_make_outputs(cell)))
        } | {"file": OPENED.format(name)}
        parts = [
            part for number, cell in enumerate(cells) for part in _parts(number, cell, outputs)
        ]
    except (ValueError, TypeError, KeyError, AttributeError) as error:
        raise InputError(f"{short(name)} is not an executed notebook: {error}") from error
    title = [] if parts and parts[0].startswith("# ") else [f"# {name}"]
    return guide_page(
        PREFIX + name, "\n\n".join([*title, *parts, "```file\n```"]), container, outputs=outputs
    )


def _parts(number: int, cell: Mapping[str, object], outputs: Container[str]) -> Iterator[str]:
    """A cell as Markdown, with a block in the place of its outputs."""
    source = _whole(cell["source"])
    if cell["cell_type"] != "code":
        yield source
        return
    fence = "`" * 3
    while fence in source:
        fence += "`"
    yield f"{fence}python\n{source}\n{fence}"
    if f"output {number}" in outputs:
        yield f"```output {number}\n```"


def _make_outputs(cell: Mapping[str, object]) -> Iterator[Markup]:
    """The outputs of a cell: of each the richest kind that needs nothing else."""
    for output in cell.get("outputs") or ():  # type: ignore[attr-defined]
        data = {kind: _whole(content) for kind, content in output.get("data", {}).items()}
        if "image/svg+xml" in data:
            yield Markup(data["image/svg+xml"])
        elif "text/html" in data:
            yield Markup(NAMELESS.sub("<td></td>", data["text/html"]))
        elif "image/png" in data:
            yield PICTURE.format("".join(data["image/png"].split()))
        elif text := data.get("text/plain", _whole(output.get("text", ""))):
            yield Markup("<pre>{}</pre>").format(escape(text.rstrip()))


def _whole(lines: object) -> str:
    """Text that a notebook holds whole or line by line."""
    return lines if isinstance(lines, str) else "".join(lines)  # type: ignore[arg-type]


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
    drawings = _files(".svg") | {name: f'<img src="{name}" alt="">' for name, _ in _pictures()}
    own_names = {*texts, *(PREFIX + name for name in notebooks)}
    pages = {name: guide_page(name, text, own_names, drawings) for name, text in texts.items()}
    made = (*python_pages(), *([command_page(commands)] if commands else []))
    *parts, last = [
        Part(title, tuple(pages[name] for name in names)) for title, names in guide_parts(texts)
    ]
    executed = tuple(notebook_page(name, text, own_names) for name, text in notebooks.items())
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


def guide_pictures() -> Iterator[tuple[str, bytes]]:
    """Address below the site's folder and content of every picture of the guide."""
    yield from ((f"guide/{name}", content) for name, content in _pictures())


def guide_texts() -> dict[str, str]:
    """Markdown of every page by its name, the listing first."""
    texts = {name.removesuffix(".md"): text for name, text in _files(".md").items()}
    return {LISTING: texts[LISTING]} | texts


def _files(ending: str) -> dict[str, str]:
    """Texts next to the pages, by name."""
    return {
        path.name: path.read_text(encoding="utf-8")
        for path in sorted((files("disting") / "guide").iterdir(), key=lambda path: path.name)
        if path.name.endswith(ending)
    }


def _pictures() -> list[tuple[str, bytes]]:
    """Pictures of a screen next to the pages: names and contents."""
    found = [path for path in (files("disting") / "guide").iterdir() if path.name.endswith(".webp")]
    return sorted((path.name, path.read_bytes()) for path in found)


def guide_parts(texts: dict[str, str]) -> list[tuple[str, list[str]]]:
    """Titles of the parts, and the pages that the listing names below each; the last one has
    those too that it does not name.

    >>> listing = "# G\\n\\n## A\\n\\n[b](b.md) [b](b.md#x)\\n\\n## C\\n"
    >>> guide_parts({"index": listing, "b": "", "d": ""})
    [('A', ['b']), ('C', ['d'])]
    """
    _, *titles_and_texts = PART.split(texts[LISTING])
    parts = [
        (title, [m[1] for m in ADDRESS.finditer(text) if m[1] in texts])
        for title, text in zip(titles_and_texts[::2], titles_and_texts[1::2], strict=True)
    ]
    listed = {LISTING}.union(*(names for _, names in parts))
    parts[-1][1].extend(name for name in texts if name not in listed)
    return [(title, list(dict.fromkeys(names))) for title, names in parts]
