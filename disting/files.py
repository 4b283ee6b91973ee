"""Files: the data that the package ships, read whole; files that a user names, never read without
a bound; and files that are written whole or not at all, with the same bytes on every system.

All JSON that is written comes from `json_text`, where a number that is not finite is null, with its
format at "format". A field that is added leaves its number as it is; one that goes, or means
something else, raises it. Of each there is a JSON Schema; definitions that several share are in one
file.
"""

import contextlib
import json
import os
import re
import stat
import threading
import warnings
from collections.abc import Iterable, Iterator
from enum import StrEnum
from hashlib import sha256
from math import isfinite
from pathlib import Path
from typing import Any, BinaryIO

from disting.errors import CatalogError, InputError, of_type, printable, short
from disting.quantities import Quantity

PROVENANCE = "provenance.json"
RECORDS = "records"  # name of the schema of lines of shipped files
STREAM = re.compile(r"/(?:dev|proc/self)/fd/(\d+)")  # a stream of this process, not a place
LARGEST = 50_000_000  # bytes of a file, unless its reader takes more
PART = 1 << 20  # bytes that are read at once of what does not tell its size
PATIENCE = 2.0  # seconds after which a pipe that says nothing is spoken of
DEFINITION = re.compile(r'"#/\$defs/(\w+)"')  # in a JSON Schema
__version__ = "0.4.0"  # of the package; files that it writes name it


def shipped_folder() -> Path:
    """Folder of the shipped files: inside the installed package, or at the top of a checkout."""
    package = Path(__file__).parent
    inside = package / "shipped"
    return inside if inside.is_dir() else package.parent / "catalog"


def intact_text(path: Path) -> str:
    """Text of a data file; raises CatalogError if the provenance file next to it names another
    digest, OSError if it cannot be read.

    Only the file that is read is hashed, as far as it went when the provenance was written if that
    names a length ("digest: bytes"). A folder without provenance, such as one that is just made,
    has nothing to compare.
    """
    content = path.read_bytes()
    wanted, _, length = _digests(path.parent).get(path.name, "").partition(":")
    named = content[: int(length)] if length.isdecimal() else content
    if wanted and wanted != sha256(named).hexdigest():
        remedy = "install disting anew, or build the file again with 'disting catalog'"
        raise CatalogError(
            f"{path} is damaged: it is not what {PROVENANCE} beside it names; {remedy}"
        )
    return content.decode("utf-8")


def _digests(folder: Path) -> dict[str, str]:
    """SHA-256 by file name."""
    path = folder / PROVENANCE
    if not path.is_file():
        return {}
    try:
        return {
            str(name): str(digest)
            for name, digest in json.loads(path.read_text(encoding="utf-8"))["files"].items()
        }
    except (ValueError, LookupError, TypeError, AttributeError):
        raise CatalogError(
            f"{path} is damaged; install disting anew, or build the catalogues again"
        ) from None


def read_bounded(path: Path, wanted: str, most: int = LARGEST) -> bytes:
    """The bytes of a file that a user names; `wanted` = what to name instead, for messages.

    A known size is compared with `most` before anything is read; of a pipe or a device no more than
    `most` is read. A pipe without a writer is waited for, with a warning after two seconds. Raises
    InputError for what is larger, or cannot be read.
    """
    name, size = printable(str(path)), 0
    try:
        about = path.stat()
        size = about.st_size if stat.S_ISREG(about.st_mode) else 0
        content = b"" if size > most else _at_most(path, size, most + 1)
    except (OSError, ValueError) as reason:
        why = getattr(reason, "strerror", None) or reason
        raise InputError(f"{name} cannot be read ({why}); name {wanted}") from None
    if max(size, len(content)) > most:
        raise InputError(f"{name} is larger than {most // 10**6} MB, too large; name {wanted}")
    return content


def as_path(path: object) -> Path:
    """A path that a user names; raises InputError for what is none."""
    return Path(of_type(path, str | os.PathLike, "a file is named by its path"))  # type: ignore[arg-type]


def read_json(path: Path, wanted: str) -> Any:
    """Read a JSON file of at most 50 MB, without duplicate keys; raises InputError."""
    content = read_bounded(path, wanted)
    try:
        return json.loads(content.decode("utf-8-sig"), object_pairs_hook=unique_keys)
    except InputError as reason:
        raise InputError(f"{printable(str(path))}: {reason}") from None
    except (ValueError, RecursionError):  # the second: brackets by the thousand
        raise InputError(f"{printable(str(path))} holds no JSON; name {wanted}") from None


def json_text(
    plain: object,
    *,
    indent: int | None = None,
    spaced: bool = False,
    ascii_only: bool = False,
    sort_keys: bool = False,
) -> str:
    """JSON text of plain data, compact unless it is to be indented or `spaced`. Every JSON that the
    package writes to a file, to standard output or into a page comes from here.

    JSON has no infinity and no NaN (RFC 8259, section 6): both are written as null, which means
    that there is no number. `ascii_only`: other characters are escaped.

    >>> json_text({"error": float("inf"), "J": 0.5})
    '{"error":null,"J":0.5}'
    """

    def written(data: object) -> str:
        """JSON text; raises ValueError for numbers that are not finite."""
        separators = (",", ":") if indent is None and not spaced else None
        return json.dumps(
            data,
            indent=indent,
            separators=separators,
            ensure_ascii=ascii_only,
            sort_keys=sort_keys,
            allow_nan=False,
        )

    try:
        return written(plain)
    except ValueError:  # rare, and a copy of a large catalogue takes long
        return written(_with_nulls(plain))


def _with_nulls(plain: object) -> object:
    """The same plain data, None in place of each number that is not finite."""
    if isinstance(plain, dict):
        return {key: _with_nulls(value) for key, value in plain.items()}
    if isinstance(plain, list | tuple):
        return [_with_nulls(value) for value in plain]
    return None if isinstance(plain, float) and not isfinite(plain) else plain


def unique_keys(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """A JSON object in which no key is doubled: of two values one would be lost."""
    entries = dict(pairs)
    if len(entries) < len(pairs):
        keys = [key for key, _ in pairs]
        name = next((value for key, value in pairs if key == "name"), None)
        where = f"model {short(name)}: " if name is not None else ""
        doubled = next(key for key in keys if keys.count(key) > 1)
        raise InputError(f"{where}{short(doubled)} is given twice; remove one of them")
    return entries


def _at_most(path: Path, size: int, most: int) -> bytes:
    """The first `most` bytes of a file of `size`, 0 where the system does not report it."""
    if size:
        with path.open("rb") as file:
            return _rest(file, file.read(size), most)
    word = threading.Timer(PATIENCE, _waiting, [path])
    word.daemon = True
    word.start()
    try:
        with path.open("rb") as file:  # waits for the writer of a pipe
            first = file.read1(PART)
            word.cancel()
            return _rest(file, first, most)
    finally:
        word.cancel()


def _rest(file: BinaryIO, first: bytes, most: int) -> bytes:
    """`first` and what comes behind it, at most `most` bytes in all."""
    parts, size = [first], len(first)
    while parts[-1] and size < most:
        parts.append(file.read(min(PART, most - size)))
        size += len(parts[-1])
    return b"".join(part for part in parts if part)


def _waiting(path: Path) -> None:
    warnings.warn(
        f"{printable(str(path))} is open, but nothing is written to it yet; still waiting, Ctrl-C"
        " stops it",
        stacklevel=2,
    )


def write_whole(path: Path, content: bytes | Iterable[str]) -> Path:
    """Write bytes, or texts as UTF-8, to a file; returns its path. What UTF-8 lacks, of odd file
    names, is escaped.

    A kill or a full disk leaves an older file as it was, and processes that write the same file at
    once leave that of one of them. A link stays a link; devices, pipes and open streams (/dev/fd/3)
    are written to as they are. Raises OSError that names the file.
    """
    parts = (content,) if isinstance(content, bytes) else map(in_bytes, content)
    try:
        with _open_replacement(path) as file:
            file.writelines(parts)
    except OSError as reason:
        raise OSError(reason.errno, reason.strerror, str(path)) from None
    return path


def in_bytes(text: str) -> bytes:
    """UTF-8; what it lacks, of odd file names, is escaped, which in JSON means the same."""
    return text.encode(errors="backslashreplace")


@contextlib.contextmanager
def _open_replacement(path: Path) -> Iterator[BinaryIO]:
    """A file that takes the place of the one that a path leads to at the end, or what it leads to
    where that is no plain file.
    """
    stream = STREAM.fullmatch(str(path))
    if stream:
        with open(int(stream[1]), "wb", closefd=False) as file:
            yield file
        return
    if path.exists() and not path.is_file():
        with path.open("wb") as file:
            yield file
        return
    target = path.resolve()
    beside = target.with_name(f"{target.name[:200]}.{os.getpid()}.partial")
    beside.unlink(missing_ok=True)  # of a killed process that had this number
    try:
        with beside.open("xb") as file:  # follows no link that somebody put there
            yield file
        beside.replace(target)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise


class Format(StrEnum):
    """Values of "format" in JSON files."""

    VERDICT = "disting verdict 2"
    EVERYWHERE = "disting verdicts for every place 1"
    VERDICTS = "disting verdicts 1"
    CATALOGUE = "disting catalogue 1"
    EQUIVALENTS = "disting equivalents 1"
    NETWORK_EQUIVALENTS = "disting equivalents of a network 1"
    NEXT = "disting next 1"
    NEXT_OF_FIT = "disting next of a fit 1"
    NEXT_OF_NETWORK_FIT = "disting next of a fit of networks 1"
    FIT = "disting fit 1"
    NETWORK_FIT = "disting fit of networks 1"
    PLAN = "disting plan 1"
    PLANS_OF_FIT = "disting plans of a fit 1"
    MODELS = "disting models 1"
    GATE = "disting gate 2"
    LOOK = "disting look 1"

    @property
    def short(self) -> str:
        """Its name on a command line, and that of its file.

        >>> Format.NEXT_OF_FIT.short
        'next-of-a-fit'
        """
        return "-".join(self.value.split()[1:-1])

    @property
    def description(self) -> str:
        """Content and origin of such a file."""
        return str(_read_schema(self.short)["description"])


def schema(of: Format) -> dict[str, Any]:
    """Its JSON Schema, which needs no other file.

    >>> schema(Format.NEXT)["title"], sorted(schema(Format.NEXT)["$defs"])[:2]
    ('disting next 1', ['certainty', 'next'])
    """
    return _with_definitions(_read_schema(of.short))


def record_schema() -> dict[str, Any]:
    """JSON Schema of one line of a shipped file (`catalog/*.jsonl`), which needs no other file.
    Each kind of file has a definition.

    >>> [name for name in record_schema()["$defs"] if name.endswith("_line")][:3]
    ['candidates_line', 'chains_line', 'dampers_line']
    """
    return _with_definitions(_read_schema(RECORDS))


def _with_definitions(own: dict[str, Any]) -> dict[str, Any]:
    """A schema with all definitions to which it refers, its own ones and those that are shared."""
    definitions = _read_schema("definitions") | own.get("$defs", {})
    definitions |= {"quantity": {"enum": [sensor.value for sensor in Quantity]}}
    needed: dict[str, Any] = {}
    new = _definitions(own)
    while new:
        needed |= {name: definitions[name] for name in sorted(new)}
        new = {n for name in new for n in _definitions(definitions[name])} - needed.keys()
    return own | {"$defs": dict(sorted(needed.items()))}


def _definitions(part: object) -> set[str]:
    """Definitions that a part of a schema refers to."""
    return set(DEFINITION.findall(json.dumps(part)))


def _read_schema(name: str) -> dict[str, Any]:
    text = (Path(__file__).parent / "schemas" / f"{name}.json").read_text(encoding="utf-8")
    content: dict[str, Any] = json.loads(text)
    return content
