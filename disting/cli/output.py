"""Where results go: words to standard output as it can show them, data to a file or to standard
output as the same bytes, UTF-8, whatever that can show.
"""

import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TextIO

from disting.errors import InputError
from disting.files import in_bytes, write_whole

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
