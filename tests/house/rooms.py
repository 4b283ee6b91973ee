"""The map of the rooms in `disting/guide/rooms.svg`, drawn from the imports of the package:
`python tests/house/rooms.py`.

A room is a folder of the package. A line leads from a room down to one that it imports; lines that
follow from others are left out.
"""

import ast
from collections.abc import Iterator
from pathlib import Path

import networkx as nx

PACKAGE = Path(__file__).parents[2] / "disting"
PICTURE = PACKAGE / "guide" / "rooms.svg"
WIDTH, BOX, HEIGHT, STEP = 640, 132, 30, 64  # of the picture, of a box, from floor to floor
WITHOUT_MODULES = {"guide", "shipped"}


def room_of(module: str) -> str | None:
    """The folder of a module such as disting.fit.select, None of what stands above all."""
    name = module.split(".")[1] if "." in module else ""
    return name if name and name not in WITHOUT_MODULES and (PACKAGE / name).is_dir() else None


def imported(path: Path) -> Iterator[str]:
    """Modules of the package that a file imports, anywhere in it, but for the list of public names
    of a package: `disting.fit` offers those of `planning` too, which stands above it.
    """
    tree = ast.parse(path.read_text(encoding="utf-8"))
    if path.name == "__init__.py":
        tree.body = [node for node in tree.body if not isinstance(node, ast.If)]
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


def rooms() -> nx.DiGraph:
    """Which room imports which."""
    graph = nx.DiGraph()
    for folder in sorted(PACKAGE.iterdir()):
        modules = sorted(folder.rglob("*.py")) if folder.is_dir() else []
        if not modules or folder.name in WITHOUT_MODULES:
            continue
        graph.add_node(folder.name)
        for path in modules:
            for name in imported(path):
                other = room_of(name) if name.startswith("disting.") else None
                if other and other != folder.name:
                    graph.add_edge(folder.name, other)
    return graph


def floors(graph: nx.DiGraph) -> list[list[str]]:
    """Rooms by floors, the ground floor last: each above all that it imports."""
    height: dict[str, int] = {}
    for room in reversed(list(nx.lexicographical_topological_sort(graph))):
        height[room] = 1 + max((height[below] for below in graph.successors(room)), default=-1)
    above = range(max(height.values()), -1, -1)
    return [sorted(room for room, at in height.items() if at == level) for level in above]


def picture(graph: nx.DiGraph) -> str:
    """The map as SVG."""
    levels, place = floors(graph), dict[str, tuple[float, float]]()
    for row, names in enumerate(levels):
        for column, name in enumerate(names):
            shift = 0.16 * WIDTH * (row % 2 - 0.5) if len(names) == 1 else 0.0
            place[name] = (WIDTH * (column + 0.5) / len(names) + shift, 24 + STEP * row)
    lines = []
    for above, below in sorted(nx.transitive_reduction(graph).edges):
        (x, y), (u, v) = place[above], place[below]
        y, v = y + HEIGHT / 2, v - HEIGHT / 2
        lines.append(f"M{x:.0f} {y:.0f}C{x:.0f} {y + 24:.0f} {u:.0f} {v - 24:.0f} {u:.0f} {v:.0f}")
    boxes = [
        f'<rect x="{x - BOX / 2:.0f}" y="{y - HEIGHT / 2:.0f}" width="{BOX}" height="{HEIGHT}" rx="6"/>'
        for x, y in place.values()
    ]
    labels = [
        f'<text x="{x:.0f}" y="{y + 4.5:.1f}">{name}</text>' for name, (x, y) in place.items()
    ]
    size = f"0 0 {WIDTH} {24 + STEP * (len(levels) - 1) + 24}"
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{size}"'
            ' font-family="system-ui, sans-serif" font-size="14" fill="none">',
            f'<path stroke="#0072b2" stroke-width="1.5" stroke-opacity=".7" d="{"".join(lines)}"/>',
            f'<g fill="var(--paper, Canvas)" stroke="#0072b2" stroke-width="1.5">{"".join(boxes)}</g>',
            f'<g fill="currentColor" text-anchor="middle">{"".join(labels)}</g>',
            "</svg>\n",
        ]
    )


if __name__ == "__main__":
    PICTURE.write_text(picture(rooms()), encoding="utf-8")
