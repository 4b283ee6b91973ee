"""All JSON that is written comes from one function, and holds no number that is not finite."""

import ast
import json
from math import inf, nan
from pathlib import Path

import pytest

import disting
from disting.files import json_text

ROOT = Path(disting.__file__).parent
# texts that the package alone reads: of its cache, of keys, of comparisons
WITHIN = {
    "behaviour/profile.py", "catalogs/catalog.py", "catalogs/files.py",
    "catalogs/network_files.py", "conditions/rule.py", "fit/search/exchange.py",
    "general/global_identifiability.py", "model/question.py",
    "decide/identifiability/levels.py", "verdict/claim_checks.py", "verdict/engine.py",
    "general/solutions.py", "verdict/verdict_file.py",
}  # fmt: skip


def writes_json(path: Path) -> bool:
    """Return True if the code, examples in docstrings aside, makes JSON by itself."""
    nodes = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
    named = [n.attr for n in nodes if isinstance(n, ast.Attribute) and is_json(n.value)]
    named += [
        a.name
        for n in nodes
        if isinstance(n, ast.ImportFrom) and n.module == "json"
        for a in n.names
    ]
    return bool({"dump", "dumps", "JSONEncoder"} & set(named))


def is_json(node: ast.expr) -> bool:
    return isinstance(node, ast.Name) and node.id == "json"


@pytest.mark.full
def test_no_other_module_writes_json():
    found = {p.relative_to(ROOT).as_posix() for p in ROOT.rglob("*.py") if writes_json(p)}
    assert found == WITHIN | {"files.py"}


@pytest.mark.parametrize("size", [inf, -inf, nan])
def test_a_number_that_is_not_finite_is_null(size):
    text = json_text({"a": [1.5, size, {"b": (size, True, "x")}]}, indent=1)
    assert json.loads(text) == {"a": [1.5, None, {"b": [None, True, "x"]}]}
    assert not {"NaN", "Infinity"} & set(text.replace(",", " ").split())


@pytest.mark.parametrize(
    ("form", "text"),
    [
        ({}, '{"b":"\u00e4","a":1}'),
        ({"spaced": True}, '{"b": "\u00e4", "a": 1}'),
        ({"ascii_only": True, "sort_keys": True}, '{"a":1,"b":"\\u00e4"}'),
        ({"indent": 1}, '{\n "b": "\u00e4",\n "a": 1\n}'),
    ],
)
def test_forms(form, text):
    assert json_text({"b": "\u00e4", "a": 1}, **form) == text


def test_what_is_no_plain_data_is_a_fault():
    with pytest.raises(TypeError):
        json_text({"a": object()})
