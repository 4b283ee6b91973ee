"""Reference entry of a name: its signature, its docstring, its members. Definitions are found in
the package's source, without importing it.

A name that a package hands on (`from .. import X as X`) is followed to the module that defines it.
Types and defaults are those in the source: an annotation that is evaluated reads differently with
every version of NumPy and Python.
"""

import ast
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cache, lru_cache
from importlib.resources import files
from itertools import chain, pairwise

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
    """Definitions and imports of a module, by name, and its docstring.

    `texts`: the string below an assignment, which describes it. `handed_on`: names that it imports
    for others.
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
        for node in _list_imports(tree.body)
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


def _list_imports(body: list[ast.stmt]) -> Iterator[ast.ImportFrom]:
    """Names that are imported when the module is, or when they are used, as `disting` does it."""
    for node in body:
        if isinstance(node, ast.ImportFrom):
            yield node
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            yield from _list_imports(node.body)


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
    if at.module.split(".")[0] != PACKAGE:
        return None
    defined, imports = _names_in(at.module)
    if at.name in defined:
        return at
    return definition(imports[at.name]) if at.name in imports else None


@cache
def _names_in(module: str) -> tuple[frozenset[str], dict[str, Place]]:
    """Names that a module defines, and its imports; both are empty if there is no such module.
    They take less memory than its syntax tree.
    """
    try:
        parsed = parse(module)
    except ModuleNotFoundError:
        return frozenset(), {}
    return frozenset(parsed.definitions), parsed.imports


def _source(name: str) -> str:
    folder = files(PACKAGE).joinpath(*name.split(".")[1:])
    if folder.is_dir():
        return (folder / "__init__.py").read_text(encoding="utf-8")
    *path, last = name.split(".")[1:]
    try:
        return files(PACKAGE).joinpath(*path, f"{last}.py").read_text(encoding="utf-8")
    except FileNotFoundError:
        raise ModuleNotFoundError(f"there is no module {name}") from None


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


ENUMS = {"Enum", "StrEnum", "IntEnum"}
RAISED = re.compile(r"\bRaises ((?:(?!\. [A-Z]).)*)", re.DOTALL)
EXCEPTION = re.compile(r"\b[A-Z]\w+(?:Error|Violation|Warning)\b")


class Kind(StrEnum):
    """Kind of a name."""

    CLASS = "class"
    FUNCTION = "function"
    METHOD = "method"
    CLASS_METHOD = "class method"
    STATIC_METHOD = "static method"
    PROPERTY = "property"
    FIELD = "field"
    MEMBER = "member"
    VALUE = "value"


@dataclass(frozen=True, slots=True)
class Argument:
    """One argument as it is written: `star` is "*" or "**" before it, type and default may be
    empty.
    """

    name: str
    annotation: str = ""
    default: str = ""
    star: str = ""


@dataclass(frozen=True, slots=True)
class Entry:
    """A public name: `place` is where it is defined, `value` what a constant or a member of an
    enumeration is, `raises` the exceptions that its docstring or its body names.
    """

    name: str
    kind: Kind
    place: Place
    text: str
    arguments: tuple[Argument, ...] | None = None
    returns: str = ""
    value: str = ""
    bases: tuple[str, ...] = ()
    raises: tuple[str, ...] = ()
    members: tuple["Entry", ...] = ()


def entries(name: str) -> Iterator[Entry]:
    """The public names of a module, in its order.

    >>> next(entry for entry in entries("disting") if entry.name == "compare").returns
    'Verdict'
    """
    for key in public(name):
        place = definition(Place(name, key))
        if place is not None:
            source = parse(place.module)
            yield _entry(key, place, source.definitions[place.name], source.texts.get(key, ""))


def _entry(name: str, place: Place, node: Definition, text: str) -> Entry:
    if isinstance(node, ast.ClassDef):
        return _class(name, place, node)
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
        return _function(name, place, node)
    return _value(name, Kind.VALUE, place, node, text)


def _class(name: str, place: Place, node: ast.ClassDef) -> Entry:
    bases = tuple(ast.unparse(base) for base in node.bases)
    members = [m for part in node.body for m in _members(part, place, bases)]
    making = [p for p in node.body if getattr(p, "name", "") in ("__init__", "__post_init__")]
    made = next(
        (p for p in making if isinstance(p, ast.FunctionDef) and p.name == "__init__"), None
    )
    arguments: tuple[Argument, ...] | None = None
    if made:
        arguments = _arguments(made.args, place.module)[1:]
    elif _is_record(node):
        arguments = _fields_as_arguments(list(_fields(place, node)), node)
    text = ast.get_docstring(node) or ""
    return Entry(
        name,
        Kind.CLASS,
        place,
        text,
        arguments=arguments,
        bases=bases,
        raises=tuple(dict.fromkeys(chain(_list_documented(text), *map(_list_raised, making)))),
        members=tuple(m for m in members if m.kind is not Kind.FIELD),
    )


def _is_record(node: ast.ClassDef) -> bool:
    decorated = any("dataclass" in ast.unparse(d) for d in node.decorator_list)
    return decorated or any(ast.unparse(base) == "NamedTuple" for base in node.bases)


def _fields(place: Place, node: ast.ClassDef) -> Iterator[Entry]:
    """The fields of a record, those of records that it extends first."""
    for base in node.bases:
        the_place = definition(Place(place.module, base.id)) if isinstance(base, ast.Name) else None
        extended = parse(the_place.module).definitions[the_place.name] if the_place else None
        if the_place and isinstance(extended, ast.ClassDef):
            yield from _fields(the_place, extended)
    if _is_record(node):
        members = (m for part in node.body for m in _members(part, place, ()))
        yield from (m for m in members if m.kind is Kind.FIELD)


def _fields_as_arguments(fields: Sequence[Entry], node: ast.ClassDef) -> tuple[Argument, ...]:
    """Arguments of a record's constructor: its fields, by keyword only where its decorator says
    so.
    """
    arguments = [Argument(m.name, m.returns, m.value) for m in fields]
    if any("kw_only=True" in ast.unparse(d) for d in node.decorator_list):
        return (Argument("", star="*"), *arguments)
    return tuple(arguments)


def _members(node: ast.stmt, place: Place, bases: Sequence[str]) -> Iterator[Entry]:
    """Public members that a statement in a class adds to it."""
    if isinstance(node, ast.FunctionDef):
        special = node.name.startswith("__") and node.name != "__init__"
        if ast.get_docstring(node) and (special or not node.name.startswith("_")):
            yield _function(node.name, place, node, within=True)
    elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
        is_given = "ClassVar" not in ast.unparse(node.annotation) and not _is_derived(node.value)
        if is_given and not node.target.id.startswith("_"):
            yield _value(node.target.id, Kind.FIELD, place, node, "")
    elif isinstance(node, ast.Assign) and ENUMS.intersection(bases):
        yield from (
            _value(target.id, Kind.MEMBER, place, node, "")
            for target in node.targets
            if isinstance(target, ast.Name) and not target.id.startswith("_")
        )


def _is_derived(value: ast.expr | None) -> bool:
    """Return True if a record sets the field itself: it is not one of its arguments."""
    return value is not None and "init=False" in ast.unparse(value)


def _function(
    name: str, place: Place, node: ast.FunctionDef | ast.AsyncFunctionDef, *, within: bool = False
) -> Entry:
    decorators = [ast.unparse(d).split(".")[-1].split("(")[0] for d in node.decorator_list]
    kind = _kind(decorators) if within else Kind.FUNCTION
    arguments = _arguments(node.args, place.module)
    if kind in (Kind.METHOD, Kind.CLASS_METHOD, Kind.PROPERTY):
        arguments = arguments[1:]
    text = ast.get_docstring(node) or ""
    return Entry(
        name,
        kind,
        place,
        text,
        arguments=None if kind is Kind.PROPERTY else arguments,
        returns=_type(node.returns),
        raises=tuple(dict.fromkeys(chain(_list_documented(text), _list_raised(node)))),
    )


def _kind(decorators: Sequence[str]) -> Kind:
    if "property" in decorators or "cached_property" in decorators:
        return Kind.PROPERTY
    if "classmethod" in decorators:
        return Kind.CLASS_METHOD
    return Kind.STATIC_METHOD if "staticmethod" in decorators else Kind.METHOD


def _arguments(of: ast.arguments, module: str) -> tuple[Argument, ...]:
    """All arguments in their order, "/" and "*" among them as in the source."""
    plain = [*of.posonlyargs, *of.args]
    defaults = [None] * (len(plain) - len(of.defaults)) + [*of.defaults]
    arguments = [_argument(*pair, module) for pair in zip(plain, defaults, strict=True)]
    if of.posonlyargs:
        arguments.insert(len(of.posonlyargs), Argument("", star="/"))
    if of.vararg:
        arguments.append(_argument(of.vararg, None, module, "*"))
    elif of.kwonlyargs:
        arguments.append(Argument("", star="*"))
    arguments += [
        _argument(*pair, module) for pair in zip(of.kwonlyargs, of.kw_defaults, strict=True)
    ]
    if of.kwarg:
        arguments.append(_argument(of.kwarg, None, module, "**"))
    return tuple(arguments)


def _argument(of: ast.arg, default: ast.expr | None, module: str, star: str = "") -> Argument:
    annotation = _type(of.annotation)
    return Argument(of.arg, annotation, _write_default(default, module) if default else "", star)


def _type(annotation: ast.expr | None) -> str:
    """As it is written, without the quotation marks of what is defined further below."""
    if isinstance(annotation, ast.Constant) and isinstance(annotation.value, str):
        return annotation.value
    return ast.unparse(annotation) if annotation else ""


def _write_default(value: ast.expr, module: str) -> str:
    """A default as a reader needs it: that of a field, and a constant's value for its name.

    >>> _write_default(ast.parse("field(default_factory=dict)", mode="eval").body, "disting.files")
    'dict()'
    >>> _write_default(ast.parse("PROVENANCE", mode="eval").body, "disting.files")
    "'provenance.json'"
    """
    if isinstance(value, ast.Call) and ast.unparse(value.func) == "field":
        exprs = {keyword.arg: keyword.value for keyword in value.keywords}
        made = exprs.get("default_factory")
        if isinstance(made, ast.Lambda):
            return ast.unparse(made.body)
        expr = exprs.get("default")
        return f"{ast.unparse(made)}()" if made else ast.unparse(expr) if expr else ""
    at = definition(Place(module, value.id)) if isinstance(value, ast.Name) else None
    node = parse(at.module).definitions[at.name] if at else None
    constant = isinstance(node, ast.Assign | ast.AnnAssign) and isinstance(node.value, ast.Constant)
    return ast.unparse(node.value if constant else value)  # type: ignore[union-attr,arg-type]


def _value(name: str, kind: Kind, place: Place, node: Definition, text: str) -> Entry:
    assert isinstance(node, ast.Assign | ast.AnnAssign)
    annotation = _type(node.annotation) if isinstance(node, ast.AnnAssign) else ""
    value = _write_default(node.value, place.module) if node.value else ""
    return Entry(name, kind, place, text, returns=annotation, value=value)


def _list_documented(text: str) -> Iterator[str]:
    """Exceptions that a docstring names after "Raises".

    >>> list(_list_documented("Raises InputError if not, OSError else. Returns KeyError."))
    ['InputError', 'OSError']
    """
    for match in RAISED.finditer(text):
        yield from EXCEPTION.findall(match[1])


def _list_raised(node: ast.AST) -> Iterator[str]:
    """Exceptions that a body raises itself."""
    for part in ast.walk(node):
        if isinstance(part, ast.Raise) and part.exc is not None:
            called = part.exc.func if isinstance(part.exc, ast.Call) else part.exc
            yield from EXCEPTION.findall(ast.unparse(called))
