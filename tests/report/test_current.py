"""The generated pages in `reports` are those of the shipped catalogues: to the byte, figures in
PNG to the pixel.
"""

import io
import shutil
from pathlib import Path

import pytest
from PIL import Image, ImageChops

from disting.catalogs import catalog
from disting.catalogs.dampers import SHIPPED_SIZES as DAMPER_SIZES, damper_catalog
from disting.catalogs.files import SHIPPED_SIZES
from disting.catalogs.sizes import sizes_catalog
from disting.cli.run import parser
from disting.report import write_report
from disting.report.write import PAGES
from tests.report.links import LEFT_OUT

pytestmark = pytest.mark.full

REPORTS = Path(__file__).parents[2] / "reports"
REMEDY = "run: disting report 1 2 3 4 5"
NOT_KEPT = [
    f"{kind}-{n}-{damping}.html"
    for kind, sizes in (("dampers", (5,)), ("motion", (4, 5)), ("next", (4, 5)))
    for n in sizes
    for damping in ("damped", "undamped")
]


def others(folder: Path) -> set[str]:
    """Pages of other commands that the index leads to."""
    return {p.link[0] for p in PAGES if (folder / p.link[0]).is_file()}


def written_anew(folder: Path) -> dict[str, Path]:
    """The whole site in another folder, which knows the pages of other commands."""
    for address in others(REPORTS):
        (folder / address).parent.mkdir(exist_ok=True)
        (folder / address).touch()
    shutil.copytree(REPORTS / "notebooks", folder / "notebooks")
    kinds = [(n, damped) for n in SHIPPED_SIZES for damped in (False, True)]
    dampers = [damper_catalog(n, damped=damped) for n, damped in kinds if n in DAMPER_SIZES]
    shipped = [catalog(n, damped=damped) for n, damped in kinds]
    across = [sizes_catalog(damped=damped, known=shipped) for damped in (False, True)]
    paths = write_report(shipped, folder, dampers, parser(), across)
    return {p.relative_to(folder).as_posix(): p for p in paths}


def wrong(fresh: dict[str, Path]) -> list[str]:
    """Files that the repository lacks or has otherwise; those left out may be there or not."""
    return [
        name
        for name, new in fresh.items()
        if not ((REPORTS / name).is_file() and is_current(new, REPORTS / name))
        and not (LEFT_OUT.fullmatch(name) and not (REPORTS / name).exists())
    ]


def is_current(new: Path, stored: Path) -> bool:
    """Equal bytes; of a PNG nearly equal pixels, because letters may differ a little between
    Pillow versions.
    """
    if new.suffix != ".png":
        return new.read_bytes() == stored.read_bytes()
    images = [Image.open(io.BytesIO(p.read_bytes())).convert("L") for p in (new, stored)]
    if images[0].size != images[1].size:
        return False
    histogram = ImageChops.difference(*images).histogram()
    return sum(histogram[64:]) <= 0.02 * images[0].width * images[0].height


def test_files_of_a_small_family_are_current(tmp_path: Path) -> None:
    """Beside the other pages, to which they lead. All files: by hand."""
    for page in (*(path.name for path in REPORTS.glob("*.html")), *others(REPORTS), *NOT_KEPT):
        (tmp_path / page).parent.mkdir(exist_ok=True)
        (tmp_path / page).touch()
    shutil.copytree(REPORTS / "notebooks", tmp_path / "notebooks")
    dampers = [damper_catalog(3, damped=True)]
    paths = write_report([catalog(3, damped=True)], tmp_path, dampers, parser())
    fresh = {p.relative_to(tmp_path).as_posix(): p for p in paths}
    del fresh["index.html"]  # leads to the other pages too
    del fresh["search.js"]  # finds the models of the other pages too
    assert len([name for name in fresh if not name.startswith("guide/")]) == 20
    assert wrong(fresh) == [], REMEDY


@pytest.mark.slow
def test_generated_files_are_current(tmp_path: Path) -> None:
    fresh = written_anew(tmp_path)
    stored = {
        p.relative_to(REPORTS).as_posix()
        for kind in ("*", "guide/*", "models/**/*")
        for p in REPORTS.glob(kind)
        if p.is_file() and p.name != ".gitignore"
    }
    assert stored - (others(REPORTS) - set(fresh)) <= set(fresh), REMEDY
    assert wrong(fresh) == [], REMEDY
