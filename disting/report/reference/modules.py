"""Definitions in the package's source, found without importing it.

A name that a package hands on (`from .. import X as X`) is followed to the module that defines it.
Types and defaults are those that stand in the source: an annotation that is evaluated reads
differently with every version of NumPy and Python.
"""

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, lru_cache
from importlib.resources import files
from itertools import pairwise

Definition = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef | ast.Assign | ast.AnnAssign
PACKAGE = "disting"
AT_ONCE = 16  # modules whose trees are kept: all of them take 40 MB


@dataclass(frozen=True, slots=True)
class Place:
    """A name in a module."""

    module: str
    name: str


@dataclass(frozen=True, slots=True)
class Module:
    """What a module defines and imports, by name, and its docstring.

    `texts`: the string below an assignment, which says what it is. `handed_on`: names that it
    imports for others.
    """

    name: str
    text: str
    definitions: dict[str, Definition]
    imports: dict[str, Place]
    texts: dict[str, str]
    handed_on: tuple[str, ...]


@lru_cache(AT_ONCE)
def parse(name: str) -> Module:
    """A module or package of disting, parsed; raises ModuleNotFoundError if there is none."""
    tree = ast.parse(_source(name))
    aliases = [
        (node.module, alias)
        for node in _imported(tree.body)
        if node.module and node.module != name  # else a package names its own modules
        for alias in node.names
    ]
    imports = {alias.asname or alias.name: Place(origin, alias.name) for origin, alias in aliases}
    handed_on = tuple(alias.name for _, alias in aliases if alias.asname == alias.name)
    # functions of its own are most of a module's tree, and nobody asks for them
    definitions = {
        key: node
        for node in tree.body
        if isinstance(node, Definition)
        for key in _names(node)
        if not (isinstance(node, ast.FunctionDef) and key.startswith("_"))
    }
    return Module(
        name, ast.get_docstring(tree) or "", definitions, imports, _texts(tree.body), handed_on
    )


def _imported(body: list[ast.stmt]) -> Iterator[ast.ImportFrom]:
    """Names that are imported when the module is, or when they are used, as `disting` does it."""
    for node in body:
        if isinstance(node, ast.ImportFrom):
            yield node
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            yield from _imported(node.body)


def public(name: str) -> tuple[str, ...]:
    """Names that a module offers: what a package hands on, else what the module defines.

    >>> "Chain" in public("disting"), "build" in public("disting.catalogs.build")
    (True, True)
    """
    module = parse(name)
    return module.handed_on or tuple(
        key
        for key, node in module.definitions.items()
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and not key.startswith("_")
    )


@cache
def definition(at: Place) -> Place | None:
    """Where a name is defined that a module defines or imports; None outside of the package.

    >>> definition(Place("disting", "Chain"))
    Place(module='disting.model.chain', name='Chain')
    """
    if at.module.split(".")[0] != PACKAGE or not _exists(at.module):
        return None
    module = parse(at.module)
    if at.name in module.definitions:
        return at
    return definition(module.imports[at.name]) if at.name in module.imports else None


def _source(name: str) -> str:
    folder = files(PACKAGE).joinpath(*name.split(".")[1:])
    if folder.is_dir():
        return (folder / "__init__.py").read_text(encoding="utf-8")
    *path, last = name.split(".")[1:]
    try:
        return files(PACKAGE).joinpath(*path, f"{last}.py").read_text(encoding="utf-8")
    except FileNotFoundError:
        raise ModuleNotFoundError(f"there is no module {name}") from None


@cache
def _exists(name: str) -> bool:
    try:
        parse(name)
    except ModuleNotFoundError:
        return False
    return True


def _names(node: ast.stmt) -> Iterator[str]:
    """Names that a statement defines."""
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        yield node.name
    elif isinstance(node, ast.AnnAssign):
        yield from [node.target.id] if isinstance(node.target, ast.Name) else []
    elif isinstance(node, ast.Assign):
        yield from (target.id for target in node.targets if isinstance(target, ast.Name))


def _texts(body: list[ast.stmt]) -> dict[str, str]:
    """The string below each assignment that has one."""
    return {
        key: after.value.value
        for node, after in pairwise(body)
        if isinstance(after, ast.Expr)
        and isinstance(after.value, ast.Constant)
        and isinstance(after.value.value, str)
        for key in _names(node)
    }
