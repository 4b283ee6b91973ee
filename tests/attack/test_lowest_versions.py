"""What pyproject.toml promises can be installed together, and works; needs a package index,
takes minutes.
"""

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.attack
SCRIPT = Path(__file__).with_name("lowest_versions.py")
PART = (
    "tests/algebra",
    "tests/behaviour",
    "tests/measurement",
    "tests/fit/test_export.py",
    "tests/store/test_store.py",
)


def test_the_lowest_versions(counts):
    done = subprocess.run(
        [sys.executable, str(SCRIPT), *PART],
        capture_output=True,
        text=True,
        check=False,
        timeout=600,
    )
    counts[done.stdout.strip().splitlines()[-1]] += 1
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
