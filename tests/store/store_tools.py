"""What the tests of the store share: worker processes, warnings, damage done behind the store's
back.
"""

import contextlib
import os
import signal
import sqlite3
import subprocess
import sys
import warnings
from collections.abc import Iterator
from pathlib import Path

from disting.store.store import CacheWarning, Store
from tests.store.store_worker import items

WORKER = Path(__file__).with_name("store_worker.py")
ROOT = Path(__file__).parents[2]
TEN = items(range(10))
LONG = 600  # seconds, after which something hangs, however busy the machine is


def start(*arguments: object) -> subprocess.Popen[bytes]:
    """A worker process; see store_worker.py for the tasks."""
    return subprocess.Popen(
        [sys.executable, str(WORKER), *map(str, arguments)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        bufsize=0,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )


def first_line(process: subprocess.Popen[bytes]) -> str:
    """Read unbuffered, so that the lines after it are left for finish or stop."""
    assert process.stdout is not None
    return process.stdout.readline().decode()


def finish(process: subprocess.Popen[bytes]) -> list[str]:
    """The lines a worker printed; it must end well and print no traceback."""
    output, errors = process.communicate(timeout=LONG)
    assert (process.returncode, errors) == (0, b"")
    return output.decode().splitlines()


def stop(process: subprocess.Popen[bytes]) -> list[str]:
    """Kill a worker at once; the lines it had printed."""
    process.send_signal(signal.SIGKILL)
    output, errors = process.communicate(timeout=LONG)
    assert (process.returncode, errors) == (-signal.SIGKILL, b"")
    return output.decode().splitlines()


@contextlib.contextmanager
def cache_warnings(number: int) -> Iterator[list[str]]:
    """Exactly this many cache warnings, and no other warning, arise in the block."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        messages: list[str] = []
        yield messages
        messages.extend(str(item.message) for item in caught)
    assert [item.category for item in caught] == [CacheWarning] * number, messages


def aside(path: Path) -> list[str]:
    """Names of the main files that were set aside."""
    return sorted(p.name for p in path.parent.glob("*.damaged-*") if p.name[-1].isdigit())


def alter(path: Path, *statements: str) -> None:
    """Change a database behind the store's back."""
    with contextlib.closing(sqlite3.connect(path, isolation_level=None)) as connection:
        for statement in statements:
            connection.execute(statement)


def overwrite(path: Path, offset: int, content: bytes) -> None:
    with path.open("r+b") as file:
        file.seek(offset)
        file.write(content)


def works(store: Store) -> bool:
    """Whether new entries can be written and read, without any warning."""
    with cache_warnings(0):
        store.put_many(items(range(1000, 1010)))
        return store.get_many(items(range(1000, 1010))) == items(range(1000, 1010))


def keeps_nothing(store: Store) -> bool:
    """Whether the store is without cache, silently."""
    with cache_warnings(0):
        store.put_many(TEN)
        return (store.get_many(TEN), store.info().entries, store.clear()) == ({}, 0, 0)
