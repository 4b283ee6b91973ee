"""The default tests are short, and yet look into every room."""

import ast
from pathlib import Path

import pytest

from tests.house.rooms import PACKAGE

TESTS = Path(__file__).resolve().parents[1]
LEFT_OUT = tuple(f"pytest.mark.{kind}" for kind in ("full", "slow", "bench", "attack"))


def default_tests(path: Path) -> list[str]:
    """The tests of a file that no mark leaves out of the default run, by their names."""
    body = ast.parse(path.read_text(encoding="utf-8")).body
    marks = [
        ast.unparse(line.value)
        for line in body
        if isinstance(line, ast.Assign) and ast.unparse(line.targets[0]) == "pytestmark"
    ]
    if any(kind in mark for kind in LEFT_OUT for mark in marks):
        return []
    return [
        line.name
        for line in body
        if isinstance(line, ast.FunctionDef)
        and line.name.startswith("test_")
        and not any(ast.unparse(mark) in LEFT_OUT for mark in line.decorator_list)
    ]


@pytest.mark.parametrize("room", sorted(path.parent.name for path in PACKAGE.glob("*/__init__.py")))
def test_every_room_has_default_tests(room):
    assert any(map(default_tests, (TESTS / room).rglob("test_*.py")))
