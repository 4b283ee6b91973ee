"""The generated pages in `reports` are those of the shipped catalogues: to the byte, figures in PNG to the pixel."""

import io
from pathlib import Path

import pytest
from PIL import Image, ImageChops

from disting.catalogs import catalog
from disting.catalogs.files import SHIPPED_SIZES
from disting.report import write_report
from disting.report.write import LINKS

REPORTS = Path(__file__).parents[2] / "reports"
REMEDY = "run: disting report 1 2 3 4 5"


def others(folder: Path) -> set[str]:
    """Pages of other commands that the index leads to."""
    return {address for address, _, _ in LINKS if (folder / address).is_file()}


@pytest.fixture(scope="module")
def fresh(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("reports")
    for address in others(REPORTS):
        (folder / address).parent.mkdir(exist_ok=True)
        (folder / address).touch()
    catalogs = [catalog(n, damped=damped) for n in SHIPPED_SIZES for damped in (False, True)]
    return {p.relative_to(folder).as_posix(): p for p in write_report(catalogs, folder)}


def test_generated_pages_are_current(fresh: dict[str, Path]) -> None:
    stored = {p.relative_to(REPORTS).as_posix() for p in [*REPORTS.glob("*"), *REPORTS.glob("models/**/*")] if p.is_file()}
    assert set(fresh) == stored - others(REPORTS), REMEDY
    old = [name for name, p in fresh.items() if p.suffix != ".png" and p.read_bytes() != (REPORTS / name).read_bytes()]
    assert old == [], REMEDY


def test_generated_figures_are_current(fresh: dict[str, Path]) -> None:
    for name, path in ((n, p) for n, p in fresh.items() if p.suffix == ".png"):
        new, stored = (Image.open(io.BytesIO(f.read_bytes())).convert("L") for f in (path, REPORTS / name))
        assert new.size == stored.size, REMEDY
        histogram = ImageChops.difference(new, stored).histogram()  # letters may differ a little between Pillow versions
        assert sum(histogram[64:]) <= 0.02 * new.width * new.height, REMEDY
