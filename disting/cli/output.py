"""Text for terminals and files that cannot hold every character, such as the code pages of
Windows, or ASCII.

What has no place there is written with signs that have: formulas stay readable, and no output ends
in an error.

Where results go: words to standard output as it can show them, data to a file or to standard output
as the same bytes, UTF-8, whatever that can show. Files and folders are checked before the work
begins, so that no computation is wasted.
"""

import argparse
import codecs
import os
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TextIO
from unicodedata import normalize

from disting.errors import InputError, brief
from disting.files import in_bytes, write_whole

HANDLER = "disting.plain"
PLAIN = {
    "≠": "!=", "≤": "<=", "≥": ">=", "≈": "~", "→": "->", "←": "<-", "↔": "<->", "·": "*", "×": "x",
    "−": "-", "–": "-", "—": "-", "±": "+-", "∞": "inf", "√": "sqrt", "∂": "d", "∃": "exists ",
    "∩": " and ", "∅": "{}", "⊂": "<", "⊆": "<=", "…": "...", "Φ": "Phi", "ω": "omega", "ρ": "rho",
    "γ": "gamma", "δ": "delta", "κ": "kappa", "σ": "sigma", "Δ": "Delta",
    "²": "^2", "³": "^3", "⁻": "^-", "¹": "1", "’": "'", "“": '"', "”": '"',
}  # fmt: skip


def say_what_can_be_said() -> None:
    """Make standard output and error write the characters that they lack as `in_ascii` does."""
    codecs.register_error(HANDLER, _replace_unencodable)
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):  # else somebody's own stream, or none
            stream.reconfigure(errors=HANDLER)


def keep_apart(names: Iterable[str]) -> None:
    """Write what the streams lack so that no two of these names, of models or files, become one:
    as escapes where they would.
    """
    own_names = set(names)
    for stream in (sys.stdout, sys.stderr):
        ways = (HANDLER, "backslashreplace", "namereplace")
        if hasattr(stream, "reconfigure"):
            encoding = stream.encoding
            apart = (
                w for w in ways if len({n.encode(encoding, w) for n in own_names}) == len(own_names)
            )
            stream.reconfigure(errors=next(apart, ways[-1]))


def in_ascii(text: str) -> str:
    """The text in ASCII: a sign's usual substitute, a letter without its accent, else an escape.

    >>> in_ascii("rank ∂(G₁)/∂p = 6 ≠ 7, Gröbner, ☂")
    'rank d(G1)/dp = 6 != 7, Grobner, \\\\u2602'
    """
    return "".join(c if c.isascii() else PLAIN.get(c) or _without_marks(c) for c in text)


def complain(message: object) -> None:
    """Write one line to standard error, printable, and shortened in its middle where somebody
    gave very much to quote.
    """
    print(f"disting: {brief(str(message))}".replace("\n", " "), file=sys.stderr)


def _without_marks(character: str) -> str:
    bare = normalize("NFKD", character).encode("ascii", "ignore").decode()
    return bare or character.encode("ascii", "backslashreplace").decode()


def _replace_unencodable(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return in_ascii(error.object[error.start : error.end]), error.end


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
    other_path = next(p for p in (path, *path.absolute().parents) if p.exists())
    if not other_path.is_dir():
        raise argparse.ArgumentTypeError(
            f"{other_path} is a file, not a folder; name another folder"
        )
    if not _takes_files(other_path):
        raise argparse.ArgumentTypeError(f"{other_path} may not be written to; name another folder")
    return path


def _takes_files(folder: Path) -> bool:
    """Return True if a file can be created in the folder: tested by creating one, since permissions
    are not reliable for all folders and users.
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
            raise _name_reason(reason) from None

    def flush(self) -> None:
        """As the stream; raises OSError that names it."""
        try:
            self._stream.flush()
        except OSError as reason:
            raise _name_reason(reason) from None

    def write_bytes(self, content: bytes) -> None:
        """Bytes as they are, behind the text that is written; raises OSError that names it."""
        self.flush()
        rest = memoryview(content)
        try:
            while rest:  # an unbuffered stream may take a part
                rest = rest[self._stream.buffer.write(rest) :]
        except OSError as reason:
            raise _name_reason(reason) from None

    def __getattr__(self, name: str) -> object:
        return getattr(self._stream, name)


def emit(where: str, text: str) -> None:
    """Write data to a file, or to standard output for -; raises InputError where a file cannot be
    written, OSError where standard output cannot.
    """
    emitted_lines(where, [text])


def emitted_lines(where: str, lines: Iterable[str]) -> None:
    """As `emit`, line by line as they come."""
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


def _name_reason(reason: OSError) -> OSError:
    return OSError(reason.errno, reason.strerror, STANDARD)
