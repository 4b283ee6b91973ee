"""Machines with springs anywhere, and what all families of machines are made with."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import combinations, permutations, product
from operator import mul

from disting.algebra.symbols import symbols
from disting.errors import InputError
from disting.model.chain import Quantity
from disting.network.expansion import transfer_functions
from disting.network.families.family import Kind
from disting.network.notation import network_of

Edge = tuple[int, int]
VALUES = (7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71, 73, 79, 83)


def machines(
    masses: int, joint: str, edges: Callable[[int], Iterable[Sequence[Edge]]]
) -> list[str]:
    """Texts of all machines with these sets of edges, up to numbering and reciprocity."""
    texts = dict[tuple[object, ...], str]()
    for joints in edges(masses):
        for force, sensor in product(combinations(range(masses + 1), 2), repeat=2):
            form = _form(masses, joints, force, sensor)
            if form not in texts and _is_whole(masses, joints, force, sensor):
                texts[form] = _machine(joints, force, sensor, joint)
    return list(texts.values())


def springs_anywhere(masses: int) -> Iterator[Sequence[Edge]]:
    """Yield the sets of springs between nodes, 0 being the ground, that leave no mass alone."""
    pairs = list(combinations(range(masses + 1), 2))
    for count in range(1, len(pairs) + 1):
        for chosen in combinations(pairs, count):
            if set(range(1, masses + 1)) <= {i for edge in chosen for i in edge}:
                yield chosen


def _form(masses: int, joints: Sequence[Edge], force: Edge, sensor: Edge) -> tuple[object, ...]:
    """The smallest of what renumbering and exchange of the ports make of it."""
    forms = []
    for order in permutations(range(1, masses + 1)):
        at = (0, *order)
        a, b, *rest = (tuple(sorted((at[i], at[j]))) for i, j in (force, sensor, *joints))
        forms.append((tuple(sorted(rest)), *sorted((a, b))))
    return min(forms)


def _is_whole(masses: int, joints: Sequence[Edge], force: Edge, sensor: Edge) -> bool:
    """Return True if the transfer function of positions has two poles for each mass, tested at one
    choice of values: at special ones it can have fewer, never more.
    """
    s = symbols(["s"])["s"]
    try:
        network = network_of(_machine(joints, force, sensor, "~"), quantity=Quantity.POSITION)
        values = {p: s**0 * x for p, x in zip(network.parameters, VALUES, strict=False)}
        (((num, den),),) = transfer_functions(network, {"s": s, **values}, "s", mul)
    except InputError:
        return False
    common = num.gcd(den)
    return not num.is_zero() and den.degrees()[0] - common.degrees()[0] == 2 * masses


def _machine(joints: Sequence[Edge], force: Edge, sensor: Edge, joint: str) -> str:
    runs = [f"{'#' if a == 0 else a}{joint}{b}" for a, b in joints]
    ends = [
        f"{letter}{b}" + (f":{a}" if a else "") for letter, (a, b) in (("F", force), ("S", sensor))
    ]
    return f"{', '.join(runs)}; {'; '.join(ends)}"


KIND = Kind(
    name="machines",
    place=1,
    sizes=(2, 3),
    largest=4,
    text="N masses, springs between them and to the ground, one at least at every mass",
    title=lambda n: f"Machines of {n} masses, springs anywhere",
    texts=lambda n, joint: machines(n, joint, springs_anywhere),
    has_dampers=True,
    shipped=("machines-2", "machines-2-damped", "machines-3", "machines-3-damped"),
    in_brief=("machines-3", "machines-3-damped"),
    with_loops=True,
)
