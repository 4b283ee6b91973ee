"""Writes the report of some catalogues into a folder: a small site of pages, with figures and
data.
"""

import argparse
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path

from disting.catalogs import Catalog, catalog
from disting.catalogs.dampers import (
    SHIPPED_SIZES as DAMPER_SIZES,
    DamperFamily,
    damper_catalog,
)
from disting.catalogs.files import SHIPPED_SIZES, damper_name, name_of
from disting.catalogs.sizes import SizesCatalog, name_of as sizes_name, sizes_catalog
from disting.files import write_whole
from disting.report.damper_page import damper_page
from disting.report.environment import source
from disting.report.guide import PREFIX, Part, guide, guide_files, guide_pictures
from disting.report.index import GUIDE, Link, index
from disting.report.ladenheim import ADDRESS as LADENHEIM
from disting.report.markdown import GuidePage
from disting.report.matrix import figure, figure_png, has_slides, slide_name, slide_png
from disting.report.model import folder_of, model_page, motion_of
from disting.report.model_list import list_pages
from disting.report.motion import motion_page
from disting.report.next_steps import found_for, page_of
from disting.report.page import next_page, page
from disting.report.scene import svg
from disting.report.search import ADDRESS, Families, families, search_script
from disting.report.sizes import sizes_page
from disting.report.words import VIEW_TITLES

STYLE = "models/style.css"


@dataclass(frozen=True, slots=True)
class Site:
    """Input of a site: the `catalogs`, families with ground `dampers` and catalogues of several
    sizes, `across`, that are written; the guide's `parts`; and `pages`, the known data of all pages
    of pairs, including those of shipped catalogues that are in the folder already.
    """

    catalogs: Sequence[Catalog]
    dampers: Sequence[DamperFamily]
    across: Sequence[SizesCatalog]
    parts: tuple[Part, ...]
    pages: Families


File = tuple[str, bytes]
"""Address below the site's folder, and content."""


def of_sizes(site: Site, damped: bool) -> Iterator[File]:
    """The page of the catalogues of several sizes, where they are given."""
    for the_catalog in site.across:
        if the_catalog.damped == damped:
            yield f"{the_catalog.name}.html", sizes_page(the_catalog, beside=site.pages).encode()
            the_catalog.forget()


@dataclass(frozen=True, slots=True)
class SitePage:
    """A page that the index leads to, in addition to those of the catalogues, once it lies in the
    folder: `files` gives its files; those of a page without any are written by another command.
    """

    link: Link
    files: Callable[[Site], Iterable[File]] = lambda _: ()


PAGES: tuple[SitePage, ...] = (
    SitePage(
        link=(
            GUIDE,
            "Guide",
            "first steps, how to do it, what the answers mean and rest on, every command and name",
        ),
        files=lambda site: (*guide_files(site.parts), *guide_pictures()),
    ),
    SitePage(
        link=(
            "sizes-undamped.html",
            "Different sizes, undamped",
            "which smaller models are limits of larger ones",
        ),
        files=lambda site: of_sizes(site, damped=False),
    ),
    SitePage(
        link=(
            "sizes-damped.html",
            "Different sizes, damped",
            "which smaller models are limits of larger ones",
        ),
        files=lambda site: of_sizes(site, damped=True),
    ),
    SitePage(
        link=(
            "paper/index.html",
            "The paper, claim by claim",
            "what the paper prints, and what is found here, side by side",
        )
    ),
    SitePage(
        link=(
            LADENHEIM,
            "Ladenheim's 108 networks",
            "circuits of at most five elements, network by network, in classes of what they can do",
        )
    ),
    *(
        SitePage(
            link=(
                address,
                "A fit",
                "which structure a measured frequency response supports",
            )
        )
        for address in ("fit.html", "fit/index.html")
    ),
)


def write_report(
    catalogs: Sequence[Catalog],
    out: Path,
    dampers: Sequence[DamperFamily] = (),
    commands: argparse.ArgumentParser | None = None,
    across: Sequence[SizesCatalog] = (),
) -> list[Path]:
    """Write page, figure (SVG, PNG) and data (CSV, JSON) of every catalogue, a page a model, the
    guide, with a reference of the `commands` where they are given, the search, and index.html.

    Of families with ground dampers, `dampers`, and of catalogues of several sizes, `across`, a page
    each. Executed notebooks in the folder `notebooks` of `out` become pages of the guide. The same
    catalogues and notebooks give the same bytes. `out` is made if it does not exist; other files in
    it stay as they are, and the index leads to the pages of shipped catalogues and to other known
    pages among them too, those of lists of models for one. Returns the paths as they were written,
    the pages of the largest catalogue first. Raises OSError where the folder cannot be written.

    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     paths = write_report([catalog(1, damped=True)], Path(folder))
    ...     paths[-1].name
    'index.html'
    """
    out.mkdir(parents=True, exist_ok=True)
    listed = sorted([*catalogs, *_beside(catalogs, out)], key=lambda c: (c.n_masses, c.damped))
    damped = sorted(
        [*dampers, *_dampers_beside(dampers, out)],
        key=lambda f: (f.family.n_masses, f.family.damped),
    )
    together = [*across, *_across_beside(across, listed, out)]
    parts = guide(commands, _notebooks(out))
    site = Site(catalogs, dampers, across, parts, families(listed, damped, together))
    # each file is written when it is made: together they take more memory than all catalogues
    names = [_write(out, file) for file in _pages(site)]
    members = set(names)
    links = [p.link for p in PAGES if p.link[0] in members or (out / p.link[0]).is_file()]
    links += [_link(page) for part in parts for page in part.pages if page.name.startswith(PREFIX)]
    lists = list(list_pages(out))
    links += [link for link, _ in lists]
    listed_models = [model for _, models in lists for model in models]
    script = search_script(parts, site.pages, [*links, *listed_models])
    style = "".join(map(source, ("style.css", "model.css", "next.css")))
    start = index(listed, links, damped, together)
    for name, text in ((ADDRESS, script), (STYLE, style), ("index.html", start)):
        names.append(_write(out, (name, text.encode())))
    return [out / name for name in names]


def _pages(site: Site) -> Iterator[File]:
    """The pages of what a site is written from, with their files; those of the largest catalogue
    first, whose figure takes most memory. What a catalogue remembers of its verdicts is let go with
    its pages.
    """
    for c in sorted(site.catalogs, key=lambda c: len(c.family), reverse=True):
        yield from _files(c, site.pages)
        c.forget()
    for family in site.dampers:
        yield _damper_file(family, site.pages)
    for site_page in PAGES:
        yield from site_page.files(site)


def _write(out: Path, file: File) -> str:
    """Write a file below the folder, and return its address there."""
    name, content = file
    (out / name).parent.mkdir(parents=True, exist_ok=True)
    write_whole(out / name, content)
    return name


def _link(notebook: GuidePage) -> Link:
    """Link from the index to the page of a notebook."""
    return (f"guide/{notebook.name}.html", f"Notebook: {notebook.title}", "with code and outputs")


def _notebooks(out: Path) -> dict[str, str]:
    """Texts of the executed notebooks in the folder `notebooks` there, by name."""
    return {p.stem: p.read_text("utf-8") for p in sorted((out / "notebooks").glob("*.ipynb"))}


def _beside(catalogs: Sequence[Catalog], out: Path) -> Iterator[Catalog]:
    """The shipped catalogues whose pages are in the folder already."""
    members = {c.name for c in catalogs}
    for n, damped in product(SHIPPED_SIZES, (False, True)):
        name = name_of(n, damped)
        if name not in members and (out / f"{name}.html").is_file():
            yield catalog(n, damped=damped)


def _dampers_beside(dampers: Sequence[DamperFamily], out: Path) -> Iterator[DamperFamily]:
    """The shipped families with ground dampers whose pages are in the folder already."""
    members = {(f.family.n_masses, f.family.damped) for f in dampers}
    for n, damped in product(DAMPER_SIZES, (False, True)):
        if (n, damped) not in members and (out / f"{damper_name(n, damped)}.html").is_file():
            yield damper_catalog(n, damped=damped)


def _across_beside(
    across: Sequence[SizesCatalog], catalogs: Sequence[Catalog], out: Path
) -> Iterator[SizesCatalog]:
    """The shipped catalogues of several sizes whose pages are in the folder already."""
    members = {s.damped for s in across}
    for damped in (False, True):
        if damped not in members and (out / f"{sizes_name(damped)}.html").is_file():
            yield sizes_catalog(damped=damped, known=catalogs)


def _damper_file(family: DamperFamily, pages: Families) -> File:
    name = damper_name(family.family.n_masses, family.family.damped)
    return f"{name}.html", damper_page(family, beside=pages).encode()


def _figures(c: Catalog) -> Iterator[File]:
    scene = figure(c)
    yield f"{c.name}-matrix.svg", svg(scene).encode()
    yield f"{c.name}-matrix.png", figure_png(scene)
    for view in VIEW_TITLES if has_slides(c) else ():
        yield slide_name(c, view), slide_png(c, view)


def _files(c: Catalog, pages: Families) -> Iterator[File]:
    yield f"{c.name}.html", page(c, beside=pages).encode()
    yield from _figures(c)
    yield f"{c.name}.csv", c.to_csv().encode()
    yield f"{c.name}.json", c.to_json().encode()
    the_catalog = found_for(c)
    if the_catalog is not None:
        yield page_of(c), next_page(c, the_catalog).encode()
    if motion_of(c):
        yield motion_of(c), motion_page(c).encode()
    for row in c.rows:
        yield f"{folder_of(c)}/{row.number}.html", model_page(c, row.number).encode()
