"""A name in backticks, in a docstring or a comment, is the name of something: what is renamed is
renamed there too. Docstrings begin with a noun or a verb, and functions are named by verbs.
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
QUESTION = re.compile(r"\s*(What|Whether|How|Which)\b")
PARTICIPLE = re.compile(
    r"_(?!seed$|need$|feed$|embed$|speed$)(\w+ed|begun|bound|broken|built|chosen|done|drawn|felt"
    r"|found|given|grown|held|kept|known|led|left|made|meant|met|said|seen|shown|taken|told|written)"
)
PROPERTIES = {"property", "cached_property"}  # values, named by nouns and participles
DOCUMENTED = ast.Module | ast.ClassDef | ast.FunctionDef
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
    texts = [ast.get_docstring(n, clean=False) or "" for n in nodes if isinstance(n, DOCUMENTED)]
    code, comments = re.subn(r'""".*?"""', "", source, flags=re.DOTALL)[0], re.compile("#.*")
    fields = {n.target.id for n in nodes if isinstance(n, ast.AnnAssign) if hasattr(n.target, "id")}
    functions = {n.name for n in nodes if isinstance(n, ast.FunctionDef | ast.ClassDef)}
    return Module(
        NAME.findall("\n".join(texts + comments.findall(code))),
        set(re.findall(r"\w+", comments.sub("", code))),
        functions | fields | {n.arg for n in nodes if isinstance(n, ast.arg)},
    )


def questions(source: str) -> list[str]:
    """First lines of docstrings, and of strings below fields and constants, that begin like a
    question.
    """
    bodies = [n.body for n in ast.walk(ast.parse(source)) if isinstance(n, DOCUMENTED)]
    texts = [s.value.value for body in bodies for s in body if is_text(s)]
    return [text.strip().splitlines()[0] for text in texts if QUESTION.match(text)]


def is_text(statement: ast.stmt) -> bool:
    value = statement.value if isinstance(statement, ast.Expr) else None
    return isinstance(value, ast.Constant) and isinstance(value.value, str)


def participles(source: str) -> list[str]:
    """Names of private functions that are a participle, and only that; properties are exempt."""
    functions = [n for n in ast.walk(ast.parse(source)) if isinstance(n, ast.FunctionDef)]
    return [
        f.name
        for f in functions
        if PARTICIPLE.fullmatch(f.name) and "_" not in f.name[1:]
        if not PROPERTIES & {ast.unparse(d) for d in f.decorator_list}
    ]


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


@pytest.mark.full
def test_docstrings_are_no_questions_and_functions_are_verbs():
    found = []
    for path in sorted(HOUSE.rglob("*.py")):
        source = path.read_text(encoding="utf-8")
        found += [
            f"{path.relative_to(HOUSE)}: {x}" for x in questions(source) + participles(source)
        ]
    assert found == []


def test_a_question_and_a_participle_are_found():
    assert questions('"""A noun."""\nx = 1\n"""Which\nrows."""\n') == ["Which"]
    assert questions('def f():\n    """Whether so."""\n') == ["Whether so."]
    verbs = "def _seen(): 0\ndef _solved(): 0\ndef _seed(): 0\ndef _solve(): 0\n"
    assert participles(verbs) == ["_seen", "_solved"]
    assert participles("class A:\n    @property\n    def _known(self): 0\n") == []
