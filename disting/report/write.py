"""Writes the report of some catalogues into a folder: pages, figures, data."""

from collections.abc import Iterator, Sequence
from itertools import product
from pathlib import Path

from disting.catalogs import Catalog, catalog
from disting.catalogs.files import SHIPPED_SIZES, name_of
from disting.report.index import index
from disting.report.matrix import matrix_png, matrix_svg
from disting.report.page import page


def write_report(catalogs: Sequence[Catalog], out: Path) -> list[Path]:
    """Write page, figure (SVG, PNG) and data (CSV, JSON) of every catalogue, and index.html; the paths written, in order.

    The same catalogues give the same bytes. `out` is made if it does not exist; other files in it stay as they are, and the
    index leads to the pages of shipped catalogues among them too.
    """
    out.mkdir(parents=True, exist_ok=True)
    listed = sorted([*catalogs, *_beside(catalogs, out)], key=lambda c: (c.n_masses, c.damped))
    files = [file for c in catalogs for file in _files(c)] + [("index.html", index(listed).encode())]
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
    yield f"{c.name}-matrix.svg", matrix_svg(c).encode()
    yield f"{c.name}-matrix.png", matrix_png(c)
    yield f"{c.name}.csv", c.to_csv().encode()
    yield f"{c.name}.json", c.to_json().encode()


def _written(path: Path, content: bytes) -> Path:
    path.write_bytes(content)
    return path
