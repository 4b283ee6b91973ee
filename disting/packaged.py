"""Where the data files of the package are: precomputed catalogues and answers about rows."""

from pathlib import Path


def shipped_folder() -> Path:
    """Folder of the shipped files: inside the installed package, or at the top of a checkout."""
    package = Path(__file__).parent
    inside = package / "shipped"
    return inside if inside.is_dir() else package.parent / "catalog"
