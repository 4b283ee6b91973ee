"""The rooms of the house stand above each other, and the map in the guide shows them."""

import networkx as nx

from tests.house.rooms import PICTURE, picture, rooms


def test_the_map_of_the_guide_is_drawn_from_the_imports():
    house = rooms()
    assert {"fit", "verdict", "algebra"} <= set(house) and nx.is_directed_acyclic_graph(house)
    assert PICTURE.read_text(encoding="utf-8") == picture(house), "python tests/house/rooms.py"
