"""Content-addressed store of computed results, kept in one SQLite file.

A wrong answer is the worst fault of a scientific cache, so nothing in the file is believed without
proof: the file is ours only if application id, schema version and table definition agree, and a
row is used only if its checksum over key and value agrees. What fails is set aside or removed, and
computed anew.

Two POSIX traps: closing any descriptor of a file drops all locks that the process has on it, so
the file is read through SQLite only. And a child of fork inherits SQLite's record of locks but not
the locks, so that even commits on a connection of its own can vanish; so the connection is closed
before every fork.
"""

import contextlib
import os
import sqlite3
import threading
import time
import warnings
import weakref
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from hashlib import blake2b
from pathlib import Path
from typing import Final, Self, TypeVar

from disting.store.database_file import (
    BUSY_CODES,
    DAMAGE_CODES,
    MEMORY,
    MISSING,
    NOWHERE,
    PAUSE_SECONDS,
    SCHEMA_VERSION,
    identity,
    locate,
    open_database,
    replace,
    result_code,
)

T = TypeVar("T")
Record = tuple[bytes, bytes, bytes]  # key, checksum, value

# A damaged or altered cell may have any type; read as bytes it fails the checksum instead of the
# program.
CELLS: Final = "CAST(coalesce(checksum, '') AS BLOB), CAST(coalesce(value, '') AS BLOB)"
SELECT: Final = f"SELECT {CELLS} FROM entry WHERE key = ?"
REPLACE: Final = "INSERT OR REPLACE INTO entry (key, checksum, value) VALUES (?, ?, ?)"
SIZE: Final = "SELECT page_count * page_size FROM pragma_page_count, pragma_page_size"
COUNT: Final = f"SELECT count(*), ({SIZE}) FROM entry"
DELETE: Final = f"DELETE FROM entry WHERE key = ? AND ({CELLS}) = (?, ?)"


class CacheWarning(UserWarning):
    """The cache was damaged or cannot be used; results stay right, only slower to get.

    >>> import warnings
    >>> warnings.simplefilter("ignore", CacheWarning)  # in a program that may lose its cache
    """


@dataclass(frozen=True)
class StoreInfo:
    """What a store holds. `path` is "" for no cache; `bytes` is page count times page size."""

    path: str
    entries: int
    bytes: int
    schema_version: int
    sqlite_version: str


def _checksum(key: bytes, value: bytes) -> bytes:
    """BLAKE2b-128 of key length (8 bytes, big-endian), key, value: a value under another key
    fails too.
    """
    return blake2b(len(key).to_bytes(8, "big") + key + value, digest_size=16).digest()


def _read(connection: sqlite3.Connection, keys: Iterable[bytes]) -> list[Record]:
    return [(key, *cells) for key in keys for cells in connection.execute(SELECT, (key,))]


def _change(connection: sqlite3.Connection, statement: str, rows: Iterable[Record]) -> None:
    with connection:
        connection.execute("BEGIN IMMEDIATE")
        connection.executemany(statement, rows)


def _empty(connection: sqlite3.Connection) -> int:
    removed = connection.execute("DELETE FROM entry").rowcount
    # space is given back only if nobody is reading
    with contextlib.suppress(sqlite3.OperationalError):
        connection.execute("VACUUM")
        connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    return removed


class Store(contextlib.AbstractContextManager["Store", None]):
    """Text values by content-addressed key; every value read has passed its checksum.

    Keys are SHA-256 hex strings that the caller makes from all that determines the value (model,
    settings, code version); values are JSON text. UnicodeEncodeError if one is not encodable as
    UTF-8; no state of the file or the disk raises an error, see CacheWarning. Threads may share a
    store, and so may forks.

    >>> from disting import Engine, compare
    >>> with Store.open(":memory:") as store:
    ...     compare("4:1", "5:2", engine=Engine(store=store)).relation.value
    'distinguishable'
    """

    def __init__(self, path: str, wait_seconds: float) -> None:
        """Use `Store.open` or `Store.none` instead."""
        self._path, self._wait, self._usable = path, wait_seconds, path != NOWHERE
        self._connection: sqlite3.Connection | None = None
        self._seen = MISSING
        self._lock = threading.RLock()
        if self._usable:
            _guard_forks(self)

    def __repr__(self) -> str:
        return f"<Store: {self._path if self._usable else 'keeps nothing'}>"

    @classmethod
    def open(cls, where: str | Path | None = None, *, wait_seconds: float = 10.0) -> Self:
        """Open the store at a file path, ":memory:" (private to this object), or "" or "off" (no
        cache).

        None means the environment variable DISTING_CACHE, or if that is not set `cache.sqlite3` in
        the user's cache folder. Missing folders are made, but not for the variable: what is
        neither one of these words nor a file in a folder that is there raises InputError.

        An operation that finds the database locked by another process waits up to twice
        `wait_seconds`, and then the store gives up the cache.
        """
        store = cls(locate(where), wait_seconds)
        store._run(lambda connection: None, None)
        return store

    @classmethod
    def none(cls) -> Self:
        """A store that keeps nothing."""
        return cls(NOWHERE, 0.0)

    def get_many(self, keys: Iterable[str]) -> dict[str, str]:
        """The values of those keys that are present; rows with a wrong checksum are absent, and
        deleted.
        """
        names = [key.encode() for key in dict.fromkeys(keys)]
        nothing: list[Record] = []
        rows = self._run(lambda connection: _read(connection, names), nothing)
        sound = [row for row in rows if row[1] == _checksum(row[0], row[2])]
        if len(sound) < len(rows):
            # Deleted only as it was read: another process may have written a sound row meanwhile.
            unsound = set(rows).difference(sound)
            self._run(lambda connection: _change(connection, DELETE, unsound), None)
            self._warn(f"{len(unsound)} damaged entries were removed")
        return {key.decode(): value.decode() for key, _, value in sound}

    def put_many(self, items: Mapping[str, str]) -> None:
        """Store all items in one transaction, replacing the values of keys already present."""
        pairs = [(key.encode(), value.encode()) for key, value in items.items()]
        rows = [(key, _checksum(key, value), value) for key, value in pairs]
        if rows:
            self._run(lambda connection: _change(connection, REPLACE, rows), None)

    def info(self) -> StoreInfo:
        """Path, number of entries, size in bytes and versions."""
        entries, size = self._run(lambda connection: connection.execute(COUNT).fetchone(), (0, 0))
        return StoreInfo(
            path=self._path,
            entries=entries,
            bytes=size,
            schema_version=SCHEMA_VERSION,
            sqlite_version=sqlite3.sqlite_version,
        )

    def clear(self) -> int:
        """Remove all entries, and return how many there were. Files set aside earlier stay."""
        return self._run(_empty, 0)

    def close(self) -> None:
        """Close the file; from then on the store keeps nothing."""
        with self._lock:
            self._usable = False
            self._disconnect()

    def __exit__(self, *_: object) -> None:
        self.close()

    def _run(self, operation: Callable[[sqlite3.Connection], T], nothing: T) -> T:
        """The result of the operation, repeated once after a repair; `nothing` if there is no
        cache.
        """
        if not self._usable:
            return nothing
        deadline = time.monotonic() + self._wait
        repaired = False
        with self._lock:
            while self._usable:
                try:
                    return operation(self._connected())
                except (sqlite3.DatabaseError, UnicodeDecodeError, OSError) as error:
                    repaired = self._recover(error, deadline, repaired)
        return nothing

    def _connected(self) -> sqlite3.Connection:
        """A connection to the file that the path holds now."""
        while (current := identity(self._path)) == MISSING:
            replace(self._path, MISSING, self._wait)
        if self._connection is None or current != self._seen:
            self._disconnect()
            self._seen = current
            self._connection = open_database(self._path, self._wait)
            # If the path changed hands in between, SQLite may have paired the old file with the new
            # log.
            if identity(self._path) != self._seen:
                raise sqlite3.OperationalError("the file was replaced while it was opened")
        return self._connection

    def _recover(self, error: Exception, deadline: float, repaired: bool) -> bool:
        """Prepare another attempt, or switch the store off; tells whether a repair has been
        made.
        """
        self._disconnect()
        code = result_code(error)
        try:
            # An error in a file that is no longer at the path says nothing about the one that is.
            passing = code in BUSY_CODES or identity(self._path) != self._seen
            if passing and time.monotonic() < deadline:
                time.sleep(PAUSE_SECONDS)
                return repaired
            # A damaged header can declare a file read-only that is not.
            false_lock = code == sqlite3.SQLITE_READONLY and os.access(self._path, os.W_OK)
            if (code in DAMAGE_CODES or false_lock) and not repaired:
                name = replace(self._path, self._seen, self._wait)
                if name:
                    self._warn(f"{error}; set aside as {name}, a new cache was begun")
                return True
        except OSError as failure:
            error = failure
        self._usable = False
        self._warn(f"{error}; going on without cache")
        return repaired

    def _warn(self, message: str) -> None:
        warnings.warn(f"cache {self._path}: {message}", CacheWarning, stacklevel=2)

    def _disconnect(self) -> None:
        if self._connection is not None:
            self._connection.close()
        self._connection = None


def _guard_forks(store: Store) -> None:
    """At every fork, wait until no thread is inside the store, and close its file (see the
    module's text).
    """
    reference = weakref.ref(store)
    held: list[Store] = []

    def before() -> None:
        """Wait for other threads, and give up the connection, which must not cross a fork."""
        store = reference()
        if store is not None:
            store._lock.acquire()
            held.append(store)
            if store._path != MEMORY:  # a database in memory has no locks to lose
                store._disconnect()

    def after() -> None:
        """Let the threads go on, in the parent and in the child."""
        while held:
            held.pop()._lock.release()

    if hasattr(os, "register_at_fork"):  # not on Windows, which has no fork
        os.register_at_fork(before=before, after_in_parent=after, after_in_child=after)
