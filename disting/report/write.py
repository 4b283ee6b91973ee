"""Writes the report of some catalogues into a folder: a small site of pages, and figures and data beside them."""

from collections.abc import Iterator, Sequence
from itertools import product
from pathlib import Path

from disting.catalogs import Catalog, catalog
from disting.catalogs.files import SHIPPED_SIZES, name_of
from disting.report.environment import source
from disting.report.index import Link, index
from disting.report.matrix import figure, figure_png
from disting.report.model import folder_of, model_page
from disting.report.page import page
from disting.report.svg import svg

STYLE = "models/style.css"
LINKS: tuple[Link, ...] = (
    ("paper/index.html", "The paper, claim by claim", "what the paper prints, and what is found here, side by side"),
    ("fit.html", "A fit", "which structure a measured frequency response supports"),
    ("fit/index.html", "A fit", "which structure a measured frequency response supports"),
)
"""Pages that other commands write, listed where they are in the folder already."""


def write_report(catalogs: Sequence[Catalog], out: Path) -> list[Path]:
    """Write page, figure (SVG, PNG) and data (CSV, JSON) of every catalogue, a page a model, and index.html.

    The same catalogues give the same bytes. `out` is made if it does not exist; other files in it stay as they are, and the
    index leads to the pages of shipped catalogues and to other known pages among them too. Returns the paths, in order.
    """
    out.mkdir(parents=True, exist_ok=True)
    listed = sorted([*catalogs, *_beside(catalogs, out)], key=lambda c: (c.n_masses, c.damped))
    start = index(listed, [link for link in LINKS if (out / link[0]).is_file()])
    style = source("style.css") + source("model.css")
    files = [file for c in catalogs for file in _files(c)] + [(STYLE, style.encode()), ("index.html", start.encode())]
    return [_written(out / name, content) for name, content in files]


def _beside(catalogs: Sequence[Catalog], out: Path) -> Iterator[Catalog]:
    """The shipped catalogues whose pages are in the folder already."""
    given = {c.name for c in catalogs}
    for n, damped in product(SHIPPED_SIZES, (False, True)):
        name = name_of(n, damped)
        if name not in given and (out / f"{name}.html").is_file():
            yield catalog(n, damped=damped)


def _files(c: Catalog) -> Iterator[tuple[str, bytes]]:
    yield f"{c.name}.html", page(c).encode()
    scene = figure(c)
    yield f"{c.name}-matrix.svg", svg(scene).encode()
    yield f"{c.name}-matrix.png", figure_png(scene)
    yield f"{c.name}.csv", c.to_csv().encode()
    yield f"{c.name}.json", c.to_json().encode()
    for row in c.rows:
        yield f"{folder_of(c)}/{row.number}.html", model_page(c, row.number).encode()


def _written(path: Path, content: bytes) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    return path
