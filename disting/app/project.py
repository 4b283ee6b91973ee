"""Project folder: measured files, what the pages hold, and every finished fit.

    data/NAME          measured files, as they were given to the page
    data.json          how they are read and fitted
    machine.json       the machine of the second page
    compare.json       the two models of the third page
    fits/1/            page, figures, JSON and models of a fit, with its request

Nothing outside of the folder is read or written: a name is one name, and a link that leads out of
the folder is refused.
"""

import json
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from filelock import FileLock, Timeout

from disting.app.interface import Json
from disting.errors import InputError, short
from disting.files import json_text, read_json, write_whole

ABOUT = "about.json"  # request and answer of a finished fit
FIGURES = "figures.json"  # its diagrams as numbers
LOCK = ".disting-app.lock"
LONGEST = 120  # bytes of a file name
FORBIDDEN = re.compile(r'[\x00-\x1f\x7f/\\:*?"<>|]')
KEPT = "-"  # between the stem of a name that is taken and its number


def check_name(name: str) -> str:
    """Return the name of a file; raises InputError for one that is no plain name.

    >>> check_name("bench 1.csv")
    'bench 1.csv'
    """
    plain = name.isprintable() and not FORBIDDEN.search(name) and name == name.strip()
    if not plain or not name or name.startswith(".") or name.endswith("."):
        raise InputError(f"{short(name)} is no plain file name; rename the file, as bench.csv")
    try:
        size = len(name.encode())
    except UnicodeEncodeError:
        raise InputError(f"{short(name)} is no plain file name; rename the file") from None
    if size > LONGEST:
        raise InputError(f"the name {short(name)} is longer than {LONGEST} bytes; rename the file")
    return name


def inside(folder: Path, *parts: str) -> Path:
    """Return a path below a folder; raises InputError where a part is no plain name or a link
    leads out of the folder.
    """
    path = folder.joinpath(*map(check_name, parts))
    if not path.resolve().is_relative_to(folder.resolve()):
        raise InputError(f"{short('/'.join(parts))} leads out of the project folder")
    return path


def measured(name: str, folder: Path | None = None) -> Path:
    """Return the path of a measured file; raises InputError where the project has none."""
    path = inside(folder or Path(), "data", name)
    if not path.is_file():
        raise InputError(f"the project has no file {short(name)}; drop it on the page")
    return path


def free_name(folder: Path, name: str) -> str:
    """Return the name, or the first numbered one that no file has.

    >>> free_name(Path("no such folder"), "a.csv")
    'a.csv'
    """
    stem, dot, ending = name.rpartition(".") if "." in name else (name, "", "")
    number, free = 1, name
    while (folder / free).exists():
        number += 1
        free = f"{stem}{KEPT}{number}{dot}{ending}"
    return free


@contextmanager
def own_folder(path: Path) -> Iterator[Path]:
    """Project folder, made where there is none, held by this process alone. Raises InputError."""
    path.mkdir(parents=True, exist_ok=True)
    folder = path.resolve()
    lock = FileLock(folder / LOCK, timeout=0)
    try:
        lock.acquire()
    except Timeout:
        raise InputError(
            f"{folder} is open in another 'disting app'; name another folder"
        ) from None
    try:
        yield folder
    finally:
        lock.release()


def open_state(request: Json) -> Json:
    """Content that a page saved, null where it saved none."""
    path = inside(Path(), f"{request['page']}.json")
    content = read_json(path, "another project folder") if path.exists() else None
    return {"content": content if isinstance(content, dict) else None}


def save_state(request: Json) -> Json:
    """Keep the content of a page."""
    path = inside(Path(), f"{request['page']}.json")
    write_whole(path, [json_text(request["content"], indent=1), "\n"])
    return {"saved": path.name}


def list_files(request: Json) -> Json:
    """Return the measured files of the project, by name."""
    folder = inside(Path(), "data")
    paths = sorted(folder.iterdir()) if folder.is_dir() else []
    own = [path for path in paths if _is_own(path, folder) and not path.name.startswith(".")]
    return {"files": [{"name": path.name, "size": path.stat().st_size} for path in own]}


def _is_own(path: Path, folder: Path) -> bool:
    """Return True for a file that lies in a folder, also behind a link."""
    return path.resolve().is_relative_to(folder.resolve()) and path.is_file()


def fit_numbers(folder: Path) -> Iterator[int]:
    """Numbers of the finished fits, in order."""
    root = folder / "fits"
    names = [path.name for path in root.iterdir()] if root.is_dir() else []
    for number in sorted(int(name) for name in names if re.fullmatch(r"[1-9]\d{0,5}", name)):
        if (root / str(number) / "fit.html").is_file():
            yield number


def list_fits(request: Json) -> Json:
    """Return all finished fits, the last one first."""
    return {"fits": [summary(number) for number in reversed([*fit_numbers(Path())])]}


def summary(number: int) -> Json:
    """Return number, files, request and answer of a finished fit."""
    folder = inside(Path(), "fits", str(number))
    own = (ABOUT, FIGURES)
    files = sorted(path.name for path in folder.iterdir() if path.name not in own)
    return read_object(folder / ABOUT) | {"fit": number, "files": files}


def show_figures(request: Json) -> Json:
    """Return the diagrams of a finished fit; none of one that was written without them."""
    folder = inside(Path(), "fits", str(request["fit"]))
    return {"figures": read_object(inside(folder, FIGURES)).get("figures", [])}


def fit_file(number: int) -> Path:
    """Return the JSON file of a finished fit, relative to the project; raises InputError."""
    path = inside(inside(Path(), "fits", str(number)), "fit.json")
    if not path.is_file():
        raise InputError(f"the project has no fit {number}")
    return path


def add_to_fit(number: int, name: str, content: Json) -> Json:
    """Keep a further answer beside that of a finished fit; return the fit as `summary` does."""
    path = fit_file(number).with_name(ABOUT)
    write_whole(path, [json_text(read_object(path) | {name: content}, indent=1), "\n"])
    return summary(number)


def read_object(path: Path) -> Json:
    """A JSON object of the project, empty where there is none."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}
    return content if isinstance(content, dict) else {}
