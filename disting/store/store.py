"""Content-addressed store of computed results, kept in one SQLite file.

A wrong answer is the worst fault of a scientific cache, so nothing in the file is believed without
proof: the file is ours only if application id, schema version and table definition agree, and a row
is used only if its checksum over key and value agrees. What fails is set aside or removed, and
computed again.

Two POSIX traps: closing any descriptor of a file drops all locks that the process has on it, so
the file is read through SQLite only. And a child of fork inherits SQLite's record of locks but not
the locks, so that even commits on a connection of its own can vanish; so the connection is closed
before every fork.

The path of the file holds either nothing or a complete database: a new one is made under another
name and renamed into place under an advisory lock, so a process killed at any moment leaves no
half-made file, and of many processes that find the same damage one alone replaces the file. The
others detect by the inode number that the path holds another file, and open that one.

A key holds a digest of the code that a result depends on, found from the imports, with the versions
of the libraries it uses. A key that names too little code serves a stale result after a change; so
nothing is listed by hand. The modules are those that one imports, directly or not, inside this
package. What a package's `__init__` offers to others counts only where the package itself is
imported from.
"""

import contextlib
import os
import re
import sqlite3
import sys
import threading
import time
import warnings
import weakref
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from hashlib import blake2b, sha256
from pathlib import Path
from typing import Final, Self, TypeVar

from disting.errors import InputError, short

PACKAGE = Path(__file__).parents[1]
LIBRARIES = ("numpy", "scipy", "python-flint")  # whose numbers may change with a version
IMPORT = re.compile(rf"^[ ]*from ({PACKAGE.name}[\w.]*) import (\([^)]*\)|.*)", re.MULTILINE)
NAME = re.compile(r"\w+")
TEXT = re.compile(r'"((?:\w+\.)+\w+)(?::\w+)?"')  # a module, or a function in it


@cache
def digest(module: str) -> str:
    """SHA-256 of the source of a module and of all that it imports here, and of the versions of
    Python and the libraries.

    >>> digest("disting.fit.search.exchange") == digest("disting.verdict.engine")
    False
    """
    from importlib.metadata import version

    sources = _sources()
    versions = [sys.version.split()[0], *(f"{name} {version(name)}" for name in LIBRARIES)]
    texts = [text for name in modules_of(module) for text in (name, sources[name])]
    return sha256("\0".join([*versions, *texts]).encode()).hexdigest()


@cache
def modules_of(module: str) -> tuple[str, ...]:
    """A module and all modules of this package that it imports, directly or not, in order of their
    names.

    >>> modules_of("disting.quantities")
    ('disting.errors', 'disting.quantities')
    """
    sources, modules, new = _sources(), set[str](), {module}
    while new:
        modules |= new
        new = {
            name for old in new for name in _list_imports(sources[old]) if name in sources
        } - modules
    return tuple(sorted(modules))


def _list_imports(source: str) -> Iterator[str]:
    """Names that may be modules: what is imported from, and with what is imported from it (a
    name may be a module); and texts "folder.module:function", by which tables name
    functions.
    """
    for origin, names in IMPORT.findall(source):
        yield origin
        yield from (f"{origin}.{name}" for name in NAME.findall(names))
    yield from (f"disting.{name}" for name in TEXT.findall(source))


@cache
def _sources() -> dict[str, str]:
    """Source text by the name of the module, a package by its own name; without the top one,
    which only names the API.
    """
    texts = {}
    for path in sorted(PACKAGE.rglob("*/*.py")) + [
        p for p in sorted(PACKAGE.glob("*.py")) if p.stem != "__init__"
    ]:
        parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
        texts[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path.read_text(
            encoding="utf-8"
        )
    return texts


Identity = tuple[int, int]  # device and inode number: which file a path holds

APPLICATION_ID: Final = 0x64737467  # "dstg" in ASCII, bytes 68 to 71 of the file
SCHEMA_VERSION: Final = 1
SCHEMA: Final = (
    "CREATE TABLE entry (key BLOB PRIMARY KEY, checksum BLOB NOT NULL, value BLOB NOT NULL)"
)
VARIABLE: Final = "DISTING_CACHE"
NOWHERE: Final = ""
OFF: Final = "off"
MEMORY: Final = ":memory:"
MISSING: Final = (0, 0)
IN_MEMORY: Final = (-1, -1)
LOCK: Final = ".lock"
SIDES: Final = ("-wal", "-shm", "-journal")  # what SQLite appends to the name for its other files
MOST_SET_ASIDE: Final = 99  # bounds the disk space taken by damaged files
PAUSE_SECONDS: Final = 0.01
# SQLite's primary result codes. Those in neither list (full disk, no permission) say nothing about
# the file.
BUSY_CODES: Final = (5, 6, 15)  # BUSY, LOCKED, PROTOCOL
# ERROR to CORRUPT, SCHEMA to MISMATCH, FORMAT, NOTADB
DAMAGE_CODES: Final = (1, 2, 11, 17, 19, 20, 24, 26)


class _ForeignError(sqlite3.DatabaseError):
    sqlite_errorcode = sqlite3.SQLITE_NOTADB


def locate(where: str | Path | None) -> str:
    """The absolute path of the database file, or MEMORY, or NOWHERE; raises InputError where the
    variable holds none of them.
    """
    default = str(_usual_folder() / "cache.sqlite3")
    text = os.environ.get(VARIABLE) if where is None else str(where)
    word = default if text is None else text.strip().lower()
    if word in (NOWHERE, OFF):
        return NOWHERE
    if word == MEMORY:
        return MEMORY
    if text is not None and where is None:
        _refuse_no_file(text)
    # Symbolic links are followed, so that all processes lock and rename beside the same file.
    return os.path.realpath(os.path.expanduser(default if text is None else text))


def _usual_folder() -> Path:
    from platformdirs import user_cache_path

    return user_cache_path("disting")


def _refuse_no_file(text: str) -> None:
    """Of the variable a plain word is no file: who writes 0 or no means something else. A file has
    an ending, or a folder before its name.
    """
    path = os.path.expanduser(text)
    folder, name = os.path.split(path)
    is_file = name and (folder or re.search(r"\.[a-z]\w*$", name, re.IGNORECASE))
    is_address = re.match(r"\w{2,}:", text)  # file:x?mode=memory; C: is a drive
    is_other = os.path.exists(path) and not os.path.isfile(path)
    if not is_file or is_address or is_other or not os.path.isdir(folder or os.curdir):
        raise InputError(
            f"{VARIABLE} is {short(text)}; it can be off, :memory:, or a file in an existing"
            " folder, such as cache.sqlite3"
        )


def identity(path: str) -> Identity:
    """Device and inode number of the file at a path: whether it is still the same file."""
    if path == MEMORY:
        return IN_MEMORY
    try:
        status = os.stat(path, follow_symlinks=False)
    except FileNotFoundError:
        return MISSING
    return (status.st_dev, status.st_ino)


def result_code(error: Exception) -> int:
    """SQLite's primary result code, the low byte of the extended one; 0 if SQLite reported none."""
    # Python cannot always decode the message about a damaged table definition.
    unknown = sqlite3.SQLITE_CORRUPT if isinstance(error, UnicodeDecodeError) else 0
    return int(getattr(error, "sqlite_errorcode", unknown)) & 0xFF


def _create(connection: sqlite3.Connection) -> None:
    connection.execute(f"PRAGMA application_id = {APPLICATION_ID}")
    connection.execute(f"PRAGMA user_version = {SCHEMA_VERSION}")
    connection.execute(SCHEMA)
    # Last, so that the table is in the main file. Where WAL is impossible the rollback journal
    # stays.
    with contextlib.suppress(sqlite3.OperationalError):
        connection.execute("PRAGMA journal_mode = WAL")


def _build(path: str) -> None:
    draft = path + ".new"
    # Left by a process that was killed in here, or by a removal of the main file alone. SQLite
    # would replay a log that lies beside the new database, whatever database it came from.
    for name in (draft, *(file + side for file in (draft, path) for side in SIDES)):
        Path(name).unlink(missing_ok=True)
    with contextlib.closing(sqlite3.connect(draft, isolation_level=None)) as connection:
        _create(connection)
    os.rename(draft, path)


def _set_aside(path: str) -> str:
    names = [f"{path}.damaged-{number}" for number in range(1, MOST_SET_ASIDE + 1)]
    free = [
        name for name in names if not any(os.path.lexists(name + side) for side in ("", *SIDES))
    ]
    if not free:
        raise OSError(f"{MOST_SET_ASIDE} damaged files are kept beside it, remove some")
    for side in ("", *SIDES):  # the main file first, so that nobody opens it without its log
        with contextlib.suppress(FileNotFoundError):
            os.rename(path + side, free[0] + side)
    return free[0]


def replace(path: str, suspect: Identity, wait: float) -> str:
    """Put an empty database in place of `suspect`; "" if there was nothing to set aside."""
    from filelock import FileLock

    os.makedirs(os.path.dirname(path), exist_ok=True)
    if suspect != MISSING and not _was_ours(path):
        raise OSError(
            "it is not a cache of disting and is left as it is; name another file with"
            " DISTING_CACHE"
        )
    with FileLock(path + LOCK).acquire(wait, PAUSE_SECONDS):
        if identity(path) != suspect:
            return ""
        name = "" if suspect == MISSING else _set_aside(path)
        _build(path)
    return name


def _was_ours(path: str) -> bool:
    """Return True if the path holds a damaged cache, not some file of the user's that was named by
    mistake.

    Our caches bear a stamp, and have a lock next to them from the moment they are made. The file is
    read only here, where it could not be used: to close it would drop the locks on one that is in
    use.
    """
    if os.path.lexists(path + LOCK) or Path(path).parent == _usual_folder():
        return True
    with contextlib.suppress(OSError), open(path, "rb") as file:
        head = file.read(100)
        return not head or head[68:72] == APPLICATION_ID.to_bytes(4, "big")
    return False


def _check_kind(path: str) -> None:
    """Check that the path may be opened, or renamed if it is not ours; raises an error for a device
    or a folder in use.
    """
    if os.path.isdir(path) and not os.listdir(path):
        raise _ForeignError("it is a folder")
    if not os.path.isfile(path):
        raise OSError("it is neither a file nor an empty folder")


def _check_stamps(connection: sqlite3.Connection) -> None:
    queries = (
        "PRAGMA application_id",
        "PRAGMA user_version",
        "SELECT sql FROM sqlite_master WHERE sql > ''",
    )
    stamps = [connection.execute(query).fetchall() for query in queries]
    if stamps != [[(APPLICATION_ID,)], [(SCHEMA_VERSION,)], [(SCHEMA.encode(),)]]:
        raise _ForeignError("it is not a cache of this version of disting")


def open_database(path: str, wait: float) -> sqlite3.Connection:
    """Connect to an existing database that passes the checks, or to a new one in memory."""
    if path != MEMORY:
        _check_kind(path)
    # rw: never creates a file
    target = path if path == MEMORY else Path(path).as_uri() + "?mode=rw"
    connection = sqlite3.connect(
        target, timeout=wait, isolation_level=None, check_same_thread=False, uri=True
    )
    with contextlib.ExitStack() as on_failure:
        on_failure.callback(connection.close)
        connection.text_factory = bytes  # damaged text must not fail to decode before it is checked
        if path == MEMORY:
            _create(connection)
        _check_stamps(connection)
        # a commit outlives the process, if not a power cut
        connection.execute("PRAGMA synchronous = NORMAL")
        on_failure.pop_all()
    return connection


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
    """Content and size of a store. `path` is "" for no cache; `bytes` is page count times page
    size.
    """

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
                    return operation(self._connect())
                except (sqlite3.DatabaseError, UnicodeDecodeError, OSError) as error:
                    repaired = self._recover(error, deadline, repaired)
        return nothing

    def _connect(self) -> sqlite3.Connection:
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
        """Prepare another attempt, or switch the store off; returns True if a repair has been
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
