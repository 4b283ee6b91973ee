"""The file behind a store: where it is, whether it is ours and whole, how it is made and set aside.

The path holds either nothing or a complete database: a new one is made under another name and
renamed into place under an advisory lock, so a process killed at any moment leaves no half-made
file, and of many processes that find the same damage one alone replaces the file. The others see
by the inode number that the path holds another file, and open that one.
"""

import contextlib
import os
import re
import sqlite3
from pathlib import Path
from typing import Final

from disting.errors import InputError, short

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
            f"{VARIABLE} is {short(text)}, which is none of its three choices: off, :memory:, or a"
            " file in a folder that is there, such as cache.sqlite3"
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
            "it is no cache of disting and is left as it is; name another file with DISTING_CACHE"
        )
    with FileLock(path + LOCK).acquire(wait, PAUSE_SECONDS):
        if identity(path) != suspect:
            return ""
        name = "" if suspect == MISSING else _set_aside(path)
        _build(path)
    return name


def _was_ours(path: str) -> bool:
    """Whether what the path holds is a damaged cache, and not some file of the user's that was
    named by mistake.

    Our caches bear a stamp, and have a lock beside them from the moment they are made. The file is
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
    """What passes may be opened, or renamed if it is not ours; a device or a folder in use may
    not.
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
