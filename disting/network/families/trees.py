"""Machines that are joined as a tree."""

from collections.abc import Iterator, Sequence
from itertools import combinations

from disting.network.families.family import Kind
from disting.network.families.machines import Edge, machines


def trees(masses: int) -> Iterator[Sequence[Edge]]:
    """Yield the trees of masses, free and with one spring to the ground."""
    pairs = list(combinations(range(1, masses + 1), 2))
    for chosen in combinations(pairs, masses - 1):
        if len(_reachable_from(1, chosen)) == masses:
            yield chosen
            yield from ((*chosen, (0, i)) for i in range(1, masses + 1))


def _reachable_from(start: int, edges: Sequence[Edge]) -> set[int]:
    nodes = {start}
    while more := {j for e in edges if nodes & set(e) for j in e} - nodes:
        nodes |= more
    return nodes


KIND = Kind(
    name="trees",
    place=2,
    sizes=(4,),
    largest=5,
    text="N masses joined as a tree, at most one spring to the ground",
    title=lambda n: f"Machines of {n} masses, joined as a tree",
    texts=lambda n, joint: machines(n, joint, trees),
    has_dampers=True,
    shipped=("trees-4",),
    in_brief=("trees-4",),
    with_loops=False,
)
