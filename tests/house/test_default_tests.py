"""The default tests are short, and yet look into every room."""

import ast
from pathlib import Path

import pytest

from tests.house.rooms import PACKAGE

TESTS = Path(__file__).resolve().parents[1]
BY_HAND = {"attack"}
DOORS = {
    "command line": ("cli/test_bad_usage.py", "test_processes_say_the_same"),
    "Python": ("test_public_api.py", "test_every_public_name_has_an_example"),
    "page": ("report/test_page.py", "test_embedded_data_give_the_verdicts_back"),
    "page in a browser": ("report/test_sizes.py", "test_hover_and_keyboard_tell_the_limit"),
    "page of the app": ("app/test_machine.py", "test_answers_have_the_form_of_their_schema"),
    "file": ("verdict/test_verification.py", "test_what_was_decided_holds"),
    "claims of the paper": ("paper/test_claim_list.py", "test_what_a_check_finds"),
    "figures of the paper": ("paper/test_claims.py", "test_pairs_by_deciding_condition"),
    "file of measured data": ("measurement/test_look.py", "test_measured_files_are_shown"),
}
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


def rooms() -> list[str]:
    """Folders of the package, and those of tests that have no such folder."""
    package = {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
    return sorted(package | {path.parent.name for path in TESTS.glob("*/test_*.py")} - BY_HAND)


@pytest.mark.parametrize("room", rooms())
def test_every_room_has_default_tests(room):
    assert any(map(default_tests, (TESTS / room).rglob("test_*.py")))


@pytest.mark.parametrize(("file", "name"), DOORS.values(), ids=DOORS)
def test_every_door_has_a_default_test(file, name):
    assert name in default_tests(TESTS / file)
