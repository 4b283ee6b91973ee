"""One-ports of R, L and C."""

from collections import Counter
from collections.abc import Iterator
from functools import cache
from itertools import combinations, combinations_with_replacement, product

from disting.network.families.family import Kind

Tree = str | tuple[str, tuple["Tree", ...]]
"""A kind of element, or "S" or "P" and the parts in series or parallel."""


def circuits(most: int, kinds: str, most_reactive: int) -> list[str]:
    """Texts of the one-ports with up to so many elements, of which so many are L or C."""
    texts = [circuit_text(t) for t in all_trees(most, kinds) if count_of(t, "LC") <= most_reactive]
    return [*texts, *(_bridges(kinds, most_reactive) if most >= len(BRIDGE) else ())]


def all_trees(most: int, kinds: str) -> Iterator[Tree]:
    """Yield the circuits of up to so many elements, without bridges, each once."""
    for count in range(1, most + 1):
        yield from dict.fromkeys((*_trees(count, "S", kinds), *_trees(count, "P", kinds)))


@cache
def _trees(count: int, top: str, kinds: str) -> tuple[Tree, ...]:
    """Circuits of so many elements that are parts in series (or parallel), each once."""
    if count == 1:
        return tuple(kinds)
    other = "P" if top == "S" else "S"
    pairs = []
    for sizes in _partitions(count, count - 1):
        pools = []
        for size, times in sorted(Counter(sizes).items()):
            choose = combinations if size == 1 else combinations_with_replacement
            pools.append(list(choose(_trees(size, other, kinds), times)))
        pairs += [
            (top, tuple(part for group in chosen for part in group)) for chosen in product(*pools)
        ]
    return tuple(pairs)


def _partitions(count: int, most: int) -> Iterator[tuple[int, ...]]:
    if count == 0:
        yield ()
    for first in range(min(count, most), 0, -1):
        yield from ((first, *rest) for rest in _partitions(count - first, first))


def _letters(tree: Tree) -> str:
    return tree if isinstance(tree, str) else "".join(map(_letters, tree[1]))


def count_of(tree: Tree, kinds: str) -> int:
    """Number of elements of these kinds."""
    return sum(letter in kinds for letter in _letters(tree))


def circuit_text(tree: Tree) -> str:
    """Write a circuit, its elements numbered in order."""
    count = Counter[str]()

    def written(part: Tree) -> str:
        """A part, its elements numbered as they come."""
        if isinstance(part, str):
            count[part] += 1
            return f"{part}{count[part]}"
        parts = list(map(written, part[1]))
        return "-".join(parts) if part[0] == "S" else f"p({','.join(parts)})"

    return written(tree)


BRIDGE = ((1, 2), (1, 3), (2, 3), (2, 0), (3, 0))  # between the ends 1 and 0 of the port
TWINS = ((0, 1, 2, 3, 4), (1, 0, 2, 4, 3), (3, 4, 2, 0, 1), (4, 3, 2, 1, 0))


def _bridges(kinds: str, most_reactive: int) -> Iterator[str]:
    """Yield the bridges of five elements, each once; one of one kind alone is a single element."""
    names = set[str]()
    for chosen in product(kinds, repeat=len(BRIDGE)):
        form = min("".join(chosen[i] for i in twin) for twin in TWINS)
        if form in names or count_of(form, "LC") > most_reactive or len(set(form)) == 1:
            continue
        names.add(form)
        count, lines = Counter[str](), []
        for kind, (a, b) in zip(form, BRIDGE, strict=True):
            count[kind] += 1
            lines.append(f"{kind}{count[kind]} {a} {b}")
        yield "; ".join(lines)


KIND = Kind(
    name="circuits",
    place=3,
    sizes=(4, 5),
    largest=6,
    text="one-ports of R, L and C, up to N elements, at most two of them L or C; bridges of five",
    title=lambda n: f"Circuits of R, L and C with up to {n} elements, at most two of them L or C",
    texts=lambda n, joint: circuits(n, "RLC", 2),
    shipped=("circuits-4", "circuits-5"),
)
