"""A whole report in a folder."""

import json
import re
from pathlib import Path

import pytest

from disting.catalogs import catalog
from disting.catalogs.dampers import damper_family
from disting.report import write_report
from disting.report.write import PAGES

ENDINGS = (".html", "-matrix.svg", "-matrix.png", ".csv", ".json")


@pytest.mark.full
def test_all_files_are_written_and_linked(tmp_path: Path) -> None:
    catalogs = [catalog(1, damped=False), catalog(2, damped=True)]
    paths = write_report(catalogs, tmp_path / "new" / "folder")
    folder = tmp_path / "new" / "folder"
    names = [p.relative_to(folder).as_posix() for p in paths]
    plain = [f"{c.name}{ending}" for c in catalogs for ending in ENDINGS]
    found = [name for name in names if "/" not in name]
    further = ["next-2-damped.html", "motion-2-damped.html", "search.js"]
    assert sorted(found) == sorted([*plain, *further, "index.html"])
    # the largest catalogue first
    models = [*(f"models/2-damped/{i}.html" for i in range(1, 4)), "models/1-undamped/1.html"]
    guide = [name for name in names if name.startswith("guide/")]
    assert [name for name in names if "/" in name] == [*models, *guide, "models/style.css"]
    assert {"guide/index.html", "guide/verdicts.html", "guide/style.css"} <= set(guide)
    assert all(p.is_file() for p in paths)
    start = paths[-1].read_text(encoding="utf-8")
    ours = [page.link[0] for page in PAGES if page.link[0] in names]
    assert ours == ["guide/index.html"]
    assert all(f'href="{name}"' in start for name in (*ours, *(f"{c.name}.html" for c in catalogs)))
    text = (folder / "chains-1-undamped.html").read_text(encoding="utf-8")
    assert all(f'href="{catalogs[0].name}{ending}"' in text for ending in ENDINGS[1:])


@pytest.mark.full
def test_data_are_the_catalogues_own(tmp_path: Path) -> None:
    source = catalog(2, damped=False)
    write_report([source], tmp_path)
    assert (tmp_path / "chains-2-undamped.csv").read_text(encoding="utf-8") == source.to_csv()
    assert json.loads((tmp_path / "chains-2-undamped.json").read_text(encoding="utf-8"))["verdicts"]


@pytest.mark.full
def test_the_index_leads_to_pages_of_other_commands_where_they_are(tmp_path: Path) -> None:
    (tmp_path / "paper").mkdir()
    (tmp_path / "paper" / "index.html").write_text("", encoding="utf-8")
    start = write_report([catalog(2, damped=False)], tmp_path)[-1].read_text(encoding="utf-8")
    assert 'href="paper/index.html"' in start and 'href="fit.html"' not in start


@pytest.mark.full
def test_families_with_ground_dampers_have_a_page_and_are_linked_both_ways(tmp_path: Path) -> None:
    found = [damper_family(2, damped=True), damper_family(1, damped=False)]
    paths = write_report([catalog(2, damped=True)], tmp_path, found)
    assert {p.name for p in paths if p.name.startswith("dampers-")} == {
        "dampers-1-undamped.html",
        "dampers-2-damped.html",
    }
    texts = {p.name: p.read_text(encoding="utf-8") for p in paths if p.suffix == ".html"}
    assert 'href="dampers-2-damped.html"' in texts["chains-2-damped.html"]
    assert (
        'href="chains-2-damped.html"' in texts["dampers-2-damped.html"]
        and "12 models, 66 pairs" in texts["index.html"]
    )
    assert 'href="chains-1-undamped.html"' not in texts["dampers-1-undamped.html"]  # not beside it
    for text in texts.values():
        for target in re.findall(r'href="(dampers-[^"#]+)', text):
            assert (tmp_path / target).is_file()


@pytest.mark.full
def test_the_index_keeps_pages_of_ground_dampers(tmp_path: Path) -> None:
    (tmp_path / "dampers-3-damped.html").write_text("", encoding="utf-8")
    texts = {
        p.name: p.read_text(encoding="utf-8")
        for p in write_report([catalog(3, damped=True)], tmp_path)
        if p.suffix == ".html"
    }
    assert (
        "88 models, 3,828 pairs" in texts["index.html"]
        and 'href="dampers-3-damped.html"' in texts["chains-3-damped.html"]
    )
    assert "dampers-3-damped.html" not in texts and not (
        tmp_path / "dampers-3-damped.html"
    ).read_text(encoding="utf-8")


@pytest.mark.full
def test_two_runs_write_the_same_bytes(tmp_path: Path) -> None:
    first, second = (write_report([catalog(2, damped=False)], tmp_path / name) for name in "ab")
    assert [p.read_bytes() for p in first] == [p.read_bytes() for p in second]


@pytest.mark.full
def test_the_index_keeps_the_pages_that_are_there(tmp_path: Path) -> None:
    for page in ("chains-3-undamped.html", "chains-1-damped.html"):
        (tmp_path / page).touch()
    start = write_report([catalog(2, damped=False)], tmp_path)[-1].read_text(encoding="utf-8")
    places = [
        start.index(f'href="chains-{name}.html"')
        for name in ("2-undamped", "3-undamped", "1-damped")
    ]
    assert places == sorted(places)  # one model has nothing to compare: last
