"""Measured third-party data, beside the checkout where they are there at all."""

from pathlib import Path

import pytest

DATA = Path(__file__).parents[3] / "shared" / "data"


def measured_data(name):
    """Path of a file; the test is skipped where it is absent."""
    path = DATA / name
    if not path.exists():
        pytest.skip(f"measured data {name} is not in ../shared/data")
    return path
