"""Files and folders to write to, looked at before the work begins, so that nothing is computed
in vain.
"""

import argparse
import os
from pathlib import Path
from tempfile import TemporaryFile

from disting.cli.output import ITS_NAMES


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
    try:
        with TemporaryFile(dir=folder):
            return True
    except OSError:
        return False
