"""An executed Jupyter notebook as a page of the guide: its words, its code and its outputs.

Drawings, tables and pictures stand in the page itself; a formula in LaTeX is shown as the plain
text beside it, because nothing that typesets is loaded.
"""

import json
import re
from collections.abc import Container, Iterator, Mapping

from markupsafe import Markup, escape

from disting.errors import InputError, shown
from disting.report.markdown import PREFIX as PREFIX
from disting.report.markdown import GuidePage, guide_page

OPENED = Markup('<p>Jupyter opens it: <a href="../notebooks/{0}.ipynb">{0}.ipynb</a>.</p>\n')
MADE = Markup('<div class="output" tabindex="0" role="group" aria-label="Output">{}</div>\n')
NAMELESS = re.compile(r"<th>\s*</th>")  # the corner of a table heads nothing
PICTURE = Markup('<img alt="Figure that the code above draws" src="data:image/png;base64,{}">')


def notebook_page(name: str, text: str, known: Container[str]) -> GuidePage:
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
            if (made := Markup("").join(_made(cell)))
        } | {"file": OPENED.format(name)}
        parts = [
            part for number, cell in enumerate(cells) for part in _parts(number, cell, outputs)
        ]
    except (ValueError, TypeError, KeyError, AttributeError) as error:
        raise InputError(f"{shown(name)} is no executed notebook: {error}") from error
    title = [] if parts and parts[0].startswith("# ") else [f"# {name}"]
    return guide_page(
        PREFIX + name, "\n\n".join([*title, *parts, "```file\n```"]), known, outputs=outputs
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


def _made(cell: Mapping[str, object]) -> Iterator[Markup]:
    """The outputs of a cell: of each the richest kind that needs nothing else."""
    for output in cell.get("outputs") or ():  # type: ignore[attr-defined]
        data = {kind: _whole(content) for kind, content in output.get("data", {}).items()}
        if "image/svg+xml" in data:
            yield Markup(data["image/svg+xml"])
        elif "text/html" in data:
            yield Markup(NAMELESS.sub("<td></td>", data["text/html"]))
        elif "image/png" in data:
            yield PICTURE.format("".join(data["image/png"].split()))
        elif said := data.get("text/plain", _whole(output.get("text", ""))):
            yield Markup("<pre>{}</pre>").format(escape(said.rstrip()))


def _whole(lines: object) -> str:
    """Text that a notebook holds whole or line by line."""
    return lines if isinstance(lines, str) else "".join(lines)  # type: ignore[arg-type]
