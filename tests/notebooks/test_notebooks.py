"""The notebooks of `reports/notebooks` hold their outputs and nothing of the machine that made them;
executed anew, they say the same.
"""

import getpass
import importlib.util
import io
import json
import re
import socket
import subprocess
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import pytest

ROOT = Path(__file__).parents[2]
NOTEBOOKS = sorted((ROOT / "reports" / "notebooks").glob("*.ipynb"))
NAMES = [
    "belt-axis", "bench-commissioned", "impedance-spectra", "own-models", "structure-and-behaviour",
    "two-responses",
]  # fmt: skip
LARGEST = 300_000  # bytes
PATHS = re.compile(r"/(?:home|root|tmp|Users|usr|opt|var|work)/|[A-Z]:\\\\")


def cells(path: Path) -> list[dict]:
    return [c for c in json.loads(path.read_text())["cells"] if c["cell_type"] == "code"]


def texts(path: Path) -> list[list[str]]:
    """What each cell prints and shows, but for pictures of matplotlib, whose bytes vary."""
    return [
        [
            "".join(part)
            for output in cell["outputs"]
            for part in (
                [output["text"]]
                if output["output_type"] == "stream"
                else [v for k, v in sorted(output["data"].items()) if k != "image/png"]
            )
        ]
        for cell in cells(path)
    ]


def test_each_is_named():
    assert [path.stem for path in NOTEBOOKS] == NAMES


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda p: p.stem)
def test_a_notebook_is_executed_small_and_of_no_machine(path):
    text = path.read_text(encoding="utf-8")
    assert len(text.encode()) < LARGEST
    shown = [cell for cell in cells(path) if cell["outputs"]]
    assert len(shown) > 6
    assert [c["execution_count"] for c in cells(path)] == list(range(1, len(cells(path)) + 1))
    kinds = {output["output_type"] for cell in shown for output in cell["outputs"]}
    assert "error" not in kinds
    streams = {o.get("name") for c in shown for o in c["outputs"] if o["output_type"] == "stream"}
    assert streams <= {"stdout"}
    written = json.dumps([json.loads(text), texts(path)], ensure_ascii=False)
    pictures = r'"image/png": "[^"]*"'
    written = re.sub(pictures, "", written)
    assert not PATHS.search(written)
    for name in {getpass.getuser(), socket.gethostname()}:
        assert not re.search(rf"\b{re.escape(name)}\b", written), name
    assert json.loads(text)["metadata"].keys() == {"kernelspec", "language_info"}


def test_drawings_tables_and_curves_are_in_them():
    kinds = {
        name
        for path in NOTEBOOKS
        for cell in cells(path)
        for output in cell["outputs"]
        for name in output.get("data", {})
    }
    assert kinds >= {"image/svg+xml", "text/html", "image/png", "text/latex", "text/plain"}


@pytest.mark.full
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda p: p.stem)
def test_every_cell_still_runs(path, tmp_path, monkeypatch):
    """In one process, without a kernel: names that have moved are found. What it says: by hand."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.stdout", io.StringIO())
    names = {"__name__": "__main__"}
    for at, cell in enumerate(cells(path), 1):
        exec(compile("".join(cell["source"]), f"{path.name}, cell {at}", "exec"), names)
    plt.close("all")


@pytest.mark.slow
@pytest.mark.skipif(not importlib.util.find_spec("nbclient"), reason="needs disting[dev]")
def test_executed_anew_they_say_the_same(tmp_path):
    command = [sys.executable, str(ROOT / ".ci" / "notebooks"), "--into", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    for path in NOTEBOOKS:
        assert texts(tmp_path / path.name) == texts(path), path.name
