"""Graphs of compartments."""

from itertools import combinations, permutations, product

from disting.network.families.family import Kind
from disting.network.outflows import reachable


def compartments(count: int) -> list[str]:
    """Texts of the graphs of so many compartments with one input and one output."""
    arrows = [(i, j) for i in range(1, count + 1) for j in range(count + 1) if i != j]
    entries = dict[tuple[object, ...], str]()
    for size in range(len(arrows) + 1):
        for flows in combinations(arrows, size):
            for enter, leave in product(range(1, count + 1), repeat=2):
                form = min(
                    (sorted((at[i], at[j]) for i, j in flows), at[enter], at[leave])
                    for order in permutations(range(1, count + 1))
                    for at in [(0, *order)]
                )
                key = (tuple(form[0]), *form[1:])
                back = [(j, i) for i, j in flows]
                ahead, behind = (reachable({i}, f, {0}) for i, f in ((enter, flows), (leave, back)))
                if key not in entries and len(ahead) == len(behind) == count:
                    phrase = ", ".join(f"{i}>{j}" for i, j in key[0])
                    entries[key] = f"{phrase}; in {key[1]}; out {key[2]}"
    return list(entries.values())


KIND = Kind(
    name="compartments",
    place=5,
    sizes=(2, 3),
    largest=4,
    text="N compartments with one input and one output, flows in any direction and to the outside",
    title=lambda n: f"{n} compartments with one input and one output",
    texts=lambda n, joint: compartments(n),
    shipped=("compartments-2", "compartments-3"),
    in_brief=("compartments-3",),
)
