"""The generated pages in `reports` are those of the shipped catalogues: to the byte, figures in PNG to the pixel."""

import io
from pathlib import Path

import pytest
from PIL import Image, ImageChops

from disting.catalogs import catalog
from disting.catalogs.files import SHIPPED_SIZES
from disting.report import write_report

REPORTS = Path(__file__).parents[2] / "reports"
REMEDY = "run: disting report 1 2 3 4 5"


@pytest.fixture(scope="module")
def fresh(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    catalogs = [catalog(n, damped=damped) for n in SHIPPED_SIZES for damped in (False, True)]
    return write_report(catalogs, tmp_path_factory.mktemp("reports"))


def test_generated_pages_are_current(fresh: list[Path]) -> None:
    assert {p.name for p in fresh} == {p.name for p in REPORTS.iterdir()}, REMEDY
    old = [p.name for p in fresh if p.suffix != ".png" and p.read_bytes() != (REPORTS / p.name).read_bytes()]
    assert old == [], REMEDY


def test_generated_figures_are_current(fresh: list[Path]) -> None:
    for path in (p for p in fresh if p.suffix == ".png"):
        new, stored = (Image.open(io.BytesIO(f.read_bytes())).convert("L") for f in (path, REPORTS / path.name))
        assert new.size == stored.size, REMEDY
        histogram = ImageChops.difference(new, stored).histogram()  # letters may differ a little between Pillow versions
        assert sum(histogram[64:]) <= 0.02 * new.width * new.height, REMEDY
