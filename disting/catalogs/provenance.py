"""What the data files of a folder are: `provenance.json` with the digest of each, compared
whenever one is read.

The file that `disting catalog settle` appends to is named with the length that it had: what is
appended later is the user's own. See `disting.files.intact_text`, which compares.
"""

import json
import platform
from importlib.metadata import version
from pathlib import Path

from disting.catalogs.damper_settled import FILE as SETTLED
from disting.catalogs.files import PROVENANCE, SCHEMA, Record, digest
from disting.files import __version__, write_whole


def provenance_of(folder: Path) -> Record:
    """Schema, software versions, command and the digest of each data file in a folder."""
    return {
        "schema": SCHEMA,
        "command": "disting catalog build 1 2 3 4 5",
        "software": (
            {"disting": __version__, "python": platform.python_version()}
            | {name: version(name) for name in ("numpy", "python-flint")}
        ),
        "files": {p.name: _told(p) for p in sorted(folder.glob("*.jsonl"))},
    }


def write_provenance(folder: Path) -> Path:
    """Write it anew, after the files of the folder; returns its path."""
    return write_whole(
        folder / PROVENANCE, [json.dumps(provenance_of(folder), indent=1, sort_keys=True), "\n"]
    )


def _told(path: Path) -> str:
    return f"{digest(path)}:{path.stat().st_size}" if path.name == SETTLED else digest(path)
