"""The rooms of the house stand above each other, and the map in the guide shows them."""

import re

import networkx as nx
import pytest

from tests.house.rooms import PACKAGE, PICTURE, picture, rooms

pytestmark = pytest.mark.full


def test_the_map_of_the_guide_is_drawn_from_the_imports():
    house = rooms()
    assert {"fit", "verdict", "algebra"} <= set(house) and nx.is_directed_acyclic_graph(house)
    assert PICTURE.read_text(encoding="utf-8") == picture(house), "python tests/house/rooms.py"


def test_the_table_of_the_guide_names_every_room_and_modules_that_exist():
    guide = (PICTURE.parent / "development.md").read_text(encoding="utf-8")
    table = guide.split("## Folders")[1].split("## Ten changes")[0]
    rows = re.findall(r"^\| `disting/(\w+)`.*? \| (.*) \|$", table, re.MULTILINE)
    assert sorted(set(rooms()) - {room for room, _ in rows}) == []
    for room, text in rows:
        modules = {path.stem for path in (PACKAGE / room).iterdir()}
        assert {name.removesuffix(".py") for name in re.findall(r"`([\w.]+)`", text)} <= modules
