"""Files: the data that the package ships, read whole, and files that are written whole or not at
all, with the same bytes on every system.
"""

import contextlib
import json
import os
import re
from collections.abc import Iterable, Iterator
from hashlib import sha256
from pathlib import Path
from typing import BinaryIO

from disting.errors import CatalogError

PROVENANCE = "provenance.json"
STREAM = re.compile(r"/(?:dev|proc/self)/fd/(\d+)")  # a stream of this process, not a place
__version__ = "0.2.0"  # of the package; files that it writes name it


def shipped_folder() -> Path:
    """Folder of the shipped files: inside the installed package, or at the top of a checkout."""
    package = Path(__file__).parent
    inside = package / "shipped"
    return inside if inside.is_dir() else package.parent / "catalog"


def intact_text(path: Path) -> str:
    """Text of a data file; raises CatalogError if the provenance beside it names another digest,
    OSError if it cannot be read.

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


def write_whole(path: Path, content: bytes | Iterable[str]) -> Path:
    """Write bytes, or texts as UTF-8, to a file; returns its path. What UTF-8 lacks, of odd file
    names, is escaped.

    A kill or a full disk leaves an older file as it was, and processes that write the same file at
    once leave that of one of them. A link stays a link; devices, pipes and open streams (/dev/fd/3)
    are written to as they are. Raises OSError that names the file.
    """
    parts = (content,) if isinstance(content, bytes) else map(in_bytes, content)
    try:
        with _opened(path) as file:
            file.writelines(parts)
    except OSError as reason:
        raise OSError(reason.errno, reason.strerror, str(path)) from None
    return path


def in_bytes(text: str) -> bytes:
    """UTF-8; what it lacks, of odd file names, is escaped, which in JSON means the same."""
    return text.encode(errors="backslashreplace")


@contextlib.contextmanager
def _opened(path: Path) -> Iterator[BinaryIO]:
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
