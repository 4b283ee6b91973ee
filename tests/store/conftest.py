"""Places for caches."""

from pathlib import Path

import pytest

from disting.store.store import Store
from tests.store.store_tools import cache_warnings
from tests.store.store_worker import items


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Where a cache may be made."""
    return tmp_path / "cache.sqlite3"


@pytest.fixture
def filled(path: Path) -> Path:
    """A closed cache of 300 entries, about 350 kB."""
    with cache_warnings(0), Store.open(path) as store:
        store.put_many(items(range(300)))
    return path
