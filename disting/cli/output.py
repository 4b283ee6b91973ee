"""Where results go: words to standard output as it can show them, data to a file or to standard
output as the same bytes, UTF-8, whatever that can show. Files and folders are looked at before the
work begins, so that nothing is computed in vain.
"""

import argparse
import os
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TextIO

from disting.errors import InputError
from disting.files import in_bytes, write_whole


def written_file(text: str) -> str:
    """A file that can be written, or - for standard output; raises ArgumentTypeError.

    >>> written_file("-")
    '-'
    """
    path = Path(text)
    if text in ITS_NAMES:
        return "-"
    if text == "/dev/stderr":  # by its number it is a stream, whatever it leads to
        return "/dev/fd/2"
    if not text or "\0" in text or path.is_dir():
        raise argparse.ArgumentTypeError(
            f"{text or 'an empty name'} is no file; name a file, or - for standard output"
        )
    if not path.parent.is_dir():
        raise argparse.ArgumentTypeError(
            f"there is no folder {path.parent}; make it first, or name another file"
        )
    if not (os.access(path, os.W_OK) if path.exists() else _takes_files(path.parent)):
        raise argparse.ArgumentTypeError(f"{text} may not be written; name another file")
    return text


def written_folder(text: str) -> Path:
    """A folder that is there or can be made; raises ArgumentTypeError."""
    path = Path(text)
    there = next(p for p in (path, *path.absolute().parents) if p.exists())
    if not there.is_dir():
        raise argparse.ArgumentTypeError(f"{there} is a file, not a folder; name another folder")
    if not _takes_files(there):
        raise argparse.ArgumentTypeError(f"{there} may not be written to; name another folder")
    return path


def _takes_files(folder: Path) -> bool:
    """Whether a file can be made there: tried, since permissions do not tell it of all folders, nor
    of all users.
    """
    from tempfile import TemporaryFile

    try:
        with TemporaryFile(dir=folder):
            return True
    except OSError:
        return False


STANDARD = "standard output"
ITS_NAMES = ("-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1")


class Output:
    """A stream whose errors name it, as those of a file do."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def write(self, text: str) -> int:
        """As the stream; raises OSError that names it."""
        try:
            return self._stream.write(text)
        except OSError as reason:
            raise _named(reason) from None

    def flush(self) -> None:
        """As the stream; raises OSError that names it."""
        try:
            self._stream.flush()
        except OSError as reason:
            raise _named(reason) from None

    def write_bytes(self, content: bytes) -> None:
        """Bytes as they are, behind the text that is written; raises OSError that names it."""
        self.flush()
        rest = memoryview(content)
        try:
            while rest:  # an unbuffered stream may take a part
                rest = rest[self._stream.buffer.write(rest) :]
        except OSError as reason:
            raise _named(reason) from None

    def __getattr__(self, name: str) -> object:
        return getattr(self._stream, name)


def emitted(where: str, text: str) -> None:
    """Write data to a file, or to standard output for -; raises InputError where a file cannot be
    written, OSError where standard output cannot.
    """
    emitted_lines(where, [text])


def emitted_lines(where: str, lines: Iterable[str]) -> None:
    """As `emitted`, line by line as they come."""
    if where == "-":
        _to_standard_output(lines)
        return
    try:
        write_whole(Path(where), lines)
    except OSError as reason:
        raise InputError(
            f"{where} cannot be written ({reason.strerror}); name another file, or - for {STANDARD}"
        ) from None


def _to_standard_output(lines: Iterable[str]) -> None:
    stream = sys.stdout
    if isinstance(stream, Output) and hasattr(stream, "buffer"):
        for line in lines:
            stream.write_bytes(in_bytes(line))
    else:  # somebody's own stream, which takes text alone
        stream.writelines(lines)


def _named(reason: OSError) -> OSError:
    return OSError(reason.errno, reason.strerror, STANDARD)
