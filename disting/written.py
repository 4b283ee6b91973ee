"""Files that are whole or not there: written beside, then renamed, with the same bytes on every
system.
"""

import contextlib
import os
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import BinaryIO


def write_whole(path: Path, content: bytes | Iterable[str]) -> Path:
    """Write bytes, or texts as UTF-8, to a file; returns its path. What UTF-8 lacks, of odd file
    names, is escaped.

    A kill or a full disk leaves an older file as it was, and processes that write the same file at
    once leave that of one of them. A link stays a link; devices and pipes are written to as they
    are. Raises OSError that names the file.
    """
    parts = (
        (content,)
        if isinstance(content, bytes)
        else (text.encode(errors="backslashreplace") for text in content)
    )
    try:
        with _opened(path.resolve()) as file:
            file.writelines(parts)
    except OSError as reason:
        raise OSError(reason.errno, reason.strerror, str(path)) from None
    return path


@contextlib.contextmanager
def _opened(target: Path) -> Iterator[BinaryIO]:
    """A file that takes the target's place at the end, or the target itself where it is no
    plain file.
    """
    if target.exists() and not target.is_file():
        with target.open("wb") as file:
            yield file
        return
    beside = target.with_name(f"{target.name[:200]}.{os.getpid()}.partial")
    beside.unlink(missing_ok=True)  # of a killed process that had this number
    try:
        with beside.open("xb") as file:  # follows no link that somebody put there
            yield file
        beside.replace(target)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise
