"""The page on file formats shows the header of every CSV file that is written, as it is written."""

import csv
from pathlib import Path

import numpy as np
import pytest

import disting
from disting.catalogs.dampers import COLUMNS as DAMPERS
from disting.catalogs.export import CSV_COLUMNS as VERDICTS
from disting.measurement import csv_text
from disting.measurement.response import FrequencyResponse
from disting.report.fit import write
from disting.report.fit.left_words import MEASURED_COLUMNS
from disting.report.fit.network_page import COLUMNS as NETWORKS
from disting.report.fit.write import COLUMNS as CANDIDATES
from disting.report.model_list import COLUMNS as MODELS
from disting.simulation.bench import HEADER as SPECTRUM
from disting.verdict.next_words import CSV_COLUMNS as NEXT
from tests.cli.process import called

from .guide_blocks import TEXTS, blocks

SHOWN = [content.strip() for kind, content in blocks(TEXTS["formats.md"]) if kind == "csv"]
PLAN = "frequency_hz,difference,noise,share_optimal,share_run"


def response() -> str:
    some = np.arange(1.0, 9.0)
    found = FrequencyResponse(some, some * 1j, deviation=some / 100, coherence=some / 10)
    return next(line for line in csv_text(found).splitlines() if not line.startswith("#"))


def test_every_header_is_shown_as_it_is_written() -> None:
    assert PLAN in Path(write.__file__).read_text("utf-8")
    named = (
        VERDICTS,
        DAMPERS,
        MODELS,
        NEXT,
        NEXT + MEASURED_COLUMNS,
        ("rank", "name", *CANDIDATES),
        NETWORKS,
    )
    written = [",".join(columns) for columns in named]
    assert [*written, PLAN, ",".join(SPECTRUM), response()] == SHOWN


@pytest.mark.full
def test_no_other_module_writes_a_table() -> None:
    """Who adds one finds this test, and the page that says what is in it."""
    root = Path(disting.__file__).parent
    found = {
        path.relative_to(root).as_posix()
        for path in root.rglob("*.py")
        if any(sign in path.read_text("utf-8") for sign in ("csv.writer(", "_csv(", "csv_lines("))
    }
    assert {"catalogs/export.py", "report/model_list.py", "report/fit/write.py"} <= found
    assert found <= {
        "catalogs/catalog.py", "catalogs/dampers.py", "catalogs/export.py", "cli/dampers.py", "cli/next.py", "cli/verdicts.py",
        "measurement/files.py", "report/fit/network_page.py", "report/fit/plan_page.py", "report/fit/write.py",
        "report/model_list.py", "report/write.py", "simulation/bench.py",
    }  # fmt: skip


@pytest.mark.thin(1)
@pytest.mark.parametrize(
    ("words", "table"),
    [
        (("verdicts", "2", "--csv", "-"), 0),
        (("dampers", "2:1", "--csv", "-"), 1),
        (("dampers", "3", "--csv", "-"), 1),
        (("next", "3:1", "3:11", "--csv", "-"), 3),
    ],
)
def test_commands_write_these_headers(words: tuple[str, ...], table: int) -> None:
    done = called(*words)
    assert done.returncode == 0, done.stderr
    header, *rows = csv.reader(done.stdout.splitlines())
    assert ",".join(header) == SHOWN[table] and all(len(row) == len(header) for row in rows)


def test_every_catalogue_file_is_named() -> None:
    page = TEXTS["formats.md"].partition("## Catalogues")[2]
    folder = Path(disting.__file__).parents[1] / "catalog"
    stems = {path.stem.split("-")[0] for path in folder.glob("*.jsonl")}
    assert {stem for stem in stems if f"`{stem}" not in page} == set() and len(stems) == 7
