"""What do all six catalogues of 3, 4 and 5 masses cost, cold, as whole processes, with one worker
and with two?

Conditions 1 to 9 on transfer functions, all Markov parameters and structure, then the exact
decision, with all evidence.
"""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.bench.measure import alternating, table

pytestmark = pytest.mark.bench


def test_catalogs(benchmark, tmp_path: Path) -> None:
    def build(jobs: int) -> None:
        command = [
            sys.executable,
            "-m",
            "disting",
            "catalog",
            "build",
            "3",
            "4",
            "5",
            "--no-cache",
            "--out",
            str(tmp_path),
        ]
        subprocess.run([*command, "--jobs", str(jobs)], check=True, capture_output=True)

    benchmark.pedantic(lambda: build(2), rounds=1)
    found = alternating({"1 process": lambda: build(1), "2 processes": lambda: build(2)}, 3)
    rows = [
        (name, f"{time:.1f} s", f"{time / found['2 processes']:.2f}")
        for name, time in found.items()
    ]
    table("All six catalogues, cold", ("workers", "time", "ratio"), rows)
