"""Phrases that may not come back into messages, help texts and pages: a user reads plain English.
Texts of the package are its string literals without docstrings, f-strings with {} for a value, the
string literals of its scripts, and what its pages show between tags.
"""

import argparse
import ast
import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import disting
from disting.cli.run import parser
from tests.report.test_plain_words import PHRASES as PROSE

HOUSE = Path(disting.__file__).parent
PHRASES = (
    r"\b(?:is|are|was|were) (?:told|said|asked|seen)\b",
    r"\btold\b",
    r"\btells? .{0,40}\bapart\b",
    r"\bleave\b.{0,60}\baway\b",
    r"\bstands? (?:beside|behind|for|in)\b",
    r"\bcomes? to (?:the same|that)\b",
    r"\bwhich(?:ever)? it is\b",
    r"\bknows? no\b",
    r"\b(?:do|does) the same\b",
    r"\blook(?:s|ed)? (?:at|on|across)\b",
    r"\bmay as well\b",
    r"\bknown badly\b",
    r"\bsurely (?:enough|tells)\b",
    r"\bbut for\b",
    r"\bsettles?\b",
    r"\bis no \w+ that is known\b",
    r"\bone and the same\b",
    r"\bbelongs? to (?:networks|machines|chains|numbered)\b",
    r"\bsays? (?:which|what|how|so|it)\b",
    r"^say (?:which|what|how|where)\b|[:;] say (?:which|what|how|where)\b",
    r"\bfit them apart\b",
    r"; (?:known|there) are\b",
)
"""Idiom of earlier versions; each is a regular expression."""

EXEMPT = {"verdict/older_files.py"}
"""Modules that may hold such a phrase: sentences of an earlier version, which are still checked."""


def texts(source: str) -> Iterator[tuple[int, str]]:
    """Yield (line, text) of every string literal of two words or more that is no docstring.

    >>> list(texts('"Doc string."\\nx = f"no {y} is told"'))
    [(2, 'no {} is told')]
    """
    tree = ast.parse(source)
    nodes = list(ast.walk(tree))
    inner = {id(part) for n in nodes if isinstance(n, ast.JoinedStr) for part in n.values}
    docs = {id(n.value) for n in nodes if isinstance(n, ast.Expr)}
    for node in nodes:
        if isinstance(node, ast.JoinedStr):
            parts = (v.value if isinstance(v, ast.Constant) else "{}" for v in node.values)
            yield node.lineno, "".join(map(str, parts))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            plain = id(node) not in inner and id(node) not in docs
            yield from [(node.lineno, node.value)] if plain and " " in node.value else []


STRING = re.compile(r'"(?:[^"\\\n]|\\.)*"|`(?:[^`\\]|\\.)*`')
HIDDEN = re.compile(r"\{#.*?#\}|\{%.*?%\}|<script.*?</script>|<[^>]*>", re.DOTALL)


def script_texts(source: str) -> Iterator[tuple[int, str]]:
    """Yield (line, text) of every string of two words or more of a script, with {} for a value."""
    for found in STRING.finditer(source):
        if " " in found[0]:
            text = re.sub(r"\$\{[^}]*\}", "{}", found[0][1:-1])
            yield source.count("\n", 0, found.start()) + 1, text


def page_texts(source: str) -> Iterator[tuple[int, str]]:
    """Yield (line, text) of what a page shows, with {} for a value."""
    shown = HIDDEN.sub(lambda found: " " + "\n" * found[0].count("\n"), source)
    for number, line in enumerate(re.sub(r"\{\{.*?\}\}", "{}", shown).split("\n"), start=1):
        if line.strip():
            yield number, " ".join(line.split())


def schema_texts(source: str) -> Iterator[tuple[int, str]]:
    """Yield (line, text) of every description of a JSON Schema."""
    for found in re.finditer(r'"description": ("(?:[^"\\]|\\.)*")', source):
        yield source.count("\n", 0, found.start()) + 1, json.loads(found[1])


def faults(text: str, phrases: tuple[str, ...] = PHRASES) -> list[str]:
    """The phrases of a text that are on the list."""
    return [found[0] for p in phrases for found in re.finditer(p, text, re.IGNORECASE)]


def modules() -> list[str]:
    return [p.relative_to(HOUSE).as_posix() for p in sorted(HOUSE.rglob("*.py"))]


def test_a_phrase_is_found() -> None:
    assert faults("--out is no option here: leave it away") == ["leave it away"]
    assert faults("remove --out, which is not supported with --models") == []
    assert list(script_texts("put(one, `no ${y} is told`)")) == [(1, "no {} is told")]
    page = '<p class="told">{# told #}\nno {{ y }}<br>is told</p>'
    assert list(page_texts(page)) == [(2, "no {} is told")]


@pytest.mark.full
@pytest.mark.parametrize("room", sorted({path.partition("/")[0] for path in modules()}))
def test_messages_are_in_plain_words(room: str) -> None:
    found = {
        f"{path}:{line}: {text[:90]!r}": faults(text)
        for path in modules()
        if path.partition("/")[0] == room and path not in EXEMPT
        for line, text in texts((HOUSE / path).read_text("utf-8"))
    }
    assert {where: phrases for where, phrases in found.items() if phrases} == {}


@pytest.mark.full
@pytest.mark.parametrize(
    ("kind", "read"), [("html", page_texts), ("js", script_texts), ("json", schema_texts)]
)
def test_pages_are_in_plain_words(
    kind: str, read: Callable[[str], Iterator[tuple[int, str]]]
) -> None:
    files = sorted(HOUSE.rglob(f"*.{kind}"))
    assert len(files) > 15
    found = {
        f"{path.name}:{line}: {text[:90]!r}": faults(text, PHRASES + PROSE)
        for path in files
        for line, text in read(path.read_text("utf-8"))
    }
    assert {where: phrases for where, phrases in found.items() if phrases} == {}


def test_exempt_modules_need_it() -> None:
    for path in EXEMPT:
        lines = texts((HOUSE / path).read_text("utf-8"))
        assert any(faults(text) for _, text in lines), path


def helps(top: argparse.ArgumentParser) -> Iterator[tuple[str, str]]:
    """Yield (command, text) of all help texts, with those of commands inside."""
    yield top.prog, top.description or ""
    yield top.prog, top.epilog or ""
    for action in top._actions:
        if action.help and action.help != argparse.SUPPRESS:
            yield top.prog, action.help
        if isinstance(action, argparse._SubParsersAction):
            for inner in dict.fromkeys(action.choices.values()):
                yield from helps(inner)


def test_help_texts_are_in_plain_words() -> None:
    listed = list(helps(parser(whole=True)))
    assert len(listed) > 200
    assert [(command, faults(text)) for command, text in listed if faults(text)] == []
