"""What does the site of the shipped catalogues cost, cold, and which part of it is which?

The ratio is that to the PNG figures alone: they are drawn and packed by Pillow, whatever is done
here.
"""

import subprocess
import sys
from pathlib import Path

import pytest

from disting import catalog
from disting.report.matrix import matrix_png
from tests.bench.measure import alternating, table

pytestmark = pytest.mark.bench
SIZES = (3, 4, 5)


def test_site(benchmark, tmp_path: Path) -> None:
    def site() -> None:
        numbers = map(str, SIZES)
        command = [sys.executable, "-m", "disting", "report", *numbers, "--no-cache", "--out"]
        subprocess.run([*command, str(tmp_path)], check=True, capture_output=True)

    def figures() -> None:
        for n in SIZES:
            for damped in (False, True):
                matrix_png(catalog(n, damped=damped))

    benchmark.pedantic(site, rounds=1)
    found = alternating({"the whole site": site, "its PNG figures alone": figures}, 3)
    rows = [
        (name, f"{time:.1f} s", f"{time / found['its PNG figures alone']:.2f}")
        for name, time in found.items()
    ]
    table("disting report 3 4 5, cold", ("what", "time", "ratio to the figures"), rows)
