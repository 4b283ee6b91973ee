"""Pictures that pages save: of a chain, a pair, two machines in motion; whole and on white paper."""

import io
from pathlib import Path
from xml.etree import ElementTree

import pytest
from PIL import Image

from disting.catalogs import catalog
from disting.report import write_report
from disting.report.drawing import draw
from disting.report.scene import Text

pytestmark = pytest.mark.full

PLACES = {
    "models/2-damped/3.html": ("main", "chains-2-damped-3", (3,)),
    "chains-2-damped.html#1-3": ("#detail", "pair", (1, 3)),
    "motion-2-damped.html#A1-A3": ("main", "two-machines", (1, 3)),
}


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("pictures")
    write_report([catalog(2, damped=True)], folder)
    return folder


@pytest.mark.parametrize("address", PLACES)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_page_saves_what_it_shows(visit, tmp_path: Path, address: str, scheme: str) -> None:  # type: ignore[no-untyped-def]
    inside, name, models = PLACES[address]
    tab = visit(address, scheme=scheme)
    if "motion" in address:
        tab.wait_for_function("() => document.getElementById('how').textContent", timeout=60_000)
    for kind in ("svg", "png"):
        with tab.expect_download() as download:
            tab.locator(inside).get_by_text(f"Save {kind.upper()}", exact=True).click()
        assert download.value.suggested_filename == f"{name}.{kind}"
        download.value.save_as(tmp_path / f"a.{kind}")
    written = (tmp_path / "a.svg").read_text("utf-8")
    assert "var(" not in written and "currentColor" not in written and "<use" not in written
    texts = [t.text for t in ElementTree.fromstring(written).iter() if t.tag.endswith("}text")]
    family = catalog(2, damped=True).family
    drawn = [s.text for m in models for s in draw(family[m]).shapes if isinstance(s, Text)]
    assert sorted(texts) == sorted(drawn)
    image = Image.open(io.BytesIO((tmp_path / "a.png").read_bytes())).convert("L")
    assert image.getpixel((1, 1)) == 255 and image.getextrema()[0] < 80
