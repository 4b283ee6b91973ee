"""Where the data files of the package are: precomputed catalogues and answers about rows."""

import json
from hashlib import sha256
from pathlib import Path

from disting.errors import CatalogError

PROVENANCE = "provenance.json"


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
