"""A copy of the package with a row or a module more, and processes that run with it."""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path

import disting

Change = tuple[str, str]
"""A text that stands once in a module, and what takes its place."""


def copied(
    folder: Path, changes: Mapping[str, Iterable[Change]], modules: Mapping[str, str] | None = None
) -> Path:
    """A copy of the package in a folder, with these changes by module, and further modules. What is
    compiled already is copied too, so that only what changed is compiled.
    """
    shipped = Path(disting.__file__).parent
    shutil.copytree(shipped, folder / "disting")
    if (shipped.parent / "catalog").is_dir():
        (folder / "catalog").symlink_to(shipped.parent / "catalog")
    for name, text in (modules or {}).items():
        (folder / "disting" / name).write_text(text, encoding="utf-8")
    for name, pairs in changes.items():
        path = folder / "disting" / name
        text = path.read_text(encoding="utf-8")
        for old, new in pairs:
            assert text.count(old) == 1, f"{name}: {old!r} stands there {text.count(old)} times"
            text = text.replace(old, new)
        path.write_text(text, encoding="utf-8")
    return folder


def said(folder: Path, *arguments: str, status: int = 0) -> str:
    """What a Python process with the copy says, with these arguments; the cache is off."""
    done = subprocess.run(
        [sys.executable, *arguments],
        env={**os.environ, "PYTHONPATH": str(folder), "DISTING_CACHE": "off"},
        cwd=folder,
        capture_output=True,
        encoding="utf-8",
        timeout=600,
        check=False,
    )
    assert done.returncode == status, done.stderr
    return done.stdout if status == 0 else done.stderr
