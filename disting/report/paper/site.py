"""Writes the page and the files of its figures into a folder."""

from collections.abc import Container, Iterator, Sequence
from pathlib import Path

from disting.files import write_whole
from disting.paper import Findings
from disting.report.paper.figures import paper_figures
from disting.report.paper.paper_page import paper_page
from disting.report.paper.picture import Picture


def write_paper(findings: Findings, out: Path, beside: Container[str] = ()) -> list[Path]:
    """Write index.html and every figure as SVG, PNG and PDF; the paths written, in order.

    Claims link to the pages of the families that are named in `beside`, one folder above `out`.

    The same findings give the same bytes. `out` is made if it does not exist; other files in it
    stay as they are.
    """
    pictures = paper_figures(findings)
    page = paper_page(findings, pictures, beside)
    out.mkdir(parents=True, exist_ok=True)
    return [write_whole(out / name, content) for name, content in _files(page, pictures)]


def _files(page: str, pictures: Sequence[Picture]) -> Iterator[tuple[str, bytes]]:
    yield "index.html", page.encode()
    for picture in pictures:
        for ending, content in picture.files:
            yield picture.name + ending, content
