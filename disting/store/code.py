"""Which code a cached result depends on: a digest of it, found from the imports, with the versions
of the libraries it uses.

A key that names too little code serves a stale result after a change; so nothing is listed by
hand. The modules are those that one imports, directly or not, inside this package. What a
package's `__init__` offers to others counts only where the package itself is imported from.
"""

import re
import sys
from collections.abc import Iterator
from functools import cache
from hashlib import sha256
from pathlib import Path

PACKAGE = Path(__file__).parents[1]
LIBRARIES = ("numpy", "scipy", "python-flint")  # whose numbers may change with a version
IMPORT = re.compile(rf"^[ ]*from ({PACKAGE.name}[\w.]*) import (\([^)]*\)|.*)", re.MULTILINE)
NAME = re.compile(r"\w+")


@cache
def digest(module: str) -> str:
    """SHA-256 of the source of a module and of all that it imports here, and of the versions of
    Python and the libraries.

    >>> digest("disting.fit.search.exchange") == digest("disting.verdict.engine")
    False
    """
    from importlib.metadata import version

    sources = _sources()
    versions = [sys.version.split()[0], *(f"{name} {version(name)}" for name in LIBRARIES)]
    texts = [text for name in modules_of(module) for text in (name, sources[name])]
    return sha256("\0".join([*versions, *texts]).encode()).hexdigest()


@cache
def modules_of(module: str) -> tuple[str, ...]:
    """A module and all modules of this package that it imports, directly or not, in order of their
    names.

    >>> modules_of("disting.algebra.certainty")
    ('disting.algebra.certainty', 'disting.algebra.content')
    """
    sources, modules, new = _sources(), set[str](), {module}
    while new:
        modules |= new
        new = {name for old in new for name in _imported(sources[old]) if name in sources} - modules
    return tuple(sorted(modules))


def _imported(source: str) -> Iterator[str]:
    """Names that may be modules: what is imported from, and with what is imported from it (a
    name may be a module).
    """
    for origin, names in IMPORT.findall(source):
        yield origin
        yield from (f"{origin}.{name}" for name in NAME.findall(names))


@cache
def _sources() -> dict[str, str]:
    """Source text by the name of the module, a package by its own name; without the top one,
    which only names the API.
    """
    texts = {}
    for path in sorted(PACKAGE.rglob("*/*.py")) + [
        p for p in sorted(PACKAGE.glob("*.py")) if p.stem != "__init__"
    ]:
        parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
        texts[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path.read_text(
            encoding="utf-8"
        )
    return texts
