"""A name in backticks, in a docstring or a comment, is the name of something: what is renamed is
renamed there too.
"""

import ast
import re
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

import pytest

import disting

HOUSE = Path(disting.__file__).parent
ELSEWHERE = {"idfrd", "savefig", "brakes"}  # MATLAB's, matplotlib's, in the table of kinds alone
SUFFIXES = {"html", "json", "jsonl", "mat", "md", "py"}
NAME = re.compile(r"(?<!`)`([a-z]\w{3,}(?:\.\w+)*)(?:\(\))?`(?!`)")


@dataclass(frozen=True)
class Module:
    """`said`: names in backticks of docstrings and comments; `names`: the words of the code;
    `defined`: functions, classes, fields and arguments.
    """

    said: list[str]
    names: set[str]
    defined: set[str]


def read(source: str) -> Module:
    nodes = list(ast.walk(ast.parse(source)))
    documented = ast.Module | ast.ClassDef | ast.FunctionDef
    texts = [ast.get_docstring(n, clean=False) or "" for n in nodes if isinstance(n, documented)]
    code, comments = re.subn(r'""".*?"""', "", source, flags=re.DOTALL)[0], re.compile("#.*")
    fields = {n.target.id for n in nodes if isinstance(n, ast.AnnAssign) if hasattr(n.target, "id")}
    functions = {n.name for n in nodes if isinstance(n, ast.FunctionDef | ast.ClassDef)}
    return Module(
        NAME.findall("\n".join(texts + comments.findall(code))),
        set(re.findall(r"\w+", comments.sub("", code))),
        functions | fields | {n.arg for n in nodes if isinstance(n, ast.arg)},
    )


def is_stale(name: str, known: set[str], inside: dict[str, set[str]]) -> bool:
    """Whether the last part of a dotted name is not in the module or room that the part before it
    names; of a plain one, whether nothing known has it.
    """
    *before, last = name.split(".")
    if before:
        return before[-1] in inside and last not in inside[before[-1]] | SUFFIXES
    return last not in known


@pytest.mark.full
def test_names_in_docstrings_exist():
    modules = {p: read(p.read_text(encoding="utf-8")) for p in sorted(HOUSE.rglob("*.py"))}
    everywhere = ELSEWHERE.union(*(m.defined for m in modules.values()))
    inside: dict[str, set[str]] = defaultdict(set)  # modules and rooms: names and modules
    for path, module in modules.items():
        room = path.parent
        inside[room.name if path.stem == "__init__" else path.stem] |= module.names
        inside[room.name] |= {path.stem}
        inside[room.parent.name] |= {room.name}
    stale = []
    for path, module in modules.items():
        # a module is named plainly in its own room and in those around it
        near = set().union(*(inside[room.name] for room in (path.parent, *path.parents)))
        known = everywhere | module.names | near
        stale += [
            f"{path.relative_to(HOUSE)}: {n}" for n in module.said if is_stale(n, known, inside)
        ]
    assert stale == [] and sum(len(m.said) for m in modules.values()) > 1_800


def test_a_name_that_is_gone_is_seen():
    inside = {"limits": {"room"}}
    assert not is_stale("limits.room", set(), inside) and is_stale("limits.gone", set(), inside)
    assert not is_stale("confirms", {"confirms"}, inside) and is_stale("gone", {"confirms"}, inside)
    assert read('def f(a):\n    """See `gone`."""\n').said == ["gone"]
