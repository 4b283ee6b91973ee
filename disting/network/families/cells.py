"""Circuits that are fitted to the impedance of cells."""

from disting.network.families.circuits import all_trees, circuit_text, circuits, count_of
from disting.network.families.family import Kind


def cells(most: int) -> list[str]:
    """Texts of what is fitted to the impedance of cells: the resistance of electrolyte and wires,
    in series with what stores charge or lets it diffuse, and the resistances in between.
    """
    bounds = {"CWP": 3, "W": 1, "P": 2}
    return [
        circuit_text(tree)
        for tree in all_trees(most, "RCWP")
        if (tree == "R" or (tree[0] == "S" and "R" in tree[1]))
        and all(count_of(tree, kinds) <= count for kinds, count in bounds.items())
    ]


TITLES = {
    4: "Cells: circuits of R, C and W with up to 4 elements",
    5: "Cells: R in series with up to 4 of R, C, W and P, at most three of them C, W or P",
}
KIND = Kind(
    name="cells",
    place=4,
    sizes=(4, 5),
    largest=5,
    text="one-ports of R, C and W, up to 4 elements; of 5: R in series with up to 4 of R, C, W, P",
    title=lambda n: TITLES[n],
    texts=lambda n, joint: cells(n) if n > 4 else circuits(n, "RCW", n),
    shipped=("cells-4", "cells-5"),
)
